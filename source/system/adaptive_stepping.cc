#include <debond/system/step_control.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>

namespace Debond
{
  void
  AdaptiveStepping::begin_phase(const StepState &accepted)
  {
    StepControl::begin_phase(accepted);
    if (phase == 1)
      first_drive = accepted.drive;
    current = node_of(accepted);
    grow(accepted);
    turn = first_turn(time, end);
    set_size(planned);
  }



  // The first time between the two at which a component of what the scene
  // prescribes has an extreme value. No step goes across it: the part of the
  // path beyond its end would be lost, and with it friction. The end if there
  // is none. Sampled in 256 parts, and found to a part in 1e8 there.
  double
  AdaptiveStepping::first_turn(const double begin, const double end) const
  {
    constexpr unsigned int n_parts = 256;
    const double           part    = (end - begin) / n_parts;
    double                 first   = end;
    Forces                 before = drive(begin), here = drive(begin + part);
    for (unsigned int i = 2; i <= n_parts && first == end; ++i)
      {
        const double t    = begin + i * part;
        const Forces next = drive(t);
        for (unsigned int k = 0; k < 6; ++k)
          if (const double there = here[k] - before[k],
              back               = here[k] - next[k];
              there * back > 0. && std::min(std::abs(there), std::abs(back)) >
                                     1e-12 * std::abs(here[k]))
            {
              const double sign = next[k] > here[k] ? 1. : -1.;
              const double at =
                boost::math::tools::brent_find_minima(
                  [&](const double time) { return sign * drive(time)[k]; },
                  t - 2. * part,
                  t,
                  std::numeric_limits<double>::digits / 2)
                  .first;
              first = std::min(first, at);
            }
        before = here;
        here   = next;
      }
    return first;
  }



  double
  AdaptiveStepping::smallest() const
  {
    return parameters.smallest_step_fraction * planned;
  }



  void
  AdaptiveStepping::set_size(const double new_size)
  {
    size       = std::clamp(new_size, smallest(), planned);
    has_middle = false;
  }



  double
  AdaptiveStepping::target_time() const
  {
    // no tiny step before the end: two equal ones instead
    const double left = turn - time;
    if (left <= size * (1. + 1e-9))
      return turn;
    return left < 2. * size ? time + 0.5 * left : time + size;
  }



  Step
  AdaptiveStepping::next()
  {
    Step step;
    step.extrapolate = has_previous;
    step.whole_time = step.time = target_time();
    if (!has_previous && !has_middle)
      step.time = 0.5 * (time + step.whole_time);
    return step;
  }



  // Of a component that is loaded the force is what the scene says.
  AdaptiveStepping::Forces
  AdaptiveStepping::answers(const Forces &forces, const Forces &positions) const
  {
    Forces result = forces;
    for (unsigned int k = 0; k < 6; ++k)
      if (chuck.component[k].loaded)
        result[k] = positions[k];
    return result;
  }



  AdaptiveStepping::Node
  AdaptiveStepping::node_of(const StepState &state) const
  {
    return {state.time,
            answers(state.forces, state.position),
            answers(state.force_rates, state.position_rates)};
  }



  // A point leaves a face all at once, and what it stands for little by little:
  // steps are not made small to see it do so, unless it is much. The curve goes
  // on without the jump, see take(): what it misses of where the rates lead, as
  // far as points have let go of it. Points beside them take over the rest.
  AdaptiveStepping::Forces
  AdaptiveStepping::passed_over(const StepState &state, const Node &last) const
  {
    constexpr double most   = 5.; // tolerances
    const Forces     let_go = answers(state.let_go, Forces::Zero()),
                 missed     = current.answers - last.answers +
                          0.5 * (last.time - current.time) *
                            (current.rates + last.rates);
    Forces jump = Forces::Zero();
    for (unsigned int k = 0; k < 6; ++k)
      if (missed[k] * let_go[k] > 0.)
        jump[k] =
          std::copysign(std::min(std::abs(missed[k]), std::abs(let_go[k])),
                        let_go[k]);
    // of what is not driven a share of the whole: single points are not
    // symmetric
    return relative(jump, state, true, 1.) <= most * tolerance ? jump :
                                                                 Forces::Zero();
  }



  void
  AdaptiveStepping::grow(const StepState &state)
  {
    greatest = greatest.cwiseMax(state.forces.cwiseAbs());
    furthest = furthest.cwiseMax(state.position.cwiseAbs());
  }



