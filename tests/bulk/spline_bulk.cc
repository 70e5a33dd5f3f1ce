// Bodies of quadratic splines: the coin is a cylinder at all depths; 2x2x2
// Gauss points leave them no motions without energy but the six rigid ones; the
// torque is that of an independent program; large strains hardly change it.

#include <debond/bulk/bulk_space.h>
#include <debond/models/simulation.h>

#include <Eigen/Eigenvalues>

#include "checks.h"
#include "coin_scene.h"
#include "pressed_and_turned.h"
#include "stiffness_at_rest.h"

using namespace Debond;

BodyParameters
coin(const unsigned int n, const unsigned int n_layers)
{
  BodyParameters parameters;
  parameters.shape   = BodyShape::coin;
  parameters.element = ElementKind::spline;
  parameters.cells   = {{n, n, n_layers}};
  return parameters;
}

BodyParameters
block(const unsigned int n, const unsigned int n_layers)
{
  BodyParameters parameters;
  parameters.element = ElementKind::spline;
  parameters.cells   = {{n, n, n_layers}};
  return parameters;
}



/** Distance of the side of a coin from its axis. */
void
check_cylinder()
{
  BodyParameters parameters = coin(3, 3);
  parameters.layer_grading  = 1.7;
  const BulkSpace mesh(parameters, Side::implant);
  double          deviation = 0., highest = 0.;
  for (const BulkSpace::Cell &cell : mesh.cells())
    for (const double z : {0., 0.65, 1.})
      for (const double s : {0., 0.4, 0.85})
        for (unsigned int side = 0; side < 4; ++side)
          {
            const bool         first = side % 2 == 0, at_end = side / 2 == 1;
            const unsigned int place =
              first ? cell.surface_element % 3 : cell.surface_element / 3;
            if (place != (at_end ? 2 : 0))
              continue;
            const double          end = at_end ? 1. : 0.;
            const Eigen::Vector3d X =
              CellFunctions(mesh, cell)
                .position({first ? end : s, first ? s : end, z});
            grow(deviation, std::abs(X.head<2>().norm() - parameters.radius));
            highest = std::max(highest, X[2]);
          }
  report("Side of a coin, distance from the cylinder", deviation, 1e-14);
  report("  and of its end from the height",
         std::abs(highest - parameters.height),
         1e-14);
}



/** Eigenvalues of the stiffness at rest, supports not heeded. */
void
check_modes(const std::string &name, const BodyParameters &parameters)
{
  const Eigen::MatrixXd K =
    stiffness_at_rest(BulkSpace(parameters, Side::implant));
  const Eigen::VectorXd values =
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
  const double largest = values[values.size() - 1];
  report(name + ", sixth eigenvalue over the largest",
         std::abs(values[5]) / largest,
         1e-13);
  report("  sixth over seventh", std::abs(values[5] / values[6]), 1e-8);
}



const std::string main_scene = R"(
subsection Bone
  set Cells    = 12, 12, 3
  set Material = linear
  set Element  = spline
end
subsection Implant
  set Cells    = 4, 3
  set Material = linear
  set Element  = spline
end
subsection Expert
  set Slip direction = trial
  subsection Bone
    set Cells under implant = 8
    set Layer grading       = 2
  end
  subsection Implant
    set Layer grading = 2
  end
  subsection Interface
    set Quadrature points = 5
  end
end
)" + pressed_then("Rotation z", "10 * max(t - 1, 0)") +
                               R"(
subsection Load steps
  set Steps = 1, 50
end
subsection Expert
  subsection Load steps
    set Residual tolerance = 1e-11
  end
end
)";



/** tests/comparison/numpy has no splines. These numbers are from a program
 *  that shares nothing with this one: numpy, B-splines by the recursion of de
 *  Boor, the stiffness as sums of Kronecker products of one-dimensional
 *  matrices, 2 x 2 x 2 points, 50 equal steps. */
void
check_torque()
{
  Simulation simulation(coin_scene(main_scene));
  simulation.run();
  const auto &rows = simulation.rows();
  report("Pressure",
         std::abs(rows[1].pressure_MPa / 2.623243832746 - 1.),
         1e-10);
  const std::vector<std::pair<unsigned int, std::array<double, 2>>> expected{
    {2, {{49.584834814588, 51.502707701009}}},
    {3, {{49.957458228126, 51.500627962227}}},
    {5, {{49.117241766903, 51.499811212546}}},
    {6, {{46.157884927297, 51.499722993912}}},
    {51, {{34.490657174556, 51.499483037439}}}};
  for (const auto &[step, values] : expected)
    {
      const std::string at = ", " + std::to_string(step - 1) + " steps of turn";
      report("Torque" + at,
             std::abs(rows[step].torque_Nmm / values[0] - 1.),
             1e-9);
      report("Force" + at, std::abs(rows[step].force_N / values[1] - 1.), 1e-9);
    }
}



/** Strains are 1e-3, and their squares hardly matter: 1.3e-6 of T_max in an
 *  independent finite-strain solution with trilinear cells; the bound here is
 *  5e-6. The steps through the peak are enough. */
void
check_neo_hooke()
{
  std::vector<std::vector<TorqueRow>> rows;
  for (const std::string material : {"linear", "neo-hookean"})
    {
      Simulation simulation(coin_scene(main_scene,
                                       {"Bone/Material=" + material,
                                        "Implant/Material=" + material,
                                        "Load steps/Times=0, 1, 1.1, 1.2",
                                        "Load steps/Steps=1, 20, 5"}));
      simulation.run();
      rows.push_back(simulation.rows());
    }
  double difference = 0., largest = 0.;
  for (unsigned int i = 0; i < rows[0].size(); ++i)
    {
      grow(difference, std::abs(rows[0][i].torque_Nmm - rows[1][i].torque_Nmm));
      grow(largest, rows[0][i].torque_Nmm);
    }
  report("Neo-Hookean bodies, change of the torque",
         difference / largest,
         5e-6);
  report("  and there is one", difference > 1e-7 * largest);
}



int
main()
{
  check_cylinder();
  check_modes("Coin of 2 x 2 x 1 cells", coin(2, 1));
  check_modes("Coin of 4 x 4 x 2 cells", coin(4, 2));
  check_modes("Block of 2 x 2 x 1 cells", block(2, 1));
  check_modes("Block of 4 x 4 x 2 cells", block(4, 2));
  check_torque();
  check_neo_hooke();
}
