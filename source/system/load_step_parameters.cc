#include <debond/input/entry_table.h>
#include <debond/support/number_text.h>
#include <debond/system/load_step_parameters.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Debond
{
  namespace
  {
    void
    declare_path(LoadSteppingParameters &parameters, EntryTable &table)
    {
      table.add(
        "Path following",
        parameters.follow_path,
        Allowed::choice("none | slip"),
        "`none': steps in time; where the equilibrium path snaps back, the "
        "program jumps or stops. `slip': follow the path by prescribing the "
        "mean sliding distance (with strength in tension: and opening); the "
        "time, and with it everything prescribed, is unknown and may fall; "
        "each accepted step is a row. While everything sticks planned steps "
        "are taken.");
      table.add("Expert / Largest slip step",
                parameters.largest_slip_step,
                Allowed::number_above(0, "mm").or_word_for("auto", "0"),
                "With Path following: largest step of the sliding distance, "
                "and of the opening, averaged over the contact face [mm]. "
                "`auto': a twentieth of the shortest distance over which the "
                "law changes, such as a_s, 2 a_s b_s, or the gap over which "
                "a bond opens.");
      table.add("Expert / Path ends at slip",
                parameters.path_ends_at_slip,
                Allowed::number_above(0, "mm").or_word_for("auto", "0"),
                "With Path following: the run ends when the mean sliding "
                "distance reaches this [mm], if not at the last time. "
                "`auto': the radius of the implant. A moment larger than the "
                "interface can carry never reaches its last time: the "
                "implant would turn for ever.");
    }



    void
    declare_iteration(LoadSteppingParameters &parameters, EntryTable &table)
    {
      table.add(
        "Expert / Smallest step fraction",
        parameters.smallest_step_fraction,
        Allowed::number_between(1e-15, 1, ""),
        "Smallest step, as a fraction of a planned step, or of Largest slip "
        "step. If it does not converge, the run stops with an error.");
      table.add("Expert / Residual tolerance",
                parameters.residual_tolerance,
                Allowed::number_between(1e-14, 0.1, ""),
                "Newton's method has converged when the residual is below "
                "this fraction of the contact force, of a load that is "
                "larger, or of the force of a penetration of 1e-6 R, or "
                "below what rounding of places makes.");
    }
  } // namespace



  void
  LoadSteppingParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Load steps");
    table.add("Times",
              times,
              Allowed::list(Allowed::number_between(-1e100, 1e100, "time"),
                            2,
                            0),
              "First time and the ends of the phases, increasing. Time is "
              "only a parameter of the load: there is no inertia.");
    table.add(
      "Steps",
      steps,
      Allowed::list(Allowed::whole_number(1, 10000000), 1, 0)
        .or_word_for("auto", "1, 1000"),
      "Number of planned steps in each phase: one number fewer than Times. "
      "With Adaptive they set the largest step. `auto': as Accuracy needs, "
      "without it 1, 1000. Finite elements with friction divide a step that "
      "prescribes more than 5 degrees about z, to keep the work accurate.");
    table.add(
      "Adaptive",
      adaptive,
      Allowed::choice("false | true").or_word_for("auto", "false"),
      "Let the program choose the steps, at most as large as the planned ones, "
      "so that the curves of torque and forces in curve.csv (for a prescribed "
      "force or moment: of the displacement) are within Tolerance, relative to "
      "the largest value of each. For a component along which the machine "
      "stands still, the reference is a tenth of the largest value of all, if "
      "that is more. Each accepted step is a row. Steps end where a prescribed "
      "motion turns back. Steps that do not converge are halved in any case. "
      "`auto': as Accuracy needs, without it false.");
    table.add("Tolerance",
              tolerance,
              Allowed::number_between(1e-7, 1, "").or_word_for("auto", "1e-3"),
              "Relative accuracy of the torque curve. With Adaptive: of the "
              "states at the ends of the steps, and of the cubics between "
              "them, both estimated; 0.1 at most is used. `auto': a quarter of "
              "Accuracy, without it 1e-3. Not used by planned steps.");
    declare_path(*this, table);
    declare_iteration(*this, table);
    table.leave_subsection();
  }



  void
  LoadSteppingParameters::check() const
  {
    const EntryCheck refuse = refusal_in("Load steps");
    for (std::size_t i = 1; i < times.size(); ++i)
      refuse(!(times[i] > times[i - 1]),
             "Times",
             to_text(times[i]) + " after " + to_text(times[i - 1]) +
               ": times must increase");
    refuse(steps.size() + 1 != times.size(),
           "Steps",
           "one number fewer than in Times is expected: " +
             std::to_string(times.size() - 1) + ", not " +
             std::to_string(steps.size()));
    const double n_planned = std::accumulate(steps.begin(), steps.end(), 0.);
    refuse(n_planned > 1e7,
           "Steps",
           to_text(n_planned) + " steps are more than the 1e7 allowed");
    for (std::size_t i = 1; i < times.size(); ++i)
      refuse((times[i] - times[i - 1]) / steps[i - 1] <
               1e-9 * std::max(std::abs(times[i]), std::abs(times[i - 1])),
             "Times",
             std::to_string(steps[i - 1]) + " steps from " +
               to_text(times[i - 1], 17) + " to " + to_text(times[i], 17) +
               " are too small to tell their times apart: let the times begin "
               "at 0");
    refuse(adaptive && follow_path,
           "Path following",
           "it chooses its steps itself: expected Load steps / Adaptive = "
           "false");
  }



  unsigned int
  LoadSteppingParameters::n_steps() const
  {
    return std::accumulate(steps.begin(), steps.end(), 0u);
  }



  unsigned int
  LoadSteppingParameters::step_in_phase(unsigned int step) const
  {
    for (unsigned int phase = 0; step > steps[phase]; ++phase)
      step -= steps[phase];
    return step;
  }



  double
  LoadSteppingParameters::planned_time(const unsigned int phase,
                                       const unsigned int step_in_phase) const
  {
    const double begin = times[phase], end = times[phase + 1];
    if (!ends.empty() && step_in_phase > 0)
      return ends[phase][step_in_phase - 1];
    return step_in_phase == steps[phase] ?
             end :
             begin + (end - begin) * step_in_phase / steps[phase];
  }



  std::vector<double>
  LoadSteppingParameters::planned_times() const
  {
    std::vector<double> planned{times[0]};
    for (unsigned int phase = 0; phase < steps.size(); ++phase)
      for (unsigned int i = 1; i <= steps[phase]; ++i)
        planned.push_back(planned_time(phase, i));
    return planned;
  }



  std::vector<double>
  LoadSteppingParameters::sample_times(const bool planned_first) const
  {
    constexpr double    golden = 0.6180339887498949;
    const unsigned int  wanted = std::max<std::size_t>(1, 1000 / steps.size());
    std::vector<double> result, between;
    for (unsigned int phase = 0; phase < steps.size(); ++phase)
      {
        const unsigned int n     = std::min(steps[phase], wanted);
        const double       begin = times[phase],
                     size        = (times[phase + 1] - begin) / n;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = 0; k <= 1 + wanted / n; ++k)
            (k == 0 ? result : between)
              .push_back(begin + (i + std::fmod(k * golden, 1.)) * size);
      }
    result.push_back(times.back());
    result.insert(result.end(), between.begin(), between.end());
    if (!planned_first)
      std::sort(result.begin(), result.end());
    return result;
  }



  TimeFunction
  ModelParameters::value_over_time(const unsigned int component) const
  {
    return chuck.value_over_time(component, implant.characteristic_radius());
  }



  std::vector<double>
  ModelParameters::sampled_values(const unsigned int component) const
  {
    std::vector<double> values = load_steps.sample_times();
    std::transform(values.begin(),
                   values.end(),
                   values.begin(),
                   value_over_time(component));
    return values;
  }
} // namespace Debond
