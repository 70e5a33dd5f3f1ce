// The curve through the rows of a table: at rows their values to the last bit,
// monotone in between, with a continuous slope that is that of its values. Two
// rows make a straight line, and the ends go on as such.

#include <debond/input/monotone_curve.h>

#include <algorithm>
#include <vector>

#include "checks.h"

int
main()
{
  const std::vector<double> x{-1., 0.5, 0.7, 2., 5., 5.5, 9.},
    y{10., 11., 30., 30., 31., 12., 37.};
  const Debond::MonotoneCurve curve(x, y);
  bool                        through = true;
  double                      outside = 0, slope = 0, jump = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    through = through && curve(x[i]) == y[i];
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    {
      const auto [least, most] = std::minmax(y[i], y[i + 1]);
      const double h           = x[i + 1] - x[i];
      for (unsigned int k = 1; k < 200; ++k)
        {
          const double at = x[i] + h * k / 200., d = 1e-6 * h;
          grow(outside, std::max(least - curve(at), curve(at) - most));
          grow(slope,
               h * std::abs(curve.slope(at) -
                            (curve(at + d) - curve(at - d)) / (2. * d)));
        }
      grow(jump,
           std::abs(curve.slope(x[i + 1]) - curve.slope(x[i + 1] - 1e-9 * h)));
    }
  report("goes through the rows", through);
  report("  and not beyond them in between", outside, 1e-13);
  report("  slope and differences, deviation", slope, 1e-6);
  report("  jump of the slope at rows", jump, 1e-5);
  report("constant where the rows are", curve(1.3) == 30.);
  report("goes on with the slopes at the ends",
         curve(-2.) == 10. - 1. / 1.5 && curve(10.) == 37. + 25. / 3.5);

  const Debond::MonotoneCurve line({1., 4.}, {-2., 7.});
  double                      bent = 0;
  for (double at = 0.; at < 5.; at += 0.1)
    {
      grow(bent, std::abs(line(at) - (3. * at - 5.)));
      grow(bent, std::abs(line.slope(at) - 3.));
    }
  report("two rows make a straight line, deviation", bent, 1e-14);
}
