#include <debond/models/torsion_curve.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Debond
{
  namespace
  {
    /** The integral of s^2 t ds from 0 to a path that grows, for points of one
     *  phi_0. */
    class AlongPath
    {
    public:
      AlongPath(const TorsionModel::Disk &disk, const double phi_0)
        : disk(disk)
        , phi_0(phi_0)
        , stick_limit(path_at(0.))
      {
        // smooth parts of the decay are divided, for the Gauss points
        constexpr unsigned int parts = 16;
        const auto            &kinks = disk.friction->kinks;
        ends                         = kinks;
        for (unsigned int i = 1; i < parts; ++i)
          ends.push_back(kinks.front() +
                         (kinks.back() - kinks.front()) * i / parts);
        std::sort(ends.begin(), ends.end());
      }

      /** Goes on to the path @p target [mm]. */
      void
      go_to(const double target)
      {
        if (s < stick_limit)
          {
            const double end = std::min(target, stick_limit);
            integral +=
              disk.stiffness * (std::pow(end, 4) - std::pow(s, 4)) / 4.;
            s = end;
          }
        if (target <= stick_limit)
          return;
        const double last = slip_at(target);
        for (auto end = std::upper_bound(ends.begin(), ends.end(), g); g < last;
             ++end)
          slide_to(end == ends.end() ? last : std::min(last, *end));
        s = target;
      }

      double integral = 0; ///< [N mm]

    private:
      double
      path_at(const double slip) const
      {
        return slip + disk.limit(phi_0, slip).value / disk.stiffness;
      }

      /** The sliding distance at a path, which is beyond the last one. */
      double
      slip_at(const double target) const
      {
        const auto excess = [&](const double slip) {
          const FrictionLimit L = disk.limit(phi_0, slip);
          return std::make_pair(slip + L.value / disk.stiffness - target,
                                1. + L.by_slip / disk.stiffness);
        };
        // where L is constant the first step is the last one
        const double guess = std::max(g, target - (path_at(g) - g));
        return boost::math::tools::newton_raphson_iterate(
          excess, std::min(guess, target), g, target, 50);
      }

      void
      slide_to(const double end)
      {
        integral += boost::math::quadrature::gauss<double, 7>::integrate(
          [&](const double slip) {
            const FrictionLimit L = disk.limit(phi_0, slip);
            const double        s = slip + L.value / disk.stiffness;
            return s * s * L.value * (1. + L.by_slip / disk.stiffness);
          },
          g,
          end);
        g = end;
      }

      const TorsionModel::Disk &disk;
      const double              phi_0;
      const double              stick_limit; ///< path [mm]
      std::vector<double>       ends;        ///< of parts of g [mm]
      double                    s = 0, g = 0;
    };
  } // namespace



  // A bonded core and what surrounds it are two such integrals: that of the
  // core up to its edge, and that of the surroundings from there on.
  Eigen::VectorXd
  torsion_curve(const TorsionModel::Disk  &disk,
                const std::vector<double> &angles)
  {
    const double R = disk.radius, R_core = std::min(R, disk.bonded_radius);
    std::vector<std::size_t> order(angles.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto i, const auto j) {
      return std::abs(angles[i]) < std::abs(angles[j]);
    });
    AlongPath       core(disk, disk.phi_0), inside(disk, 0.), around(disk, 0.);
    Eigen::VectorXd torque = Eigen::VectorXd::Zero(angles.size());
    for (const std::size_t i : order)
      {
        const double angle = std::abs(angles[i]);
        if (angle == 0.)
          continue;
        const double factor =
          std::copysign(2. * M_PI / std::pow(angle, 3), angles[i]);
        core.go_to(R_core * angle);
        torque[i] = factor * core.integral;
        if (R_core == R)
          continue;
        inside.go_to(R_core * angle);
        around.go_to(R * angle);
        torque[i] += factor * (around.integral - inside.integral);
      }
    return torque;
  }
} // namespace Debond
