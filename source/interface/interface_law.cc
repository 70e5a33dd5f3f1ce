#include <debond/interface/interface_law.h>
#include <debond/support/input_error.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>

// The law of the paper across and along the interface: a spring that pushes,
// and friction under its pressure. What other laws have in common with it is
// here, too: the friction law is asked in rub(), and nowhere else.
namespace Debond
{
  bool
  InterfaceLaw::initialise()
  {
    characteristic_distance = friction->characteristic_distance;
    return true;
  }



  InterfaceLawPointer
  initialised(const std::shared_ptr<InterfaceLaw> &law)
  {
    // A law whose parameters leave friction alone, such as a bond without
    // strength, is no law of its own: points then take the shortest way.
    return law->initialise() ?
             law :
             initialised(std::make_shared<InterfaceLaw>(*law));
  }



  InterfaceLawPointer
  friction_under_pressure(const double              stiffness,
                          const FrictionLawPointer &friction)
  {
    const auto law = std::make_shared<InterfaceLaw>();
    law->stiffness = stiffness;
    law->friction  = friction;
    return initialised(law);
  }



  // Eq. (28) along the normal, t_n = eps_n g_n n: a spring that pushes, p =
  // -eps_n g_n > 0, while g_n < 0; and Eq. (30), L of this pressure. The
  // compliance 1/eps_n is a property of the interface, not a numerical device:
  // in the paper's test it is most of the compliance of the whole.
  InterfaceResponse
  InterfaceLaw::answer(const PointStart &start,
                       const double      g_n,
                       const double      distance) const
  {
    const BoneLayer::Push push = this->push(start, g_n, distance);
    InterfaceResponse     result;
    result.pressure        = push.pressure;
    result.pressure_by_gap = push.by_gap;
    result.energy          = push.energy; // the potential
    result.resists         = result.pressure > 0.;
    if (result.resists)
      rub(start,
          distance,
          Changing(result.pressure, result.pressure_by_gap, 0.),
          bond_after(start, distance),
          result);
    return result;
  }



  // No interface carries more shear than the bone beside it. Interface and bone
  // are in series: both carry the same traction, and what slides is the weaker
  // one. In a step the faces slide by d_f, as far as it takes until friction
  // and viscosity together hold tau_b,
  //
  //   L(d_f) + eta/dt d_f = tau_b,
  //
  // and the rest of the distance is sliding in the bone, which leaves g_s as it
  // is, unless that is to wear the bond, too. Where friction alone holds tau_b
  // at rest d_f is 0; where it never holds that much d_f is all of the
  // distance, and nothing of this is seen. A law that softens within the step
  // from above tau_b to below it so slides in the bone to its end: the bond has
  // not slid yet, and cannot have softened.
  //
  // The traction is tau_b, whatever gap and distance, so that its derivatives
  // vanish. Faces that climb as they slide are pushed apart by d_f only, which
  // depends on the gap by the equation above: hence the additional dp/dg_n.
  InterfaceResponse
  InterfaceLaw::respond_in_bone(const PointStart &start,
                                const double      g_n,
                                const double      distance) const
  {
    const double tau_b = bone.shear_strength;
    const auto   total = [&](const InterfaceResponse &at, const double d) {
      return at.limit + (at.resists ? start.viscous * d : 0.);
    };
    InterfaceResponse result        = answer(start, g_n, distance);
    result.rubbed                   = distance;
    const InterfaceResponse at_rest = answer(start, g_n, 0.);
    const bool              holds   = at_rest.limit >= tau_b;
    if (total(result, distance) <= tau_b &&
        (!holds || bone.shear_wears_bond || distance < 0.))
      return result;
    if (distance < 0.) // it cannot; see rub()
      {
        result.limit        = tau_b;
        result.limit_by_gap = result.limit_by_slip = 0.;
        return result;
      }
    double rubbed = 0.;
    if (!holds)
      {
        std::uintmax_t iterations = 100;
        rubbed                    = boost::math::tools::toms748_solve(
                   [&](const double d) {
                     return total(answer(start, g_n, d), d) - tau_b;
                   },
                   0.,
                   distance,
                   at_rest.limit - tau_b,
                   total(result, distance) - tau_b,
                   boost::math::tools::eps_tolerance<double>(),
                   iterations)
                   .first;
      }
    if (!bone.shear_wears_bond)
      {
        result = answer(start, g_n, rubbed);
        // the faces slide as far as friction takes to reach tau_b
        const double slope =
          result.limit_by_slip + (result.resists ? start.viscous : 0.);
        if (rubbed > 0. && !result.resists) // as far as viscosity sets in
          result.pressure_by_gap = 0.;
        else if (rubbed > 0. && slope != 0.)
          result.pressure_by_gap -=
            result.pressure_by_slip * result.limit_by_gap / slope;
        result.pressure_by_slip = 0.;
      }
    result.shears = true;
    result.rubbed = rubbed;
    result.limit  = tau_b - (result.resists ? start.viscous * rubbed : 0.);
    result.limit_by_gap = result.limit_by_slip = result.limit_by_damage = 0.;
    return result;
  }



