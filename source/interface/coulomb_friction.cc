#include <debond/input/allowed_values.h>
#include <debond/input/entry_table.h>
#include <debond/interface/modified_coulomb.h>

#include <algorithm>
#include <cmath>

// The friction law of the paper, and Coulomb's as a special case of it. Points
// first stick to the interface by an elastic spring; this file says what limits
// the traction of that spring, as a function of the pressure p [MPa] and of the
// distance g_s [mm] that a point has slid.
namespace Debond
{
  void
  ModifiedCoulomb::declare_coefficients(EntryTable &table)
  {
    // 0 is for faces without friction; anything else below 1e-9 is taken for a
    // slip of the pen
    const AllowedValues allowed =
      Allowed::number_between(1e-9, 1e6, "").or_number(0).without_default();
    if (coefficients == Coefficients::one)
      table.add("Friction coefficient",
                parameters.mu_broken,
                allowed,
                "Coefficient mu of Friction law = coulomb, dimensionless.");
    if (coefficients != Coefficients::two)
      return;
    table.add("Friction coefficient broken",
              parameters.mu_broken,
              allowed,
              "Friction coefficient mu_b of a debonded point, dimensionless. "
              "Used by modified coulomb and table.");
    table.add(
      "Friction coefficient unbroken",
      parameters.mu_unbroken,
      allowed,
      "Coefficient mu_ub of a fully bonded point, dimensionless. Used by "
      "modified coulomb and table, not with Law = mixed mode.");
  }



  // All parameters as they are given. What they would have to be is a matter of
  // calibration: the paper finds them from measured torque curves for given
  // mu_b. Allowed values keep a_s and b_s above zero, by which Eq. (13)
  // divides.
  void
  ModifiedCoulomb::declare(EntryTable &table)
  {
    declare_coefficients(table);
    table.add("Characteristic slip distance",
              parameters.sliding_threshold,
              Allowed::number_between(1e-9, 1e6, "mm").without_default(),
              "Characteristic slip distance a_s [mm]: sliding distance up to "
              "which a point stays fully bonded. Used by modified coulomb, and "
              "by coulomb with Law = adhesive; not with Law = mixed mode.");
    table.add("Transition factor",
              parameters.transition_factor,
              Allowed::number_between(1e-9, 1e6, "").without_default(),
              "Factor b_s, dimensionless: a point is fully debonded once it "
              "has slid (1 + 2 b_s) a_s. Used where Characteristic slip "
              "distance is.");
  }



  void
  ModifiedCoulomb::initialise()
  {
    if (coefficients == Coefficients::one) // no bond changes it
      parameters.mu_unbroken = parameters.mu_broken;
    if (coefficients == Coefficients::none)
      parameters.mu_broken = parameters.mu_unbroken = 0.;
    // this is more than mu = 0, with which the viscosity still resists
    is_frictionless = coefficients == Coefficients::none;
    // s and its slope are continuous there, its curvature is not
    const double a_s = parameters.sliding_threshold,
                 b_s = parameters.transition_factor;
    kinks            = {a_s, a_s * (1. + 2. * b_s)};
    // The shorter of the two stages [mm]: the bond holds over a_s and falls
    // over 2 b_s a_s. The largest step along a path of equilibrium is a
    // twentieth of it where the scene does not say.
    characteristic_distance =
      is_frictionless ? PointHistory::far : a_s * std::min(1., 2. * b_s);
    // of the steepest slope pi / (4 a_s b_s)
    entries_against_fall = "Characteristic slip distance or Transition factor";
  }



  // Eqs. (11) and (30): mu is mu_ub where the bond is whole and mu_b where it
  // is gone. phi never rises, since g_s never falls and s never rises: damage
  // does not heal.
  //
  // The law is implicit: phi is that at the end of the step, after g_s^n plus
  // what the point slides in it, Eq. (32). So softening follows the slip
  // without the lag of a step, and Newton's method needs dL/dphi. phi of g_s^n
  // instead would leave the torque of the main scene in 50 steps too high by up
  // to 4.4 % of the largest while the bond softens, right at its maximum and at
  // the end (doc/explanation/contact.md, Stick and slip).
  FrictionLimit
  ModifiedCoulomb::limit(const PointStart &,
                         const double phi,
                         const double pressure,
                         const double) const
  {
    const double drop = parameters.mu_unbroken - parameters.mu_broken,
                 mu   = parameters.mu_broken + phi * drop;
    return {mu * pressure, mu, drop * pressure, 0.};
  }



