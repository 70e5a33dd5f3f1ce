// Viscosity turns the jump of a brittle bond under a compliant machine into a
// fast motion: torque and viscous work against an independent computation,
// rings of a rigid disk that slide with
//   eta d'(r) = max(0, eps_t (r theta - d) - mu(d) p),
// while the disk is in balance with the spring,
//   k (theta_m - theta) = 2 pi int r^2 eps_t (r theta - d) dr,
// integrated in time by Boost; and the smaller the viscosity, the closer its
// work comes to the energy that the closed form of the jump releases.

#include <debond/interface/modified_coulomb.h>
#include <debond/models/closed_forms.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/numeric/odeint.hpp>

#include "driven_scene.h"

using namespace Debond;

constexpr double R = 2.5, eps = 585, p = 2.6, k = 3000,
                 turning = 2. * M_PI / 180.; ///< of the machine per time

FrictionLawPointer
brittle()
{
  return modified_coulomb({0.40, 0.58, 0.005, 0.3});
}



/** The rings. The state is the sliding distance of each and, last, the viscous
 *  work. */
class Rings
{
public:
  using State = std::vector<double>;

  explicit Rings(const double viscosity)
    : viscosity(viscosity)
  {
    // Gauss points on 20 intervals
    using Gauss              = boost::math::quadrature::gauss<double, 10>;
    const unsigned int parts = 20;
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

  double
  torque(const State &state, const double time) const
  {
    return k * (turning * time - angle(state, time));
  }

  void
  operator()(const State &state, State &rate, const double time) const
  {
    const double theta = angle(state, time);
    rate.back()        = 0.;
    for (std::size_t i = 0; i < radius.size(); ++i)
      {
        const double over = eps * (radius[i] * theta - state[i]) -
                            friction->coefficient({1., {state[i]}}, 0.).mu * p;
        rate[i] = std::max(0., over) / viscosity;
        rate.back() += weight[i] * viscosity * rate[i] * rate[i];
      }
  }

  /** Torque at @p times, and the viscous work at the end. */
  std::pair<std::vector<double>, double>
  integrate(const std::vector<double> &times) const
  {
    using namespace boost::numeric::odeint;
    State               state(radius.size() + 1, 0.);
    std::vector<double> torques;
    integrate_times(make_controlled<runge_kutta_dopri5<State>>(1e-9, 1e-9),
                    *this,
                    state,
                    times.begin(),
                    times.end(),
                    1e-4,
                    [&](const State &now, const double time) {
                      torques.push_back(torque(now, time));
                    });
    return {torques, state.back()};
  }

private:
  const double             viscosity;
  const FrictionLawPointer friction = brittle();
  std::vector<double>      radius, weight;
};



const std::string scene_text = R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
  set Cells    = 6, 2
end
subsection Interface
  set Characteristic slip distance = 0.005
  set Transition factor = 0.3
end
subsection Chuck
  subsection Press
    set Value = 2.6 / 585 * min(t, 1)
  end
  subsection Rotation z
    set Value     = 2 * max(t - 1, 0)
    set Stiffness = 3000
  end
end
subsection Load steps
  set Times = 0, 1, 2
end
)";



struct Deviation
{
  double torque       = 0; ///< largest, relative to the largest torque
  double viscous_work = 0; ///< relative, at the end
};

Deviation
deviation(const double viscosity, const unsigned int n_steps)
{
  const auto rows =
    run_scene("viscous_snap_back",
              ::scene_text,
              {"Interface/Viscosity=" + std::to_string(viscosity),
               "Load steps/Steps=1," + std::to_string(n_steps)});
  std::vector<double> times;
  for (std::size_t i = 1; i < rows.size(); ++i) // without the push-in
    times.push_back(rows[i].time - 1.);
  const auto [torques, viscous_work] = Rings(viscosity).integrate(times);
  double worst = 0., T_max = 0., over_bound = 0.;
  for (std::size_t i = 1; i < rows.size(); ++i)
    {
      const TorqueRow &row = rows[i];
      grow(worst, std::abs(row.torque_Nmm - torques[i - 1]));
      grow(T_max, row.torque_Nmm);
      grow(over_bound,
           std::abs(row.energy_defect) / (row.energy_defect_bound + 1e-9));
    }
  const std::string steps = "  " + std::to_string(n_steps) + " steps, ";
  report(steps + "energy defect relative to its bound", over_bound, 1.);
  report(steps + "nothing released in jumps",
         rows.back().released_energy_Nmm == 0.);
  return {worst / T_max, rows.back().viscous_work_Nmm / viscous_work - 1.};
}



// Implicit steps are of first order in their size: twice as many halve the
// deviation, and what remains of the work after one extrapolation is that of
// the integral over 6 x 6 surface elements.
void
check_order(const double viscosity)
{
  std::cout << "eta = " << viscosity << std::endl;
  const Deviation coarse = deviation(viscosity, 500);
  const Deviation fine   = deviation(viscosity, 1000);
  report("  torque, relative to the largest", fine.torque, 6e-3);
  report("  its deviation over that with half the steps, from 1/2",
         std::abs(fine.torque / coarse.torque - 0.5),
         0.01);
  report("  viscous work, relative deviation",
         std::abs(fine.viscous_work),
         5e-3);
  report("  the same, extrapolated to infinitely many steps",
         std::abs(2. * fine.viscous_work - coarse.viscous_work),
         1e-3);
}



// The motion before and after the jump is slow, and its viscous work vanishes
// with eta; that of the jump tends to what the closed form releases.
void
check_limit()
{
  TorsionModel::Disk parameters;
  parameters.radius    = R;
  parameters.pressure  = p;
  parameters.stiffness = eps;
  parameters.friction  = brittle();
  const RigidBodiesTorsion      bodies(parameters);
  const CompliantMachineTorsion machine(bodies, k, turning);
  const double released = machine.jumps.at(0).released_energy;
  const auto   over     = [&](const double viscosity) {
    return Rings(viscosity).integrate({0., 1.}).second / released;
  };
  report("viscous work over the energy released without, eta = 0.001, from 1",
         std::abs(over(0.001) - 1.),
         0.02);
  report("closer than with eta = 0.01", over(0.01) > over(0.001));
}



void
test()
{
  check_order(1.);
  check_limit();
}



int
main()
{
  return run_test(test);
}
