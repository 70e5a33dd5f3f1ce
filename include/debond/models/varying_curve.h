#pragma once

#include <debond/output/torque_curve.h>
#include <debond/scene/varying_scene.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  struct BodyPair;
  class Simulation;

  /**
   * The curve of a scene some of whose entries change again and again, as while
   * they are fitted. What an entry does not change is kept: the scene is not
   * read again, and the bodies are not condensed again. What @p changed says
   * holds until the next call. Not for several threads at a time.
   */
  class VaryingCurve
  {
  public:
    /** Throws InputError. The scene's reference curve is not read. */
    VaryingCurve(const std::vector<SceneEntry> &entries,
                 const std::string             &name);

    /** Refuses what is not allowed, or makes no sense together: throws
     *  EntryError. */
    void
    check(const std::vector<SceneEntry> &changed);

    /** Why the disk on a foundation does not predict torque and axial force of
     *  this scene; empty if it does. */
    std::string
    why_no_closed_form() const;

    /** By how much the bodies make the interface more compliant [mm/MPa],
     *  pressed and turned. One linear solution of finite elements, or nothing
     *  if bodies are rigid. Throws InputError. */
    std::array<double, 2>
    compliance_of_bodies(const std::vector<SceneEntry> &changed);

    /** The closed form `foundation`, whose bodies have this compliance: the
     *  torque [N mm] at each of these angles [deg], and the force along z [N].
     *  Throws EntryError. */
    std::pair<Eigen::VectorXd, double>
    by_foundation(const std::vector<SceneEntry> &changed,
                  const std::array<double, 2>   &compliance,
                  const std::vector<double>     &angles);

    /** Ends of the steps of each phase that a run with adaptive steps chooses,
     *  finer than for the curve alone; none for other scenes. Runs that take
     *  the same steps give curves that change smoothly with the entries. */
    std::vector<std::vector<double>>
    steps_of(const std::vector<SceneEntry> &changed);

    /** The rows of the scene's own model, or points of the curve between them;
     *  with these steps if there are any. Throws InputError and RunError. */
    std::vector<TorqueRow>
    by_scene(const std::vector<SceneEntry>          &changed,
             const std::vector<std::vector<double>> &ends_of_steps);

  private:
    const Scene &
    take(const std::vector<SceneEntry> &changed);
    std::unique_ptr<Simulation>
    run(const Scene &now);

    VaryingScene              scene;
    const Scene               given;
    std::string               bulk_entries; ///< of the bodies that are kept
    std::shared_ptr<BodyPair> bodies, linear_bodies;
  };
} // namespace Debond