  // How far the curve is from what is drawn in the middle of the step. With
  // s = (t - t_0) / h the cubic is
  //
  //   p(s) = F_0 + s D + s (1 - s) ((1 - s) (h m_0 - D) - s (h m_1 - D)),
  //
  // D = F_1 - F_0. Values and rates at three times determine a polynomial of
  // degree five (four, if the first of them is where the phase began), which is
  //
  //   p(s) + s^2 (1 - s)^2 (a + b (s + r)),
  //
  // with the time before at s = -r.
  AdaptiveStepping::Forces
  AdaptiveStepping::difference(const Node &last) const
  {
    const double h      = last.time - current.time;
    const Forces change = last.answers - current.answers,
                 end    = h * last.rates - change;
    const Forces begin  = h * current.rates - change;
    const double r      = (current.time - previous.time) / h;
    const double w      = std::pow(r * (1. + r), 2), // s^2 (1 - s)^2 at -r, and
      dw                = -2. * r * (1. + r) * (1. + 2. * r); // its derivative
    const Forces a      = (previous.answers - current.answers + r * change +
                      r * (1. + r) * ((1. + r) * begin + r * end)) /
                     w;
    Forces b = Forces::Zero();
    if (!second)
      {
        const Forces slope = change +
                             (1. + 2. * r) * ((1. + r) * begin + r * end) +
                             r * (1. + r) * (begin + end);
        b = (h * previous.rates - slope - dw * a) / w;
      }
    return (a + (0.5 + r) * b) / 16.;
  }



  // The same in the first step of a phase, where m_0 is not known. What is
  // drawn is the parabola through both ends with the rate m_1, whose rate in
  // the middle is D. If value and rate are off there by d and m / h, then the
  // quartic through all that is known is off by
  //
  //   4 s (1 - s)^2 (2 (m + 2 d) s - m).
  //
  // The parabola may cross the curve in the middle; hence also at s = 1/5,
  // where the part of m is nearly largest.
  std::array<AdaptiveStepping::Forces, 2>
  AdaptiveStepping::differences_of_parabola(const Node &last) const
  {
    const double h      = last.time - current.time;
    const Forces change = last.answers - current.answers,
                 d      = middle.answers - current.answers - 0.75 * change +
                     0.25 * h * last.rates,
                 m = h * middle.rates - change;
    return {{d, 0.512 * (0.8 * d - 0.6 * m)}};
  }



  // The largest of the six, over what they are compared with. They are of the
  // answers, or all of the forces.
  double
  AdaptiveStepping::relative(const Forces    &difference,
                             const StepState &state,
                             const bool       of_answers,
                             const double     of_whole) const
  {
    // a rate that could not be found: as bad as can be
    if (!difference.allFinite())
      return std::numeric_limits<double>::infinity();
    // moments are forces at the distance of the radius, and arcs have lengths
    Forces unit;
    unit << 1., 1., 1., radius, radius, radius;
    const Forces largest  = greatest.cwiseMax(state.forces.cwiseAbs()),
                 motion   = furthest.cwiseMax(state.position.cwiseAbs());
    const double of_all   = largest.cwiseQuotient(unit).maxCoeff(),
                 distance = motion.cwiseProduct(unit).maxCoeff();
    // A component next to nothing, for instance by symmetry, has no curve.
    // Small reactions to patterns beside the axis have a kink wherever a few
    // points begin to slide: in proportion to themselves they would take three
    // times as many steps as the torque.
    double result = 0.;
    for (unsigned int k = 0; k < 6; ++k)
      {
        const double floor    = drive_change[k] > 0. ? 1e-3 : of_whole,
                     force    = std::max(largest[k], floor * of_all * unit[k]),
                     place    = std::max(motion[k], floor * distance / unit[k]);
        const auto &component = chuck.component[k];
        // what a compliant machine lags behind is its force over its stiffness
        const double scale = of_answers && component.loaded ?
                               place :
                             component.stiffness > 0. ?
                               std::min(force, component.stiffness * place) :
                               force;
        if (scale > 0.)
          result = std::max(result, std::abs(difference[k]) / scale);
      }
    return result;
  }



  // The rate at the end of the step, if the cubic of the step before went on:
  // with q = h / (t_0 - t_-1), A = m_-1 - D and B = m_0 - D,
  //
  //   D + (1 + 2 q) (q A + (1 + q) B) + q (1 + q) (A + B).
  AdaptiveStepping::Forces
  AdaptiveStepping::expected_rates(const double h) const
  {
    const double before = current.time - previous.time, q = h / before;
    const Forces D = (current.answers - previous.answers) / before,
                 A = previous.rates - D, B = current.rates - D;
    return D + (1. + 2. * q) * (q * A + (1. + q) * B) + q * (1. + q) * (A + B);
  }



