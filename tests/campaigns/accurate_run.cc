// Runs with an accuracy: of two rigid bodies, whose closed form is within the
// error that is estimated; what is said where the error is larger and cells may
// not become more; and a coarser run that fails, which ends nothing.

#include <debond/campaigns/run_scene.h>
#include <debond/input/csv_table.h>
#include <debond/models/closed_forms.h>
#include <debond/output/result_files.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "driven_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;
using Changes = std::vector<std::string>;

const std::string directory = "results/accurate";



/** Runs the scene and returns what it says. */
std::string
run(const std::string &accuracy, const Changes &changes)
{
  std::filesystem::remove_all(directory);
  const Changes all = Changes{"Accuracy=" + accuracy,
                              "Output/Directory=" + directory,
                              "Output/Fields every=none"} +
                      changes;
  std::ostringstream said;
  auto *const        console = std::cout.rdbuf(said.rdbuf());
  try
    {
      run_scene(coin_scene(pressed_and_turned, all));
    }
  catch (const std::exception &error)
    {
      said << "stopped: " << error.what();
    }
  std::cout.rdbuf(console);
  return said.str();
}



bool
contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}



double
summary(const std::string &name)
{
  return number_in(read_json(directory + "/summary.json"), name);
}



// Two rigid bodies on their interface.
void
test_closed_form()
{
  std::cout << "Rigid bodies" << std::endl;
  run("1 %", {"Bone/Material=rigid", "Implant/Material=rigid"});
  TorsionModel::Disk disk;
  disk.radius    = 2.5;
  disk.pressure  = 0.0049 * 585.;
  disk.stiffness = 585.;
  const RigidBodiesTorsion exact(disk);
  double                   largest = 0., difference = 0.;
  for (const auto &row : read_csv_columns(directory + "/torque.csv",
                                          "",
                                          {"angle_deg", "torque_Nmm"}))
    {
      const double T = exact.torque(row[0] * M_PI / 180.);
      grow(largest, T);
      grow(difference, std::abs(T - row[1]));
    }
  const double estimate = summary("error_estimate");
  report("  the error is below the accuracy", difference < 0.01 * largest);
  report("  and below its estimate", difference < estimate * largest);
  report("  which is below the accuracy", estimate < 0.01);
  report("  parts of it make the sum",
         std::abs(summary("error_of_cells") + summary("error_of_steps") -
                  estimate),
         1e-12);
  report("  no error by bodies that do not deform",
         summary("error_of_bodies") == 0.);
}



void
test_limits()
{
  std::cout << "Cells that may not become more" << std::endl;
  const auto says = [](const std::string &what,
                       const Changes     &changes,
                       const std::string &why) {
    const std::string said = run("0.1 %", changes);
    report("  " + what,
           contains(said, "warning: the estimated error, ") &&
             contains(said, " is above Accuracy, 0.1 %") &&
             contains(said, why) && !contains(said, "once more") &&
             !contains(said, "stopped"));
    report("  the results are there",
           summary("error_estimate") > 0.001 &&
             read_json(directory + "/summary.json")["converged"] == true &&
             std::filesystem::exists(directory + "/errors.csv"));
  };
  says("too many unknowns",
       {"Expert/Largest number of unknowns=6000"},
       ", are beyond Expert / Largest number of unknowns");
  says("too long a time",
       {"Expert/Largest minutes=1e-6"},
       ", are beyond Expert / Largest minutes");
  says("cells of the scene",
       {"Bone/Cells=9, 9, 2", "Implant/Cells=3, 2"},
       ": the scene sets its cells itself");
}



// It cannot write its rows.
void
test_coarser_run_that_fails()
{
  std::cout << "A coarser run that fails" << std::endl;
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory +
                                      "/coarser/torque.csv.partial");
  const Scene        scene = coin_scene(pressed_and_turned,
                                 {"Accuracy=1 %",
                                         "Bone/Material=rigid",
                                         "Implant/Material=rigid",
                                         "Expert/Output/Console=quiet",
                                         "Output/Fields every=none",
                                         "Output/Directory=" + directory});
  std::ostringstream none;
  auto *const        console = std::cout.rdbuf(none.rdbuf());
  std::string        error;
  try
    {
      run_scene(scene);
    }
  catch (const std::exception &stopped)
    {
      error = stopped.what();
    }
  std::cout.rdbuf(console);
  report("  the run is finished", error.empty());
  report("  without an estimate", std::isnan(summary("error_estimate")));
  report("  and says so", contains(none.str(), "the error is not known"));
}



void
test()
{
  test_closed_form();
  test_limits();
  test_coarser_run_that_fails();
}



int
main()
{
  return run_test(&test);
}
