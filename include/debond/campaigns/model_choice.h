#ifndef debond_campaigns_model_choice_h
#define debond_campaigns_model_choice_h

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <array>
#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

namespace Debond
{
  /** "rigid", "linear" or "neo-hookean". */
  std::string
  name_of(Material material);

  /** Cells of a body: "15 x 15 x 2", or "fitted 16 x 6 x 10 x 9". */
  std::string
  in_words(const BodyParameters &body);

  /** A model of a scene, and what came out of it. */
  struct ModelLevel
  {
    static constexpr double undefined =
      std::numeric_limits<double>::quiet_NaN();

    Scene        scene;    ///< with the bodies and the mesh of this model
    unsigned int mesh = 0; ///< doublings of the coarsest mesh

    std::vector<TorqueRow> rows;    ///< none: it could not be run
    std::string            why_not; ///< it could not
    double                 seconds = 0;
    double difference = undefined; ///< largest, from the best level, over T_max
    double estimate   = undefined; ///< of the error, over T_max

    bool
    is_foundation() const
    {
      return scene.model == ModelKind::foundation;
    }
    /** Those of bone and implant. */
    std::array<Material, 2>
    materials() const
    {
      return {{scene.bone.material, scene.implant.material}};
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
   * The models that `Model = auto` tries, from the cheapest: the closed form;
   * bodies from rigid ones to those of the scene, on mesh 0; these on meshes
   * with twice the cells in every direction, and again. Mesh 0 is that of the
   * scene, or a half, a quarter ... of it as long as all numbers of cells are
   * even and 15 cells across the bone, 3 across the implant and 2 layers stay.
   */
  struct ModelLadder
  {
    /** Throws EntryError if the scene has no torque curve that models could be
     *  compared by. */
    explicit ModelLadder(const Scene &scene);

    std::vector<ModelLevel> levels;
    std::string             why_no_further;
  };

  /** Largest |T - T_reference| relative to the largest |T_reference|: the
   *  `difference_max` of summary.json, at the rows of both curves. Only angles
   *  that both have and that are beyond zero in the sense of the rotation. NaN
   *  if no such row is left or if one of the curves turns back. */
  double
  largest_difference(const std::vector<TorqueRow> &rows,
                     const std::vector<TorqueRow> &reference);

  /**
   * Error of the finest of several meshes, each of which has half the cell size
   * of the one before, from the @p differences between neighbours, coarsest
   * first: that of order one, and from the second difference on of the order
   * that is observed, but at most two; 1.25 times as a reserve. NaN if the
   * observed order is below one half: meshes that do not converge tell nothing.
   */
  double
  discretisation_error(const std::vector<double> &differences);

  /** `Model = auto`: runs models from the cheapest until one will do. Results
   *  of the answer are then in the scene's directory, those of every level in
   *  DIR/rung-1 and so on, and auto.csv lists them. If the tolerance was not
   *  reached the answer is the best model, and summary.json says so. Throws
   *  what ModelLadder does. */
  void
  run_auto(const Scene &scene);

  /** Prints which models it would try. */
  void
  check_auto(const Scene &scene, std::ostream &out);
} // namespace Debond
#endif
