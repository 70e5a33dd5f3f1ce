#include <debond/system/energy_balance.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  void
  EnergyBalance::add(const EnergyState &state)
  {
    if (started)
      {
        const Chuck::Vector6 dq = state.position - last.position;
        W += 0.5 * (state.forces + last.forces).dot(dq);
        bound +=
          0.5 * (state.forces - last.forces).cwiseAbs().dot(dq.cwiseAbs());
        // sliding points work along the chords of their paths: tan(a/2) / (a/2)
        // of the turn a is 1 + a^2 / 12 + a^4 / 120 + ...
        const double turn = dq.tail<3>().squaredNorm() / 10.;
        bound += turn * state.forces.cwiseAbs().dot(dq.cwiseAbs());
        max_W = std::max(max_W, std::abs(W));
      }
    else
      first = state;
    started = true;
    last    = state;
  }



  double
  EnergyBalance::defect() const
  {
    return max_W > 0. ? (W - (last.stored - first.stored) -
                         (last.dissipated - first.dissipated)) /
                          max_W :
                        0.;
  }



  bool
  EnergyBalance::dissipates_too_much() const
  {
    // what was stored in the first row may be dissipated as well
    return last.dissipated - first.dissipated >
           W + first.stored + bound + 1e-9 * max_W;
  }



  double
  ReleasedEnergy::add(const EnergyState &state)
  {
    double excess = 0.;
    if (started)
      {
        const Chuck::Vector6 dq = state.position - last.position;
        const double put_in     = 0.5 * (state.forces + last.forces).dot(dq);
        work += put_in;
        largest_work = std::max({largest_work, std::abs(work), state.stored});
        // of the trapezoid, and of residuals that are not quite zero; force and
        // motion may have turned within the step, so that its ends alone tell
        // too little
        const Chuck::Vector6 change = (state.forces - last.forces).cwiseAbs();
        const Chuck::Vector6 motion = dq.cwiseAbs();
        const double         bound =
          0.5 * change.cwiseMax(last_change).dot(motion.cwiseMax(last_motion)) +
          state.bound - last.bound + 1e-6 * largest_work;
        last_change = change;
        last_motion = motion;
        excess      = put_in - (state.stored - last.stored) -
                 (state.dissipated - last.dissipated);
        hidden = std::abs(excess) > 1e-3 * 0.5 * change.dot(motion) &&
                 falls_steeply(state, dq);
        if (excess <= bound)
          excess = 0.;
        else // the next step is no part of the jump
          {
            hidden      = false;
            last_change = last_motion = Chuck::Vector6::Zero();
          }
      }
    started  = true;
    last     = state;
    greatest = greatest.cwiseMax(state.forces.cwiseAbs());
    released += excess;
    jumps += excess > 0. ? 1 : 0;
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
