#include <debond/closed_forms.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace Debond
{
  namespace
  {
    /** Sliding distance at which s(g_s / a_s) of Eq. (13) has fallen to zero.
     */
    double
    end_of_decay(const FrictionParameters &friction)
    {
      return friction.sliding_threshold *
             (1. + 2. * friction.transition_factor);
    }
  } // namespace



  RigidBodiesTorsion::RigidBodiesTorsion(const Parameters &parameters)
    : parameters(parameters)
  {
    AssertThrow(has_unique_solution(parameters),
                dealii::ExcMessage(
                  "The friction coefficient falls too fast for the tangential "
                  "stiffness of the interface: the traction would jump."));
  }



  bool
  RigidBodiesTorsion::has_unique_solution(const Parameters &parameters)
  {
    return steepest_fall(parameters.friction, parameters.phi_0) *
             parameters.normal_penalty * parameters.push_in <
           parameters.tangential_penalty;
  }



  double
  RigidBodiesTorsion::pressure() const
  {
    return parameters.normal_penalty * parameters.push_in;
  }



  double
  RigidBodiesTorsion::path(const double slip) const
  {
    const double mu =
      friction_coefficient(parameters.friction, parameters.phi_0, slip).mu;
    return slip + mu * pressure() / parameters.tangential_penalty;
  }



  double
  RigidBodiesTorsion::slip(const double r, const double theta) const
  {
    const double distance = r * std::abs(theta);
    if (distance <= path(0.))
      return 0.; // sticks
    // path(slip) rises, is too short at 0 and long enough at the distance
    std::uintmax_t max_iterations = 200;
    const auto     bracket        = boost::math::tools::toms748_solve(
      [&](const double g) { return path(g) - distance; },
      0.,
      distance,
      path(0.) - distance,
      path(distance) - distance,
      boost::math::tools::eps_tolerance<double>(),
      max_iterations);
    return 0.5 * (bracket.first + bracket.second);
  }



  double
  RigidBodiesTorsion::traction(const double r, const double theta) const
  {
    // In stick as in slip the elastic part of the path makes the traction.
    const double distance = r * std::abs(theta);
    return std::copysign(parameters.tangential_penalty *
                           (distance - slip(r, theta)),
                         theta);
  }



  double
  RigidBodiesTorsion::torque(const double theta) const
  {
    if (theta == 0.)
      return 0.;
    // The traction has kinks where sliding begins and where s begins and ends
    // to fall. Between them it is smooth.
    const double        R = parameters.radius;
    std::vector<double> ends{0., R};
    for (const double slip : {0.,
                              parameters.friction.sliding_threshold,
                              end_of_decay(parameters.friction)})
      ends.push_back(std::min(R, path(slip) / std::abs(theta)));
    std::sort(ends.begin(), ends.end());

    double integral = 0.;
    for (unsigned int i = 0; i + 1 < ends.size(); ++i)
      if (ends[i + 1] > ends[i])
        integral +=
          boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
            [&](const double r) { return r * r * traction(r, theta); },
            ends[i],
            ends[i + 1],
            10,
            1e-12);
    return 2. * dealii::numbers::PI * integral;
  }
} // namespace Debond
