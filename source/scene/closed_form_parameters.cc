#include <debond/input/allowed_values.h>
#include <debond/scene/closed_form_parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace Debond
{
  void
  ClosedFormParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Closed form");
    prm.declare_entry("Pressure",
                      "0",
                      Allowed::number_from(0, "MPa"),
                      "Mean contact pressure p [MPa] during the rotation. 0: "
                      "that of Chuck / Translation z, which is either a force "
                      "or a depth times the normal stiffness.");
    prm.declare_entry("Normal stiffness",
                      "0",
                      Allowed::number_from(0, "MPa/mm"),
                      "Mean pressure per depth of push-in [MPa/mm], interface "
                      "and bodies in series. 0: from one linear solution with "
                      "the bodies of the scene.");
    prm.declare_entry("Torsional stiffness",
                      "0",
                      Allowed::number_from(0, "MPa/mm"),
                      "Stiffness lambda [MPa/mm] of the foundation that the "
                      "model foundation turns on, Eq. (39) of the paper: "
                      "traction per path while everything sticks, interface "
                      "and bodies in series. 0: from one linear solution with "
                      "the bodies of the scene.");
    prm.declare_entry("Linear limit angle",
                      "0.13",
                      Allowed::number_above(0, "deg"),
                      "Angle theta_lin [deg] of the model analytical at which "
                      "the rim begins to slide, Eq. (17).");
    prm.declare_entry("Full sliding angle",
                      "1.13",
                      Allowed::number_above(0, "deg"),
                      "Angle theta_max [deg] of the model analytical from "
                      "which on sliding wears the bond, Eq. (49).");
    prm.declare_entry(
      "Shear modulus",
      "40.4",
      Allowed::number_above(0, "MPa"),
      "Shear modulus G [MPa] of the half space in the model "
      "mathieu, Eq. (14). Fitted to a torque curve it comes out "
      "far below that of bone; the default is fitted to T_max "
      "and theta_max of the paper's data set 1.");
    prm.declare_entry("Adhesion energy",
                      "22.2",
                      Allowed::number_from(0, "N/m"),
                      "Adhesion energy w_adh [N/m] of the model mathieu, "
                      "Eq. (14), fitted as Shear modulus.");
    prm.leave_subsection();
  }



  void
  ClosedFormParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Closed form");
    pressure            = prm.get_double("Pressure");
    normal_stiffness    = prm.get_double("Normal stiffness");
    torsional_stiffness = prm.get_double("Torsional stiffness");
    linear_limit        = prm.get_double("Linear limit angle");
    full_sliding        = prm.get_double("Full sliding angle");
    shear_modulus       = prm.get_double("Shear modulus");
    adhesion_energy     = prm.get_double("Adhesion energy");
    prm.leave_subsection();
  }
} // namespace Debond
