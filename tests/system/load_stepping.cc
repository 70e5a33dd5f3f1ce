// Planned times are hit exactly, also after sub-steps; a step that fails is
// halved, one that succeeds may grow again on its grid, and there is a smallest
// step. Adaptive steps keep a known curve within the tolerance, with not many
// more than the fewest possible, and end phases exactly.

#include <debond/system/step_control.h>

#include <string>
#include <utility>
#include <vector>

#include "checks.h"

using namespace Debond;

/** Takes the next planned step from @p start; sub-steps longer than @p largest
 *  fail. Returns the ends of those that succeed, or nothing if the step is
 * given up. */
std::vector<double>
take(PlannedSteps &control, const double start, const double largest)
{
  std::vector<double> times;
  if (control.is_between_phases())
    control.begin_phase(StepState());
  do
    {
      const Step   step = control.next();
      const double from = times.empty() ? start : times.back();
      if (step.time - from <= largest * (1. + 1e-9))
        {
          times.push_back(step.time);
          control.take(step, StepState(), 0);
        }
      else if (!control.reject(step, false))
        return {};
    }
  while (!control.row_is_complete());
  return times;
}

bool
are(const std::vector<double> &times, const std::vector<double> &expected)
{
  bool result = (times.size() == expected.size());
  for (unsigned int k = 0; result && k < times.size(); ++k)
    result = std::abs(times[k] - expected[k]) < 1e-15;
  return result;
}



/** A force that is pressed up in the first phase, and a torque that then rises
 *  steeply, falls and stays, much like that of an implant. */
AdaptiveStepping::Forces
forces_at(const double t, const double ripple = 0.)
{
  AdaptiveStepping::Forces forces = AdaptiveStepping::Forces::Zero();
  const double             s      = std::max(0., t - 1.);
  forces[2]                       = -40. * std::min(t, 1.);
  forces[5]                       = 30. * std::tanh(60. * s) +
              10. * (1. - std::tanh(20. * (s - 0.15))) * std::tanh(60. * s);
  // a lateral reaction of a machine that holds still there
  forces[0] = ripple * std::sin(100. * s);
  return forces;
}



/** What the scene prescribes. */
AdaptiveStepping::Forces
drive_at(const double t, const bool sideways = false)
{
  AdaptiveStepping::Forces drive = AdaptiveStepping::Forces::Zero();
  drive[2]                       = -std::min(t, 1.);
  drive[5]                       = std::max(0., t - 1.);
  drive[0]                       = sideways ? std::max(0., t - 1.) : 0.;
  return drive;
}



/** Rates of the forces in the phase that ends at or after @p t. */
AdaptiveStepping::Forces
rates_at(const double t, const double ripple = 0.)
{
  const double h = 1e-6;
  return (forces_at(t, ripple) - forces_at(t - h, ripple)) / h;
}



/** What is drawn of force @p k at the part @p x of the step that ends with
 *  times[i]: Hermite's cubic, or a parabola where a phase begins. */
double
drawn(const std::vector<double> &times,
      const unsigned int         i,
      const double               x,
      const unsigned int         k,
      const double               ripple = 0.)
{
  const double h      = times[i] - times[i - 1];
  const double F_0    = forces_at(times[i - 1], ripple)[k],
               F_1    = forces_at(times[i], ripple)[k],
               m_1    = h * rates_at(times[i], ripple)[k];
  const bool   begins = times[i - 1] == 0. || times[i - 1] == 1.;
  const double m_0 =
    begins ? 2. * (F_1 - F_0) - m_1 : h * rates_at(times[i - 1], ripple)[k];
  return F_0 * (1. + 2. * x) * (1. - x) * (1. - x) +
         m_0 * x * (1. - x) * (1. - x) + F_1 * x * x * (3. - 2. * x) -
         m_1 * x * x * (1. - x);
}



/** The ends of the steps; notes in @p n_pressing how many the first phase has.
 */
