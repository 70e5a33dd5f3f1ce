// The tangent of the whole system, assembled or applied to a vector, equals
// central differences of its residual: an implant that is turned, tilted and
// pressed by a chuck loaded in all six components, linear bodies, points that
// stick, slip and are open. The interface's part is the same assembled and
// applied column by column.

#include <debond/scene/scene.h>
#include <debond/support/runtime.h>
#include <debond/system/coupled_system.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "checks.h"
#include "coin_scene.h"
#include "softening.h"

using namespace Debond;

/** Moves the unknowns by @p dv as a Newton correction does. */
void
move(CoupledSystem &system, const Eigen::VectorXd &dv)
{
  const unsigned int        n = system.bone.n_unknowns();
  CoupledSystem::Correction correction;
  correction.unknowns = dv;
  correction.bodies   = {
      {system.bone.correction(dv.head(n), {}),
       system.implant.correction(dv.segment(n, system.implant.n_unknowns()),
                               {})}};
  system.correct(correction);
}

void
turn(CoupledSystem &system, const Chuck::Vector6 &dq)
{
  for (const auto &[component, number] : system.configuration.chuck_unknowns)
    system.chuck.correct(component, dq[component]);
}



/** Largest deviation of a block relative to the largest entry of @p scale. */
double
deviation(const Eigen::MatrixXd &ours,
          const Eigen::MatrixXd &reference,
          const Eigen::MatrixXd &scale)
{
  double       worst   = 0;
  const double largest = scale.cwiseAbs().maxCoeff();
  for (unsigned int k = 0; k < ours.size(); ++k)
    grow(worst, std::abs(ours(k) - reference(k)) / largest);
  return worst;
}

double
deviation(const Eigen::MatrixXd &ours, const Eigen::MatrixXd &reference)
{
  return deviation(ours, reference, reference);
}



/** Lifts and turns the implant, lets points face the bone anew, and presses it
 *  down by @p from there, with all other unknowns disturbed a little. */
void
check(const std::string    &name,
      const std::string    &changes,
      const Chuck::Vector6 &lifted,
      const Chuck::Vector6 &pressed)
{
  std::cout << name << std::endl;
  std::string text = R"(
    subsection Bone
      set Size     = 8, 8, 4
      set Cells    = 5, 5, 2
      set Material = linear
    end
    subsection Implant
      set Material = linear
    end
    subsection Interface
      set Normal stiffness            = 600
      set Tangential stiffness = 350
    end
    subsection Expert
      subsection Interface
        set Quadrature points = 4
      end
    end)" + changes;
  for (const char *component : ChuckParameters::names)
    {
      const bool rotation = (component[0] == 'R');
      text += "\nsubsection Chuck\nsubsection " + std::string(component) +
              "\nset Control = " + (rotation ? "moment" : "force") +
              "\nset Value = 1\nset Stiffness = none\nend\nend\n";
    }
  const Scene            scene = coin_scene(text);
  CoupledSystem          system(scene);
  const ContactPointMode mode;
  system.start(0.);
  turn(system, lifted);
  system.evaluate(mode);
  system.commit(0.);
  turn(system, pressed);
  Eigen::VectorXd disturbance(system.n_unknowns());
  for (double &component : disturbance)
    component = 5e-4 * random_number(-1., 1.);
  disturbance.tail<6>().setZero();
  move(system, disturbance);
  system.evaluate(mode);

  // what is tested
  const unsigned int n = system.n_unknowns();
  Eigen::MatrixXd    tangent, applied(n, n);
  system.tangent().assemble(tangent);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd       column(n);
  for (unsigned int j = 0; j < n; ++j)
    applied.col(j) = system.tangent().product(identity.col(j));
  Eigen::MatrixXd interface_tangent = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd interface_applied(n, n);
  system.interface.add_tangent(system.configuration, interface_tangent);
  for (unsigned int j = 0; j < n; ++j)
    {
      column.setZero();
      system.interface.apply_tangent(system.configuration,
                                     identity.col(j),
                                     column);
      interface_applied.col(j) = column;
    }
  const auto summary = system.interface.summarise();
  std::cout << "  points stick: " << (summary.share_stick > 0.01)
            << ", slip: " << (summary.share_slip > 0.01)
            << ", are open: " << (summary.share_open > 0.01)
            << ", soften: " << softens(system.interface, 3.5) << std::endl;

  // what it is tested against
  Eigen::MatrixXd difference(n, n);
  for (unsigned int j = 0; j < n; ++j)
    {
      const double step = (j + 3 < n ? 1e-6 : 1e-6 / system.R);
      move(system, step * identity.col(j));
      column = system.evaluate(mode).unknowns;
      move(system, -2. * step * identity.col(j));
      difference.col(j) =
        (column - system.evaluate(mode).unknowns) / (2. * step);
      move(system, step * identity.col(j));
    }
  report("  the unknowns stay the same", system.n_unknowns() == n);
  report("  interface, assembled against applied",
         deviation(interface_applied, interface_tangent),
         1e-12);
  report("  system, assembled against applied",
         deviation(applied, tangent),
         1e-12);
  const unsigned int m = n - 6;
  // stiffnesses of the bodies, known exactly, are much larger
  report("  bodies against central differences",
         deviation(tangent.topLeftCorner(m, m),
                   difference.topLeftCorner(m, m),
                   interface_tangent.topLeftCorner(m, m)),
         1e-6);
  report("  bodies with chuck",
         std::max(deviation(tangent.topRightCorner(m, 3),
                            difference.topRightCorner(m, 3)),
                  deviation(tangent.block(0, m, m, 3),
                            difference.block(0, m, m, 3))),
         1e-6);
  report("  chuck with bodies",
         std::max(deviation(tangent.bottomLeftCorner(3, m),
                            difference.bottomLeftCorner(3, m)),
                  deviation(tangent.block(m, 0, 3, m),
                            difference.block(m, 0, 3, m))),
         1e-6);
  double chuck = 0;
  for (const unsigned int i : {0, 3})
    for (const unsigned int j : {0, 3})
      grow(chuck,
           deviation(tangent.block(m + i, m + j, 3, 3),
                     difference.block(m + i, m + j, 3, 3)));
  report("  chuck with itself", chuck, 1e-6);
}



int
main()
{
  set_up_libraries();
  const std::string bone_is_slave = R"(
    subsection Expert
      subsection Interface
        set Slave = bone
      end
    end)";

  // nearly flat: sticking and slipping points, some of them softening
  Chuck::Vector6 lifted, pressed;
  lifted << 0.1, -0.2, 0.5, 0.002, -0.001, 0.7;
  pressed << 0.001, -0.002, -0.507, 0.0005, -0.0003, 0.012;
  check("Pressed flat", "", lifted, pressed);
  check("Pressed flat, the bone is the slave", bone_is_slave, lifted, pressed);

  // on its edge: a large tilt
  lifted << 0., 0., 1., 0.3, -0.2, 0.9;
  pressed << 0.01, 0.02, -0.55, 0.002, -0.001, 0.01;
  check("On its edge", "", lifted, pressed);
  check("On its edge, the bone is the slave", bone_is_slave, lifted, pressed);
}
