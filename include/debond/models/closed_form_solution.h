#pragma once

#include <debond/models/closed_forms.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <iosfwd>
#include <memory>
#include <vector>

namespace dealii
{
  class Timer;
}

namespace Debond
{
  /**
   * A scene solved with the closed form that it asks for instead of finite
   * elements. Closed forms know one loading, a coin that is pressed down and
   * then turned, ever further, under constant pressure; scenes that ask for
   * more are refused. Nothing is written and nothing is printed.
   */
  struct ClosedFormSolution
  {
    /** Throws EntryError if the closed form does not apply to the scene. */
    explicit ClosedFormSolution(const Scene &scene);

    const Scene scene;
    /** Those of the foundation [MPa/mm], 0 where the model needs none. */
    double normal_stiffness = 0, torsional_stiffness = 0;

    std::unique_ptr<TorsionModel> model;
    /** What the machine has jumped over at the end; empty if it is rigid. */
    std::vector<CompliantMachineTorsion::Jump> jumps;
    /** A row per planned step or, with adaptive steps, as many as the tolerance
     *  needs. What a closed form does not know is NaN. */
    std::vector<TorqueRow> rows;

    /** What the measures of the torque curve refer to. */
    CurveSettings
    curve_settings() const;
  };

  /** Writes the files of a solution into the directory of its scene: those of
   *  finite elements, with what closed forms know. @p clock was started before
   *  the solution. */
  void
  write_results(const ClosedFormSolution &solution, const dealii::Timer &clock);

  /** The disk of `Model = foundation` under the load at the end of a scene that
   *  has this closed form, on a foundation with these stiffnesses [MPa/mm].
   *  Throws EntryError if it has no pressure, or if its bond breaks in a jump.
   */
  TorsionModel::Disk
  foundation_disk(const Scene &scene,
                  double       normal_stiffness,
                  double       torsional_stiffness);

  /** Why closed forms do not know what the chuck of a scene does; empty: they
   *  do. */
  std::string
  why_no_closed_form(const Scene &scene);

  /** What `--check` says of it. */
  void
  describe(const ClosedFormSolution &solution, std::ostream &out);
} // namespace Debond
