#include <debond/input/allowed_values.h>
#include <debond/input/entry_table.h>
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
      // The entries, in a subsection of their own. A and D stay above zero:
      // without the direct effect the fall of mu in a step, up to B/D, would be
      // the same however short the step is.
      void
      declare(EntryTable &table) override
      {
        table.enter_subsection("Rate and state");
        table.add(
          "Reference coefficient",
          mu_0,
          Allowed::number_between(1e-9, 1e6, "").or_number(0).without_default(),
          "mu_0, dimensionless: coefficient at a speed far below Reference "
          "speed, with the state Sliding distance / Reference speed.");
        table.add("Direct effect",
                  A,
                  Allowed::number_between(1e-9, 1e6, "").without_default(),
                  "A, dimensionless: mu rises immediately by A ln(1 + V/V_0) "
                  "with the speed V.");
        table.add(
          "Evolution effect",
          B,
          Allowed::number_between(1e-9, 1e6, "").or_number(0).without_default(),
          "B, dimensionless: mu changes by B ln(V_0 theta/D) as the state "
          "theta evolves. With B > A friction falls with the speed.");
        table.add("Reference speed",
                  V_0,
                  Allowed::number_between(1e-30, 1e15, "mm per unit of time")
                    .without_default(),
                  "V_0 [mm per unit of time]: speed that V and D / theta are "
                  "compared with.");
        table.add("Sliding distance",
                  D,
                  Allowed::number_between(1e-9, 1e6, "mm").without_default(),
                  "D [mm]: sliding distance over which the state evolves after "
                  "a change of speed.");
        table.add("Initial state",
                  theta_0,
                  Allowed::number_between(1e-30, 1e30, "units of time")
                    .or_word_for("auto", "0"),
                  "theta [unit of time] when friction starts. `auto': Sliding "
                  "distance / Reference speed, the steady state at Reference "
                  "speed.");
        table.add("Expert / Evolution",
                  is_slip_law,
                  Allowed::choice("ageing | slip"),
                  "`ageing': d theta/dt = 1 - V theta/D, also while a point "
                  "sticks. `slip': d theta/dt = -(V theta/D) ln(V theta/D), "
                  "which needs sliding. An open point keeps its state.");
        table.leave_subsection();
      }

      void
      initialise() override
      {
        // Refused with it are closed forms, the model `auto', paths of
        // equilibrium, along which time may fall, and the explicit update.
        depends_on_rate = true;
        // the state follows a new speed over that distance
        characteristic_distance = D;
        // psi of theta_0; without an entry 0, which is steady sliding at V_0
        initial_variables = {
          {theta_0 > 0. ? std::log(V_0 * theta_0 / D) : 0., 0.}};
        entries_against_fall =
          "Rate and state / Sliding distance or Direct effect";
      }

      // mu at the end of a step in which the point slides by the distance d
      // [mm]. The mean speed V = d/dt stands for the speed at the end, which is
      // backward Euler: of first order in the step, but with d as the only
      // unknown of the local problem. The derivative is total, with dV = dd/dt
      // and dpsi/dd from the state's own update. Where no time
      // passes the speed is that of the last step, for output: in row 0 there
      // is no direct effect, and the law is Coulomb's with mu_0 + B psi.
      FrictionLimit
      limit(const PointStart &start,
            const double,
            const double pressure,
            const double distance) const override
      {
        const double dt = start.duration;
        double       slope;
        const double psi = evolved(start, distance, slope);
        // 1 + V/V_0 instead of V/V_0 under the logarithm keeps mu finite at V =
        // 0, where points stick; the derivative by d is A/(V_0 dt + d) [1/mm],
        // which grows as steps shrink.
        const double V   = dt > 0. ? distance / dt : start.history.internal[1],
                     mu  = mu_0 + A * std::log1p(V / V_0) + B * psi,
                     dmu = dt > 0. ? A / (V_0 * dt + distance) + B * slope : 0.;
        return {mu * pressure, mu, 0., dmu * pressure};
      }

      // The history of an accepted step: psi at its end, and V for output and
      // for the bound of the work. A point that sticks comes here with the
      // distance 0, and ages.
      InternalVariables
      advance(const PointStart &start, const double distance) const override
      {
        double       slope;
        const double dt = start.duration;
        return {
          {evolved(start, distance, slope), dt > 0. ? distance / dt : 0.}};
      }

      // int L dg_s [N/mm] at the constant speed of the step: after a part of
      // the distance the same part of the time has passed, so that V is the
      // same and only psi changes. 15 Gauss points resolve that, unless a step
      // is many D long.
      //
      // A point that slows down had a higher speed than that of the step: the
      // work could be more by A ln of the ratio of both speeds, which is taken
      // into account before the balance of energy says that a step has jumped.
      // For a point that speeds up it is 0: the direct effect can only have
      // been less.
      PointWork
      work(const PointStart &start,
           const double      pressure,
           const double      distance) const override
      {
        // L after this part of the step, by the same update over a shorter time
        const auto L = [&](const double part) {
          PointStart to_there = start;
          to_there.duration *= part;
          return limit(to_there, 0., pressure, part * distance).value;
        };
        PointWork result;
        result.friction =
          distance *
          boost::math::quadrature::gauss<double, 15>::integrate(L, 0., 1.);
        if (start.duration > 0.)
          result.friction_bound =
            pressure * distance * A *
            std::max(0.,
                     std::log((V_0 + start.history.internal[1]) /
                              (V_0 + distance / start.duration)));
        return result;
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
      steepest_fall(const PointStart &start,
                    const double      pressure,
                    const double      distance) const override
      {
        const double dt = start.duration;
        if (dt == 0. || distance == 0.)
          return 0.;
        // ln(V theta_n/D): 0 in the steady state, positive for a state older
        // than the speed wants
        const double from_steady =
          is_slip_law ?
            start.history.internal[0] + std::log(distance / (V_0 * dt)) :
            0.;
        return pressure * std::max(0.,
                                   B / D * (1. + std::max(0., from_steady)) -
                                     A / (V_0 * dt + distance));
      }

    private:
      /** psi after the step, and d psi/d @p distance. With x = distance/D and
       *  constant V = distance/dt
       *    ageing: theta = theta_n e^-x + dt (1 - e^-x)/x,
       *    slip:   ln(V theta/D) = e^-x ln(V theta_n/D). */
      double
      evolved(const PointStart &start,
              const double      distance,
              double           &slope) const
      {
        // psi instead of theta: theta runs over many orders of magnitude, and
        // what the law asks for is its logarithm. x is dimensionless, the
        // distance in units of D.
        const double psi = start.history.internal[0], dt = start.duration;
        const double x = distance / D, decay = std::exp(-x);
        slope = 0.;
        if (dt == 0.)
          return psi;
        if (!is_slip_law)
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
      double mu_0 = 0.4, A = 0.01, B = 0.015, V_0 = 1e-3, D = 0.01, theta_0 = 0;
      bool   is_slip_law = false; ///< else ageing
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
            RateAndState()};
  }
} // namespace Debond
