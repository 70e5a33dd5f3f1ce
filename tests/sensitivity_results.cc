// Derivatives by parameters: of rigid bodies against those of the exact torque;
// with adaptive steps against those of the same times as planned steps; of a
// run that went on from an archive against one in one go, to the last bit; and
// as Output / Sensitivities writes them, of finite elements and of a closed
// form.

#include <debond/campaigns/run_scene.h>
#include <debond/models/closed_forms.h>
#include <debond/models/simulation.h>
#include <debond/support/number_text.h>
#include <debond/support/written_files.h>

#include <sstream>

#include "driven_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;

const std::string small_coin = pressed_and_turned +
                               "subsection Bone\n"
                               " set Material = linear\n set Cells = 6, 6, 2\n"
                               "end\n"
                               "subsection Implant\n"
                               " set Material = linear\n set Cells = 2, 2\n"
                               "end\n"
                               "subsection Output\n"
                               " set Sensitivities = Interface/Sliding "
                               "threshold, Chuck/Translation z/Value,\\\n"
                               "  Interface/Bonding/Initial bonding\n"
                               "end\n"
                               "subsection Load steps\n"
                               " set Steps = 2, 20\n"
                               "end\n";

std::vector<Simulation::RowDerivatives>
derivatives(const Scene &scene)
{
  Simulation simulation(scene);
  simulation.differentiate(variations_of(scene));
  simulation.run();
  return simulation.row_derivatives();
}



void
check_exact_torque()
{
  const Scene scene = Scene::from_text(
    small_coin,
    {"Bone/Material=rigid",
     "Implant/Material=rigid",
     "Implant/Cells=20, 2",
     "Interface/Quadrature points=8",
     "Output/Sensitivities=Interface/Sliding threshold, Interface/Friction "
     "coefficient unbroken, Interface/Tangential penalty stiffness",
     "Interface/Tangential penalty stiffness=400"});
  const auto torque = [&](const Scene &varied, const double angle) {
    TorsionModel::Disk disk;
    disk.radius    = 2.5;
    disk.pressure  = 585 * 0.0049;
    disk.stiffness = varied.interface.tangential_stiffness();
    disk.friction  = varied.interface.friction;
    return RigidBodiesTorsion(disk).torque(angle);
  };
  const auto ours       = derivatives(scene);
  const auto variations = variations_of(scene);
  for (unsigned int j = 0; j < variations.size(); ++j)
    {
      double error = 0., largest = 0.;
      for (unsigned int i = 0; i <= 20; ++i)
        {
          // a wider difference, as the torque is an integral by quadrature
          const double h        = 1e-3;
          const auto   entry    = scene.output.sensitivities[j];
          const double value    = 0.5 * variations[j].width / 1e-5;
          const auto   exact_at = [&](const double factor) {
            return torque(Scene::from_text(scene.completed_parameters,
                                           {entry + "=" +
                                            exact_text(factor * value)}),
                          i * 0.5 * M_PI / 180.);
          };
          const double exact =
            (exact_at(1. + h) - exact_at(1. - h)) / (2. * h * value);
          grow(error, std::abs(ours[i + 2].torque[j] - exact));
          grow(largest, std::abs(exact));
        }
      report("exact torque by " + variations[j].name + ", relative difference",
             error / largest,
             2e-3);
    }
}



void
check_adaptive()
{
  const Scene scene =
    Scene::from_text(small_coin,
                     {"Load steps/Adaptive=true", "Load steps/Steps=1, 10"});
  Simulation simulation(scene);
  simulation.differentiate(variations_of(scene));
  simulation.run();
  std::string times, steps;
  for (const TorqueRow &row : simulation.rows())
    {
      times += (times.empty() ? "" : ", ") + exact_text(row.time);
      if (row.step > 0)
        steps += (steps.empty() ? "" : ", ") + std::string("1");
    }
  const auto  planned    = derivatives(Scene::from_text(
    small_coin, {"Load steps/Times=" + times, "Load steps/Steps=" + steps}));
  const auto &adaptive   = simulation.row_derivatives();
  double      difference = 0., largest = 0.;
  for (unsigned int i = 0; i < adaptive.size(); ++i)
    {
      grow(difference, (adaptive[i].reaction - planned[i].reaction).norm());
      grow(largest, planned[i].reaction.norm());
    }
  report("adaptive steps against planned ones, relative difference",
         difference / largest,
         1e-6);
}



void
check_resumed()
{
  const Scene       scene = Scene::from_text(small_coin);
  const auto        whole = derivatives(scene);
  std::stringstream bytes;
  {
    Simulation first(scene);
    first.differentiate(variations_of(scene));
    while (first.rows().size() < 12)
      first.advance();
    boost::archive::binary_oarchive archive(bytes);
    archive << first;
  }
  Simulation second(scene);
  second.differentiate(variations_of(scene));
  boost::archive::binary_iarchive archive(bytes);
  archive >> second;
  second.run();
  const auto &resumed = second.row_derivatives();
  bool        same    = resumed.size() == whole.size();
  for (unsigned int i = 0; same && i < whole.size(); ++i)
    same = resumed[i].reaction == whole[i].reaction &&
           resumed[i].position == whole[i].position &&
           resumed[i].torque == whole[i].torque;
  report("a run that goes on has the same derivatives", same);
}



void
check_files()
{
  for (const std::string model : {"finite elements", "foundation"})
    {
      Scene scene                          = Scene::from_text(small_coin,
                                     {"Model=" + model,
                                                               "Output/Directory=results/" + model,
                                                               "Output/Console=quiet"});
      scene.output.overwrite_other_results = true;
      run_scene(scene);
      std::istringstream text(
        read_whole_file("results/" + model + "/sensitivities.csv")
          .value_or(""));
      std::string line;
      std::getline(text, line);
      std::cout << model << ": " << line.substr(0, line.find(",d chuck_"))
                << std::endl;
      unsigned int n = 0;
      while (std::getline(text, line))
        ++n;
      report("  a line for each row", n == scene.load_steps.n_steps() + 1);
    }
}



void
check_all()
{
  check_exact_torque();
  check_adaptive();
  check_resumed();
  check_files();
}

int
main()
{
  return run_test(check_all);
}
