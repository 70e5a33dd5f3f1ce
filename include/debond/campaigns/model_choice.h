#ifndef debond_campaigns_model_choice_h
#define debond_campaigns_model_choice_h

#include <debond/campaigns/model_ladder.h>
#include <debond/models/foundation.h>

#include <functional>
#include <string>
#include <vector>

namespace Debond
{
  /** "4.4 %", or "unknown". */
  std::string
  percent(double ratio);

  /**
   * Climbs the models of a ModelLadder from the cheapest until the error of one
   * of their torque curves is estimated to be within `Load steps / Tolerance`,
   * and answers with the cheapest one that is. The error is the largest
   * difference from the curve of the scene's own bodies on a converged mesh,
   * relative to the largest torque; doc/auto.md says how it is estimated. How a
   * model is run and what becomes of its results is for the caller to say.
   */
  class ModelChoice
  {
  public:
    /** Throws InputError, beginning with the name of the entry, if the scene
     *  has no torque curve that models could be compared by. */
    explicit ModelChoice(const Scene &scene);

    /** Tries the models. @p run fills Rung::rows, and Rung::estimate of the
     *  foundation, and throws if it cannot. @p report is called after each
     *  model, when its error is mostly not known yet. */
    void
    climb(const std::function<void(Rung &)>       &run,
          const std::function<void(const Rung &)> &report);

    /** Those that were tried, by cost. */
    const std::vector<Rung> &
    rungs() const
    {
      return tried;
    }
    /** The cheapest within the tolerance, else the best; none if no model could
     *  be run. */
    const Rung *
    answer() const;
    bool
    is_sufficient(const Rung &rung) const
    {
      return rung.done && rung.estimate <= tolerance;
    }
    /** Why the answer is no better than it is, in words. */
    std::string
    reason() const;

    /** Error of a foundation by itself, see foundation_error(). */
    double
    foundation_estimate(const Rung                &foundation,
                        const FoundationStiffness &stiffness) const;

    const double      tolerance;
    const ModelLadder ladder;

    /** Materials of the meshes that are refined. */
    const Materials &
    refined_materials() const
    {
      return refined;
    }

  private:
    void
    try_rung(Rung rung, const std::function<void(Rung &)> &run);
    const Rung *
    find(const Materials &materials, unsigned int mesh) const;
    const Rung *
    best() const;
    const Rung *
    sufficient() const;
    void
    estimate_errors();
    double
    linearisation_error() const;

    const double      step_error; ///< what steps contribute to an estimate
    std::vector<Rung> tried;
    std::string       why_no_further; ///< if the tolerance is not reached
    Materials         refined;
  };
} // namespace Debond
#endif
