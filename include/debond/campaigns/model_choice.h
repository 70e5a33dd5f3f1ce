#ifndef debond_campaigns_model_choice_h
#define debond_campaigns_model_choice_h

#include <debond/campaigns/model_hierarchy.h>

#include <functional>
#include <string>
#include <vector>

namespace Debond
{
  /** Largest |T - T_reference| relative to the largest |T_reference|: the
   *  `difference_max` of summary.json, at the rows of both curves. Only angles
   *  that both have and that are beyond zero in the sense of the rotation, and
   *  only rows with more than 1 % of their curve's largest torque. NaN if no
   *  such row is left or if one of the curves turns back. */
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

  /** "4.4 %", or "unknown". */
  std::string
  percent(double ratio);

  /**
   * Runs the models of a ModelHierarchy from the cheapest until the error of
   * one of their torque curves is estimated to be within `Load steps /
   * Tolerance`, and answers with the cheapest one that is. The error is the
   * largest difference from the curve of the scene's own bodies on a converged
   * mesh, relative to the largest torque; doc/auto.md says how it is estimated.
   */
  class ModelChoice
  {
  public:
    /** Throws EntryError if the scene has no torque curve that models could be
     *  compared by. */
    explicit ModelChoice(const Scene &scene);

    /** Tries the models, each in a directory DIR/rung-1 and so on. @p report is
     *  called after each of them, when its error is mostly not known yet. */
    void
    climb(const std::function<void(const ModelLevel &)> &report);

    /** Those that were tried, by cost. */
    const std::vector<ModelLevel> &
    levels() const
    {
      return tried;
    }
    /** The cheapest within the tolerance, else the best; none if no model could
     *  be run. */
    const ModelLevel *
    answer() const;
    bool
    is_sufficient(const ModelLevel &level) const
    {
      return level.done && level.estimate <= tolerance;
    }
    /** Why the answer is no better than it is, in words. */
    std::string
    reason() const;

    const double         tolerance;
    const ModelHierarchy hierarchy;

  private:
    void
    run(ModelLevel &level) const;
    void
    try_level(ModelLevel level);
    const ModelLevel *
    find(const Materials &materials, unsigned int mesh) const;
    const ModelLevel *
    best() const;
    const ModelLevel *
    sufficient() const;
    void
    estimate_errors();
    double
    linearisation_error() const;

    const double            step_error; ///< what steps add to an estimate
    std::vector<ModelLevel> tried;
    std::string             why_no_further; ///< if the tolerance is not reached
    Materials               refined;        ///< those of the finer meshes
  };
} // namespace Debond
#endif
