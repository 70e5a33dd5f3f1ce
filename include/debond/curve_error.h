#ifndef debond_curve_error_h
#define debond_curve_error_h

#include <debond/torque_curve.h>

#include <vector>

namespace Debond
{
  /** Largest |T - T_reference| over all angles that both curves have, relative
   *  to the largest |T_reference|: the `difference_max` of summary.json at the
   *  rows of both. NaN if they have no angle in common or if one of them turns
   *  back. */
  double
  largest_difference(const std::vector<TorqueRow> &rows,
                     const std::vector<TorqueRow> &reference);

  /**
   * Error of the finest of several meshes, each of which has half the cell size
   * of the one before, from the @p differences between neighbours, coarsest
   * first: that of order one, and from the second difference on of the order
   * that is observed, but at most two and at least one half; 1.25 times as a
   * reserve.
   */
  double
  discretisation_error(const std::vector<double> &differences);
} // namespace Debond
#endif
