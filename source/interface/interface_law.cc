#include <debond/interface/interface_law.h>

#include <algorithm>

namespace Debond
{
  InterfaceLaw::InterfaceLaw(const InterfaceLawParts &parts)
    : stiffness(parts.stiffness)
    , friction(parts.friction)
    , opening_breaks_bond(parts.opening_breaks_bond)
  {}



  PointStart
  InterfaceLaw::begin(const PointHistory &history,
                      const double        phi_0,
                      const double        duration,
                      const bool          frictionless) const
  {
    PointStart start{
      history, phi_0, duration, frictionless, history.damage, {}};
    if (!frictionless)
      start.at_rest = friction->coefficient(start.friction(), 0.);
    return start;
  }



  // g_s grows by the distance, Eq. (32), and what else the friction law
  // remembers goes on with it: a state may age at rest. Before friction starts
  // neither does.
  PointHistory
  InterfaceLaw::advance(const PointStart &start,
                        const double      g_n,
                        const double      distance) const
  {
    PointHistory history = start.history;
    history.normal_gap   = g_n;
    history.joined       = history.joined || g_n < 0.;
    if (!start.frictionless)
      {
        history.slip     = start.history.slip + distance;
        history.internal = friction->advance(start.friction(), distance);
      }
    return history;
  }



  // An open point carries nothing, but does not forget how far it has slid:
  // damage does not heal. In the paper's law a point that closes again is
  // bonded as before; once broken, a bond stays so.
  PointHistory
  InterfaceLaw::open(const PointHistory &history) const
  {
    PointHistory result = history;
    result.normal_gap   = PointHistory::far;
    result.broken       = history.broken || opening_breaks_bond;
    return result;
  }



  FrictionCoefficient
  InterfaceLaw::reported(const PointHistory &history, const double phi_0) const
  {
    return friction->reported(
      PointStart{history, phi_0, 0., false, history.damage, {}}.friction());
  }



  // A point cannot slide against what pulls it. Where Newton's method looks
  // there, at negative distances, mu goes on along its tangent, but never
  // rises: the distance alone would have a second solution there where
  // friction rises with the speed, a rise one where it falls steeply.
  FrictionCoefficient
  InterfaceLaw::coefficient(const PointStart &start,
                            const double      distance) const
  {
    if (start.frictionless)
      return {};
    FrictionCoefficient result =
      distance > 0. ? friction->coefficient(start.friction(), distance) :
                      start.at_rest;
    if (distance < 0.)
      {
        result.dmu = std::max(0., result.dmu);
        result.mu += result.dmu * distance;
      }
    return result;
  }
} // namespace Debond
