#include <debond/interface/friction_law.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>

// Friction that depends on the speed, which is not in the paper: its law of the
// bond knows the distance only, so that its torque is that of any speed of the
// test. Steady sliding has mu = mu_0 + A ln(1 + V/V_0) - B ln(V/V_0). With B >
// A it weakens as the speed grows; sliding at V >> V_0 is then stable on a
// spring stiffer than k_c = p (B - A)/D [MPa/mm] only, the interface's own
// eps_t being in series with the rest. On a softer one disturbances grow until
// the speed is infinite, and there is no quasi-static solution: the run warns
// of a jump or ends. `Interface / Viscosity' bounds the speed, and the implant
// sticks and slips in turns (doc/explanation/interface.md).
//
// The time steps are what such a law costs. They are implicit and of first
// order, and damp what oscillates with the frequency omega by omega^2 dt/4:
// growth is only seen in steps shorter than 2 V (k_c - k)/(p A omega^2).
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
      explicit RateAndState(const LawChoice &choice)
        : mu_0(choice.number("Reference coefficient"))
        , A(choice.number("Direct effect"))
        , B(choice.number("Evolution effect"))
        , V_0(choice.number("Reference speed"))
        , D(choice.number("Sliding distance"))
        , theta_0(choice.number("Initial state"))
        , ageing(choice.text("Evolution") == "ageing")
      {}

      // mu at the end of a step in which the point slides by the distance d
      // [mm]. The mean speed V = d/dt stands for the speed at the end, which is
      // backward Euler: of first order in the step, but with d as the only
      // unknown of the local problem. The derivative is total, with dV = dd/dt
      // and dpsi/dd from the state's own update. Where no time passes, as in
      // row 0, there is no direct effect, and the law is Coulomb's with mu_0 +
      // B psi.
      FrictionCoefficient
      coefficient(const FrictionState &start,
                  const double         distance) const override
      {
        const double dt = start.duration;
        double       slope;
        const double psi = evolved(start, distance, slope);
        // 1 + V/V_0 instead of V/V_0 under the logarithm keeps mu finite at V =
        // 0, where points stick; the derivative by d is A/(V_0 dt + d) [1/mm],
        // which grows as steps shrink.
        if (dt == 0.) // no time, no speed
          return {0., mu_0 + B * psi, 0.};
        return {0.,
                mu_0 + A * std::log1p(distance / (V_0 * dt)) + B * psi,
                A / (V_0 * dt + distance) + B * slope};
      }

      // The history of an accepted step: psi at its end, and V for output and
      // for the bound of the work. A point that sticks comes here with the
      // distance 0, and ages.
      InternalVariables
      advance(const FrictionState &start, const double distance) const override
      {
        double       slope;
        const double dt = start.duration;
        return {
          {evolved(start, distance, slope), dt > 0. ? distance / dt : 0.}};
      }

      // psi_n = ln(V_0 theta_0/D); without an entry 0, which is steady sliding
      // at V_0.
      InternalVariables
      initial_variables() const override
      {
        return {{theta_0 > 0. ? std::log(V_0 * theta_0 / D) : 0., 0.}};
      }

      // For output no step is under way: mu of the last speed and state.
      FrictionCoefficient
      reported(const FrictionState &state) const override
      {
        return {0.,
                mu_0 + A * std::log1p(state.internal[1] / V_0) +
                  B * state.internal[0],
                0.};
      }

      // The work per pressure, int mu dg_s [mm], at the constant speed of the
      // step: after a part of the distance the same part of the time has
      // passed, so that V is the same and only psi changes. 15 Gauss points
      // resolve that, unless a step is many D long.
      double
      friction_strength(const FrictionState &start,
                        const double         distance) const override
      {
        // mu after this part of the step, by the same update over a shorter
        // time
        const auto mu_at = [&](const double part) {
          FrictionState to_there = start;
          to_there.duration *= part;
          return coefficient(to_there, part * distance).mu;
        };
        return distance * boost::math::quadrature::gauss<double, 15>::integrate(
                            mu_at, 0., 1.);
      }

      // A point that slows down had a higher speed than that of the step.
      //
      // It is taken into account before the balance of energy says that a step
      // has jumped: the work could be more by A ln of the ratio of both speeds.
      // For a point that speeds up it is 0: the direct effect can only have
      // been less.
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
      // most with the ageing law, from below the steady state, and by 1 + ln(V
      // theta/D) over D with the slip law. As the direct effect of a step grows
      // like 1/dt, there is one solution in steps that are short enough.
      //
      // This asks for the distance of the step, unlike laws of g_s alone: what
      // is ahead depends on speeds that are not known yet. Where it exceeds
      // eps_t / p the step is halved (doc/explanation/interface.md).
      double
      steepest_fall(const FrictionState &start,
                    const double         distance) const override
      {
        const double dt = start.duration;
        if (dt == 0. || distance == 0.)
          return 0.;
        // ln(V theta_n/D): 0 in the steady state, positive for a state older
        // than the speed wants
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

      // Refused with it are closed forms, the model `auto', paths of
      // equilibrium, along which time may fall, and the explicit update.
      bool
      depends_on_rate() const override
      {
        return true;
      }

      // D [mm]: the state follows a new speed over that distance.
      double
      characteristic_distance() const override
      {
        return D;
      }

      // The entries, in a subsection of their own. A and D stay above zero:
      // without the direct effect the fall of mu in a step, up to B/D, would be
      // the same however short the step is.
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
              "mu_0, dimensionless: coefficient at a speed far below "
              "Reference speed, with the state Sliding distance / Reference "
              "speed."),
          row("Direct effect",
              "0.01",
              Allowed::number_between(1e-9, 1e6, ""),
              "A, dimensionless: mu rises immediately by A ln(1 + V/V_0) "
              "with the speed V."),
          row("Evolution effect",
              "0.015",
              Allowed::number_between(1e-9, 1e6, "").or_number(0),
              "B, dimensionless: mu changes by B ln(V_0 theta/D) as the "
              "state theta evolves. With B > A friction falls with the speed."),
          row("Reference speed",
              "1e-3",
              Allowed::number_between(1e-30, 1e15, "mm per unit of time"),
              "V_0 [mm per unit of time]: speed that V and D / theta are "
              "compared with."),
          row("Sliding distance",
              "0.01",
              Allowed::number_between(1e-9, 1e6, "mm"),
              "D [mm]: sliding distance over which the state evolves after a "
              "change of speed."),
          row(
            "Initial state",
            "0",
            Allowed::number_between(1e-30, 1e30, "units of time")
              .or_word_for("auto", "0"),
            "theta [unit of time] when friction starts. `auto': Sliding "
            "distance / Reference speed, the steady state at Reference speed."),
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
        // psi instead of theta: theta runs over many orders of magnitude, and
        // what the law asks for is its logarithm. x is dimensionless, the
        // distance in units of D.
        const double psi = start.internal[0], dt = start.duration;
        const double x = distance / D, decay = std::exp(-x);
        slope = 0.;
        if (dt == 0.)
          return psi;
        if (ageing)
          {
            // With e^psi = V_0 theta/D the ageing law reads e^psi = e^(psi_n -
            // x) + (V_0 dt/D) (1 - e^-x)/x: what is left of the old state, and
            // what has aged meanwhile. At rest, x = 0, it is theta_n + dt.
            // expm1 keeps digits where x is small.
            const double aged = V_0 * dt / D, old = std::exp(psi) * decay;
            const bool   small = x < 0.01; // where the other one cancels
            const double mean  = x > 0. ? -std::expm1(-x) / x : 1.;
            // d/dx of (1 - e^-x)/x = (e^-x (1 + x) - 1)/x^2, which for small x
            // is a difference of nearly equal numbers over x^2: a series then,
            // whose first term left out is of the order of x^5
            const double mean_slope =
              small ?
                -0.5 + x * (1. / 3. - x * (0.125 - x * (1. / 30. - x / 144.))) :
                (decay * (1. + x) - 1.) / (x * x);
            // psi = ln(state) by the chain rule, over D as dx = dd/D
            const double state = old + aged * mean;
            slope              = (aged * mean_slope - old) / (D * state);
            return std::log(state);
          }
        // The slope is logarithmically infinite at V = 0. A point at rest would
        // keep its state for ever with this law, so the speed is bounded from
        // below; there V does not enter mu by the direct effect either. With
        // ln(V_0 theta/D) = psi and s = ln(V/V_0) the solution above is psi =
        // e^-x (psi_n + s) - s.
        const double speed = std::log(std::max(distance / (V_0 * dt), slowest));
        slope =
          -(decay * (psi + speed) + (x > 0. ? -std::expm1(-x) / x : 1.)) / D;
        return psi * decay + std::expm1(-x) * speed;
      }

      // mu_0, A, B dimensionless; V_0 [mm per unit of time], D [mm], theta_0
      // [unit of time]
      static constexpr double slowest = 1e-12; ///< of the slip law, in V_0
      const double            mu_0, A, B, V_0, D, theta_0;
      const bool              ageing;
    };
  } // namespace



  // The law as scenes choose it. It is of the form of Eqs. (9) and (10): a
  // limit of the traction that depends on pressure, speed and a state, and a
  // local evolution law for that state.
  FrictionLawPlugin
  rate_and_state_plugin()
  {
    return {"rate and state",
            "mu = mu_0 + A ln(1 + V/V_0) + B ln(V_0 theta/D), with the "
            "sliding speed V and a state theta that evolves with sliding, "
            "see subsection Rate and state",
            RateAndState::entries(),
            [](const LawChoice &choice) {
              return FrictionLawPointer(std::make_shared<RateAndState>(choice));
            }};
  }
} // namespace Debond
