#include <debond/input/entry_table.h>
#include <debond/scene/scene.h>

#include <limits>

namespace Debond
{
  namespace
  {
    void
    declare_closed_form(ClosedFormParameters &closed_form, EntryTable &table)
    {
      table.enter_subsection("Closed form");
      table.add(
        "Pressure",
        closed_form.pressure,
        Allowed::number_between(1e-9, 1e12, "MPa").or_word_for("auto", "0"),
        "Mean contact pressure p [MPa] during the rotation. `auto': that of "
        "Chuck / Press, which is either a force or a depth times the normal "
        "stiffness.");
      table.add("Normal stiffness",
                closed_form.normal_stiffness,
                Allowed::number_between(1e-6, 1e15, "MPa/mm")
                  .or_word_for("auto", "0"),
                "Mean pressure per depth of push-in [MPa/mm], interface and "
                "bodies in series. `auto': from one linear solution with the bodies "
                "of the scene.");
      table.add("Torsional stiffness",
                closed_form.torsional_stiffness,
                Allowed::number_between(1e-6, 1e15, "MPa/mm")
                  .or_word_for("auto", "0"),
                "Stiffness lambda [MPa/mm] of the foundation that the model "
                "foundation turns on, Eq. (39) of the paper: traction per path "
                "while everything sticks, interface and bodies in series. "
                "`auto': from one linear solution with the bodies of the scene.");
      table.add(
        "Linear limit angle",
        closed_form.linear_limit,
        Allowed::number_between(1e-9, 1e6, "deg"),
        "Angle theta_lin [deg] of the model prescribed angles at which the rim "
        "begins to slide, Eq. (17).");
      table.add("Slip counts from angle",
                closed_form.full_sliding,
                Allowed::number_between(1e-9, 1e6, "deg"),
                "Angle theta_slide [deg] of the model prescribed angles from "
                "which on sliding wears the bond, Eq. (49).");
      table.add(
        "Shear modulus",
        closed_form.shear_modulus,
        Allowed::number_between(1e-6, 1e12, "MPa"),
        "Shear modulus G [MPa] of the half space in the model crack, "
        "Eq. (14). Fitted to a torque curve it comes out far below that "
        "of bone; the default is fitted to T_max and theta_max of the "
        "paper's data set 1.");
      table.add("Adhesion energy",
                closed_form.adhesion_energy,
                Allowed::number_between(1e-12, 1e12, "N/m").or_number(0),
                "Adhesion energy w_adh [N/m] of the model crack, Eq. (14), "
                "fitted as Shear modulus.");
      table.leave_subsection();
    }



    void
    declare_campaigns(unsigned int    &largest_number_of_unknowns,
                      StudyParameters &study,
                      EntryTable      &table)
    {
      table.enter_subsection("Auto");
      table.add(
        "Largest number of unknowns",
        largest_number_of_unknowns,
        Allowed::whole_number(1, 100000000),
        "With Model = auto: unknowns of both bodies up to which meshes "
        "are refined. The memory needed goes with it: 1 GB for 105 000, "
        "some 3 GB for 250 000.");
      table.leave_subsection();
      table.enter_subsection("Study");
      table.add(
        "Reference variant",
        study.reference_variant,
        Allowed::whole_number(1, 100000).or_word_for("none", "0"),
        "In a study, whose entries hold several values as in {{a|b|c}}: "
        "number of the variant that the others' torque curves are "
        "compared with in study.csv. `none': they are compared with Output / "
        "Reference curve, if there is one.");
      table.add(
        "Factors varied at once",
        study.factors_at_once,
        Allowed::whole_number(1, 1000).or_word_for("all", "0"),
        "Of all combinations, only those in which at most this many "
        "factors differ from their first value: 1 varies one factor at a "
        "time, 2 also every pair. A factor is an entry {{a|b|c}}, or all "
        "entries {{name: a|b|c}} with one name. `all': all combinations.");
      table.add("Repetitions",
                study.repetitions,
                Allowed::whole_number(1, 1000),
                "Number of runs of each variant. In study.csv seconds are then "
                "medians; all else is that of the last run. Seconds mean "
                "something with --jobs 1 only.");
      table.leave_subsection();
    }



