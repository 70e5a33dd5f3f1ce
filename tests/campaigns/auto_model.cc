// Model = auto: scenes that it refuses, a chain whose answer is the closed
// form, one that ends without reaching the tolerance, and the parts of its
// estimates. That the estimates bound the error is tested by
// prm/verification/auto.prm.

#include <debond/bulk/bulk_space.h>
#include <debond/campaigns/model_choice.h>
#include <debond/campaigns/run_scene.h>
#include <debond/models/closed_forms.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "driven_scene.h"

using namespace Debond;

const char *const twisted_coin = R"(
set Model = auto
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 10 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps     = 1, 10
  set Tolerance = 0.005
end
subsection Output
  set Fields every = 20
  set Directory    = results/auto
  set Console      = quiet
end
)";

std::string
contents_of(const std::string &filename)
{
  std::ostringstream text;
  text << std::ifstream(filename).rdbuf();
  return text.str();
}



bool
contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}



void
check(const std::vector<std::string> &overrides)
{
  std::ostringstream plan;
  run_scene(Scene::from_text(twisted_coin, overrides), nullptr, &plan);
}



void
show_refusal(const std::vector<std::string> &overrides)
{
  try
    {
      check(overrides);
      report("refused", false);
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}



void
report_accepted(const std::string              &what,
                const std::vector<std::string> &overrides)
{
  bool accepted = true;
  try
    {
      check(overrides);
    }
  catch (const InputError &)
    {
      accepted = false;
    }
  report(what, accepted);
}



// Where the angle holds and something else moves, torque is no function of it.
void
test_holds()
{
  const std::string times = "Load steps/Times=0, 1, 2, 3, 4",
                    steps = "Load steps/Steps=1, 2, 2, 2",
                    twist_hold_twist =
                      "Chuck/Rotation z/Value="
                      "5 * (min(max(t - 1, 0), 1) + max(t - 3, 0))";
  show_refusal({times,
                steps,
                twist_hold_twist,
                "Chuck/Press/Value="
                "0.0049 * (min(t, 1) + 0.2 * min(max(t - 2, 0), 1))"});
  show_refusal({times,
                steps,
                "Chuck/Rotation z/Value=5 * min(max(t - 1, 0), 1)",
                "Chuck/Rotation x/Value=0.01 * max(t - 3, 0)"});
  report_accepted("a hold in which nothing moves",
                  {times, steps, twist_hold_twist});
  report_accepted("pressed deeper during the rotation",
                  {"Chuck/Press/Value=0.0049 * t"});
}



/** Runs the scene; what it ends with if it fails. */
std::string
run(const std::vector<std::string> &overrides)
{
  Scene scene = Scene::from_text(twisted_coin, overrides);
  scene.output.overwrite_other_results = true;
  std::filesystem::remove_all("results/auto");
  try
    {
      run_scene(scene);
    }
  catch (const RunError &error)
    {
      return error.what();
    }
  return "";
}



std::string
summary(const std::string &name)
{
  return read_json("results/auto/summary.json")[name].dump();
}



// A run begins anew without the levels of the one before and leaves the rest.
void
test_other_results_stay()
{
  const std::vector<std::string> rigid{"Bone/Material=rigid",
                                       "Implant/Material=rigid"};
  run(rigid);
  std::filesystem::create_directory("results/auto/rung-7");
  std::filesystem::copy_file("results/auto/parameters.prm",
                             "results/auto/rung-7/parameters.prm");
  std::filesystem::create_directory("results/auto/rung-8");
  std::filesystem::create_directory("results/auto/rung-notes");
  Scene scene                          = Scene::from_text(twisted_coin, rigid);
  scene.output.overwrite_other_results = true;
  run_scene(scene);
  report("a level of an earlier run is gone",
         !std::filesystem::exists("results/auto/rung-7"));
  report("what only has the name of a level stays",
         std::filesystem::exists("results/auto/rung-8") &&
           std::filesystem::exists("results/auto/rung-notes"));
}



// Two rigid bodies on their interface: the closed form is exact.
void
test_chain_of_the_closed_form()
{
  std::cout << "rigid bodies" << std::endl;
  report("no error",
         run({"Bone/Material=rigid", "Implant/Material=rigid"}).empty());
  std::cout << summary("answer") << ", rungs " << summary("rungs")
            << ", converged " << summary("converged") << std::endl;
  TorsionModel::Disk disk;
  disk.radius    = 2.5;
  disk.pressure  = 0.0049 * 585.;
  disk.stiffness = 585.;
  const RigidBodiesTorsion exact(disk);
  const ReferenceCurve curve = read_reference_curve("results/auto/torque.csv");
  double               largest = 0., difference = 0.;
  for (const auto &[angle, torque] : curve)
    {
      const double T = exact.torque(angle * M_PI / 180.);
      grow(largest, T);
      grow(difference, std::abs(T - torque));
    }
  report("its torques against two rigid bodies", difference / largest, 1e-9);
}



void
test_tolerance_not_reached()
{
  std::cout << "a limit to the mesh" << std::endl;
  const std::string message = run({"Auto/Largest number of unknowns=16000"});
  report("the tolerance is not reached",
         contains(message, "the tolerance of 0.5 % was not reached"));
  report("why it went no further",
         contains(message,
                  "the next mesh has 105480 unknowns, more than 16000 (Auto / "
                  "Largest number of unknowns)"));
  std::cout << summary("answer") << ", rungs " << summary("rungs")
            << ", converged " << summary("converged") << std::endl;
  report("the reason is in the summary",
         contains(summary("reason"), "was not reached"));
  report("the answer's curve is there",
         contents_of("results/auto/torque.csv") ==
           contents_of("results/auto/rung-5/torque.csv"));
  report("its fields are there",
         std::filesystem::exists("results/auto/interface.pvd"));

  std::istringstream table(contents_of("results/auto/auto.csv"));
  std::string        line;
  std::getline(table, line);
  std::cout << line << std::endl;
  while (std::getline(table, line))
    {
      std::size_t verdict = 0;
      for (unsigned int i = 0; i < 12; ++i)
        verdict = line.find(',', verdict) + 1;
      std::cout << line.substr(0, line.find(',', line.find(',') + 1)) << ": "
                << line.substr(verdict) << std::endl;
    }
}



void
test_estimates()
{
  std::cout << "estimates" << std::endl;
  // errors C h^p with h halved: the finest of them is known
  for (const double p : {0.75, 1., 1.5, 2.})
    {
      const double e[] = {1., std::exp2(-p), std::exp2(-2. * p)};
      report("order found from three meshes",
             std::abs(discretisation_error({e[0] - e[1], e[1] - e[2]}) /
                        (1.25 * e[2]) -
                      1.),
             1e-12);
    }
  report("order one is assumed of two",
         std::abs(discretisation_error({0.5}) / (1.25 * 0.5) - 1.),
         1e-12);
  report("no order above two is trusted",
         discretisation_error({1., 0.01}) > 0.01 / 3.);
  report("order 0.6 is",
         std::isfinite(discretisation_error({1., std::exp2(-0.6)})));
  report("none from order 0.4",
         std::isnan(discretisation_error({1., std::exp2(-0.4)})));
  report("none from meshes that part",
         std::isnan(discretisation_error({0.01, 0.02})));

  // a triangle against a line: they differ most at its tip
  std::vector<TorqueRow> tip(3), line(2);
  tip[1].angle_deg = 0.3;
  tip[2].angle_deg = line[1].angle_deg = 1.;
  tip[1].torque_Nmm                    = 1.;
  tip[2].torque_Nmm = line[1].torque_Nmm = 2.;
  report("largest difference of two polygons",
         std::abs(largest_difference(tip, line) - 0.2),
         1e-12);
  report("the same the other way round",
         std::abs(largest_difference(line, tip) - 0.2),
         1e-12);
}



// Of 12 x 12 cells 8 x 8 are under the implant, and 2 beside them on each side.
void
test_cells_that_heed_the_rim()
{
  const ModelLadder ladder(Scene::from_text(twisted_coin,
                                            {"Bone/Element=spline",
                                             "Bone/Cells=12, 12, 3",
                                             "Bone/Cells under implant=8",
                                             "Implant/Element=spline",
                                             "Implant/Cells=4, 3"}));
  for (const ModelLevel &level : ladder.levels)
    if (level.model() == "neo-hookean" && level.mesh < 2)
      {
        const BodyParameters &bone    = level.scene.bone,
                             &implant = level.scene.implant;
        std::cout << level.description() << ", " << bone.cells_under_implant
                  << " under the implant\n";
        report("unknowns are those of the bodies",
               level.unknowns() ==
                 BulkSpace(bone, Side::bone).n_unknowns() +
                   BulkSpace(implant, Side::implant).n_unknowns());
      }
}



void
test()
{
  show_refusal({"Chuck/Rotation z/Value=0"});
  show_refusal({"Chuck/Rotation z/Value=sin(3 * t)"});
  // turns back between the ends of planned steps only
  show_refusal({"Chuck/Rotation z/Value=2 * sin(pi * 4.5 * (t - 1))",
                "Load steps/Steps=1, 1"});
  show_refusal({"Chuck/Rotation z/Control=moment"});
  test_holds();
  test_cells_that_heed_the_rim();
  test_other_results_stay();
  test_estimates();
  test_chain_of_the_closed_form();
  test_tolerance_not_reached();
}



int
main()
{
  return run_test(&test);
}
