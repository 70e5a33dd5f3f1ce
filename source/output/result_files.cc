#include <debond/input/allowed_values.h>
#include <debond/output/earlier_results.h>
#include <debond/output/result_files.h>
#include <debond/support/directory_lock.h>
#include <debond/support/input_error.h>

#include <deal.II/base/parameter_handler.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace Debond
{
  void
  OutputParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    prm.declare_entry("Directory",
                      "output/coin",
                      Allowed::directory(),
                      "Directory for the results, relative to the working "
                      "directory; created if missing. One that holds results "
                      "of another scene is refused without --force. The name "
                      "is taken as it is: no quotes, and no ~ or $ at its "
                      "beginning.");
    prm.declare_entry("Fields every",
                      "50",
                      Allowed::whole_number(0, std::numeric_limits<int>::max()),
                      "Planned steps between VTU files, counted from the "
                      "beginning of each phase, whose end is always written; "
                      "0: no VTU files.");
    prm.declare_entry("Reference curve",
                      "",
                      Allowed::optional_text("the name of a CSV file"),
                      "CSV file with the columns angle_deg,torque_Nmm to "
                      "compare the torque curve with; empty: none.");
    prm.declare_entry("Reference profiles",
                      "",
                      Allowed::optional_text("the name of a CSV file"),
                      "CSV file with the columns angle_deg, x_mm, y_mm, "
                      "area_mm2, pressure_MPa and slip_mm, as profiles.csv of "
                      "another run, to compare local values with at those of "
                      "its angles that Profile angles has; empty: none.");
    prm.declare_entry("Full sliding angle",
                      "0",
                      Allowed::number_from(0, "deg"),
                      "Angle theta_full [deg] from which on E_fric is counted. "
                      "0: the last angle with a torque of at least 0.999 of "
                      "the largest.");
    prm.declare_entry("Observed bonding",
                      "0",
                      Allowed::number_between(0, 1, ""),
                      "Mean phi_0 that w_adh refers to, Eq. (21), where it was "
                      "observed and differs from that of the scene; 0: that of "
                      "the scene.");
    prm.declare_entry("Profile angles",
                      "",
                      Allowed::numbers(0, 0, true, "deg"),
                      "Angles [deg] at which pressure, traction, sliding "
                      "distance and friction coefficient of all points of the "
                      "interface are written into profiles.csv, each at the "
                      "first planned step that reaches it; empty: none.");
    prm.declare_entry("Friction law curve",
                      "false",
                      Allowed::yes_or_no(),
                      "Write phi and mu over the sliding distance g_s into "
                      "friction_law.csv.");
    prm.declare_entry("Checkpoint every",
                      "0",
                      Allowed::whole_number(0, std::numeric_limits<int>::max()),
                      "Planned steps between checkpoints, from which "
                      "`debond --resume DIR' goes on with results that are "
                      "the same to the last bit; where rows are accepted "
                      "steps, number of rows. 0: only when SIGINT, SIGTERM or "
                      "SIGHUP interrupts the run. For Model = finite "
                      "elements.");
    prm.declare_entry("Console",
                      "steps",
                      Allowed::choice("steps | quiet"),
                      "`steps': lines about the steps (a hundred if very many "
                      "are planned), progress and timings. "
                      "`quiet': warnings and errors only.");
    prm.leave_subsection();
  }



  void
  OutputParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    directory          = prm.get("Directory");
    fields_every       = prm.get_integer("Fields every");
    reference_curve    = prm.get("Reference curve");
    reference_profiles = prm.get("Reference profiles");
    full_sliding_angle = prm.get_double("Full sliding angle");
    observed_bonding   = prm.get_double("Observed bonding");
    profile_angles     = to_numbers(prm.get("Profile angles"));
    friction_law_curve = prm.get_bool("Friction law curve");
    checkpoint_every   = prm.get_integer("Checkpoint every");
    console =
      prm.get("Console") == "quiet" ? ConsoleKind::quiet : ConsoleKind::steps;
    prm.leave_subsection();
  }



  DirectoryContent
  content_of_result_directory(const OutputParameters &output,
                              const std::string      &completed_parameters)
  {
    std::ifstream file(output.directory + "/parameters.prm", std::ios::binary);
    if (!file)
      return DirectoryContent::no_results;
    std::ostringstream existing;
    existing << file.rdbuf();
    return existing.str() == completed_parameters ?
             DirectoryContent::same_scene :
             DirectoryContent::other_scene;
  }



  ResultDirectory::ResultDirectory(const std::string &path)
    : directory(path)
  {
    while (directory.size() > 1 && directory.back() == '/')
      directory.pop_back();
    lock = DirectoryLock::take(directory);
  }



  ResultDirectory::ResultDirectory(const OutputParameters &output,
                                   const std::string      &completed_parameters)
    : ResultDirectory(output.directory)
  {
    const std::string entry = "Output / Directory = '" + output.directory + "'";

    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
      throw InputError(
        entry + ": this directory cannot be created: " + error.message());
    if (!lock) // there was no directory yet
      lock = DirectoryLock::take(directory);

    const bool is_of_other_scene =
      content_of_result_directory(output, completed_parameters) ==
      DirectoryContent::other_scene;
    if (is_of_other_scene && !output.overwrite_other_results)
      throw InputError(entry +
                       ": this directory holds results of another scene "
                       "(compare its parameters.prm): choose another one, "
                       "or overwrite them with --force");

    try
      {
        if (is_of_other_scene) // nobody must take them for this scene's
          remove_results(directory);
        write_file(file("parameters.prm"), completed_parameters);
      }
    catch (const std::exception &reason)
      {
        throw InputError(entry + ": " + reason.what());
      }
  }



  void
  write_json(const std::string &filename, const nlohmann::ordered_json &json)
  {
    // names of files need not be UTF-8
    constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
    write_file(filename, json.dump(2, ' ', false, replace) + "\n");
  }



  nlohmann::ordered_json
  read_json(const std::string &filename)
  {
    std::ifstream                file(filename);
    const nlohmann::ordered_json json =
      nlohmann::ordered_json::parse(file, nullptr, false);
    return json.is_object() ? json : nlohmann::ordered_json::object();
  }
} // namespace Debond