  // Eq. (13), with x = g_s/a_s: the bond holds up to x = 1, is gone from x = 1
  // + 2 b_s on, and falls along half a sine in between, smoothly at both ends,
  // so that the slope [1/mm] is continuous. Where it is 0 the point follows
  // Coulomb's law.
  //
  // The integral is there for the work of adhesion, which a trapezoid over a
  // step would miss by the curvature of s. Over the whole decay it is (1 + b_s)
  // a_s: as if the bond held fully up to the middle of the fall, by symmetry of
  // the sine. Under the pressure p a bond costs phi_0 (mu_ub - mu_b) p (1 +
  // b_s) a_s per area [N/mm].
  //
  // The largest slope that is still ahead, pi / (4 a_s b_s) up to the middle of
  // the fall, gives the bound of local uniqueness, p / eps_t < 4 a_s b_s / (pi
  // phi_0 (mu_ub - mu_b)) (doc/explanation/stability.md). A point before the
  // middle is judged by the middle already, so that a large step does not jump
  // over it unnoticed. A short fall is a brittle bond: the torque of the main
  // scene falls by less than 1 N m/rad, far less than any machine is stiff;
  // with a_s = 0.005 mm and b_s = 0.3 it is 8.9 N m/rad for rigid bodies, and a
  // compliant machine may snap back.
  Decay
  ModifiedCoulomb::decay(const double slip) const
  {
    const double a_s = parameters.sliding_threshold,
                 b_s = parameters.transition_factor, x = slip / a_s,
                 steepest = 0.25 * M_PI / (a_s * b_s);
    if (is_frictionless) // nothing wears it
      return {1., 0., slip, 0.};
    if (x < 1.)
      return {1., 0., slip, steepest};
    if (x > 1. + 2. * b_s)
      return {0., 0., a_s * (1. + b_s), 0.};
    // from -pi/2 to pi/2 over the fall, 0 in its middle, x = 1 + b_s; the slope
    // carries the 1/a_s of the inner derivative
    const double argument = 0.5 * M_PI / b_s * (x - b_s - 1.),
                 cosine = std::cos(argument), slope = -steepest * cosine;
    return {0.5 * (1. - std::sin(argument)),
            slope,
            a_s * (0.5 * (1. + x) + b_s / M_PI * cosine),
            argument < 0. ? steepest : -slope};
  }



  // For programs and tests, without a scene; the plug-ins below make the same
  // from entries. Laws are shared and never change: all points refer to one
  // object.
  FrictionLawPointer
  modified_coulomb(const ModifiedCoulombParameters     parameters,
                   const ModifiedCoulomb::Coefficients coefficients)
  {
    const auto law =
      std::make_shared<ModifiedCoulomb>(parameters, coefficients);
    law->initialise();
    return law;
  }



  // Three names of one class. With the first a closed point is projected on the
  // master, without a tangential traction.
  FrictionLawPlugin
  frictionless_plugin()
  {
    return {"frictionless",
            "no friction",
            ModifiedCoulomb({}, ModifiedCoulomb::Coefficients::none)};
  }



  // Eq. (8). It is what the debonded implant slides with at the end of the
  // paper's test.
  FrictionLawPlugin
  coulomb_plugin()
  {
    return {"coulomb",
            "constant, Friction coefficient",
            ModifiedCoulomb({}, ModifiedCoulomb::Coefficients::one)};
  }



  FrictionLawPlugin
  modified_coulomb_plugin()
  {
    return {"modified coulomb",
            "falls from Friction coefficient unbroken to broken with the "
            "accumulated sliding distance of a point (Eqs. 11 to 13 of the "
            "paper)",
            ModifiedCoulomb()};
  }
} // namespace Debond