  // The largest error of what is drawn in the step over the tolerance.
  AdaptiveStepping::ErrorBetween
  AdaptiveStepping::error_between(const StepState &state,
                                  const Node      &last) const
  {
    const auto in_parts = [&](const Forces &difference) {
      return relative(difference, state, true) / tolerance;
    };
    if (!has_previous) // twice: the curve need not be a quartic
      {
        const auto [there, before] = differences_of_parabola(last);
        const double error = 2. * std::max(in_parts(there), in_parts(before));
        return {error, error};
      }
    // A kink near the end of the step hardly moves the polynomial in its
    // middle, and shows in the rate. On a smooth curve with equal steps that
    // rate is off by h^3 F'''' / 2, and the cubic by h^4 F'''' / 384; half as
    // much is wanted.
    const double h = last.time - current.time;
    const double smooth =
      std::max(in_parts(difference(last)),
               in_parts(h / 96. * (last.rates - expected_rates(h))));
    // A cubic leaves a kink between two straight lines by h |m_1 - m_0| / 8,
    // and a jump by half of it and more. Where the error is much more than the
    // fourth power of the step would make of that of the steps before, or that
    // is not known, they are taken to be there. Elsewhere there may be one that
    // the estimate sees a quarter of.
    const Forces begin = h * current.rates, end = h * last.rates;
    const double drawn = std::max(
      {smooth,
       in_parts((end - begin) / 8.),
       in_parts((last.answers - current.answers - (begin + end) / 2.) / 2.)});
    const double expected =
      second ? 0. : std::max(bend, bend_before) * std::pow(h, 4);
    return {smooth,
            smooth < std::max(2. * expected, 0.02) ?
              std::min(4. * smooth, drawn) :
              drawn};
  }



  // The error of the state at the end of the step over the tolerance.
  double
  AdaptiveStepping::error_at_end(const StepState &state) const
  {
    return relative(state.error(), state, false) / tolerance;
  }



  bool
  AdaptiveStepping::take(const Step      &step,
                         const StepState &state,
                         const unsigned int)
  {
    // A press in one step goes on to forces that a longer trial has shown:
    // errors are a share of those, not of a contact that has just begun.
    if (parameters.steps[phase - 1] == 1 && phase < parameters.steps.size())
      grow(state);
    if (step.time != step.whole_time)
      {
        middle     = node_of(state);
        has_middle = true;
        return false;
      }
    drive_change =
      drive_change.cwiseMax((state.drive - first_drive).cwiseAbs());
    Node         last = node_of(state);
    const Forces jump =
      has_previous ? passed_over(state, last) : Forces::Zero();
    last.answers += jump;
    const auto [smooth, drawn] = error_between(state, last);
    const double taken         = step.time - time;
    // to 0.8 of the tolerance: the error of the cubic goes with the fourth
    // power of the step, that of the state at its end with the square
    double     at_end = 0.;
    const auto change = [&](const double curve) {
      return std::min(std::pow(0.8 / std::max(curve, 1e-12), 0.25),
                      std::pow(0.8 / std::max(at_end, 1e-12), 0.5));
    };
    if (!leaps && taken > smallest() * (1. + 1e-9))
      {
        if (drawn <= 1.)
          at_end = error_at_end(state);
        if (std::max(drawn, at_end) > 1.)
          {
            set_size(taken * std::clamp(change(drawn), 0.1, 0.7));
            return false;
          }
      }
    second = !has_previous;
    if (second) // of the parabola that was drawn
      current.rates =
        2. / taken * (last.answers - current.answers) - last.rates;
    leaps        = false;
    is_resolved  = drawn <= 1.;
    previous     = current;
    bend_before  = second ? 0. : bend;
    bend         = is_resolved ? smooth / std::pow(taken, 4) : 0.;
    has_previous = last.rates.allFinite();
    current      = last;
    for (Node *const node : {&previous, &current})
      node->answers -= jump;
    time = step.time;
    if (time == turn && time != end)
      {
        // as a new phase, but for the size of steps
        turn         = first_turn(time, end);
        has_previous = false;
      }
    grow(state);
    set_size(taken *
             std::clamp(
               change(std::max(drawn, 0.2 * bend_before * std::pow(taken, 4))),
               0.5,
               2.));
    return true;
  }



  bool
  AdaptiveStepping::reject(const Step &step, const bool has_edge)
  {
    const double tried = step.whole_time - time;
    const bool   fails = tried <= smallest() * (1. + 1e-9);
    leaps              = leaps || (fails && has_edge);
    if (leaps ? step.whole_time == turn || size == planned : fails)
      return false;
    set_size((leaps ? 2. : 0.5) * tried);
    return true;
  }
} // namespace Debond
