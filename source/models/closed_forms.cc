#include <debond/models/closed_forms.h>
#include <debond/output/torque_curve.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace Debond
{
  namespace
  {
    constexpr double pi = dealii::numbers::PI;



    /** The zero of a function that rises from @p f_a <= 0 at @p a to @p f_b >=
     *  0 at @p b. */
    template <typename Function>
    double
    zero_of(const Function &f,
            const double    a,
            const double    b,
            const double    f_a,
            const double    f_b)
    {
      if (f_a == 0.)
        return a;
      if (f_b == 0.)
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



  TorsionModel::State
  TorsionModel::state(const double theta) const
  {
    std::vector<double> ends{0., R};
    if (theta != 0.)
      for (const double r : kinks(theta))
        ends.push_back(std::min(R, r));
    std::sort(ends.begin(), ends.end());

    State      sum;
    const auto add = [&](const double r, const double weight) {
      const Point  here = point(r, theta);
      const double dA   = 2. * pi * r * weight;
      const double adhesive =
        p * friction->adhesive_strength({initial_bonding(r)}, here.slip);
      sum.torque += r * here.traction * dA;
      sum.phi_mean += here.phi * dA / (pi * R * R);
      if (here.traction != 0.) // else the stiffness may be zero, too
        sum.stored_energy +=
          0.5 * here.traction * here.traction / stiffness() * dA;
      sum.adhesive_work += adhesive * dA;
      sum.dissipation +=
        (adhesive + friction->mu_without_bond() * p * here.slip) * dA;
    };
    // The fields are smooth between kinks, so that Gauss points do.
    using Gauss = boost::math::quadrature::gauss<double, 30>;
    for (unsigned int i = 0; i + 1 < ends.size(); ++i)
      if (ends[i + 1] > ends[i])
        {
          const double half   = 0.5 * (ends[i + 1] - ends[i]);
          const double middle = 0.5 * (ends[i + 1] + ends[i]);
          for (unsigned int q = 0; q < Gauss::abscissa().size(); ++q)
            for (const double side : {-1., 1.})
              add(middle + side * half * Gauss::abscissa()[q],
                  half * Gauss::weights()[q]);
        }
    return sum;
  }



  RigidBodiesTorsion::RigidBodiesTorsion(const Parameters &parameters)
    : TorsionModel(parameters.radius,
                   parameters.normal_penalty * parameters.push_in,
                   parameters.friction)
    , parameters(parameters)
  {
    AssertThrow(has_unique_solution(parameters),
                dealii::ExcMessage(
                  "The friction coefficient falls too fast for the tangential "
                  "stiffness of the interface: the traction would jump."));
  }



  bool
  RigidBodiesTorsion::has_unique_solution(const Parameters &parameters)
  {
    return parameters.friction->steepest_fall({parameters.phi_0}) *
             parameters.normal_penalty * parameters.push_in <
           parameters.tangential_penalty;
  }



  double
  RigidBodiesTorsion::initial_bonding(const double r) const
  {
    return r <= parameters.bonded_radius ? parameters.phi_0 : 0.;
  }



  double
  RigidBodiesTorsion::path(const double slip, const double phi_0) const
  {
    return slip +
           coefficient(phi_0, slip).mu * p / parameters.tangential_penalty;
  }



  double
  RigidBodiesTorsion::slip(const double r, const double theta) const
  {
    const double phi_0    = initial_bonding(r);
    const double distance = r * std::abs(theta);
    const double begin    = friction->kinks().front(),
                 end      = friction->kinks().back();
    // Before and after the decay the coefficient is constant: mu p / eps_t of
    // the path is elastic.
    if (distance <= path(begin, phi_0))
      return std::max(0., distance - path(0., phi_0));
    if (distance >= path(end, phi_0))
      return distance - (path(end, phi_0) - end);
    const auto excess = [&](const double g) {
      return path(g, phi_0) - distance;
    };
    return zero_of(excess, begin, end, excess(begin), excess(end));
  }



  TorsionModel::Point
  RigidBodiesTorsion::point(const double r, const double theta) const
  {
    const double phi_0 = initial_bonding(r);
    Point        here;
    here.slip                = slip(r, theta);
    here.sticks              = here.slip == 0.;
    const auto friction_here = coefficient(phi_0, here.slip);
    here.phi                 = friction_here.phi;
    here.mu                  = friction_here.mu;
    here.traction = std::copysign(here.sticks ? parameters.tangential_penalty *
                                                  r * std::abs(theta) :
                                                here.mu * p,
                                  theta);
    return here;
  }



  double
  RigidBodiesTorsion::stick_radius(const double theta) const
  {
    // a bonded core sticks further out than what surrounds it, or not at all
    const double bonded_radius = std::min(R, parameters.bonded_radius);
    const double inner =
      path(0., parameters.phi_0) / std::max(1e-300, std::abs(theta));
    if (inner < bonded_radius)
      return inner;
    const double outer = path(0., 0.) / std::max(1e-300, std::abs(theta));
    return std::min(R, std::max(bonded_radius, outer));
  }



  std::vector<double>
  RigidBodiesTorsion::kinks(const double theta) const
  {
    std::vector<double> radii{parameters.bonded_radius};
    for (const double phi_0 : {parameters.phi_0, 0.})
      {
        radii.push_back(path(0., phi_0) / std::abs(theta));
        for (const double slip : friction->kinks())
          radii.push_back(path(slip, phi_0) / std::abs(theta));
      }
    return radii;
  }



  CompliantMachineTorsion::CompliantMachineTorsion(
    const RigidBodiesTorsion &bodies,
    const double              stiffness,
    const double              largest_angle)
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
              limits.push_back({minimum.first,
                                sign * minimum.second,
                                bodies.torque(minimum.first),
                                sign < 0.});
            }
      }
  }



  void
  CompliantMachineTorsion::find_jumps()
  {
    const auto stored_or_spent = [&](const double theta, const double at) {
      const auto state = bodies.state(theta);
      return 0.5 * stiffness * std::pow(at - theta, 2) + state.stored_energy +
             state.dissipation;
    };
    double reached = 0.; // the largest machine angle so far
    for (std::size_t i = 0; i < limits.size(); ++i)
      {
        const LimitPoint &from = limits[i];
        if (!from.is_maximum || from.machine_angle <= reached)
          continue;
        // the next branch that rises and leads high enough
        for (std::size_t j = i + 1; j < limits.size(); ++j)
          {
            const bool   is_last = j + 1 == limits.size();
            const double end = is_last ? largest_angle : limits[j + 1].angle;
            if (limits[j].is_maximum || machine_angle(end) < from.machine_angle)
              continue;
            const double to =
              angle_between(limits[j].angle, end, from.machine_angle);
            all_jumps.push_back(
              {from.machine_angle,
               from.angle,
               to,
               from.torque,
               bodies.torque(to),
               stored_or_spent(from.angle, from.machine_angle) -
                 stored_or_spent(to, from.machine_angle)});
            reached = from.machine_angle;
            break;
          }
      }
  }



  // On a branch that rises.
  double
  CompliantMachineTorsion::angle_between(const double begin,
                                         const double end,
                                         const double wanted) const
  {
    const auto excess = [&](const double theta) {
      return machine_angle(theta) - wanted;
    };
    return zero_of(excess,
                   begin,
                   end,
                   std::min(0., excess(begin)),
                   std::max(0., excess(end)));
  }



  double
  CompliantMachineTorsion::angle(const double machine_angle) const
  {
    double begin = 0.;
    for (const Jump &jump : all_jumps)
      {
        if (machine_angle <= jump.machine_angle)
          return angle_between(begin, jump.angle_before, machine_angle);
        begin = jump.angle_after;
      }
    return angle_between(begin, largest_angle, machine_angle);
  }



  AnalyticalTorsion::AnalyticalTorsion(const Parameters &parameters)
    : TorsionModel(parameters.radius, parameters.pressure, parameters.friction)
    , parameters(parameters)
  {
    AssertThrow(parameters.linear_limit > 0. &&
                  parameters.full_sliding >= parameters.linear_limit,
                dealii::ExcMessage("0 < theta_lin <= theta_max is expected."));
  }



  // Eq. (17)
  double
  AnalyticalTorsion::stick_radius(const double theta) const
  {
    return std::abs(theta) <= parameters.linear_limit ?
             R :
             R * parameters.linear_limit / std::abs(theta);
  }



  double
  AnalyticalTorsion::slip_per_radius(const double theta) const
  {
    const double angle = std::abs(theta);
    // the angle went from degrees to radians, as theta_max did
    return angle < parameters.full_sliding * (1. - 1e-12) ?
             0. :
             angle - parameters.full_sliding + parameters.linear_limit;
  }



  // Eq. (18)
  TorsionModel::Point
  AnalyticalTorsion::point(const double r, const double theta) const
  {
    const auto   unbroken = coefficient(parameters.phi_0, 0.);
    const double angle    = std::abs(theta);
    Point        here;
    here.sticks = angle <= parameters.linear_limit || r < stick_radius(theta);
    if (here.sticks)
      {
        here.phi = unbroken.phi;
        here.mu  = unbroken.mu;
        here.traction =
          unbroken.mu * p * r * angle / (R * parameters.linear_limit);
      }
    else
      {
        here.slip          = r * slip_per_radius(theta);
        const auto sliding = coefficient(parameters.phi_0, here.slip);
        here.phi           = sliding.phi;
        here.mu            = sliding.mu;
        here.traction      = sliding.mu * p;
      }
    here.traction = std::copysign(here.traction, theta);
    return here;
  }



  std::vector<double>
  AnalyticalTorsion::kinks(const double theta) const
  {
    const double        per_radius = slip_per_radius(theta);
    std::vector<double> radii{stick_radius(theta)};
    for (const double slip : friction->kinks())
      radii.push_back(slip / per_radius);
    return radii;
  }



  // Eqs. (43) and (46)
  double
  AnalyticalTorsion::stiffness() const
  {
    return coefficient(parameters.phi_0, 0.).mu * p /
           (R * parameters.linear_limit);
  }



  MathieuTorsion::MathieuTorsion(const Parameters &parameters)
    : TorsionModel(parameters.radius, parameters.pressure, nullptr)
    , parameters(parameters)
  {}



  double
  MathieuTorsion::angle(const double c) const
  {
    return std::sqrt(pi * parameters.adhesion_energy /
                     (4. * c * parameters.shear_modulus)) +
           parameters.friction_stress / (2. * parameters.shear_modulus) *
             std::acosh(std::max(1., R / c));
  }



  double
  MathieuTorsion::stick_radius(const double theta) const
  {
    const auto excess = [&](const double c) {
      return std::abs(theta) - angle(c);
    };
    if (excess(R) <= 0.)
      return R; // the crack has not started
    // a smaller crack belongs to a larger angle
    double inner = 0.5 * R;
    while (excess(inner) > 0. && inner > 1e-300)
      inner *= 0.5;
    if (excess(inner) > 0.)
      return 0.; // nothing sticks
    return zero_of(
      excess, inner, 2. * inner, excess(inner), excess(2. * inner));
  }



  TorsionModel::Point
  MathieuTorsion::point(const double r, const double theta) const
  {
    const double c = stick_radius(theta);
    Point        here;
    here.sticks = r <= c && c > 0.;
    here.phi    = here.sticks ? 1. : 0.;
    here.slip = here.mu = CurveMeasures::undefined;
    if (!here.sticks)
      here.traction = parameters.friction_stress; // Eq. (15)
    else if (c < R)                               // Eq. (16)
      here.traction =
        2. / pi *
        (std::sqrt(pi * parameters.shear_modulus * parameters.adhesion_energy /
                   c) *
           r / std::sqrt(c * c - r * r) +
         parameters.friction_stress *
           std::asin(r / c * std::sqrt((R * R - c * c) / (R * R - r * r))));
    else // Reissner and Sagoci
      here.traction = 4. / pi * parameters.shear_modulus * std::abs(theta) * r /
                      std::sqrt(R * R - r * r);
    here.traction = std::copysign(here.traction, theta);
    return here;
  }



  TorsionModel::State
  MathieuTorsion::state(const double theta) const
  {
    const double c = stick_radius(theta), k = c / R;
    State        sum;
    sum.torque =
      c < R ?
        8. / 3. * std::pow(c, 2.5) *
            std::sqrt(pi * parameters.shear_modulus *
                      parameters.adhesion_energy) +
          4. / 3. * parameters.friction_stress * std::pow(R, 3) *
            (std::acos(k) + k * std::sqrt(1. - k * k)) :
        16. / 3. * parameters.shear_modulus * std::pow(R, 3) * std::abs(theta);
    sum.torque        = std::copysign(sum.torque, theta);
    sum.phi_mean      = k * k;
    sum.adhesive_work = parameters.adhesion_energy * pi * (R * R - c * c);
    sum.stored_energy = sum.dissipation = CurveMeasures::undefined;
    return sum;
  }



  std::vector<double>
  MathieuTorsion::kinks(const double theta) const
  {
    return {stick_radius(theta)};
  }



  double
  MathieuTorsion::stiffness() const
  {
    return CurveMeasures::undefined;
  }
} // namespace Debond
