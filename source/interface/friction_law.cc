#include <debond/interface/friction_law.h>

#include <algorithm>

namespace Debond
{
  // L, affine in phi, at the mean of phi over the distance: exactly int L dg_s
  // [N/mm]. Debonded friction, and the bond on top of it, whose part summed
  // over the face is D_adh, which does not depend on how a curve is read, as
  // the W_adh of Eq. (20) does. The balance that tells whether a step has
  // jumped compares it with the work of the machine: a trapezoid between the
  // two ends of a step would hold for any two states.
  PointWork
  FrictionLaw::work(const PointStart &start,
                    const double      pressure,
                    const double      distance) const
  {
    PointWork result;
    if (distance == 0.)
      return result;
    const double slip = start.history.slip,
                 mean =
                   start.bond_left() *
                   (decay(slip + distance).integral - decay(slip).integral) /
                   distance;
    result.friction = limit(start, mean, pressure, distance).value * distance;
    result.adhesive =
      result.friction - limit(start, 0., pressure, distance).value * distance;
    return result;
  }



  // dL/dphi is the same for all phi, and s falls steepest somewhere from g_s^n
  // on, whatever the distance slid in this step: the law does not depend on the
  // rate, so that what is ahead of a point is known. A bond that strengthens as
  // it breaks never falls.
  double
  FrictionLaw::steepest_fall(const PointStart &start,
                             const double      pressure,
                             const double      distance) const
  {
    const double by_bond =
      std::max(0., limit(start, 1., pressure, distance).by_bond);
    return by_bond * start.bond_left() * decay(start.history.slip).steepest;
  }
} // namespace Debond
