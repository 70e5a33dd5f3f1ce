#include <debond/input/entry_table.h>
#include <debond/interface/interface_parameters.h>
#include <debond/support/input_error.h>

namespace Debond
{
  void
  InterfaceParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Interface");
    table.add("Slave",
              slave,
              Allowed::choice("bone | implant"),
              "The body whose contact face carries the quadrature points; they "
              "are projected onto the face of the other.");
    table.add("Quadrature points",
              quadrature_points,
              Allowed::whole_number(1, 64),
              "Gauss points per direction and slave surface element.");
    table.add("Penalty stiffness",
              normal_penalty,
              Allowed::number_between(1e-6, 1e15, "MPa/mm"),
              "Normal stiffness eps_n [MPa/mm] of the interface: pressure per "
              "penetration.");
    table.add("Tangential penalty stiffness",
              tangential_penalty,
              Allowed::number_between(1e-6, 1e15, "MPa/mm").or_number(0),
              "Tangential stiffness eps_t [MPa/mm] of the interface. 0: the "
              "same as the normal one.");
    declare_friction(table);
    table.add("Opening breaks bond",
              opening_breaks_bond,
              Allowed::yes_or_no(),
              "Whether a bonded point that opens is debonded for good. `false' "
              "is the law of the paper, which has no strength in tension and "
              "forgets that the point was open.");
    declare_variants(table);
    bonding.declare(table);
    table.leave_subsection();
  }



  void
  InterfaceParameters::declare_friction(EntryTable &table)
  {
    table.add(
      "Friction law",
      friction.kind,
      Allowed::choice("frictionless | coulomb | modified coulomb"),
      "`frictionless': no tangential traction. `coulomb': the constant "
      "coefficient Friction coefficient broken. `modified coulomb': the "
      "coefficient falls from its unbroken to its broken value as the "
      "accumulated sliding distance of a point grows (Eqs. 11 to 13 of the "
      "paper).");
    table.add("Friction coefficient broken",
              friction.mu_broken,
              Allowed::number_between(1e-9, 1e6, "").or_number(0),
              "Coefficient mu_b of a debonded point, dimensionless; the "
              "coefficient of plain coulomb.");
    table.add("Friction coefficient unbroken",
              friction.mu_unbroken,
              Allowed::number_between(1e-9, 1e6, "").or_number(0),
              "Coefficient mu_ub of a fully bonded point, dimensionless. Only "
              "used by modified coulomb.");
    table.add("Sliding threshold",
              friction.sliding_threshold,
              Allowed::number_between(1e-9, 1e6, "mm"),
              "Sliding distance a_s [mm] up to which a point stays fully "
              "bonded. Only used by modified coulomb.");
    table.add("Transition factor",
              friction.transition_factor,
              Allowed::number_between(1e-9, 1e6, ""),
              "Factor b_s, dimensionless: a point is fully debonded once it "
              "has slid (1 + 2 b_s) a_s. Only used by modified coulomb.");
    table.add(
      "Friction starts at",
      friction.starts_at,
      Allowed::number("time"),
      "Time before which the interface is frictionless, for instance to press "
      "the implant in without locking tangential traction in.");
  }



  void
  InterfaceParameters::declare_variants(EntryTable &table)
  {
    table.add(
      "Viscosity",
      viscosity,
      Allowed::number_between(1e-15, 1e15, "MPa per (mm per unit of time)")
        .or_number(0),
      "Viscosity eta [MPa per (mm per unit of time)] of sliding: a point that "
      "slides with the speed v carries mu p + eta v. One that sticks carries "
      "none of it, nor one without friction. With it a bond that would break "
      "in a jump breaks in time instead: the local solution is unique while |d "
      "mu/d g_s| p is below the tangential penalty stiffness plus eta over the "
      "(sub-)step's duration. Time is then more than a parameter of the load: "
      "results depend on the rate. Must be 0 with Friction law = "
      "frictionless.");
    table.add(
      "Slip direction",
      slip_along_previous_gap,
      Allowed::choice("trial | previous gap"),
      "Direction in which a sliding point is pulled. `trial': that of the gap "
      "which it would have without sliding in this step. `previous gap': that "
      "of the step before, Eq. (31) as printed, which can never turn; it is "
      "there to show what that leads to.");
    table.add(
      "Friction update",
      explicit_friction,
      Allowed::choice("implicit | explicit"),
      "`implicit': the friction coefficient belongs to the sliding distance at "
      "the end of the step. `explicit': to that at its beginning, so that a "
      "softening bond lags behind by a step; it is there to show what that "
      "costs.");
  }



  void
  InterfaceParameters::check(const BodyParameters &implant) const
  {
    if (friction.kind == FrictionLawKind::frictionless && viscosity != 0.)
      throw EntryError("Interface / Viscosity",
                       "it is not used by Friction law = frictionless: it "
                       "belongs to laws with friction");
    bonding.check(implant);
  }
} // namespace Debond