  // Before friction starts slip does not count, and nothing wears what lies
  // behind a point.
  InterfaceLaw::Changing
  InterfaceLaw::bond_after(const PointStart &start, const double distance) const
  {
    // phi of Eq. (13) at the end of the step, as (value, by gap, by distance).
    // A law asks for it several times at the place where the step begins, which
    // is why that decay comes along with the point, see begin().
    const bool   rests = start.frictionless || explicit_friction;
    const Decay  s     = rests || distance <= 0. ?
                           start.at_rest :
                           friction->decay(start.history.slip + distance);
    const double phi_0 = start.bond_left();
    return {phi_0 * s.value, 0., rests || distance < 0. ? 0. : phi_0 * s.slope};
  }



  // A point cannot slide against what pulls it. Where Newton's method looks
  // there, at negative distances, L goes on along its tangent (without a part
  // of the bond), but never rises: the distance alone would have a second
  // solution there where friction rises with the speed. dL/dp goes with L, as
  // for laws whose coefficient does not depend on the pressure.
  void
  InterfaceLaw::rub(const PointStart  &start,
                    const double       distance,
                    const Changing    &pressed,
                    const Changing    &phi,
                    InterfaceResponse &response) const
  {
    if (start.frictionless)
      return;
    // The only place at which the friction law is asked for L: by the pressure
    // and the bonding state that the law of the interface sees. Chain rule,
    // with pressed = (p, dp/dg_n, dp/dd) and phi likewise:
    //
    //   dL/dg_n = L_p dp/dg_n + L_phi dphi/dg_n,
    //   dL/dd   = L_d + L_phi dphi/dd + L_p dp/dd.
    const FrictionLimit L =
      friction->limit(start,
                      phi[0],
                      pressed[0],
                      explicit_friction ? 0. : std::max(0., distance));
    double factor = 1., by_slip = 0.; // under the same pressure
    if (!explicit_friction)
      by_slip = L.by_slip + L.by_bond * phi[2];
    if (distance < 0.)
      {
        by_slip = std::max(0., by_slip);
        if (L.value != 0.)
          factor += by_slip * distance / L.value;
      }
    response.limit = factor * L.value;
    response.limit_by_gap =
      factor * L.by_pressure * pressed[1] + L.by_bond * phi[1];
    response.limit_by_slip = by_slip + L.by_pressure * pressed[2];
  }



