#ifndef debond_campaigns_fit_statistics_h
#define debond_campaigns_fit_statistics_h

#include <debond/campaigns/curve_fit.h>

#include <string>
#include <vector>

namespace Debond
{
  /** What is known of an unknown after a fit. */
  struct FittedUnknown
  {
    double best = 0;
    /** Of the 95 % interval; infinite where the curves do not tell. */
    double lower = 0, upper = 0;
    bool   at_bound = false; ///< its best value is one of its bounds
  };

  /** Unknowns that the curves cannot tell apart: if they change together by
   *  these parts of themselves, the curves stay nearly the same. */
  struct FlatDirection
  {
    Eigen::VectorXd changes; ///< relative, the largest is 1 in magnitude
    double          effect;  ///< on the curves, over their largest value
  };

  /** How far computed curves are from measured ones. */
  struct CurveMisfit
  {
    std::string name; ///< of the column
    /** Eq. (19), rows above a hundredth of the largest value, and with a noise
     *  that is not above it. */
    double e_mp;
    double e_rel; ///< Eq. (50), same rows
    double rms;   ///< over the largest measured value
    /** Correlation of neighbouring residuals, over their noise. */
    double correlation;
  };

  /**
   * What least squares say of unknowns at the best fit: the curves are taken to
   * be straight in them, or in their logarithms, and the residuals to be
   * independent and normal,
   *
   *   covariance = s^2 (J^T J)^-1,
   *
   * with s = 1 if the noise is known and s^2 = sum r^2 / (rows - unknowns) if
   * not. Intervals have the quantiles of Student's distribution. Unknowns at
   * their bounds count as known.
   */
  class FitStatistics
  {
  public:
    FitStatistics(const Misfit          &misfit,
                  const Eigen::VectorXd &best,
                  const Evaluation      &at_best);

    std::vector<FittedUnknown> unknowns;
    Eigen::MatrixXd            correlations;
    std::vector<FlatDirection> flat;
    std::vector<CurveMisfit>   curves;
    double                     s     = 0; ///< of a residual
    double                     e_rel = 0; ///< the largest of all curves
    /** Standard deviation that the unknowns give to the predicted values, and
     *  half the width of their 95 % band. */
    Eigen::VectorXd sd_of_values, band;
    /** What a user has to know. */
    std::vector<std::string> warnings;

    /** Half widths of the 95 % intervals, as searched, if another experiment
     *  with these derivatives over standard deviations were done, too;
     *  infinite where neither tells, 0 for an unknown at its bound. */
    Eigen::VectorXd
    intervals_with(const Eigen::MatrixXd &derivatives) const;

    /** Half width of the 95 % interval as searched; infinite. */
    Eigen::VectorXd half_widths;

  private:
    /** Intervals for what is no sum of squares: fits to residuals that are
     * drawn anew block by block, with curves that are straight in the unknowns.
     */
    void
    bootstrap(const Misfit &misfit, const Eigen::VectorXd &values);
    void
    judge_unknowns(const Misfit &misfit, const Eigen::VectorXd &best);
    void
    judge_residuals(const Misfit &misfit, const Eigen::VectorXd &values);
    /** s^2 (J^T J)^-1, from the singular values. */
    struct Covariance
    {
      Eigen::MatrixXd finite; ///< without what the curves do not tell
      /** With a variance for that, too, that is far larger than all others. */
      Eigen::MatrixXd   whole;
      std::vector<bool> is_bounded; ///< whether the curves tell an unknown

      double
      half_width(unsigned int j, double quantile) const;
    };
    Covariance
    covariance_of(const Eigen::MatrixXd &jacobian) const;

    Eigen::MatrixXd   jacobian; ///< by what is searched, over noise
    std::vector<bool> is_free;
    double            quantile   = 0;
    double            flat_limit = 0;
  };

  /** "Sliding threshold +1 % and Transition factor -0.5 %", or in words that
   *  only their product or their ratio counts. */
  std::string
  text_of(const FlatDirection &direction, const Unknowns &unknowns);
} // namespace Debond
#endif
