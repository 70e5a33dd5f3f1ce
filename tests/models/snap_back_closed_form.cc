// Two rigid bodies turned by a compliant machine, in closed form: where the
// machine's angle falls along the curve of equilibrium, what an independent
// computation finds, and the energy released in the jump against the integral
// between spring and torque.

#include <debond/interface/modified_coulomb.h>
#include <debond/models/closed_forms.h>

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>

#include "checks.h"

using namespace Debond;

constexpr double degree = M_PI / 180.;

/** A bond that breaks within 3 um of sliding. */
RigidBodiesTorsion
brittle_bond()
{
  TorsionModel::Disk parameters;
  parameters.radius    = 2.5;
  parameters.pressure  = 2.6;
  parameters.stiffness = 585;
  parameters.friction  = Debond::modified_coulomb({0.40, 0.58, 0.005, 0.3});
  return RigidBodiesTorsion(parameters);
}



int
main()
{
  const RigidBodiesTorsion      bodies = brittle_bond();
  const double                  k      = 3000;
  const CompliantMachineTorsion machine(bodies, k, 2. * degree);

  // an independent computation: a table of int d^2 t(d) dd with 400 000
  // intervals, theta in steps of 1e-4 degrees
  const auto &jump = machine.jumps.at(0);
  report("one jump", machine.jumps.size() == 1);
  report("its machine angle [deg]",
         std::abs(jump.machine_angle / degree - 1.1215001),
         1e-6);
  report("where it begins [deg]",
         std::abs(jump.angle_before / degree - 0.1925),
         2e-4);
  report("torque where it begins, relative",
         std::abs(jump.torque_before / 48.6423 - 1.),
         1e-3);
  report("where it ends [deg]",
         std::abs(jump.angle_after / degree - 0.4459),
         2e-4);
  report("torque where it ends, relative",
         std::abs(jump.torque_after / 35.373 - 1.),
         1e-4);
  report("energy released in it, relative",
         std::abs(jump.released_energy / 0.0127672 - 1.),
         1e-3);

  // the area between the spring's line and the curve
  double area = 0;
  for (unsigned int i = 0; i < 100; ++i)
    {
      const double part = (jump.angle_after - jump.angle_before) / 100.;
      area += boost::math::quadrature::gauss<double, 10>::integrate(
        [&](const double theta) {
          return k * (jump.machine_angle - theta) - bodies.torque(theta);
        },
        jump.angle_before + i * part,
        jump.angle_before + (i + 1) * part);
    }
  report("released energy against the area between the curves, relative",
         std::abs(area / jump.released_energy - 1.),
         1e-6);

  // a machine that turns on and on
  double worst = 0;
  for (const double angle : {0.01, 0.1, 0.19, 0.45, 1., 1.9})
    grow(worst,
         std::abs(machine.angle(machine.machine_angle(angle * degree)) /
                    (angle * degree) -
                  1.));
  report("angle from machine angle beside the jump, relative", worst, 1e-10);
  report("it skips what lies in the jump",
         machine.angle(jump.machine_angle + 1e-9) >= jump.angle_after);

  // the steepest fall of the torque, 8901.6 N mm/rad by the same independent
  // computation, divides machines that snap back from those that do not
  for (const double stiffness : {8700., 9100.})
    report("snaps back at " + std::to_string(int(stiffness)) + " N mm/rad",
           CompliantMachineTorsion(bodies, stiffness, 2. * degree)
               .jumps.empty() == (stiffness > 8901.6));
}
