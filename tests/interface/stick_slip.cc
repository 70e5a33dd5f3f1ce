// Rate and state friction that weakens with the speed, under a machine softer
// than what steady sliding needs: with viscosity the disk sticks and slips in
// turns. Torque against an independent computation, rings of a rigid disk that
// slide with the speed V of
//   p (mu_0 + A ln(1 + V/V_0) + B psi) + eta V = eps_t (r theta - d),
//   psi' = V_0 e^(-psi)/D - V/D,   psi = ln(V_0 state/D),
// while the disk is in balance with the spring,
//   k (theta_m - theta) = 2 pi int r^2 eps_t (r theta - d) dr,
// integrated in time by Boost. Without viscosity there is no quasi-static
// solution once it slips, and the run says so; under a machine stiffer than
// that it slides steadily.

#include <debond/models/simulation.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <cmath>

#include "driven_scene.h"

using namespace Debond;

constexpr double R = 2.5, eps = 585, p = 2.6, mu_0 = 0.4, A = 0.01, B = 0.03,
                 V_0 = 1e-3, D = 0.01, k = 200, eta = 0.02,
                 turning = 10. * M_PI / 180.; ///< of the machine per time



/** The rings. The state is the sliding distance of each, then psi of each. */
class RateAndStateRings
{
public:
  using State = std::vector<double>;

  RateAndStateRings()
  {
    // Gauss points on a few intervals
    using Gauss              = boost::math::quadrature::gauss<double, 10>;
    const unsigned int parts = 4;
    const double       half  = 0.5 * R / parts;
    for (unsigned int i = 0; i < parts; ++i)
      for (std::size_t j = 0; j < Gauss::abscissa().size(); ++j)
        for (const double sign : {-1., 1.})
          {
            radius.push_back((2 * i + 1) * half +
                             sign * half * Gauss::abscissa()[j]);
            weight.push_back(2. * M_PI * radius.back() * half *
                             Gauss::weights()[j]);
          }
  }

  double
  angle(const State &state, const double time) const
  {
    double moment = k * turning * time, stiffness = k;
    for (std::size_t i = 0; i < radius.size(); ++i)
      {
        moment += weight[i] * radius[i] * eps * state[i];
        stiffness += weight[i] * radius[i] * radius[i] * eps;
      }
    return moment / stiffness;
  }

  void
  operator()(const State &state, State &rate, const double time) const
  {
    const double      theta = angle(state, time);
    const std::size_t n     = radius.size();
    for (std::size_t i = 0; i < n; ++i)
      {
        const double psi = state[n + i];
        const double V =
          speed(eps * (radius[i] * theta - state[i]) - p * (mu_0 + B * psi));
        rate[i]     = V;
        rate[n + i] = (V_0 * std::exp(-psi) - V) / D;
      }
  }

  /** Torque at @p times; the pressing took a unit of time. */
  std::vector<double>
  torques(const std::vector<double> &times) const
  {
    using namespace boost::numeric::odeint;
    State state(2 * radius.size(), 0.);
    std::fill(state.begin() + radius.size(),
              state.end(),
              std::log(1. + V_0 / D)); // aged at rest
    std::vector<double> result;
    integrate_times(make_controlled<runge_kutta_dopri5<State>>(1e-8, 1e-8),
                    *this,
                    state,
                    times.begin(),
                    times.end(),
                    1e-4,
                    [&](const State &now, const double time) {
                      result.push_back(k * (turning * time - angle(now, time)));
                    });
    return result;
  }

private:
  // p A ln(1 + V/V_0) + eta V = over, by Newton's method in ln(1 + V/V_0),
  // where the left-hand side is convex.
  static double
  speed(const double over)
  {
    if (over <= 0.)
      return 0.;
    double u = std::min(over / (p * A), std::log1p(over / (eta * V_0)));
    for (unsigned int iteration = 0; iteration < 50; ++iteration)
      {
        const double step = (p * A * u + eta * V_0 * std::expm1(u) - over) /
                            (p * A + eta * V_0 * std::exp(u));
        u -= step;
        if (std::abs(step) < 1e-14 * u)
          break;
      }
    return V_0 * std::expm1(u);
  }

  std::vector<double> radius, weight;
};



const std::string scene_text = R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
  set Cells    = 4, 2
end
subsection Interface
  set Friction law = rate and state
  subsection Rate and state
    set Reference coefficient = 0.4
    set Direct effect         = 0.01
    set Evolution effect      = 0.03
    set Reference speed       = 1e-3
    set Sliding distance      = 0.01
  end
end
subsection Chuck
  subsection Press
    set Value = 2.6 / 585 * min(t, 1)
  end
  subsection Rotation z
    set Value     = 10 * max(t - 1, 0)
    set Stiffness = 200
  end
