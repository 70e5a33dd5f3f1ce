// Two rigid bodies against the closed form of torsion: the error of the torque
// falls with the order of the quadrature, and the traction is that of the
// closed form at each quadrature point.

#include <debond/models/closed_forms.h>

#include <functional>

#include "driven_scene.h"

const char *const scene_text = R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
end
subsection Chuck
  subsection Press
    set Value = 2.6 / 585 * min(t, 1)
  end
  subsection Rotation z
    set Value = max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 1.05, 1.1, 1.2, 1.6, 2, 2.5, 3, 11
  set Steps = 1, 1, 1, 2, 8, 8, 10, 10, 160
end
)";

const std::vector<double> angles_deg{0.05, 0.1, 0.2, 0.6, 1, 1.5, 2, 10};

Debond::TorsionModel::Disk
paper()
{
  Debond::TorsionModel::Disk parameters;
  parameters.radius    = 2.5;
  parameters.pressure  = 2.6;
  parameters.stiffness = 585;
  return parameters;
}

const Debond::RigidBodiesTorsion closed_form(paper());



/** Goes through all angles and calls @p look at each. */
void
twist(const std::vector<std::string>                   &overrides,
      const std::function<void(DrivenScene &, double)> &look)
{
  DrivenScene driven(scene_text, overrides);
  for (const double angle : angles_deg)
    {
      driven.advance_to(1 + angle);
      look(driven, angle * M_PI / 180);
    }
}



void
check_torque()
{
  double before = 0;
  for (const unsigned int n : {3, 4, 5, 6, 7, 8, 9, 10})
    {
      double worst = 0;
      twist({"Expert/Interface/Quadrature points=" + std::to_string(n)},
            [&](DrivenScene &driven, const double theta) {
              grow(worst,
                   std::abs(driven.system.chuck_forces()[5] /
                              closed_form.torque(theta) -
                            1));
            });
      if (n == 3)
        report("error of the torque with order 3", worst, 5e-3);
      else
        report("error of the torque with order " + std::to_string(n) +
                 " over that with order " + std::to_string(n - 1),
               worst / before,
               1);
      before = worst;
    }
  report("error of the torque with order 10", before, 3e-4);
}



/**
 * Traction at the radius @p r, relative to the pressure, without the closed
 * form's assumption that the elastic gap is short against the radius: the
 * interacting point follows the slave point like a towed one, at the distance
 * mu(g_s) p / eps_t, and does not stay on the circle. Integrated in the turning
 * frame, by Runge and Kutta.
 */
double
towed(const double r, const double theta)
{
  const auto   parameters = paper();
  const double length     = parameters.pressure / parameters.stiffness;
  const auto   mu         = [&](const double slip) {
    return parameters.friction->coefficient({1., {slip}}, 0.);
  };
  const double longest = mu(0).mu * length; // gap of a sticking point
  const double begin  = longest < 2 * r ? 2 * std::asin(longest / (2 * r)) : 7.;
  const double turned = std::min(begin, theta);
  // gap and sliding distance; the slave point is at (r, 0)
  Eigen::Vector3d state(r - r * std::cos(turned), r * std::sin(turned), 0);
  if (theta > begin)
    {
      const auto rate = [&](const Eigen::Vector3d &y) {
        const Eigen::Vector2d gap  = y.head<2>();
        const Eigen::Vector2d tau  = gap.normalized();
        const double          slip = tau[1] * r / (1 + mu(y[2]).dmu * length);
        return Eigen::Vector3d(-slip * tau[0] + gap[1],
                               r - slip * tau[1] - gap[0],
                               slip);
      };
      constexpr unsigned int n = 1000;
      const double           h = (theta - begin) / n;
      for (unsigned int i = 0; i < n; ++i)
        {
          const Eigen::Vector3d k1 = rate(state);
          const Eigen::Vector3d k2 = rate(state + 0.5 * h * k1);
          const Eigen::Vector3d k3 = rate(state + 0.5 * h * k2);
          const Eigen::Vector3d k4 = rate(state + h * k3);
          state += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
    }
  return state.head<2>().norm() / length;
}



/** Calls @p look with radius, angle and traction over pressure of all points.
 */
void
look_at_points(
  const unsigned int                                           n,
  const std::function<void(double r, double theta, double t)> &look)
{
  twist({"Expert/Interface/Quadrature points=" + std::to_string(n)},
        [&](DrivenScene &driven, const double theta) {
          const auto &system = driven.system;
          const auto &control_points =
            system.configuration.side[system.interface.slave_side()].positions;
          for (const auto &point : system.interface.get_points())
            {
              Eigen::Vector3d x = Eigen::Vector3d::Zero();
              for (unsigned int a = 0; a < point.basis.size; ++a)
                x += point.basis.N[a] *
                     control_points.col(point.basis.control_point[a]);
              look(x.head<2>().norm(),
                   theta,
                   point.trial.tangential_traction.norm() /
                     closed_form.disk.pressure);
            }
        });
}



void
check_traction()
{
  double by_closed_form = 0, by_towed = 0;
  look_at_points(5, [&](const double r, const double theta, const double t) {
    grow(by_closed_form,
         std::abs(t - closed_form.point(r, theta).traction /
                        closed_form.disk.pressure));
  });
  report("traction over pressure differs from the closed form",
         by_closed_form,
         1e-5);
  // Closer to the axis the closed form itself is that much off.
  look_at_points(10, [&](const double r, const double theta, const double t) {
    if (r < 0.5)
      grow(by_towed, std::abs(t - towed(r, theta)));
  });
  report(
    "traction over pressure near the axis differs from that of a towed point",
    by_towed,
    1e-5);
}



void
test()
{
  check_torque();
  check_traction();
}



int
main()
{
  return run_test(test);
}
