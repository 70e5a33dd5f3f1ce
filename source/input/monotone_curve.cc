#include <debond/input/monotone_curve.h>

#include <algorithm>

namespace Debond
{
  MonotoneCurve::MonotoneCurve(std::vector<double> x, std::vector<double> y)
    : abscissae(std::move(x))
    , values(std::move(y))
  {
    const std::size_t   n = abscissae.size();
    std::vector<double> length, chord;
    for (std::size_t i = 0; i + 1 < n; ++i)
      {
        length.push_back(abscissae[i + 1] - abscissae[i]);
        chord.push_back((values[i + 1] - values[i]) / length[i]);
      }
    slopes.assign(n, 0.); // that of an extreme value
    slopes.front() = chord.front();
    slopes.back()  = chord.back();
    for (std::size_t i = 1; i + 1 < n; ++i)
      if (chord[i - 1] * chord[i] > 0.)
        {
          const double before = length[i - 1] + 2. * length[i],
                       after  = 2. * length[i - 1] + length[i];
          slopes[i] =
            (before + after) / (before / chord[i - 1] + after / chord[i]);
        }
  }



  std::size_t
  MonotoneCurve::interval(const double x) const
  {
    return std::upper_bound(abscissae.begin() + 1, abscissae.end() - 1, x) -
           abscissae.begin() - 1;
  }



  // With s = (x - x_0) / h and D = y_1 - y_0 the cubic is
  //
  //   y_0 + s D + s (1 - s) ((1 - s) (h m_0 - D) - s (h m_1 - D)).
  double
  MonotoneCurve::operator()(const double x) const
  {
    if (x <= first())
      return values.front() + slopes.front() * (x - first());
    if (x >= last())
      return values.back() + slopes.back() * (x - last());
    const std::size_t i = interval(x);
    const double      h = abscissae[i + 1] - abscissae[i],
                 s = (x - abscissae[i]) / h, D = values[i + 1] - values[i];
    return values[i] + s * D +
           s * (1. - s) *
             ((1. - s) * (h * slopes[i] - D) - s * (h * slopes[i + 1] - D));
  }



  double
  MonotoneCurve::slope(const double x) const
  {
    if (x <= first() || x >= last())
      return x <= first() ? slopes.front() : slopes.back();
    const std::size_t i = interval(x);
    const double      h = abscissae[i + 1] - abscissae[i],
                 s      = (x - abscissae[i]) / h,
                 D      = (values[i + 1] - values[i]) / h;
    return D + (1. - s) * (1. - 3. * s) * (slopes[i] - D) +
           s * (3. * s - 2.) * (slopes[i + 1] - D);
  }
} // namespace Debond
