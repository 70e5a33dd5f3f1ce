// The equation that prescribes the mean sliding distance: its row of the
// tangent equals central differences of the mean over the interface, in the
// control points of both bodies and all six chuck components; the system with
// it is the same assembled and applied.

#include <debond/scene/scene.h>
#include <debond/support/runtime.h>
#include <debond/system/coupled_system.h>

#include <sstream>
#include <string>

#include "checks.h"
#include "coin_scene.h"

using namespace Debond;

void
check(const std::string &slave)
{
  std::cout << "The slave is the " << slave << std::endl;
  const Scene      scene = coin_scene(R"(
    subsection Bone
      set Size     = 8, 8, 4
      set Cells    = 5, 5, 2
      set Material = linear
    end
    subsection Implant
      set Material = linear
    end
    subsection Expert
      subsection Interface
        set Slave             = )" +
                                 slave +
                                 R"(
        set Quadrature points = 4
      end
    end
    subsection Chuck
      subsection Press
        set Value = -(-0.005 - 0.001 * t)
      end
      subsection Rotation z
        set Value     = 1.5 * t + t * t
        set Stiffness = 50000
      end
    end
    subsection Load steps
      set Path following = slip
    end)");
  CoupledSystem    system(scene);
  ContactPointMode mode;
  system.start(0.);
  system.predict(0., 0., false);
  system.evaluate(mode);
  system.commit(0.);

  // a trial state beside equilibrium, part of which slides
  system.predict(0.4, 1., false);
  system.prescribe_slip(1e-3);
  system.chuck.correct(5, 0.006);
  const unsigned int n    = system.n_unknowns();
  const auto         move = [&](const Eigen::VectorXd &dv) {
    const unsigned int n_bone    = system.bone.n_unknowns(),
                       n_implant = system.implant.n_unknowns();
    system.bone.correct(system.bone.correction(dv.head(n_bone), {}));
    system.implant.correct(
      system.implant.correction(dv.segment(n_bone, n_implant), {}));
    for (const auto &[component, number] : system.configuration.chuck_unknowns)
      system.chuck.correct(component, dv[number]);
  };
  Eigen::VectorXd disturbance(n);
  for (double &component : disturbance)
    component = 1e-4 * random_number(-1., 1.);
  disturbance.tail<7>().setZero();
  move(disturbance);
  system.evaluate(mode);
  const auto summary = system.interface.summarise();
  report("  some points stick, some slide",
         summary.share_stick > 0.05 && summary.share_slip > 0.05);

  Eigen::MatrixXd tangent, applied(n, n);
  system.tangent().assemble(tangent);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  for (unsigned int j = 0; j < n; ++j)
    applied.col(j) = system.tangent().product(identity.col(j));
  report("  assembled against applied",
         (tangent - applied).cwiseAbs().maxCoeff() /
           tangent.cwiseAbs().maxCoeff(),
         1e-12);

  // the row is the mean in units of force; what the unit is comes from its
  // largest entry
  const Eigen::RowVectorXd row = tangent.row(n - 1);
  Eigen::RowVectorXd       difference(n);
  const auto               mean = [&]() {
    system.evaluate(mode);
    return system.interface.path_length(system.configuration).value;
  };
  for (unsigned int j = 0; j < n; ++j)
    {
      const double step = 1e-7;
      move(step * identity.col(j));
      const double above = mean();
      move(-2. * step * identity.col(j));
      difference[j] = (above - mean()) / (2. * step);
      move(step * identity.col(j));
    }
  int largest = 0;
  difference.cwiseAbs().maxCoeff(&largest);
  const double unit = row[largest] / difference[largest];
  report("  row against central differences",
         (row / unit - difference).cwiseAbs().maxCoeff() /
           std::abs(difference[largest]),
         1e-6);
  double control_points = 0;
  for (unsigned int j = 0; j + 7 < n; ++j)
    grow(control_points, std::abs(row[j] / unit - difference[j]));
  report("  the same for control points, relative to the largest of them",
         control_points / difference.head(n - 7).cwiseAbs().maxCoeff(),
         1e-6);

  // the loads of the chuck over the time, exactly: 50 000 N mm/rad times
  // (1.5 + 2 t) degrees
  report("  load over time",
         std::abs(tangent(n - 2, n - 1) /
                    (-50000. * (1.5 + 2. * 0.4) * M_PI / 180.) -
                  1.),
         1e-8);

  // a correction that is shortened: the time is one of what it corrects, and
  // prescribed components follow the time
  const auto           residual   = system.evaluate(mode);
  const double         time       = system.time();
  const Chuck::Vector6 start      = system.chuck.position();
  const auto           correction = system.solve(residual, 1e-9);
  system.correct(correction);
  const double         full_time = system.time();
  const Chuck::Vector6 full      = system.chuck.position();
  system.correct(correction, -0.75);
  report("  a quarter of the time's correction",
         std::abs((system.time() - time) / (full_time - time) - 0.25),
         1e-9);
  report("  a quarter of the angle's correction",
         std::abs((system.chuck.position()[5] - start[5]) /
                    (full[5] - start[5]) -
                  0.25),
         1e-9);
  report("  the prescribed component is where the scene has it at that time",
         std::abs(system.chuck.position()[2] -
                  system.chuck.values(system.time())[2]),
         1e-15);
}



int
main()
{
  set_up_libraries();
  check("implant");
  check("bone");
}
