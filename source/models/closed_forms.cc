#include <debond/models/closed_forms.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <array>
#include <cmath>

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
    const double phi_0    = initial_bonding(r);
    const double distance = r * std::abs(theta);
    const double begin    = disk.friction->kinks.front();
    const double end      = disk.friction->kinks.back();
    // Before and after the decay the coefficient is constant: mu p / eps_t of
    // the path is elastic.
    if (distance <= path(begin, phi_0))
      return std::max(0., distance - path(0., phi_0));
    if (distance >= path(end, phi_0))
      return distance - (path(end, phi_0) - end);
    return zero_of([&](const double g) { return path(g, phi_0) - distance; },
                   begin,
                   end);
  }



  double
  RigidBodiesTorsion::stick_radius(const double theta) const
  {
    // a bonded core sticks further out than what surrounds it, or not at all
    const double core  = std::min(disk.radius, disk.bonded_radius);
    const double angle = std::max(1e-300, std::abs(theta));
    const double inner = path(0., disk.phi_0) / angle;
    if (inner < core)
      return inner;
    return std::min(disk.radius, std::max(core, path(0., 0.) / angle));
  }



  std::vector<double>
  RigidBodiesTorsion::kinks(const double theta) const
  {
    std::vector<double> kinks{disk.bonded_radius};
    if (theta != 0.)
      for (const double phi_0 : {disk.phi_0, 0.})
        {
          kinks.push_back(path(0., phi_0) / std::abs(theta));
          for (const double slip : disk.friction->kinks)
            kinks.push_back(path(slip, phi_0) / std::abs(theta));
        }
    return kinks;
  }



  CompliantMachineTorsion::CompliantMachineTorsion(const TorsionModel &bodies,
                                                   const double stiffness,
                                                   const double largest_angle)
    : bodies(bodies)
    , stiffness(stiffness)
    , largest_angle(largest_angle)
  {
    find_limit_points();
    find_jumps();
  }



  void
  CompliantMachineTorsion::find_limit_points()
  {
    constexpr unsigned int n    = 4000;
    const double           step = largest_angle / n;
    std::array<double, 3>  last{{0., 0., machine_angle(step)}};
    for (unsigned int i = 2; i <= n; ++i)
      {
        last = {{last[1], last[2], machine_angle(i * step)}};
        for (const double sign : {-1., 1.})
          if (sign * last[1] < sign * last[0] &&
              sign * last[1] <= sign * last[2])
            {
              const auto minimum = boost::math::tools::brent_find_minima(
                [&](const double theta) { return sign * machine_angle(theta); },
                (i - 2) * step,
                i * step,
                std::numeric_limits<double>::digits / 2);
              limit_points.push_back({minimum.first,
                                      sign * minimum.second,
                                      bodies.torque(minimum.first),
                                      sign < 0.});
            }
      }
  }



  void
  CompliantMachineTorsion::find_jumps()
  {
    const auto stored_or_dissipated = [&](const double theta, const double at) {
      const auto state = bodies.state(theta);
      return 0.5 * stiffness * std::pow(at - theta, 2) + state.stored_energy +
             state.dissipation;
    };
    double reached = 0.; // the largest machine angle so far
    for (auto from = limit_points.begin(); from != limit_points.end(); ++from)
      if (from->is_maximum && from->machine_angle > reached)
        // the next branch that rises and leads high enough
        for (auto to = from + 1; to != limit_points.end(); ++to)
          {
            const double end =
              to + 1 == limit_points.end() ? largest_angle : (to + 1)->angle;
            const double at = from->machine_angle;
            if (to->is_maximum || machine_angle(end) < at)
              continue;
            const double after = angle_between(to->angle, end, at);
            jumps.push_back({at,
                             from->angle,
                             after,
                             from->torque,
                             bodies.torque(after),
                             stored_or_dissipated(from->angle, at) -
                               stored_or_dissipated(after, at)});
            reached = at;
            break;
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



    class MathieuTorsion : public TorsionModel
    {
    public:
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
