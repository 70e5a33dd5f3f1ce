#ifndef debond_support_sample_statistics_h
#define debond_support_sample_statistics_h

#include <limits>
#include <vector>

namespace Debond
{
  /**
   * Quantile of a sample that is sorted in ascending order, linear between the
   * order statistics: the smallest value belongs to @p p = 0, the largest to
   * 1, and those between to equal distances (type 7 of Hyndman and Fan,
   * American Statistician 50 (1996) 361-365; the default of R and NumPy). NaN
   * if the sample is empty.
   */
  double
  quantile(const std::vector<double> &sorted, double p);

  /** What a sample amounts to, in the unit of its values. */
  struct SampleStatistics
  {
    static constexpr double undefined =
      std::numeric_limits<double>::quiet_NaN();

    unsigned int n    = 0;
    double       mean = undefined;
    double       sd   = undefined; ///< with n - 1; NaN below two values
    double       p05 = undefined, p50 = undefined, p95 = undefined;
  };

  /** Leaves out values that are not finite. */
  SampleStatistics
  sample_statistics(std::vector<double> values);
} // namespace Debond
#endif
