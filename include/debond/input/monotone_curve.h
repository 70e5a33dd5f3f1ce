#pragma once

#include <vector>

namespace Debond
{
  /**
   * A curve through the rows of a table: cubics whose slopes at the rows are
   * the weighted harmonic means of those of the chords beside them (Fritsch and
   * Butland), at both ends that of the chord. It is monotone where the rows
   * are, its slope is continuous, and two rows make a straight line, which goes
   * on beyond the first and the last row of any table.
   */
  class MonotoneCurve
  {
  public:
    /** Two rows or more; @p x is strictly ascending. */
    MonotoneCurve(std::vector<double> x, std::vector<double> y);

    /** The value at @p x, which at rows is theirs to the last bit. */
    double
    operator()(double x) const;
    /** Its derivative with respect to @p x. */
    double
    slope(double x) const;

    double
    first() const
    {
      return abscissae.front();
    }
    double
    last() const
    {
      return abscissae.back();
    }

  private:
    /** The interval that @p x lies in, or is next to. */
    std::size_t
    interval(double x) const;

    std::vector<double> abscissae, values, slopes;
  };
} // namespace Debond
