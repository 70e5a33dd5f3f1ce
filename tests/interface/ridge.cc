// A point that is pressed into a valley of two planes, of 20 degrees either
// way, and moved from one to the other. Over the valley's line, where neither
// plane has its closest point, the normal is that of the gap: without friction
// the traction is eps_n times the gap to the line, exactly. With friction and
// other stiffnesses the traction goes on without a jump, and its derivative is
// that of differences.

#include <debond/interface/contact_point.h>

#include "checks.h"
#include "law_of_text.h"

using namespace Debond;
using Eigen::Vector3d;

constexpr double angle = 20. * M_PI / 180., depth = 0.02;

/** Two squares that rise from the line x = 0; the second one runs the other
 *  way along it. */
NurbsSurface
valley()
{
  const double x = std::cos(angle), z = std::sin(angle);
  ControlNet   net(3, 6);
  net << -x, 0., -x, 0., x, x, 0., 0., 1., 1., 1., 0., z, 0., z, 0., z, z;
  return NurbsSurface(1, {{0, 1, 2, 3}, {4, 3, 5, 1}}, net);
}



struct Question
{
  const NurbsSurface surface = valley();
  ContactPointLaw    law;
  ContactPointState  start;

  Question(const std::string &friction, const double tangential_stiffness)
  {
    law.joint =
      interface_law_of_text("set Law = friction\n", law_of_text(friction));
    law.tangential_penalty = tangential_stiffness;
    law.slip_direction     = SlipDirection::integrated;
    start.joined = start.has_partner = true;
    start.status                     = PointStatus::stick;
    start.normal_gap                 = -depth;
    start.xi                         = {0.95, 0.4};
    start.internal                   = law.joint->friction->initial_variables;
  }

  ContactPointResult
  at(const Vector3d &x) const
  {
    ContactPointResult result;
    update_contact_point(
      law, start, 1., x, {&surface, &surface.control_points(), 1.}, {}, result);
    return result;
  }
};

/** Below the line, and a little along it. */
Vector3d
place(const double x)
{
  return {x, 0.4 + 0.3 * x, -depth};
}



int
main()
{
  const double   half = depth * std::tan(angle); // of the region of the line
  const Question smooth("set Friction law = frictionless\n", 250.);
  const double   stiffness = smooth.law.joint->stiffness;
  double         missed    = 0.;
  for (double x = -0.95 * half; x < half; x += 0.1 * half)
    {
      const Vector3d gap(x, 0., -depth);
      grow(missed, (smooth.at(place(x)).traction - stiffness * gap).norm());
    }
  report("without friction eps_n times the gap, to [MPa]", missed, 1e-9);

  for (const double eps_t : {250., 600., 1500.})
    {
      const Question question(
        "set Friction law = coulomb\nset Friction coefficient = 0.3\n", eps_t);
      const double h    = 1e-6;
      double       jump = 0., derivatives = 0.;
      unsigned int on_line = 0, failed = 0;
      Vector3d     before = question.at(place(-3. * half)).traction;
      for (double x = -3. * half + h; x < 3. * half; x += h)
        {
          const auto now = question.at(place(x));
          failed += now.failed;
          grow(jump, (now.traction - before).norm());
          before = now.traction;
          if (std::abs(now.state.xi[0] - 1.) > 1e-14 &&
              std::abs(now.state.xi[0] - 3.) > 1e-14)
            continue;
          ++on_line;
          for (const Vector3d &way :
               {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)})
            {
              Eigen::Matrix<double, W::size, 1> dw;
              dw.setZero();
              dw.segment<3>(W::gap) = dw.segment<3>(W::trial_gap) = way;
              const Vector3d difference =
                (question.at(place(x) + 1e-7 * way).traction -
                 question.at(place(x) - 1e-7 * way).traction) /
                2e-7;
              if (on_line > 100 && on_line % 100 == 0)
                grow(derivatives, (difference - now.dt * dw).norm());
            }
        }
      const std::string name = "eps_t = " + std::to_string(int(eps_t)) + ": ";
      report(name + "no failure, and the line holds the point on its way",
             failed == 0 && on_line > 1000);
      report(name + "largest change of the traction in 1e-6 mm [MPa]",
             jump,
             3e-6 * std::max(eps_t, stiffness));
      report(name + "derivatives, deviation from differences [MPa/mm]",
             derivatives,
             1e-3 * stiffness);
    }
}