    void
    declare_rig(EntryTable &table)
    {
      table.add("Angle offset",
                "0",
                nullptr,
                Allowed::number("deg"),
                "Angle [deg] that the instrument shows where the implant has "
                "not turned.");
      table.add("Slack",
                "0",
                nullptr,
                Allowed::number("deg"),
                "Angle [deg] that the machine turns before it takes the "
                "implant along; after a reversal it turns back by as much.");
      table.add("Machine compliance",
                "0",
                nullptr,
                Allowed::number_from(0, "deg/(N mm)"),
                "How much more the machine turns than the implant, per torque "
                "[deg/(N mm)].");
      table.add("Torque offset",
                "0",
                nullptr,
                Allowed::number("N mm"),
                "Torque [N mm] that the instrument shows without a load.");
      table.add("Torque drift",
                "0",
                nullptr,
                Allowed::number("N mm"),
                "By how much the torque that the instrument shows without a "
                "load grows [N mm] from the first row of the measured file to "
                "the last one, evenly.");
    }



    void
    declare_noise(EntryTable &table)
    {
      table.add("Noise",
                "auto",
                nullptr,
                Allowed::list(Allowed::number_above(0, ""), 1, 0)
                  .or_word("auto"),
                "Standard deviation of what is measured, relative to the "
                "largest value of the curve: of each curve, or one for all. "
                "`auto': unknown, and taken from what the fit leaves of each curve.");
      table.add("Noise columns",
                "none",
                nullptr,
                Allowed::text("columns of the file", false).or_word("none"),
                "Columns of the measured file, by name or number, that hold "
                "the standard deviation of each row, one for each of Curves; "
                "instead of Noise.");
    }



    void
    declare_calibration(EntryTable &table)
    {
      table.enter_subsection("Calibration");
      table.add("Curves",
                "auto",
                nullptr,
                Allowed::list(Allowed::text("a column of torque.csv", false),
                              1,
                              0)
                  .or_word("auto"),
                "What has been measured: columns of torque.csv, of torque_Nmm "
                "and those that begin with chuck_, in the order of Output / "
                "Reference columns. `auto': the load of Output / Curve.");
      table.add(
        "Over",
        "auto",
        nullptr,
        Allowed::text("a column of torque.csv", false).or_word("auto"),
        "What it has been measured over: time, angle_deg or another "
        "column of torque.csv that begins with chuck_. It is the first "
        "of Output / Reference columns. `auto': the position of Output / "
        "Curve.");
      table.add("Windows",
                "none",
                nullptr,
                Allowed::list(Allowed::number(""), 2, 0).or_word("none"),
                "Parts of the measured curves that are fitted, as pairs of "
                "bounds in Over: 0, 0.13, 9, 10. `none': the whole curves.");
      declare_noise(table);
      declare_rig(table);
      table.add("Measure",
                "least squares",
                nullptr,
                Allowed::choice("least squares | e_mp | e_rel"),
                "What is made small: the sum of squares, or the mean of "
                "relative differences of Eq. (19) or (50), smoothed where they "
                "are less than a thousandth.");
      table.add("Largest misfit",
                "0.1",
                nullptr,
                Allowed::number_above(0, ""),
                "e_rel, Eq. (50), above which nothing has been found: the "
                "program says so and ends with the code 2.");
      table.add("Starts",
                "20",
                nullptr,
                Allowed::whole_number(1, 100000),
                "Places from which unknowns are searched; the five best of "
                "them are followed to the end.");
      table.add("Seed",
                "1",
                nullptr,
                Allowed::whole_number(1, std::numeric_limits<int>::max()),
                "Of random samples, for intervals of e_mp and e_rel.");
      table.add("Profiles",
                "false",
                nullptr,
                Allowed::choice("false | true"),
                "Fix each unknown in turn at values around the best one and "
                "fit the others: profile.csv.");
      table.leave_subsection();
    }