  // g_s grows by the distance, Eqs. (12) and (32), and what else the friction
  // law remembers goes on with it: a state may age at rest. Before friction
  // starts neither does.
  PointHistory
  InterfaceLaw::advance(const PointStart &start,
                        const double      g_n,
                        const double      distance) const
  {
    PointHistory history = start.history;
    history.normal_gap   = g_n;
    // pressed together once, the faces of a law with strength in tension are
    // bonded
    const double gap = gap_left(start, g_n, distance);
    history.joined   = history.joined || gap < 0.;
    history.crushed  = push(start, g_n, distance).crushed;
    if (!start.frictionless)
      {
        history.slip     = start.history.slip + distance;
        history.internal = friction->advance(start, distance);
      }
    if (start.history.crushed == 0.)
      history.crushed_at = slid(history);
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



  // The law is integrated over the distance, with the pressure between its two
  // ends. Of the friction the bond has its part, D_adh, which tells what the
  // adhesion costs without reading it off the torque curve as Eq. (20) does.
  // What the pressure can be wrong by, and a speed that changes within the
  // step, keeps a fast but stable fall from being reported as a jump.
  PointWork
  InterfaceLaw::work(const PointStart &start,
                     const double      g_n,
                     const double      distance) const
  {
    PointWork result;
    if (start.frictionless || distance == 0.)
      return result;
    // [N/mm] at the gaps of both ends; an open end has rubbed at no pressure
    const auto at = [&](const double pressure) {
      return pressure > 0. ? friction->work(start, pressure, distance) :
                             PointWork();
    };
    const PointWork first = at(pressed(start, start.history.normal_gap, 0.)),
                    last  = at(pressed(start, g_n, distance));
    result.friction       = 0.5 * (first.friction + last.friction);
    result.friction_bound = 0.5 * (std::abs(first.friction - last.friction) +
                                   first.friction_bound + last.friction_bound);
    result.adhesive       = 0.5 * (first.adhesive + last.adhesive);
    return result;
  }



  // Where L falls steepest, from the accepted g_s on.
  double
  InterfaceLaw::softening_by_slip(const PointStart &start,
                                  const double      pressure,
                                  const double      distance) const
  {
    // [MPa/mm] at the pressure of the trial state. The explicit law has no
    // slope within a step; nothing that does not press softens.
    return explicit_friction || !(pressure > 0.) ?
             0. :
             friction->steepest_fall(start, pressure, distance);
  }



  FrictionCoefficient
  InterfaceLaw::reported(const PointHistory &history,
                         const double        phi_0,
                         const double        pressure) const
  {
    // an open point has that of 1 MPa
    return friction->coefficient(begin(history, phi_0),
                                 0.,
                                 pressure > 0. ? pressure : 1.);
  }



  // As if there were the other one alone.
  std::array<double, 2>
  InterfaceLaw::left_by_each(const PointHistory &history) const
  {
    // For maps of what opening and slip have each done to a bond, at phi_0 = 1.
    PointHistory opening = history, slip = history;
    opening.slip = 0.;
    slip.damage  = 0.;
    slip.broken  = false;
    return {{reported(opening, 1., 0.).phi, reported(slip, 1., 0.).phi}};
  }



  void
  InterfaceLaw::require_bond(const std::string &law) const
  {
    // A law with strength in tension says itself what opening does to the bond
    // of the friction law, and multiplies its own damage into phi: there must
    // be a bond, and no second rule for its end.
    if (opening_breaks_bond)
      throw EntryError("Interface / Opening breaks bond",
                       "with Law = " + law +
                         " opening breaks a bond by as much as the law says: "
                         "expected false",
                       "true");
    if (!(friction->decay(0.).value > 0.) || explicit_friction)
      throw EntryError("Interface / Law",
                       "the law " + law +
                         " needs a friction law whose bond breaks with the "
                         "slip: modified coulomb, coulomb, frictionless or "
                         "a table that begins with a bond, with Friction "
                         "update = implicit");
  }



  // That of the paper; others derive from it.
  InterfaceLawPlugin
  friction_interface_law_plugin()
  {
    return {"friction",
            "friction under pressure, no strength in tension (the paper)",
            InterfaceLaw()};
  }
} // namespace Debond
