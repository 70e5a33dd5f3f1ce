#include <debond/system/energy_balance.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** Of the energy of a press fit, what cells make it differ as it turns. */
    constexpr double cells = 1e-3;
  } // namespace



  void
  EnergyBalance::add(const EnergyState &state)
  {
    if (started)
      {
        const Chuck::Vector6 dq = state.position - last.position;
        // A trapezoid, as for the dissipation of the points: with the same rule
        // on both sides the balance holds to the bound of what forces change
        // within the step.
        W += 0.5 * (state.forces + last.forces).dot(dq) + state.press_fit -
             last.press_fit;
        bound +=
          0.5 * (state.forces - last.forces).cwiseAbs().dot(dq.cwiseAbs());
        // Sliding points work along the chords of their paths. With tractions
        // along the path at both ends that is sin(a) / a of the work along the
        // arc of the angle a: less by 1 - sin(a) / a < a^2 / 6.
        const Chuck::Vector6 mean =
          0.5 * (state.forces.cwiseAbs() + last.forces.cwiseAbs());
        bound += dq.tail<3>().squaredNorm() / 6. * mean.dot(dq.cwiseAbs());
        bound += state.bound - last.bound;
        max_W = std::max(max_W, std::abs(W));
        last  = state;
      }
    else
      {
        first = last = state;
        begin_phase();
      }
    started = true;
  }



  void
  EnergyBalance::begin_phase()
  {
    phase = {last.stored, last.dissipated, W, bound};
  }



  double
  EnergyBalance::defect() const
  {
    return max_W > 0. ? (W - (last.stored - first.stored) -
                         (last.dissipated - first.dissipated)) /
                          max_W :
                        0.;
  }



  // Residuals that are not quite zero are no fault, nor is what a press fit
  // stores more or less as it turns over the cells of a mesh.
  double
  EnergyBalance::missing_bound() const
  {
    return bound - phase.bound + 1e-9 * max_W + cells * first.stored;
  }



  double
  EnergyBalance::missing() const
  {
    return W - phase.work - (last.stored - phase.stored) -
           (last.dissipated - phase.dissipated);
  }



  bool
  EnergyBalance::dissipates_too_much() const
  {
    // what was stored when the phase began may be dissipated as well
    return last.dissipated - phase.dissipated >
           W - phase.work + phase.stored + missing_bound();
  }



  double
  ReleasedEnergy::add(const EnergyState &state)
  {
    constexpr double rounding = 1e-15; // [N mm]
    double           excess   = 0.;
    if (started)
      {
        const Chuck::Vector6 dq = state.position - last.position;
        // Energy that goes in and neither is stored nor dissipated by the law
        // has been released in a jump: inertia, which the model leaves out,
        // would have it.
        const double put_in = 0.5 * (state.forces + last.forces).dot(dq) +
                              state.press_fit - last.press_fit;
        work += put_in;
        largest_work = std::max({largest_work, std::abs(work), state.stored});
        // of the trapezoid, and of residuals that are not quite zero; force and
        // motion may have turned within the step, so that its ends alone tell
        // too little
        const Chuck::Vector6 change = (state.forces - last.forces).cwiseAbs();
        const Chuck::Vector6 motion = dq.cwiseAbs();
        const double         bound =
          0.5 * change.cwiseMax(last_change).dot(motion.cwiseMax(last_motion)) +
          dq.tail<3>().squaredNorm() / 6. * greatest.dot(motion) + // of chords
          state.bound - last.bound + 1e-6 * largest_work + cells * at_start +
          rounding;
        last_change = change;
        last_motion = motion;
        excess      = put_in - (state.stored - last.stored) -
                 (state.dissipated - last.dissipated);
        may_hide_a_jump = std::abs(excess) > 1e-3 * 0.5 * change.dot(motion) &&
                          falls_steeply(state, dq);
        missing = excess < -bound ? -excess : 0.;
        if (excess <= bound)
          excess = 0.;
        else // the next step is no part of the jump
          {
            may_hide_a_jump = false;
            last_change = last_motion = Chuck::Vector6::Zero();
          }
      }
    else
      at_start = state.stored;
    started  = true;
    last     = state;
    greatest = greatest.cwiseMax(state.forces.cwiseAbs());
    total += excess;
    n_jumps += excess > 0. ? 1 : 0;
    return excess;
  }



  // Whether a force that makes up for some of the work, and against which the
  // machine moves on, has fallen by a fifth of its largest value.
  bool
  ReleasedEnergy::falls_steeply(const EnergyState    &now,
                                const Chuck::Vector6 &dq) const
  {
    for (unsigned int k = 0; k < 6; ++k)
      {
        const double fall = std::abs(last.forces[k]) - std::abs(now.forces[k]);
        if (last.forces[k] * dq[k] > 0. && fall > 0.2 * greatest[k] &&
            fall * std::abs(dq[k]) > 1e-3 * largest_work)
          return true;
      }
    return false;
  }
} // namespace Debond