std::vector<double>
adaptive_times(const double  tolerance,
               unsigned int &n_pressing,
               const double  ripple   = 0.,
               const bool    sideways = false)
{
  LoadSteppingParameters parameters;
  parameters.times                  = {0, 1, 2};
  parameters.steps                  = {1, 4};
  parameters.tolerance              = tolerance;
  parameters.smallest_step_fraction = 1e-6;
  AdaptiveStepping    stepping(parameters,
                            2.5,
                            ChuckParameters(),
                            [&](const double time) {
                              return drive_at(time, sideways);
                            });
  std::vector<double> times{0.};
  const auto          state_at = [&](const double time) {
    return StepState{time,
                     forces_at(time, ripple),
                     drive_at(time, sideways),
                     0.,
                     rates_at(time, ripple),
                     [] { return AdaptiveStepping::Forces::Zero(); }};
  };
  while (!stepping.is_finished())
    {
      if (stepping.is_between_phases())
        stepping.begin_phase(state_at(times.back()));
      const Step step = stepping.next();
      if (stepping.take(step, state_at(step.time), 1))
        times.push_back(step.time);
      if (times.back() == 1.)
        n_pressing = times.size() - 1;
    }
  return times;
}



/** Largest distance of the curve of the lateral force from what is drawn.
 */
double
lateral_error(const std::vector<double> &times, const double ripple)
{
  double error = 0;
  for (unsigned int i = 0; i + 1 < times.size(); ++i)
    for (unsigned int k = 0; k < 200; ++k)
      {
        const double x = k / 200.;
        const double t = times[i] + x * (times[i + 1] - times[i]);
        grow(error,
             std::abs(forces_at(t, ripple)[0] -
                      drawn(times, i + 1, x, 0, ripple)));
      }
  return error;
}



/** A small reaction where the machine holds still costs few steps, although its
 *  curve bends everywhere, and is within the tolerance of a tenth of the
 * largest force. Where the machine moves the force is within the tolerance of
 * itself. */
void
check_small_forces()
{
  unsigned int n_pressing = 0;
  const double tolerance = 1e-3, ripple = 0.05;
  const auto   without = adaptive_times(tolerance, n_pressing);
  const auto   with    = adaptive_times(tolerance, n_pressing, ripple);
  const auto   driven  = adaptive_times(tolerance, n_pressing, ripple, true);
  // in proportion to itself it would take some 100 / (384 tolerance)^(1/4) =
  // 130
  report("Steps that a small reaction adds",
         double(with.size()) - without.size(),
         90);
  report("Its error relative to the tolerance of a tenth of the largest",
         lateral_error(with, ripple) / (tolerance * 0.1 * 40.),
         1.);
  report("Error of a small force that is driven, relative to its own tolerance",
         lateral_error(driven, ripple) / (tolerance * ripple),
         1.5);
}



const double largest_torque = 49.43; // that forces_at() gives



/** Largest distance of the torque curve from what is drawn, over the largest
 *  torque. */
double
torque_error(const std::vector<double> &times)
{
  double error = 0;
  for (unsigned int i = 1; i < times.size(); ++i)
    for (unsigned int k = 0; k < 200; ++k)
      {
        const double x = k / 200.;
        const double t = times[i - 1] + x * (times[i] - times[i - 1]);
        grow(error, std::abs(forces_at(t)[5] - drawn(times, i, x, 5)));
      }
  return error / largest_torque;
}



/** Whatever the first steps are that the tolerance leads to: with some of them
 *  the parabola crosses the curve in the middle of the step. */
void
check_many_tolerances()
{
  double worst = 0;
  for (double tolerance = 0.05; tolerance > 1e-4; tolerance *= 0.99)
    {
      unsigned int n_pressing = 0;
      grow(worst,
           torque_error(adaptive_times(tolerance, n_pressing)) / tolerance);
    }
  report("Error relative to the tolerance, of 600 tolerances", worst, 1.2);
}



