// Random patterns against uniform bonding of the same mean, 0.55 on 400
// elements. For two rigid bodies the mean torque of many random patterns is
// that of closed form (c) averaged over phi_0 in {0, 1}, the uniform one that
// with phi_0 = 0.55. The traction min(eps_t r theta, mu p) is concave in phi_0,
// so that random patterns carry less while parts of the face slide and others
// do not: up to 3 %, and less than 0.3 % of the largest torque from 0.2 degrees
// on. Compliant bodies behave alike. Stiffness before sliding and torque at 10
// degrees are the same for all patterns.

#include <debond/models/closed_forms.h>

#include <iomanip>

#include "driven_scene.h"
#include "pressed_and_turned.h"

const std::string scene_text = R"(
subsection Bone
  set Cells = 8, 8, 2
end
subsection Implant
  set Cells = 20, 2
end
subsection Expert
  subsection Interface
    set Quadrature points = 3
  end
end
)" + pressed_then("Rotation z", "max(t - 1, 0)") +
                               R"(
subsection Load steps
  set Times = 0, 1, 1.03, 1.06, 1.08, 1.1, 1.2, 1.5, 1.7, 2, 2.4, 11
  set Steps = 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 5
end
)";

const std::vector<double>
                   angles{0.03, 0.06, 0.08, 0.1, 0.2, 0.5, 0.7, 1., 1.4, 10.};
const double       fraction = 0.55;
const unsigned int n_seeds  = 50;

/** Torque at the angles [N mm]. */
using Curve = std::vector<double>;



Curve
run(const std::string &material, const std::vector<std::string> &bonding)
{
  std::vector<std::string> overrides{"Bone/Material=" + material,
                                     "Implant/Material=" + material};
  for (const std::string &entry : bonding)
    overrides.push_back("Interface/Bonding/" + entry);
  DrivenScene driven(scene_text, overrides);
  Curve       curve;
  for (const double angle : angles)
    {
      driven.advance_to(1 + angle);
      curve.push_back(driven.system.chuck_forces()[5]);
    }
  return curve;
}



Curve
closed_form(const double phi_0)
{
  Debond::TorsionModel::Disk parameters;
  parameters.radius    = 2.5;
  parameters.pressure  = 585 * 0.0049;
  parameters.stiffness = 585;
  parameters.phi_0     = phi_0;
  const Debond::RigidBodiesTorsion form(parameters);
  Curve                            curve;
  for (const double angle : angles)
    curve.push_back(form.torque(angle * M_PI / 180));
  return curve;
}



struct Ensemble
{
  Curve  uniform, mean, standard_deviation;
  double largest          = 0; ///< torque of the uniform pattern
  double stiffness_spread = 0, end_spread = 0; ///< relative, over all patterns
};



Ensemble
run_ensemble(const std::string &material)
{
  Ensemble ensemble;
  ensemble.uniform = run(material, {"Bonding degree=0.55"});
  for (const double torque : ensemble.uniform)
    grow(ensemble.largest, torque);
  std::vector<Curve> curves;
  for (unsigned int seed = 1; seed <= n_seeds; ++seed)
    curves.push_back(run(material,
                         {"Pattern=random",
                          "Bonded fraction=0.55",
                          "Seed=" + std::to_string(seed)}));
  for (const std::string pattern : {"disk", "annulus"})
    {
      const Curve curve =
        run(material, {"Pattern=" + pattern, "Bonded fraction=0.55"});
      grow(ensemble.stiffness_spread,
           std::abs(curve.front() / ensemble.uniform.front() - 1.));
      grow(ensemble.end_spread,
           std::abs(curve.back() / ensemble.uniform.back() - 1.));
    }
  for (unsigned int i = 0; i < angles.size(); ++i)
    {
      double sum = 0., squares = 0.;
      for (const Curve &curve : curves)
        sum += curve[i] / n_seeds;
      for (const Curve &curve : curves)
        squares += std::pow(curve[i] - sum, 2) / (n_seeds - 1);
      ensemble.mean.push_back(sum);
      ensemble.standard_deviation.push_back(std::sqrt(squares));
    }
  for (const Curve &curve : curves)
    {
      grow(ensemble.stiffness_spread,
           std::abs(curve.front() / ensemble.uniform.front() - 1.));
      grow(ensemble.end_spread,
           std::abs(curve.back() / ensemble.uniform.back() - 1.));
    }
  return ensemble;
}



void
check_spread(const Ensemble &ensemble)
{
  double below = 0., later = 0., scatter = 0.;
  bool   is_below = true;
  for (unsigned int i = 0; i < angles.size(); ++i)
    {
      const double difference =
        (ensemble.mean[i] - ensemble.uniform[i]) / ensemble.largest;
      if (angles[i] < 0.2)
        {
          grow(below, -difference);
          is_below = is_below && difference < 1e-6;
        }
      else
        grow(later, std::abs(difference));
      grow(scatter, ensemble.standard_deviation[i] / ensemble.largest);
    }
  report("  mean of random patterns is below the uniform one under 0.2 degrees",
         is_below);
  report("  by more than 2 and less than 3.5 %", below > 0.02 && below < 0.035);
  report("  from 0.2 degrees on the difference over the largest torque",
         later,
         3e-3);
  report("  scatter of one pattern is between 0.3 and 0.7 %",
         scatter > 3e-3 && scatter < 7e-3);
  report("  stiffness while all sticks, spread over all patterns",
         ensemble.stiffness_spread,
         2e-3);
  report("  torque at 10 degrees, spread", ensemble.end_spread, 2e-3);
}



void
test()
{
  std::cout << "Rigid bodies" << std::endl;
  const Ensemble rigid            = run_ensemble("rigid");
  const Curve    uniform          = closed_form(fraction);
  const Curve    bonded           = closed_form(1.);
  const Curve    unbonded         = closed_form(0.);
  double         error_of_uniform = 0., error_of_mean = 0.;
  for (unsigned int i = 0; i < angles.size(); ++i)
    {
      grow(error_of_uniform,
           std::abs(rigid.uniform[i] - uniform[i]) / rigid.largest);
      // in standard deviations of a mean; 1e-4 for the quadrature
      grow(error_of_mean,
           std::abs(rigid.mean[i] - fraction * bonded[i] -
                    (1. - fraction) * unbonded[i]) /
             (rigid.standard_deviation[i] / std::sqrt(n_seeds) +
              1e-4 * rigid.largest));
    }
  report("  uniform bonding against the closed form, over the largest torque",
         error_of_uniform,
         3e-4);
  report("  mean against the mean of closed forms, in standard deviations",
         error_of_mean,
         4.);
  check_spread(rigid);
  std::cout << "Linear bodies" << std::endl;
  check_spread(run_ensemble("linear"));
}



int
main()
{
  return run_test(test);
}
