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
        "Mean contact pressure p [MPa] during the rotation. `auto': from "
        "Chuck / Press or Translation z: a force, or a depth times Expert / "
        "Closed form / Normal stiffness.");
      table.add(
        "Expert / Normal stiffness",
        closed_form.normal_stiffness,
        Allowed::number_between(1e-6, 1e15, "MPa/mm").or_word_for("auto", "0"),
        "Mean pressure per depth of push-in [MPa/mm], interface and "
        "bodies in series. `auto': from one linear solution with the bodies "
        "of the scene.");
      table.add(
        "Expert / Torsional stiffness",
        closed_form.torsional_stiffness,
        Allowed::number_between(1e-6, 1e15, "MPa/mm").or_word_for("auto", "0"),
        "Stiffness lambda [MPa/mm] of the foundation in torsion, Eq. (39) of "
        "the paper: tangential traction per displacement while everything "
        "sticks, interface and bodies in series. `auto': from one linear "
        "solution with the bodies of the scene.");
      table.add(
        "Linear limit angle",
        closed_form.linear_limit,
        Allowed::number_between(1e-9, 1e6, "deg").without_default(),
        "Angle theta_lin [deg] of the model prescribed angles at which the rim "
        "begins to slide, Eq. (17).");
      table.add("Slip counts from angle",
                closed_form.full_sliding,
                Allowed::number_between(1e-9, 1e6, "deg").without_default(),
                "Angle theta_slide [deg] of the model prescribed angles from "
                "which on sliding wears the bond, Eq. (49).");
      table.add(
        "Shear modulus",
        closed_form.shear_modulus,
        Allowed::number_between(1e-6, 1e12, "MPa").without_default(),
        "Shear modulus G [MPa] of the half space in the model crack, Eq. "
        "(14). A fit to a torque curve gives values far below those of bone: "
        "40.4, with an Adhesion energy of 22.2 N/m, to T_max and theta_max of "
        "the paper's data set 1.");
      table.add("Adhesion energy",
                closed_form.adhesion_energy,
                Allowed::number_between(1e-12, 1e12, "N/m")
                  .or_number(0)
                  .without_default(),
                "Adhesion energy w_adh [N/m] of the model crack, Eq. (14), "
                "fitted with Shear modulus.");
      table.leave_subsection();
    }



    void
    declare_study(StudyParameters &study, EntryTable &table)
    {
      table.enter_subsection("Study");
      table.add(
        "Reference variant",
        study.reference_variant,
        Allowed::whole_number(1, 100000).or_word_for("none", "0"),
        "Number of the variant of a study whose curve the others are "
        "compared with in study.csv. `none': they are compared with Output / "
        "Reference curve, if there is one.");
      table.add(
        "Expert / Factors varied at once",
        study.factors_at_once,
        Allowed::whole_number(1, 1000).or_word_for("all", "0"),
        "Run only combinations in which at most this many factors differ "
        "from their first value: 1 varies one factor at a time, 2 also every "
        "pair. A factor is an entry {{a|b|c}}, or all entries {{name: "
        "a|b|c}} with one name. `all': all combinations.");
      table.add("Expert / Repetitions",
                study.repetitions,
                Allowed::whole_number(1, 1000),
                "Number of runs of each variant. Seconds in study.csv are "
                "then medians; everything else is from the last run. Seconds "
                "are meaningful with --jobs 1 only.");
      table.leave_subsection();
    }



    void
    declare_rig(EntryTable &table)
    {
      const auto add = [&table](const std::string &name,
                                const std::string &unit,
                                const bool         is_signed,
                                const std::string &text) {
        table.add(name,
                  "0",
                  nullptr,
                  is_signed ? Allowed::number(unit) :
                              Allowed::number_from(0, unit),
                  text + " [" + unit + "].");
      };
      const std::string sign =
        ", in the sign of the file, before a minus in Reference columns";
      for (const bool turns : {true, false})
        {
          const std::string way       = turns ? "Angle" : "Displacement",
                            load      = turns ? "Torque" : "Force",
                            unit      = turns ? "deg" : "mm",
                            load_unit = turns ? "N mm" : "N";
          add(way + " offset",
              unit,
              true,
              way + " that the instrument shows before the implant has moved" +
                sign);
          add(turns ? "Slack" : "Displacement slack",
              unit,
              true,
              "Backlash: way of the machine before it moves the implant, in "
              "the direction in which the measured curve begins; after a "
              "reversal it moves back by as much");
          add(turns ? "Machine compliance" : "Displacement compliance",
              unit + (turns ? "/(N mm)" : "/N"),
              false,
              "Additional motion of the machine relative to the implant, per "
              "load about or along the same axis");
          add(load + " offset",
              load_unit,
              true,
              load + " that the instrument shows without load" + sign);
          add("Expert / " + load + " drift",
              load_unit,
              true,
              "Linear drift of this offset from the first to the last row of "
              "the measured file");
        }
    }



    void
    declare_noise(EntryTable &table)
    {
      table.add(
        "Noise",
        "auto",
        nullptr,
        Allowed::list(Allowed::number_above(0, ""), 1, 0).or_word("auto"),
        "Standard deviation of what is measured, relative to the largest "
        "value of the curve: of each curve, or one for all. `auto': "
        "estimated from the residuals of each curve.");
      table.add("Expert / Noise columns",
                "none",
                nullptr,
                Allowed::text("columns of the file", false).or_word("none"),
                "Columns of the measured file, by name or number, with the "
                "standard deviation of each row, one for each of Curves; "
                "replaces Noise. `none': no such columns.");
    }



    void
    declare_search(EntryTable &table)
    {
      table.add("Expert / Measure",
                "least squares",
                nullptr,
                Allowed::choice("least squares | e_mp | e_rel"),
                "What is minimised: the sum of squares, or the mean relative "
                "difference of Eq. (19) or (50), smoothed where it is less "
                "than a thousandth.");
      table.add("Expert / Largest misfit",
                "0.1",
                nullptr,
                Allowed::number_above(0, ""),
                "Largest e_rel, Eq. (50), of an acceptable fit. Above it the "
                "program says that nothing fits, and ends with exit code 2.");
      table.add("Expert / Smallest share of rows",
                "0.5",
                nullptr,
                Allowed::number_between(0, 1, ""),
                "A fit that can use a smaller share of the rows in Windows is "
                "refused: the others are beyond what the scene comes to, as "
                "with angles in another unit.");
      table.add("Expert / Starts",
                "20",
                nullptr,
                Allowed::whole_number(1, 100000),
                "Number of starting points of the search; the best, five or, "
                "where only runs of finite elements can search, two, are "
                "followed to the end.");
      table.add("Expert / Seed",
                "1",
                nullptr,
                Allowed::whole_number(1, std::numeric_limits<int>::max()),
                "Seed of the random samples for intervals of e_mp and e_rel.");
      table.add("Expert / Profiles",
                "false",
                nullptr,
                Allowed::choice("false | true"),
                "Write profile.csv: each unknown in turn is fixed at values "
                "around the best one, and the others are fitted.");
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
                "Measured quantities, as columns of torque.csv (torque_Nmm "
                "and those that begin with chuck_), in the order of Output / "
                "Reference columns. `auto': the load of Output / Curve.");
      table.add(
        "Over",
        "auto",
        nullptr,
        Allowed::text("a column of torque.csv", false).or_word("auto"),
        "Quantity that Curves were measured over, the first of Output / "
        "Reference columns: time, angle_deg or another column of torque.csv "
        "that begins with chuck_ or machine_. `auto': the position of Output "
        "/ Curve.");
      table.add("Windows",
                "none",
                nullptr,
                Allowed::list(Allowed::number(""), 2, 0).or_word("none"),
                "Parts of the measured curves that are fitted, as pairs of "
                "bounds in Over: 0, 0.13, 9, 10. `none': the whole curve.");
      declare_noise(table);
      declare_rig(table);
      declare_search(table);
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
        "Main curve of the scene: a position of the chuck (Translation x, y, "
        "z, Rotation x, y, z) and a load (Force x, y, z, Moment x, y, z) "
        "over it, as in Translation z, Force z. The report draws it; "
        "measured curves are compared with it and fitted to it. `auto': "
        "Rotation z, Moment z where the scene turns the chuck about z, or "
        "where Reference curve is of angles and torques only, else position "
        "and load of the component that it moves most, after a first press if "
        "more follows.");
      table.add(
        "Reference curve",
        output.reference_curve,
        Allowed::text("the name of a CSV file", false).or_word_for("none", ""),
        "Table that the curve is compared with: a file from an instrument or "
        "spreadsheet, or the torque.csv or reactions.csv of a run. Columns are "
        "separated by semicolons, tabs, commas or blanks; units are read from "
        "the names of the columns, as in torque [N m]. `none': no comparison.");
      table.add(
        "Reference columns",
        output.reference_columns,
        Allowed::text("two columns, the angle and the torque", false)
          .or_word_for("auto", ""),
        "Columns of Reference curve with angle and torque, or with the "
        "quantities of Curve: each by name or by number from 1, with a unit "
        "(such as deg, rad; mm, um; N mm, N cm, N m; N, kN) where the file has "
        "none: Winkel [rad], 3 [N m]. A minus before the unit, 3 [-N m], turns "
        "the sign. `auto': angle_deg and torque_Nmm, or the columns of "
        "torque.csv that Curve names, else the only ones with such units.");
      table.add(
        "Expert / Reference profiles",
        output.reference_profiles,
        Allowed::text("the name of a CSV file", false).or_word_for("none", ""),
        "CSV file with local values to compare with, such as profiles.csv of "
        "another run: columns angle_deg, x_mm, y_mm, area_mm2, pressure_MPa "
        "and slip_mm. Compared are the angles that both files have. `none': "
        "no comparison.");
    }



    void
    declare_measures(OutputParameters &output, EntryTable &table)
    {
      table.add(
        "Motion between",
        output.motion_between,
        Allowed::list(Allowed::number("time"), 2, 0).or_word_for("auto", ""),
        "Times, ascending, between which the motion of the faces along each "
        "other is measured, slip and elastic gap: for cyclic loads the ends of "
        "cycles, where it is their drift, or of half cycles. It begins and ends "
        "with the first rows that come to them: choose Load steps / Times. "
        "`auto': the first and the last time.");
      table.add(
        "Expert / Curve angles",
        output.curve_at,
        Allowed::list(Allowed::number_between(-1e6, 1e6, "deg"), 1, 0)
          .or_word_for("none", ""),
        "Angles [deg] at which torque, force and position of the chuck are "
        "written into curve_at.csv, each time the implant turns through one "
        "of them, interpolated as in curve.csv, or linearly without that "
        "file. `none': no such file.");
      table.add(
        "Expert / Friction energy from angle",
        output.full_sliding_angle,
        Allowed::number_above(0, "deg").or_word_for("auto", "0"),
        "Angle theta_fric [deg] from which E_fric of Eq. (20) is counted. "
        "`auto': theta_full, the last angle with a torque of at least 0.999 of "
        "the largest; with Model = prescribed angles, Slip counts from angle.");
      table.add("Expert / Observed bonding",
                output.observed_bonding,
                Allowed::number_between(1e-9, 1, "").or_word_for("auto", "0"),
                "Observed mean of phi_0 that w_adh of Eq. (21) refers to. "
                "`auto': that of the scene.");
    }



    void
    declare_checkpoints(OutputParameters &output, EntryTable &table)
    {
      table.add(
        "Expert / Checkpoint every",
        output.checkpoint_every,
        Allowed::whole_number(1, std::numeric_limits<int>::max())
          .or_word_for("none", "0"),
        "Number of planned steps (with Adaptive or Path following: of rows) "
        "between checkpoints, from which `debond --resume DIR' goes on. "
        "`none': no such checkpoints. SIGINT, SIGTERM, SIGHUP and SIGUSR1 "
        "leave one in any case. For Model = finite elements.");
      table.add(
        "Expert / Checkpoint minutes",
        output.checkpoint_minutes,
        Allowed::number_above(0, "min").or_word_for("none", "0"),
        "Time [min] after which the next row writes a checkpoint, in "
        "addition to Checkpoint every. `none': no such checkpoints. For "
        "Model = finite elements.");
    }



    void
    declare_fields(OutputParameters &output, EntryTable &table)
    {
      const unsigned int every = output.fields_every;
      table.add(
        "Fields every",
        every == 0                   ? "none" :
        every == output.usual_fields ? "auto" :
                                       std::to_string(every),
        [&output](const std::string &text) {
          output.fields_every = text == "auto" ? output.usual_fields : 0;
          if (text != "auto" && text != "none")
            read_entry(text, output.fields_every);
        },
        Allowed::whole_number(1, std::numeric_limits<int>::max())
          .or_word("none")
          .or_word("auto"),
        "Planned steps between VTU files, counted in each phase (with "
        "Adaptive or Path following: rows, counted in the run). The end of a "
        "phase is always written. `auto': 50 planned steps, or 5 rows. `none': "
        "no VTU files.");
    }



    void
    declare_output(OutputParameters &output, EntryTable &table)
    {
      table.enter_subsection("Output");
      table.add(
        "Directory",
        output.directory,
        Allowed::directory(),
        "Folder for the results, relative to the working directory; created "
        "if missing. A folder with results of another scene is refused "
        "without --force.");
      declare_fields(output, table);
      declare_references(output, table);
      declare_measures(output, table);
      table.add(
        "Expert / Profile angles",
        output.profile_angles,
        Allowed::list(Allowed::number_above(0, "deg"), 1, 0)
          .or_word_for("none", ""),
        "Angles [deg] at which local values of all points of the interface "
        "are written into profiles.csv, each at the first row that reaches "
        "it. `none': no such file.");
      table.add("Expert / Friction law curve",
                output.friction_law_curve,
                Allowed::choice("false | true"),
                "Write phi and mu over the sliding distance g_s into "
                "friction_law.csv.");
      declare_checkpoints(output, table);
      table.add("Report",
                output.report,
                Allowed::choice("false | true"),
                "Write report.html, a page for a browser with curve, maps of "
                "the contact face, results and warnings, and maps.csv. "
                "Variants of a study write none.");
      table.add(
        "Expert / Reference marks",
        "none",
        nullptr,
        Allowed::list(Allowed::number(""), 1, 4).or_word("none"),
        "Reference values that the report marks in the curve: T_max, T_inf "
        "[N mm], theta_lin, theta_max (of the peak) [deg], all or the first "
        "of them. `none': no marks.");
      table.add("Expert / Console",
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
              "Title of the scene, printed at the start of a run and in the "
              "report.");
    table.add("Model",
              model,
              Allowed::choice(
                "finite elements | foundation | prescribed angles | crack"),
              "Model that is solved. `finite elements': two bodies with an "
              "interface between them. `foundation': closed form, a rigid "
              "disk on springs (interface and bodies in series) with the "
              "full friction law. `prescribed angles': closed form, Eq. (18) "
              "of the paper. `crack': closed form, Eqs. (14) to (16) of the "
              "paper. Closed forms are for a coin that is pressed and then "
              "turned, see subsection Closed form.");
    table.add("Task",
              "simulate",
              nullptr,
              Allowed::choice("simulate | calibrate"),
              "What to do with the model. `simulate': run it once. "
              "`calibrate': find the numbers that are written as <<START in "
              "LOWER..UPPER>> in entries, such that the curve is closest to "
              "Output / Reference curve; see subsection Calibration.");
    declare_accuracy(table);
    bone.declare_bone(table);
    implant.declare_implant(table);
    interface.declare(table);
    chuck.declare(table);
    load_steps.declare(table);
    declare_closed_form(closed_form, table);
    declare_study(study, table);
    declare_calibration(table);
    declare_output(output, table);
    interface.declare_expert(table);
    declare_limits(table);
  }
} // namespace Debond
