#ifndef debond_support_sample_statistics_h
#define debond_support_sample_statistics_h

#include <limits>
#include <vector>

namespace Debond
{
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

  /** Leaves out values that are not finite. A quantile p is linear between the
   *  order statistics: the smallest value belongs to p = 0, the largest to 1,
   *  and those between to equal distances (type 7 of Hyndman and Fan, American
   *  Statistician 50 (1996) 361-365; the default of R and NumPy). */
  SampleStatistics
  sample_statistics(std::vector<double> values);
} // namespace Debond
#endif