    void
    declare_references(OutputParameters &output, EntryTable &table)
    {
      AllowedValues curves = Allowed::text(
        "auto, or a position and a load of the chuck: Translation z, Force z",
        false);
      curves.test = [](const std::string &text) {
        return text == "auto" || CurveAxes::read(text);
      };
      table.add(
        "Curve",
        output.curve,
        curves,
        "The curve that the scene is about: a load of the chuck (Force x, y, z, "
        "Moment x, y, z) over one of its positions (Translation x, y, z, "
        "Rotation x, y, z): Translation z, Force z. Pages draw it, measured "
        "curves are compared with it and fitted. `auto': Rotation z, Moment z "
        "where the scene turns the chuck about z, or where Reference curve is of "
        "angles and torques only, else position and load of the component that "
        "it moves most.");
      table.add("Reference curve",
                output.reference_curve,
                Allowed::text("the name of a CSV file", false)
                  .or_word_for("none", ""),
                "Table to compare the Curve with, as an instrument or a "
                "spreadsheet writes it, or the torque.csv of a run. "
                "Semicolons, tabs, commas or blanks separate; units are "
                "read off the names of the columns, as in torque [N m].");
      table.add(
        "Reference columns",
        output.reference_columns,
        Allowed::list(Allowed::text("a column", false), 1, 0)
          .or_word_for("auto", ""),
        "Which columns of Reference curve are angle and torque, or what Curve "
        "says, each by its name there or its number from 1, with a unit (deg, "
        "rad, mrad; mm, um, m; N mm, mN m, N cm, N m, kN m; N, kN) where the "
        "file has none: Winkel [rad], 3 [N m]. A minus before the unit, "
        "3 [-N m], turns the sign. `auto': angle_deg and torque_Nmm, or the "
        "columns of torque.csv that Curve names, else the only ones with such "
        "units.");
      table.add("Reference profiles",
                output.reference_profiles,
                Allowed::text("the name of a CSV file", false)
                  .or_word_for("none", ""),
                "CSV file with the columns angle_deg, x_mm, y_mm, area_mm2, "
                "pressure_MPa and slip_mm, as profiles.csv of another run, to "
                "compare local values with at those of its angles that Profile "
                "angles has.");
    }



    void
    declare_measures(OutputParameters &output, EntryTable &table)
    {
      table.add(
        "Curve angles",
        output.curve_at,
        Allowed::list(Allowed::number_between(-1e6, 1e6, "deg"), 1, 0)
          .or_word_for("none", ""),
        "Angles [deg] at which torque, force and place of the chuck are "
        "written to curve_at.csv, each time that the implant turns "
        "through one of them; between rows as curve.csv has them, or "
        "linear.");
      table.add(
        "Friction energy from angle",
        output.full_sliding_angle,
        Allowed::number_above(0, "deg").or_word_for("auto", "0"),
        "Angle theta_fric [deg] from which on E_fric is counted, Eq. (20). "
        "`auto': theta_full, the last angle with a torque of at least 0.999 of the "
        "largest.");
      table.add("Observed bonding",
                output.observed_bonding,
                Allowed::number_between(1e-9, 1, "").or_word_for("auto", "0"),
                "Observed mean phi_0 that w_adh refers to, Eq. (21). `auto': "
                "that of the scene.");
    }



    void
    declare_checkpoints(OutputParameters &output, EntryTable &table)
    {
      table.add(
        "Checkpoint every",
        output.checkpoint_every,
        Allowed::whole_number(1, std::numeric_limits<int>::max())
          .or_word_for("none", "0"),
        "Planned steps (where rows are accepted steps: rows) between "
        "checkpoints, from which `debond --resume DIR' goes on. `none': only when "
        "SIGINT, SIGTERM, SIGHUP or SIGUSR1 interrupts the run. For Model = finite "
        "elements.");
      table.add(
        "Checkpoint minutes",
        output.checkpoint_minutes,
        Allowed::number_above(0, "min").or_word_for("none", "0"),
        "Time [min] after which the next row leaves a checkpoint, beside "
        "those of Checkpoint every. For Model = finite "
        "elements.");
    }



