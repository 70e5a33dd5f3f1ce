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

  /** "15 x 15 x 2". */
  std::string
  in_words(const std::array<unsigned int, 3> &cells);

  /** One model of a scene, and what came out of it. */
  struct Rung
  {
    static constexpr double undefined =
      std::numeric_limits<double>::quiet_NaN();

    Materials    materials; ///< of bone and implant
    unsigned int mesh = 0;  ///< doublings of the coarsest mesh
    Scene        scene;

    bool                   done = false;
    std::string            why_not; ///< it is not done
    std::vector<TorqueRow> rows;
    double                 seconds = 0;
    double difference = undefined; ///< largest, from the best rung, over T_max
    double estimate   = undefined; ///< of the error, over T_max

    bool
    is_foundation() const
    {
      return scene.model == ModelKind::foundation;
    }
    /** "foundation" or the richer of both materials. */
    std::string
    model() const;
    /** "linear, 15 x 15 x 2 and 3 x 3 x 2 cells". */
    std::string
    description() const;
    /** Unknowns of both bodies; none of those that are rigid. */
    double
    unknowns() const;
  };

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
    /** @p step_tolerance is that of the adaptive steps of all models. */
    ModelLadder(const Scene &scene, double step_tolerance);

    /** Materials from the poorest, two rigid bodies, to the scene's own. */
    const std::vector<Materials> &
    materials() const
    {
      return all_materials;
    }

    /** The richest that are not Neo-Hookean. */
    Materials
    linear_materials() const
    {
      return limited_to(Material::linear);
    }

    /** Finite elements. @p number: its results go to DIR/rung-NUMBER. */
    Rung
    finite_elements(unsigned int     number,
                    const Materials &materials,
                    unsigned int     mesh) const;

    /** The closed form with the linear solution on mesh 0. */
    Rung
    foundation(unsigned int number) const;

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
    /** Materials of the scene, none of them richer than @p limit. */
    Materials
    limited_to(Material limit) const;

    const Scene                                scene;
    const double                               step_tolerance;
    std::vector<Materials>                     all_materials;
    std::array<std::array<unsigned int, 3>, 2> coarsest;
  };
} // namespace Debond
#endif
