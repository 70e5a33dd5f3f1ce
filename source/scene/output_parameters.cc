#include <debond/input/entry_table.h>
#include <debond/scene/output_parameters.h>
#include <debond/scene/reference_data.h>
#include <debond/support/input_error.h>

#include <limits>

namespace Debond
{
  namespace
  {
    void
    declare_references(OutputParameters &parameters, EntryTable &table)
    {
      table.add("Reference curve",
                parameters.reference_curve,
                Allowed::optional_text("the name of a CSV file"),
                "CSV file with the columns angle_deg,torque_Nmm to compare the "
                "torque curve with; empty: none.");
      table.add("Reference profiles",
                parameters.reference_profiles,
                Allowed::optional_text("the name of a CSV file"),
                "CSV file with the columns angle_deg, x_mm, y_mm, area_mm2, "
                "pressure_MPa and slip_mm, as profiles.csv of another run, to "
                "compare local values with at those of its angles that Profile "
                "angles has; empty: none.");
    }
  } // namespace



  void
  OutputParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Output");
    table.add("Directory",
              directory,
              Allowed::directory(),
              "Directory for the results, relative to the working directory; "
              "created if missing. One that holds results of another scene is "
              "refused without --force. The name is taken as it is: no quotes, "
              "and no ~ or $ at its beginning.");
    table.add("Fields every",
              fields_every,
              Allowed::whole_number(0, std::numeric_limits<int>::max()),
              "Planned steps between VTU files, counted from the beginning of "
              "each phase, whose end is always written; 0: no VTU files.");
    declare_references(*this, table);
    table.add("Full sliding angle",
              full_sliding_angle,
              Allowed::number_from(0, "deg"),
              "Angle theta_full [deg] from which on E_fric is counted. 0: the "
              "last angle with a torque of at least 0.999 of the largest.");
    table.add("Observed bonding",
              observed_bonding,
              Allowed::number_between(0, 1, ""),
              "Mean phi_0 that w_adh refers to, Eq. (21), where it was "
              "observed and differs from that of the scene; 0: that of the "
              "scene.");
    table.add("Profile angles",
              profile_angles,
              Allowed::list(Allowed::number_above(0, "deg"), 0, 0),
              "Angles [deg] at which pressure, traction, sliding distance and "
              "friction coefficient of all points of the interface are written "
              "into profiles.csv, each at the first planned step that reaches "
              "it; empty: none.");
    table.add("Friction law curve",
              friction_law_curve,
              Allowed::yes_or_no(),
              "Write phi and mu over the sliding distance g_s into "
              "friction_law.csv.");
    table.add("Checkpoint every",
              checkpoint_every,
              Allowed::whole_number(0, std::numeric_limits<int>::max()),
              "Planned steps between checkpoints, from which `debond --resume "
              "DIR' goes on with results that are the same to the last bit; "
              "where rows are accepted steps, number of rows. 0: only when "
              "SIGINT, SIGTERM or SIGHUP interrupts the run. For Model = "
              "finite elements.");
    table.add("Console",
              console,
              Allowed::choice("steps | quiet"),
              "`steps': lines about the steps (a hundred if very many are "
              "planned), progress and timings. `quiet': warnings and errors "
              "only.");
    table.leave_subsection();
  }



  void
  OutputParameters::check() const
  {
    read_reference_curve(reference_curve);
    read_profiles(reference_profiles);
    if (!reference_profiles.empty() && profile_angles.empty())
      throw EntryError("Output / Reference profiles",
                       "it needs Output / Profile angles to compare at");
  }
} // namespace Debond