    void
    declare_output(OutputParameters &output, EntryTable &table)
    {
      table.enter_subsection("Output");
      table.add(
        "Directory",
        output.directory,
        Allowed::directory(),
        "Directory for the results, relative to the working directory; "
        "created if missing. One that holds results of another scene is "
        "refused without --force.");
      table.add(
        "Fields every",
        output.fields_every,
        Allowed::whole_number(1, std::numeric_limits<int>::max())
          .or_word_for("none", "0"),
        "Planned steps between VTU files, counted from the beginning of "
        "each phase, whose end is always written.");
      declare_references(output, table);
      declare_measures(output, table);
      table.add(
        "Profile angles",
        output.profile_angles,
        Allowed::list(Allowed::number_above(0, "deg"), 1, 0)
          .or_word_for("none", ""),
        "Angles [deg] at which local values of all points of the interface "
        "are written into profiles.csv, each at the first planned step that "
        "reaches it.");
      table.add("Friction law curve",
                output.friction_law_curve,
                Allowed::choice("false | true"),
                "Write phi and mu over the sliding distance g_s into "
                "friction_law.csv.");
      declare_checkpoints(output, table);
      table.add("Report",
                output.report,
                Allowed::choice("false | true"),
                "Write report.html, a page with curve, maps of the interface, "
                "results in words and warnings, and maps.csv. Variants of a "
                "study write none.");
      table.add(
        "Reference marks",
        "none",
        nullptr,
        Allowed::list(Allowed::number(""), 1, 4).or_word("none"),
        "T_max, T_inf [N mm], theta_lin, theta_max (of the peak) [deg], the "
        "first of them or all, that the report marks in the curve.");
      table.add("Console",
                output.quiet,
                Allowed::choice("steps | quiet"),
                "`steps': lines about the steps (a hundred if very many are "
                "planned), on a terminal a line of progress instead. `quiet': "
                "warnings and errors only.");
      table.leave_subsection();
    }
  } // namespace



  void
  Scene::declare(EntryTable &table)
  {
    table.add("Title",
              title,
              Allowed::text("any text"),
              "Title of the scene, for people.");
    table.add("Model",
              model,
              Allowed::choice("finite elements | foundation | prescribed angles | "
                              "crack | auto"),
              "Model that is solved. `finite elements': two bodies with an "
              "interface between them. The others are closed forms for a coin "
              "that is pressed down and then turned: `foundation': a rigid "
              "disk on a foundation with the stiffness of interface and bodies "
              "in series, and the full friction law. `prescribed angles': Eq. "
              "(18) of the paper. `crack': Eqs. (14) to (16). See subsection "
              "Closed form. `auto': climbs from the cheapest of `foundation', rigid, "
              "linear and the scene's own bodies on finer and finer meshes "
              "until the error of the torque curve is estimated to be within "
              "Load steps / Tolerance, and answers with the cheapest model "
              "that is; the program chooses the steps.");
    table.add("Task",
              "simulate",
              nullptr,
              Allowed::choice("simulate | calibrate"),
              "What to do with the model. `simulate': run it once. "
              "`calibrate': find the numbers that stand in entries as "
              "<<START in LOWER..UPPER>> from Output / Reference curve, see "
              "subsection Calibration.");
    bone.declare_bone(table);
    implant.declare_implant(table);
    interface.declare(table);
    chuck.declare(table);
    load_steps.declare(table);
    declare_closed_form(closed_form, table);
    declare_campaigns(largest_number_of_unknowns, study, table);
    declare_calibration(table);
    declare_output(output, table);
    interface.declare_expert(table);
  }
} // namespace Debond
