#ifndef debond_interface_mean_slip_h
#define debond_interface_mean_slip_h

#include <debond/interface/nodal_sums.h>
#include <debond/interface/slave_point.h>

namespace Debond
{
  /** Area mean of the sliding distance g_s over the contact face [mm], and its
   *  derivatives with respect to the positions of the control points of both
   *  surfaces, in space. */
  struct MeanSlip
  {
    double    value = 0;
    NodalSums gradient;
  };

  /** Of @p points in their trial states. */
  MeanSlip
  mean_slip(const std::vector<SlavePoint> &points,
            Side                           slave,
            const InterfaceConfiguration  &configuration,
            bool                           frictionless);
} // namespace Debond
#endif
