#include <debond/input/allowed_values.h>
#include <debond/interface/interface_parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace Debond
{
  namespace
  {
    void
    declare_regularisation(dealii::ParameterHandler &prm)
    {
      prm.declare_entry(
        "Viscosity",
        "0",
        Allowed::number_from(0, "MPa per (mm per unit of time)"),
        "Viscosity eta [MPa per (mm per unit of time)] of sliding: a point that "
        "slides with the speed v carries mu p + eta v. One that sticks carries "
        "none of it, nor one without friction. With it a bond that would break "
        "in a jump breaks in time instead: the local solution is unique while "
        "|d mu/d g_s| p is below the tangential penalty stiffness plus eta "
        "over the (sub-)step's duration. Time is then more than a parameter "
        "of the load: results depend on the rate. Must be 0 with Friction law = "
        "frictionless.");
    }



    void
    declare_variants(dealii::ParameterHandler &prm)
    {
      prm.declare_entry(
        "Slip direction",
        "trial",
        Allowed::choice("trial | previous gap"),
        "Direction in which a sliding point is pulled. `trial': that of the "
        "gap which it would have without sliding in this step. `previous gap': "
        "that of the step before, Eq. (31) as printed, which can never turn; "
        "it is there to show what that leads to.");
      prm.declare_entry(
        "Friction update",
        "implicit",
        Allowed::choice("implicit | explicit"),
        "`implicit': the friction coefficient belongs to the sliding distance "
        "at the end of the step. `explicit': to that at its beginning, so that "
        "a softening bond lags behind by a step; it is there to show what that "
        "costs.");
    }
  } // namespace



  void
  InterfaceParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Interface");
    prm.declare_entry("Slave",
                      "implant",
                      Allowed::choice("implant | bone"),
                      "The body whose contact face carries the quadrature "
                      "points; they are projected onto the face of the other.");
    prm.declare_entry("Quadrature points",
                      "5",
                      Allowed::whole_number(1, 64),
                      "Gauss points per direction and slave surface element.");
    prm.declare_entry("Penalty stiffness",
                      "585",
                      Allowed::number_above(0, "MPa/mm"),
                      "Normal stiffness eps_n [MPa/mm] of the interface: "
                      "pressure per penetration.");
    prm.declare_entry("Tangential penalty stiffness",
                      "0",
                      Allowed::number_from(0, "MPa/mm"),
                      "Tangential stiffness eps_t [MPa/mm] of the interface. "
                      "0: the same as the normal one.");
    declare_friction_laws(prm);
    prm.declare_entry("Friction starts at",
                      "0",
                      Allowed::number("time"),
                      "Time before which the interface is frictionless, for "
                      "instance to press the implant in without locking "
                      "tangential traction in.");
    prm.declare_entry("Opening breaks bond",
                      "false",
                      Allowed::yes_or_no(),
                      "Whether a bonded point that opens is debonded for good. "
                      "`false' is the law of the paper, which has no strength "
                      "in tension and forgets that the point was open.");
    declare_regularisation(prm);
    declare_variants(prm);
    BondingParameters::declare(prm);
    prm.leave_subsection();
  }



  void
  InterfaceParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Interface");
    slave = prm.get("Slave") == "bone" ? Side::bone : Side::implant;
    quadrature_points   = prm.get_integer("Quadrature points");
    normal_penalty      = prm.get_double("Penalty stiffness");
    opening_breaks_bond = prm.get_bool("Opening breaks bond");
    normal              = penalty_law(normal_penalty, opening_breaks_bond);
    tangential_penalty  = prm.get_double("Tangential penalty stiffness");
    if (tangential_penalty == 0)
      tangential_penalty = normal_penalty;
    viscosity               = prm.get_double("Viscosity");
    slip_along_previous_gap = prm.get("Slip direction") == "previous gap";
    explicit_friction       = prm.get("Friction update") == "explicit";
    friction                = create_friction_law(prm);
    friction_starts_at      = prm.get_double("Friction starts at");
    bonding.parse(prm);
    prm.leave_subsection();
  }
} // namespace Debond
