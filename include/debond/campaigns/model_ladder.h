#ifndef debond_campaigns_model_ladder_h
#define debond_campaigns_model_ladder_h

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace Debond
{
  /** The materials of bone and implant. */
  using Materials = std::array<Material, 2>;

  /** "rigid", "linear" or "neo-hookean". */
  std::string
  name_of(Material material);

  /** One model of a scene, and what came out of it. */
  struct Rung
  {
    static constexpr double undefined =
      std::numeric_limits<double>::quiet_NaN();

    std::string  model;     ///< "foundation" or the richer of both materials
    Materials    materials; ///< of bone and implant
    unsigned int mesh = 0;  ///< doublings of the coarsest mesh
    Scene        scene;

    bool                   done = false;
    std::string            why_not; ///< it is not done
    std::vector<TorqueRow> rows;
    double                 seconds = 0;
    double difference = undefined; ///< largest, from the best rung, over T_max
    double estimate   = undefined; ///< of the error, over T_max

    /** "linear, 15 x 15 x 2 and 3 x 3 x 2 cells". */
    std::string
    description() const;
    /** Unknowns of both bodies. */
    double
    unknowns() const;
  };

  /** Number of unknowns of a body and, roughly, of those that contact reaches,
   *  from its cells; none if it is rigid. */
  double
  predicted_unknowns(const BodyParameters &body);

  /**
   * The models that `Model = auto` may choose among: the scenes that they are.
   * Meshes are numbered from 0, the coarsest; each has twice the cells of the
   * one before in every direction. The coarsest is that of the scene, or a
   * half, a quarter ... of it as long as all numbers of cells are even and the
   * mesh keeps 15 cells across the bone, 3 across the implant and 2 layers.
   */
  class ModelLadder
  {
  public:
    explicit ModelLadder(const Scene &scene);

    /** Materials from the poorest, two rigid bodies, to the scene's own. */
    const std::vector<Materials> &
    materials() const
    {
      return all_materials;
    }

    /** The richest that are not Neo-Hookean. */
    Materials
    linear_materials() const;

    /** Finite elements; @p step_tolerance is that of their adaptive steps. */
    Rung
    finite_elements(unsigned int     number,
                    const Materials &materials,
                    unsigned int     mesh,
                    double           step_tolerance) const;

    /** The closed form with the linear solution on mesh 0. */
    Rung
    foundation(unsigned int number, double step_tolerance) const;

    /** The scene with half the cells of mesh 0, rounded up, for the linear
     *  solution only. @p ratio of cell sizes: the smallest of all directions.
     */
    Scene
    below_coarsest(double &ratio) const;

    /** Why this mesh is more than a computer can be asked for; empty if it is
     *  not. */
    std::string
    limit(const Materials &materials, unsigned int mesh) const;

  private:
    Scene
    with(const std::vector<std::string> &overrides, unsigned int number) const;
    std::vector<std::string>
    cells(unsigned int mesh) const;

    const Scene                                scene;
    std::vector<Materials>                     all_materials;
    std::array<std::array<unsigned int, 3>, 2> coarsest;
  };
} // namespace Debond
#endif
