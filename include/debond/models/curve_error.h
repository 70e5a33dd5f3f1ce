#ifndef debond_models_curve_error_h
#define debond_models_curve_error_h

#include <debond/output/torque_curve.h>

#include <vector>

namespace Debond
{
  /** Largest |T - T_reference| relative to the largest |T_reference|: the
   *  `difference_max` of summary.json, at the rows of both curves. Only angles
   *  that both have and that are beyond zero in the sense of the rotation, and
   *  only rows with more than 1 % of their curve's largest torque. NaN if no
   *  such row is left or if one of the curves turns back. */
  double
  largest_difference(const std::vector<TorqueRow> &rows,
                     const std::vector<TorqueRow> &reference);

  /**
   * Error of the finest of several meshes, each of which has half the cell size
   * of the one before, from the @p differences between neighbours, coarsest
   * first: that of order one, and from the second difference on of the order
   * that is observed, but at most two; 1.25 times as a reserve. NaN if the
   * observed order is below one half: meshes that do not converge tell nothing.
   */
  double
  discretisation_error(const std::vector<double> &differences);
} // namespace Debond
#endif
