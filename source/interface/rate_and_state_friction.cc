#include <debond/interface/friction_law.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /**
     * Dieterich (1979) and Ruina (1983): friction that depends on the speed V
     * and on a state theta, a time,
     *
     *   mu = mu_0 + A ln(1 + V/V_0) + B ln(V_0 theta/D),
     *   d theta/dt = 1 - V theta/D                    (ageing), or
     *   d theta/dt = -(V theta/D) ln(V theta/D)       (slip).
     *
     * The speed of a step is the distance over its duration; with it theta is
     * integrated exactly, and mu is taken at the end. Internal variables: psi =
     * ln(V_0 theta/D), and the speed of the last step.
     */
    class RateAndState : public FrictionLaw
    {
    public:
      explicit RateAndState(const FrictionLawChoice &choice)
        : mu_0(choice.number("Reference coefficient"))
        , A(choice.number("Direct effect"))
        , B(choice.number("Evolution effect"))
        , V_0(choice.number("Reference speed"))
        , D(choice.number("Sliding distance"))
        , theta_0(choice.number("Initial state"))
        , ageing(choice.text("Evolution") == "ageing")
      {}

      FrictionCoefficient
      coefficient(const FrictionState &start,
                  const double         distance) const override
      {
        const double dt = start.duration;
        double       slope;
        const double psi = evolved(start, distance, slope);
        if (dt == 0.) // no time, no speed
          return {0., mu_0 + B * psi, 0.};
        return {0.,
                mu_0 + A * std::log1p(distance / (V_0 * dt)) + B * psi,
                A / (V_0 * dt + distance) + B * slope};
      }

      InternalVariables
      advance(const FrictionState &start, const double distance) const override
      {
        double       slope;
        const double dt = start.duration;
        return {
          {evolved(start, distance, slope), dt > 0. ? distance / dt : 0.}};
      }

      InternalVariables
      initial_variables() const override
      {
        return {{theta_0 > 0. ? std::log(V_0 * theta_0 / D) : 0., 0.}};
      }

      FrictionCoefficient
      reported(const FrictionState &state) const override
      {
        return {0.,
                mu_0 + A * std::log1p(state.internal[1] / V_0) +
                  B * state.internal[0],
                0.};
      }

      // At the speed of the step.
      double
      friction_strength(const FrictionState &start,
                        const double         distance) const override
      {
        const auto mu_at = [&](const double part) {
          FrictionState to_there = start;
          to_there.duration *= part;
          return coefficient(to_there, part * distance).mu;
        };
        return distance * boost::math::quadrature::gauss<double, 15>::integrate(
                            mu_at, 0., 1.);
      }

      // A point that slows down had a higher speed than that of the step.
      double
      strength_bound(const FrictionState &start,
                     const double         distance) const override
      {
        const double dt = start.duration;
        if (dt == 0.)
          return 0.;
        return distance * A *
               std::max(0.,
                        std::log((V_0 + start.internal[1]) /
                                 (V_0 + distance / dt)));
      }

      // The direct effect rises by A/(V_0 dt + d) at least. psi falls by 1/D at
      // most with the ageing law, from below the steady state, and by 1 +
      // ln(V theta/D) over D with the slip law. As the direct effect of a step
      // grows like 1/dt, there is one solution in steps that are short enough.
      double
      steepest_fall(const FrictionState &start,
                    const double         distance) const override
      {
        const double dt = start.duration;
        if (dt == 0. || distance == 0.)
          return 0.;
        const double from_steady =
          ageing ? 0. : start.internal[0] + std::log(distance / (V_0 * dt));
        return std::max(0.,
                        B / D * (1. + std::max(0., from_steady)) -
                          A / (V_0 * dt + distance));
      }

      std::string
      entries_against_fall() const override
      {
        return "Rate and state / Sliding distance or Direct effect";
      }

      bool
      depends_on_rate() const override
      {
        return true;
      }

      double
      characteristic_distance() const override
      {
        return D;
      }

      static std::vector<LawEntry>
      entries()
      {
        const auto row = [](const char          *name,
                            const char          *value,
                            const AllowedValues &allowed,
                            const char          *text) {
          return LawEntry{"Rate and state", name, value, allowed, text};
        };
        return {
          row("Reference coefficient",
              "0.4",
              Allowed::number_between(1e-9, 1e6, "").or_number(0),
              "mu_0, dimensionless: that of a point that has been sliding with "
              "a speed far below Reference speed and whose state is Sliding "
              "distance / Reference speed."),
          row("Direct effect",
              "0.01",
              Allowed::number_between(1e-9, 1e6, ""),
              "A, dimensionless: mu rises by A ln(1 + V/V_0) at once with the "
              "speed V."),
          row("Evolution effect",
              "0.015",
              Allowed::number_between(1e-9, 1e6, "").or_number(0),
              "B, dimensionless: mu changes by B ln(V_0 theta/D) as the state "
              "theta follows. B > A weakens with the speed."),
          row("Reference speed",
              "1e-3",
              Allowed::number_between(1e-30, 1e15, "mm per unit of time"),
              "V_0 [mm per unit of time]."),
          row("Sliding distance",
              "0.01",
              Allowed::number_between(1e-9, 1e6, "mm"),
              "D [mm], over which the state follows the speed."),
          row(
            "Initial state",
            "0",
            Allowed::number_between(1e-30, 1e30, "units of time").or_number(0),
            "theta [unit of time] when friction starts. 0: Sliding distance "
            "/ Reference speed, the steady state at Reference speed."),
          row("Evolution",
              "ageing",
              Allowed::choice("ageing | slip"),
              "`ageing': d theta/dt = 1 - V theta/D, also while a point "
              "sticks. `slip': d theta/dt = -(V theta/D) ln(V theta/D), which "
              "needs sliding. An open point keeps its state.")};
      }

    private:
      /** psi after the step, and d psi/d @p distance. With x = distance/D and
       *  constant V = distance/dt
       *    ageing: theta = theta_n e^-x + dt (1 - e^-x)/x,
       *    slip:   ln(V theta/D) = e^-x ln(V theta_n/D). */
      double
      evolved(const FrictionState &start,
              const double         distance,
              double              &slope) const
      {
        const double psi = start.internal[0], dt = start.duration;
        const double x = distance / D, decay = std::exp(-x);
        slope = 0.;
        if (dt == 0.)
          return psi;
        if (ageing)
          {
            const double aged = V_0 * dt / D, old = std::exp(psi) * decay;
            const bool   small = x < 0.01; // where the other one cancels
            const double mean  = x > 0. ? -std::expm1(-x) / x : 1.;
            const double mean_slope =
              small ?
                -0.5 + x * (1. / 3. - x * (0.125 - x * (1. / 30. - x / 144.))) :
                (decay * (1. + x) - 1.) / (x * x);
            const double state = old + aged * mean;
            slope              = (aged * mean_slope - old) / (D * state);
            return std::log(state);
          }
        // the slope is logarithmically infinite at V = 0
        const double speed = std::log(std::max(distance / (V_0 * dt), slowest));
        slope =
          -(decay * (psi + speed) + (x > 0. ? -std::expm1(-x) / x : 1.)) / D;
        return psi * decay + std::expm1(-x) * speed;
      }

      static constexpr double slowest = 1e-12; ///< of the slip law, in V_0
      const double            mu_0, A, B, V_0, D, theta_0;
      const bool              ageing;
    };
  } // namespace



  FrictionLawPlugin
  rate_and_state_plugin()
  {
    return {"rate and state",
            "mu = mu_0 + A ln(1 + V/V_0) + B ln(V_0 theta/D) with the sliding "
            "speed V and a state theta that follows it, see Rate and state",
            RateAndState::entries(),
            [](const FrictionLawChoice &choice) {
              return FrictionLawPointer(std::make_shared<RateAndState>(choice));
            }};
  }
} // namespace Debond
