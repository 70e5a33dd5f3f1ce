#include <debond/models/closed_forms.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace Debond
{
  namespace
  {
    constexpr double pi = dealii::numbers::PI;



    /** The zero between @p a and @p b of a function that rises. Where rounding
     *  has put it next to one of them, that one. */
    template <typename Function>
    double
    zero_of(const Function &f, const double a, const double b)
    {
      const double f_a = f(a), f_b = f(b);
      if (f_a >= 0.)
        return a;
      if (f_b <= 0.)
        return b;
      std::uintmax_t max_iterations = 200;
      const auto     bracket        = boost::math::tools::toms748_solve(
        f,
        a,
        b,
        f_a,
        f_b,
        boost::math::tools::eps_tolerance<double>(),
        max_iterations);
      return 0.5 * (bracket.first + bracket.second);
    }
  } // namespace



  double
  TorsionModel::Disk::slip_at(const double phi_0,
                              const double target,
                              const double before) const
  {
    const auto excess = [&](const double slip) {
      const FrictionLimit L = limit(phi_0, slip);
      return std::make_pair(slip + L.value / stiffness - target,
                            1. + L.by_slip / stiffness);
    };
    // where L is constant the first step is the last one
    const double guess = target - (path(phi_0, before) - before);
    return boost::math::tools::newton_raphson_iterate(
      excess, std::clamp(guess, before, target), before, target, 50);
  }



  TorsionModel::Point
  TorsionModel::point_with(const bool   sticks,
                           const double r,
                           const double slip,
                           const double theta) const
  {
    const auto   law = disk.friction->coefficient({initial_bonding(r), {slip}},
                                                0.,
                                                disk.pressure);
    const double traction =
      sticks ? disk.stiffness * r * std::abs(theta) : law.mu * disk.pressure;
    return {sticks, slip, std::copysign(traction, theta), law.phi, law.mu};
  }



  TorsionModel::State
  TorsionModel::state(const double theta) const
  {
    const double R = disk.radius;
    State        sum;
    const auto   add = [&](const double r, const double weight) {
      const Point  here = point(r, theta);
      const double dA   = 2. * pi * r * weight;
      sum.torque += r * here.traction * dA;
      sum.phi_mean += here.phi * dA / (pi * R * R);
      if (here.traction != 0.) // else the stiffness may be zero, too
        sum.stored_energy +=
          0.5 * here.traction * here.traction / disk.stiffness * dA;
      const PointWork work =
        disk.friction->work({initial_bonding(r)}, disk.pressure, here.slip);
      sum.dissipation += work.friction * dA;
      sum.adhesive_work += work.adhesive * dA;
    };

    // The fields are smooth between kinks, so that Gauss points do.
    std::vector<double> ends = kinks(theta);
    ends.push_back(R);
    std::sort(ends.begin(), ends.end());
    using Gauss  = boost::math::quadrature::gauss<double, 30>;
    double begin = 0.;
    for (const double kink : ends)
      {
        const double end = std::min(R, kink);
        if (!(end > begin))
          continue;
        const double half = 0.5 * (end - begin), middle = 0.5 * (end + begin);
        for (unsigned int q = 0; q < Gauss::abscissa().size(); ++q)
          for (const double side : {-1., 1.})
            add(middle + side * half * Gauss::abscissa()[q],
                half * Gauss::weights()[q]);
        begin = end;
      }
    return sum;
  }



  RigidBodiesTorsion::RigidBodiesTorsion(const Disk &disk)
    : TorsionModel(disk)
  {
    AssertThrow(has_unique_solution(disk),
                dealii::ExcMessage(
                  "The friction coefficient falls too fast for the tangential "
                  "stiffness of the interface: the traction would jump."));
  }



  double
  RigidBodiesTorsion::slip(const double r, const double theta) const
  {
    const double phi_0 = initial_bonding(r), path = r * std::abs(theta);
    return path <= disk.path(phi_0) ? 0. : disk.slip_at(phi_0, path);
  }



  double
  RigidBodiesTorsion::stick_radius(const double theta) const
  {
    // a bonded core sticks further out than what surrounds it, or not at all
    const double core  = std::min(disk.radius, disk.bonded_radius);
    const double angle = std::max(1e-300, std::abs(theta));
    const double inner = disk.path(disk.phi_0) / angle;
    if (inner < core)
      return inner;
    return std::min(disk.radius, std::max(core, disk.path(0.) / angle));
  }



  std::vector<double>
  RigidBodiesTorsion::kinks(const double theta) const
  {
    std::vector<double> kinks{disk.bonded_radius};
    if (theta != 0.)
      for (const double phi_0 : {disk.phi_0, 0.})
        {
          kinks.push_back(disk.path(phi_0) / std::abs(theta));
          for (const double slip : disk.friction->kinks)
            kinks.push_back(disk.path(phi_0, slip) / std::abs(theta));
        }
    return kinks;
  }



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
        , stick_limit(disk.path(phi_0))
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
        const double last = disk.slip_at(phi_0, target, g);
        for (auto end = std::upper_bound(ends.begin(), ends.end(), g); g < last;
             ++end)
          slide_to(end == ends.end() ? last : std::min(last, *end));
        s = target;
      }

      double integral = 0; ///< [N mm]

    private:
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



  // Of states with the same machine angle a machine that turns on and on comes
  // to the first one: it jumps from a maximum that exceeds all before to where
  // the curve rises beyond it.
  CompliantMachineTorsion::CompliantMachineTorsion(const TorsionModel &bodies,
                                                   const double stiffness,
                                                   const double largest_angle)
    : bodies(bodies)
    , stiffness(stiffness)
    , largest_angle(largest_angle)
  {
    constexpr unsigned int n    = 4000;
    const double           step = largest_angle / n;
    std::vector<double>    samples;
    for (unsigned int i = 0; i <= n; ++i)
      samples.push_back(machine_angle(i * step));
    const auto stored_or_dissipated = [&](const double theta, const double at) {
      const auto state = bodies.state(theta);
      return 0.5 * stiffness * std::pow(at - theta, 2) + state.stored_energy +
             state.dissipation;
    };
    for (auto top = samples.begin();; ++top)
      {
        top = std::adjacent_find(top, samples.end(), std::greater<>());
        if (top == samples.end())
          return;
        const double i       = top - samples.begin();
        const auto   maximum = boost::math::tools::brent_find_minima(
          [&](const double theta) { return -machine_angle(theta); },
          std::max(0., i - 1.) * step,
          (i + 1.) * step,
          std::numeric_limits<double>::digits / 2);
        const double before = maximum.first, at = -maximum.second;
        top = std::find_if(top, samples.end(), [at](const double sample) {
          return sample > at;
        });
        if (top == samples.end())
          return;
        const double end   = (top - samples.begin()) * step,
                     after = angle_between(end - step, end, at);
        jumps.push_back(
          {at,
           before,
           after,
           bodies.torque(before),
           bodies.torque(after),
           stored_or_dissipated(before, at) - stored_or_dissipated(after, at)});
      }
  }



  double
  CompliantMachineTorsion::angle_between(const double begin,
                                         const double end,
                                         const double wanted) const
  {
    return zero_of(
      [&](const double theta) { return machine_angle(theta) - wanted; },
      begin,
      end);
  }



  double
  CompliantMachineTorsion::angle(const double machine_angle) const
  {
    double begin = 0.;
    for (const Jump &jump : jumps)
      {
        if (machine_angle <= jump.machine_angle)
          return angle_between(begin, jump.angle_before, machine_angle);
        begin = jump.angle_after;
      }
    return angle_between(begin, largest_angle, machine_angle);
  }



  namespace
  {
    class AnalyticalTorsion : public TorsionModel
    {
    public:
      using TorsionModel::TorsionModel;

      double linear_limit = 0, full_sliding = 0; // [rad]

      // Eq. (17)
      double
      stick_radius(const double theta) const override
      {
        return std::abs(theta) <= linear_limit ?
                 disk.radius :
                 disk.radius * linear_limit / std::abs(theta);
      }

      // Eq. (18)
      Point
      point(const double r, const double theta) const override
      {
        const bool sticks =
          std::abs(theta) <= linear_limit || r < stick_radius(theta);
        const double slip = sticks ? 0. : r * slip_per_radius(theta);
        return point_with(sticks, r, slip, theta);
      }

    private:
      std::vector<double>
      kinks(const double theta) const override
      {
        std::vector<double> kinks{stick_radius(theta)};
        for (const double slip : disk.friction->kinks)
          kinks.push_back(slip / slip_per_radius(theta));
        return kinks;
      }

      // g_s / r of sliding points, Eq. (49) [rad]
      double
      slip_per_radius(const double theta) const
      {
        const double angle = std::abs(theta);
        // the angle went from degrees to radians, as theta_slide did
        return angle < full_sliding * (1. - 1e-12) ?
                 0. :
                 angle - full_sliding + linear_limit;
      }
    };



    struct MathieuTorsion : TorsionModel
    {
      using TorsionModel::TorsionModel;

      double G = 0, w_adh = 0, tau_0 = 0; // [MPa, N/mm, MPa]

      // Radius of the crack: the inverse of Eq. (14).
      double
      stick_radius(const double theta) const override
      {
        // a smaller crack belongs to a larger angle
        const auto excess = [&](const double c) {
          return std::abs(theta) - std::sqrt(pi * w_adh / (4. * c * G)) -
                 tau_0 / (2. * G) * std::acosh(std::max(1., disk.radius / c));
        };
        if (excess(disk.radius) <= 0.)
          return disk.radius; // the crack has not started
        double inner = 0.5 * disk.radius;
        while (excess(inner) > 0. && inner > 1e-300)
          inner *= 0.5;
        return excess(inner) > 0. ? 0. : // nothing sticks
                                    zero_of(excess, inner, 2. * inner);
      }

      // The traction is infinite at the crack tip.
      Point
      point(const double r, const double theta) const override
      {
        const double R = disk.radius, c = stick_radius(theta);
        Point        here;
        here.sticks = r <= c && c > 0.;
        here.phi    = here.sticks ? 1. : 0.;
        here.slip = here.mu = undefined;
        if (!here.sticks)
          here.traction = tau_0; // Eq. (15)
        else if (c < R)          // Eq. (16)
          here.traction =
            2. / pi *
            (std::sqrt(pi * G * w_adh / c) * r / std::sqrt(c * c - r * r) +
             tau_0 *
               std::asin(r / c * std::sqrt((R * R - c * c) / (R * R - r * r))));
        else // Reissner and Sagoci
          here.traction =
            4. / pi * G * std::abs(theta) * r / std::sqrt(R * R - r * r);
        here.traction = std::copysign(here.traction, theta);
        return here;
      }

      // With Eq. (37) integrated in closed form.
      State
      state(const double theta) const override
      {
        const double R = disk.radius, c = stick_radius(theta), k = c / R;
        const double torque =
          c < R ? 8. / 3. * std::pow(c, 2.5) * std::sqrt(pi * G * w_adh) +
                    4. / 3. * tau_0 * std::pow(R, 3) *
                      (std::acos(k) + k * std::sqrt(1. - k * k)) :
                  16. / 3. * G * std::pow(R, 3) * std::abs(theta);
        return {std::copysign(torque, theta),
                k * k,
                undefined,
                undefined,
                w_adh * pi * (R * R - c * c)};
      }
    };
  } // namespace



  std::unique_ptr<TorsionModel>
  prescribed_angles_torsion(const TorsionModel::Disk &disk,
                            const double              linear_limit,
                            const double              full_sliding)
  {
    // Eqs. (43) and (46): all of the disk sticks until theta_lin.
    TorsionModel::Disk own = disk;
    own.stiffness = disk.limit(disk.phi_0).value / (disk.radius * linear_limit);
    auto model    = std::make_unique<AnalyticalTorsion>(own);
    model->linear_limit = linear_limit;
    model->full_sliding = full_sliding;
    return model;
  }



  std::unique_ptr<TorsionModel>
  crack_torsion(const TorsionModel::Disk &disk,
                const double              shear_modulus,
                const double              adhesion_energy,
                const double              friction_stress)
  {
    auto model   = std::make_unique<MathieuTorsion>(disk);
    model->G     = shear_modulus;
    model->w_adh = adhesion_energy;
    model->tau_0 = friction_stress;
    return model;
  }
} // namespace Debond
