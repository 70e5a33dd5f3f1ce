#include <debond/support/sample_statistics.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  double
  quantile(const std::vector<double> &sorted, const double p)
  {
    if (sorted.empty())
      return SampleStatistics::undefined;
    const double      position = p * (sorted.size() - 1);
    const std::size_t below    = std::floor(position);
    const std::size_t above    = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (position - below) * (sorted[above] - sorted[below]);
  }



  SampleStatistics
  sample_statistics(std::vector<double> values)
  {
    values.erase(std::remove_if(values.begin(),
                                values.end(),
                                [](const double x) {
                                  return !std::isfinite(x);
                                }),
                 values.end());
    std::sort(values.begin(), values.end());

    SampleStatistics result;
    result.n = values.size();
    if (result.n == 0)
      return result;
    // relative to one of them, so that equal values have no deviation
    const double origin = values.front();
    double       sum = 0., squares = 0.;
    for (const double x : values)
      sum += x - origin;
    result.mean = origin + sum / result.n;
    for (const double x : values)
      squares += std::pow(x - result.mean, 2);
    if (result.n > 1)
      result.sd = std::sqrt(squares / (result.n - 1));
    result.p05 = quantile(values, 0.05);
    result.p50 = quantile(values, 0.50);
    result.p95 = quantile(values, 0.95);
    return result;
  }
} // namespace Debond