/** The first step of a phase on a quartic, whose error is known in it: its
 *  parabola is 100 s, from which the curve and h times its rate are off by d =
 *  0.1 and m = -1 in the middle. At s = 1/5 that is 0.512 (0.8 d - 0.6 m) =
 *  0.348; twice that over 100 is compared with the tolerance. */
void
check_first_step()
{
  const auto curve_at = [](const double s) {
    const double d = 0.1, m = -1., c = 2. * (m + 2. * d), p = (1. - s);
    AdaptiveStepping::Forces F = AdaptiveStepping::Forces::Zero(), rate = F;
    F[5] = 100. * s + 4. * s * p * p * (c * s - m);
    rate[5] =
      100. + 4. * (p * p - 2. * s * p) * (c * s - m) + 4. * s * p * p * c;
    return std::make_pair(F, rate);
  };
  const auto takes_one_step = [&](const double tolerance) {
    LoadSteppingParameters parameters;
    parameters.times     = {0, 1};
    parameters.steps     = {1};
    parameters.tolerance = tolerance;
    const auto drive     = [](const double time) {
      AdaptiveStepping::Forces result = AdaptiveStepping::Forces::Zero();
      result[5]                       = time;
      return result;
    };
    const auto state_at = [&](const double time) {
      const auto [forces, rates] = curve_at(time);
      return StepState{time, forces, drive(time), 0., rates, [] {
                         return AdaptiveStepping::Forces::Zero();
                       }};
    };
    AdaptiveStepping stepping(parameters, 2.5, ChuckParameters(), drive);
    stepping.begin_phase(state_at(0.));
    const Step middle = stepping.next();
    stepping.take(middle, state_at(middle.time), 1);
    const Step whole = stepping.next();
    return middle.time == 0.5 && whole.time == 1. &&
           stepping.take(whole, state_at(whole.time), 1);
  };
  report("A quartic within the tolerance takes one step",
         takes_one_step(2. * 0.00348 * 1.001));
  report("Beyond it it does not", !takes_one_step(2. * 0.00348 * 0.999));
}



void
check_adaptive(const double tolerance)
{
  unsigned int n_pressing = 0;
  const auto   times      = adaptive_times(tolerance, n_pressing);
  double       integral   = 0;
  for (unsigned int i = 0; i + 1 < times.size(); ++i)
    for (unsigned int k = 0; k < 200; ++k)
      {
        const double x = k / 200.;
        const double t = times[i] + x * (times[i + 1] - times[i]);
        // the fewest cubics: int (|F_4| / 384 / tolerance)^(1/4) dt
        const double h = 1e-3;
        const auto   F = [&](const int i) { return forces_at(t + i * h)[5]; };
        const double F4 =
          (F(2) - 4. * F(1) + 6. * F(0) - 4. * F(-1) + F(-2)) / std::pow(h, 4);
        if (t > 1. + 2. * h)
          integral += std::pow(std::abs(F4) / 384., 0.25) *
                      (times[i + 1] - times[i]) / 200.;
      }
  const double fewest = integral / std::pow(tolerance * largest_torque, 0.25);
  std::cout << "Adaptive, tolerance " << tolerance << std::endl;
  report("A straight line takes one step", n_pressing == 1);
  report("The end is hit exactly", times.back() == 2.);
  report("Error relative to the tolerance",
         torque_error(times) / tolerance,
         1.);
  report("Steps per step of the fewest",
         (times.size() - 2.) / (fewest + 4.),
         2.5);
}



