#include <debond/interface/bond_friction.h>
#include <debond/interface/interface_law.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  PointStart
  InterfaceLaw::begin(const PointHistory &history,
                      const double        phi_0,
                      const double        duration,
                      const bool          frictionless) const
  {
    return {history, phi_0, duration, frictionless, history.damage};
  }



  void
  InterfaceLaw::ask_at_rest(PointStart &start) const
  {
    start.at_rest = coefficient(start, 0.);
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
    return friction->reported(begin(history, phi_0).friction());
  }



  // As if there were the other one alone.
  BondLeft
  InterfaceLaw::left_by_each(const PointHistory &history) const
  {
    PointHistory opening = history, slip = history;
    opening.slip = 0.;
    slip.damage  = 0.;
    slip.broken  = false;
    return {reported(opening, 1.).phi, reported(slip, 1.).phi};
  }



  // The law is integrated over the distance, with the pressure between its two
  // ends. Of the friction the bond has its part, int (mu - mu_b) dg_s: D_adh,
  // which tells what the adhesion costs without reading it off the torque curve
  // as Eq. (20) does. What the mean pressure can be wrong by, and a speed that
  // changes within the step, keeps a fast but stable fall from being reported
  // as a jump.
  PointWork
  InterfaceLaw::work_of_friction(const PointStart &start,
                                 const double      p,
                                 const double      p_end,
                                 const double      distance) const
  {
    if (start.frictionless || distance == 0.)
      return {};
    const FrictionState state = start.friction();
    const double        mean  = 0.5 * (p + p_end),
                 per_pressure = friction->friction_strength(state, distance);
    PointWork result;
    result.friction       = mean * per_pressure;
    result.friction_bound = 0.5 * std::abs(p - p_end) * per_pressure;
    if (depends_on_rate())
      result.friction_bound += mean * friction->strength_bound(state, distance);
    if (friction->has_bond())
      result.adhesive =
        mean * (per_pressure - friction->mu_without_bond() * distance);
    return result;
  }



  // -dmu/dg_s where it is largest, from the accepted g_s on, times p.
  double
  InterfaceLaw::softening_by_slip(const PointStart &start,
                                  const double      pressure,
                                  const double      distance) const
  {
    return explicit_friction ?
             0. :
             friction->steepest_fall(start.friction(), distance) *
               std::max(0., pressure);
  }



  std::shared_ptr<const BondFriction>
  bond_that_opens(const InterfaceLawParts &parts, const std::string &law)
  {
    if (parts.opening_breaks_bond)
      throw EntryError("Interface / Opening breaks bond",
                       "with Law = " + law +
                         " opening breaks a bond by as much as the law says: "
                         "expected false",
                       "true");
    auto bond = std::dynamic_pointer_cast<const BondFriction>(parts.friction);
    if (!bond || parts.explicit_friction)
      throw EntryError("Interface / Law",
                       "the law " + law +
                         " needs a friction law whose bond breaks with the "
                         "slip: modified coulomb, coulomb, frictionless or "
                         "table, with Friction update = implicit");
    return bond;
  }
} // namespace Debond
