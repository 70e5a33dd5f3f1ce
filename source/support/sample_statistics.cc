#include <debond/support/sample_statistics.h>

#include <boost/range/algorithm_ext/erase.hpp>

#include <algorithm>
#include <cmath>

namespace Debond
{
  SampleStatistics
  sample_statistics(std::vector<double> values)
  {
    boost::remove_erase_if(values,
                           [](const double x) { return !std::isfinite(x); });
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

    const auto quantile = [&values](const double p) {
      const double      position = p * (values.size() - 1);
      const std::size_t below    = std::floor(position);
      const std::size_t above    = std::min(below + 1, values.size() - 1);
      return values[below] +
             (position - below) * (values[above] - values[below]);
    };
    result.p05 = quantile(0.05);
    result.p50 = quantile(0.50);
    result.p95 = quantile(0.95);
    return result;
  }
} // namespace Debond