int
main()
{
  check_adaptive(1e-2);
  check_adaptive(1e-3);
  check_adaptive(1e-4);
  check_first_step();
  check_many_tolerances();
  check_small_forces();

  LoadSteppingParameters parameters;
  parameters.times                  = {0.1, 1.3, 2.2, 2.9};
  parameters.steps                  = {3, 1000, 7};
  parameters.smallest_step_fraction = 1. / 64.;
  const std::vector<double> plan    = parameters.planned_times();

  std::cout << "Planned steps: " << parameters.n_steps() << std::endl;
  report("Ends of phases are hit exactly",
         plan[0] == 0.1 && plan[3] == 1.3 && plan[1003] == 2.2 &&
           plan[1010] == 2.9);
  double deviation  = 0;
  bool   increasing = true;
  for (unsigned int k = 1; k <= 1010; ++k)
    {
      increasing = increasing && plan[k] > plan[k - 1];
      if (k >= 3 && k <= 1003)
        grow(deviation, std::abs(plan[k] - (1.3 + 0.9 * (k - 3.) / 1000.)));
    }
  report("Times increase", increasing);
  report("Deviation from equal steps", deviation, 2e-15);
  report("Phases and their first steps",
         parameters.step_in_phase(0) == 0 && parameters.step_in_phase(1) == 1 &&
           parameters.step_in_phase(3) == 3 &&
           parameters.step_in_phase(4) == 1 &&
           parameters.step_in_phase(5) == 2 &&
           parameters.step_in_phase(1003) == 1000 &&
           parameters.step_in_phase(1004) == 1 &&
           parameters.step_in_phase(1010) == 7);

  // from 0.1 to 0.5, 0.9 and 1.3
  PlannedSteps whole(parameters);
  report("A step that succeeds is taken whole",
         are(take(whole, 0.1, 0.4), {plan[1]}));
  const Step second = whole.next();
  report("The next one is its continuation",
         second.extrapolate && second.time == plan[2]);
  whole.take(second, StepState(), 0);
  take(whole, plan[2], 0.4);
  whole.begin_phase(StepState());
  report("One in a new phase is not", !whole.next().extrapolate);

  PlannedSteps halving(parameters);
  report("Halved twice", are(take(halving, 0.1, 0.1), {0.2, 0.3, 0.4, 0.5}));
  bool         hit_exactly = true;
  unsigned int n_parts     = 0;
  for (unsigned int k = 2; k <= 1010; ++k)
    {
      const double start = plan[k - 1], end = plan[k];
      const auto   times = take(halving, start, 0.125 * (end - start));
      hit_exactly        = hit_exactly && times.back() == end;
      n_parts += times.size();
    }
  report("Planned times are hit exactly by sub-steps",
         hit_exactly && n_parts == 8 * 1009);
  report("Then all is done", halving.is_finished());

  // ends a and b of which a + (b - a) is not b
  for (const auto &[a, b] : {std::make_pair(0.3, 0.9),
                             std::make_pair(0.7, 2.9),
                             std::make_pair(1.3, 3.4)})
    {
      LoadSteppingParameters single;
      single.times = {a, b};
      single.steps = {1};
      PlannedSteps sub_steps(single);
      hit_exactly = hit_exactly && single.planned_times()[1] == b &&
                    take(sub_steps, a, 0.25 * (b - a)).back() == b;
    }
  report("Also where differences are rounded", hit_exactly);

  // failures of the first quarter only: 1/4, then 1/4 + 1/2, no more than fits
  PlannedSteps growing(parameters);
  growing.begin_phase(StepState());
  for (unsigned int n = 0; n < 2; ++n)
    growing.reject(growing.next(), false);
  report("Grows again on its grid",
         are(take(growing, 0.1, 1.), {0.2, 0.3, 0.5}));
  report("The next step is whole", are(take(growing, 0.5, 1.), {plan[2]}));

  PlannedSteps keeping(parameters);
  take(keeping, 0.1, 0.1);
  report("The size is kept for the next step", keeping.next().time < plan[2]);

  PlannedSteps small(parameters);
  small.begin_phase(StepState());
  unsigned int n = 0;
  while (small.reject(small.next(), false))
    ++n;
  std::cout << "Can be halved " << n << " times" << std::endl;
  PlannedSteps allowed(parameters), forbidden(parameters);
  report("1/64 is allowed", !take(allowed, 0.1, 0.4 / 64.).empty());
  report("1/128 is not", take(forbidden, 0.1, 0.4 / 128.).empty());
}
