// A program that uses the library and does not say that it takes all processes
// of mpirun: each solves scenes of its own, by multigrid, as one process does.
// Then those of a communicator solve one together, against the direct solver;
// scenes that differ are refused, and what ends a run on one rank does so on
// all. MPI, which the library has initialised, is ended when the program exits.

#include <debond/models/simulation.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <memory>

#include "../checks.h"

using namespace Debond;



/** The scene of doc/example, coarser; the motion is no text. */
Scene
coin(const BulkSolver solver, const double angle)
{
  Scene scene;
  scene.bone.cells                   = {{8, 8, 2}};
  scene.bone.material                = Material::linear;
  scene.bone.bulk_solver             = solver;
  scene.implant.shape                = BodyShape::coin;
  scene.implant.cells                = {{4, 4, 2}};
  scene.implant.material             = Material::linear;
  scene.implant.young_modulus        = 113000;
  scene.interface.normal_penalty     = 585;
  scene.interface.tangential_penalty = 585;
  scene.chuck.component[2].function  = [](const double t) {
    return -0.0049 * std::min(t, 1.);
  };
  scene.chuck.component[5].function = [angle](const double t) {
    return angle * std::max(t - 1., 0.);
  };
  scene.load_steps.times              = {0, 1, 2};
  scene.load_steps.steps              = {1, 4};
  scene.load_steps.residual_tolerance = 1e-10;
  scene.check();
  return scene;
}



double
difference(const Simulation &simulation, const double angle)
{
  Simulation direct(coin(BulkSolver::direct, angle));
  direct.run();
  double result = 0., largest = 0.;
  for (unsigned int i = 0; i < direct.rows().size(); ++i)
    {
      grow(result,
           std::abs(simulation.rows().at(i).torque_Nmm -
                    direct.rows()[i].torque_Nmm));
      grow(largest, std::abs(direct.rows()[i].torque_Nmm));
    }
  return result / largest;
}



std::string
message_of(const std::function<void()> &work)
{
  try
    {
      work();
    }
  catch (const std::exception &error)
    {
      return error.what();
    }
  return "NO error";
}



/** Of all processes; the first one reports. */
void
report_of_all(const std::string &what, const double value)
{
  const Ranks::Together together(MPI_COMM_WORLD);
  const double          largest = Ranks::largest(value);
  if (Ranks::is_first())
    report(what, largest, 1e-8);
}



int
main()
{
  set_up_libraries();
  const bool was_alone = Ranks::number() == 1;
  Simulation first_alone(coin(BulkSolver::multigrid, 5));
  first_alone.run();
  int rank, n_processes;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_processes);
  report_of_all("alone", difference(first_alone, 5) + !was_alone);

  Simulation own(coin(BulkSolver::multigrid, 2. + rank));
  for (unsigned int row = 0; row < 2; ++row)
    own.advance();

  std::unique_ptr<Simulation> shared;
  {
    const Ranks::Together together(MPI_COMM_WORLD);
    shared = std::make_unique<Simulation>(coin(BulkSolver::multigrid, 5));
    own.run(); // goes on alone
  }
  const auto ends = shared->signals.row.connect([rank](const TorqueRow &row) {
    if (rank == 1 && row.step == 2)
      throw std::logic_error("enough");
  });
  const std::string why = message_of([&] { shared->run(); });
  ends.disconnect();
  shared->run(); // still together
  report_of_all("scenes of their own", difference(own, 2. + rank));
  report_of_all("together", difference(*shared, 5));

  const std::string refusal = message_of([&] {
    const Ranks::Together together(MPI_COMM_WORLD);
    Simulation            differ(coin(BulkSolver::multigrid, 5. + rank));
  });
  // those of the last one, which mpirun might print before lines of the first
  const auto words = dealii::Utilities::MPI::all_gather(
    MPI_COMM_WORLD, refusal.substr(0, refusal.find(" over time")) + '\n' + why);
  if (rank == 0)
    std::cout << words[n_processes - 1] << std::endl;
}
