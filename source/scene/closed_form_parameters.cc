#include <debond/input/entry_table.h>
#include <debond/scene/closed_form_parameters.h>

namespace Debond
{
  void
  ClosedFormParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Closed form");
    table.add("Pressure",
              pressure,
              Allowed::number_between(1e-9, 1e12, "MPa").or_number(0),
              "Mean contact pressure p [MPa] during the rotation. 0: that of "
              "Chuck / Translation z, which is either a force or a depth times "
              "the normal stiffness.");
    table.add("Normal stiffness",
              normal_stiffness,
              Allowed::number_between(1e-6, 1e15, "MPa/mm").or_number(0),
              "Mean pressure per depth of push-in [MPa/mm], interface and "
              "bodies in series. 0: from one linear solution with the bodies "
              "of the scene.");
    table.add("Torsional stiffness",
              torsional_stiffness,
              Allowed::number_between(1e-6, 1e15, "MPa/mm").or_number(0),
              "Stiffness lambda [MPa/mm] of the foundation that the model "
              "foundation turns on, Eq. (39) of the paper: traction per path "
              "while everything sticks, interface and bodies in series. 0: "
              "from one linear solution with the bodies of the scene.");
    table.add("Linear limit angle",
              linear_limit,
              Allowed::number_between(1e-9, 1e6, "deg"),
              "Angle theta_lin [deg] of the model analytical at which the rim "
              "begins to slide, Eq. (17).");
    table.add("Full sliding angle",
              full_sliding,
              Allowed::number_between(1e-9, 1e6, "deg"),
              "Angle theta_max [deg] of the model analytical from which on "
              "sliding wears the bond, Eq. (49).");
    table.add("Shear modulus",
              shear_modulus,
              Allowed::number_between(1e-6, 1e12, "MPa"),
              "Shear modulus G [MPa] of the half space in the model mathieu, "
              "Eq. (14). Fitted to a torque curve it comes out far below that "
              "of bone; the default is fitted to T_max and theta_max of the "
              "paper's data set 1.");
    table.add("Adhesion energy",
              adhesion_energy,
              Allowed::number_between(1e-12, 1e12, "N/m").or_number(0),
              "Adhesion energy w_adh [N/m] of the model mathieu, Eq. (14), "
              "fitted as Shear modulus.");
    table.leave_subsection();
  }
} // namespace Debond