end
subsection Load steps
  set Times = 0, 1, 2, 2.8
end
)";

Simulation
scene_with(const double       viscosity,
           const double       stiffness,
           const unsigned int n_steps)
{
  return Simulation(
    Scene::from_text(scene_text,
                     {"Interface/Viscosity=" + std::to_string(viscosity),
                      "Chuck/Rotation z/Stiffness=" + std::to_string(stiffness),
                      "Load steps/Steps=1,20," + std::to_string(n_steps)}));
}

/** The run has warned of a jump, and that nothing limits the speed. */
bool
jumps(const Simulation &simulation)
{
  return std::any_of(simulation.warnings().begin(),
                     simulation.warnings().end(),
                     [](const Warning &warning) {
                       return warning.check == "jump" &&
                              warning.text.find("no quasi-static solution") !=
                                std::string::npos;
                     });
}



/** Torque before and after the second slip event, and the time between its end
 *  and that of the first one. */
struct Cycle
{
  double highest, lowest, period;
};

Cycle
cycle_of(const std::vector<double> &times, const std::vector<double> &torques)
{
  std::vector<std::size_t> peaks, valleys;
  for (std::size_t i = 1; i + 1 < torques.size(); ++i)
    {
      if (torques[i] >= torques[i - 1] && torques[i] > torques[i + 1])
        peaks.push_back(i);
      if (torques[i] <= torques[i - 1] && torques[i] < torques[i + 1])
        valleys.push_back(i);
    }
  return {torques[peaks.at(1)],
          torques[valleys.at(1)],
          times[valleys.at(1)] - times[valleys.at(0)]};
}

/** Of the program's cycle, relative to that of the rings. */
Cycle
deviation(const unsigned int n_steps)
{
  Simulation simulation = scene_with(eta, k, n_steps);
  simulation.run();
  const auto         &rows = simulation.rows();
  std::vector<double> times, torques;
  for (std::size_t i = 1; i < rows.size(); ++i) // without the push-in
    {
      times.push_back(rows[i].time - 1.);
      torques.push_back(rows[i].torque_Nmm);
    }
  report("  " + std::to_string(n_steps) + " steps: nothing jumps",
         !jumps(simulation));
  const Cycle exact = cycle_of(times, RateAndStateRings().torques(times));
  const Cycle found = cycle_of(times, torques);
  return {found.highest / exact.highest - 1.,
          found.lowest / exact.lowest - 1.,
          found.period / exact.period - 1.};
}



// Implicit steps are of first order in their size: one extrapolation takes
// their error away. That of the period is as fine as a step, 0.2 %.
void
check_stick_slip()
{
  std::cout << "soft machine, with viscosity" << std::endl;
  const Cycle coarse = deviation(800), fine = deviation(1600);
  report("  torque before the slip, half the steps over all, from 2",
         std::abs(coarse.highest / fine.highest - 2.),
         0.1);
  report("  the same, extrapolated, relative deviation",
         std::abs(2. * fine.highest - coarse.highest),
         5e-4);
  report("  torque after it", std::abs(2. * fine.lowest - coarse.lowest), 1e-3);
  report("  period", std::abs(2. * fine.period - coarse.period), 6e-3);
}



// Steady sliding at V = r omega: mu_0 + A ln(1 + V/V_0) - B ln(V/V_0). Without
// viscosity it is stable where the machine is stiffer than k_c = p (B - A)/D
// times int r^2 dA, 319 N mm/rad.
void
check_without_viscosity()
{
  std::cout << "without viscosity" << std::endl;
  const auto torque_of = [](const double r) {
    const double V = r * turning;
    return 2. * M_PI * r * r * p *
           (mu_0 + A * std::log1p(V / V_0) - B * std::log(V / V_0));
  };
  const double steady =
    boost::math::quadrature::gauss<double, 30>::integrate(torque_of, 0., R);
  Simulation stiff = scene_with(0., 2000., 200);
  stiff.run();
  report("  stiff machine: steady torque, relative deviation",
         std::abs(stiff.rows().back().torque_Nmm / steady - 1.),
         1e-3);
  report("  stiff machine: nothing jumps", !jumps(stiff));
  // a speed that ends is no jump
  Simulation held(
    Scene::from_text(scene_text,
                     {"Chuck/Rotation z/Value=10 * min(max(t - 1, 0), 1.4)",
                      "Chuck/Rotation z/Stiffness=2000",
                      "Load steps/Steps=1,20,100"}));
  held.run();
  report("  stiff machine that stops: nothing jumps", !jumps(held));
  Simulation soft = scene_with(0., k, 200);
  soft.run();
  report("  soft machine: there is no quasi-static solution, and it is said",
         jumps(soft));
}



void
test()
{
  check_stick_slip();
  check_without_viscosity();
}



int
main()
{
  return run_test(test);
}
