#pragma once

#include <debond/bulk/chuck.h>

namespace Debond
{
  /** Accepted state, as accounts of energy know it. */
  struct EnergyState
  {
    /** Generalised forces of the chuck and the motion that they work along, in
     *  internal units. */
    Chuck::Vector6 forces     = Chuck::Vector6::Zero();
    Chuck::Vector6 position   = Chuck::Vector6::Zero();
    double         stored     = 0; ///< [N mm]
    double         dissipated = 0; ///< [N mm]
    double         bound = 0; ///< of errors of all of these, sum so far [N mm]
    double         press_fit = 0; ///< work of an interference [N mm]

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &forces &position &stored &dissipated &bound &press_fit;
    }
  };



  /**
   * The energy balance W = E_bulk + E_interface + D, counted from the first
   * row. W is the work of an interference that changes and that of the chuck, a
   * trapezoid of the generalised forces over the motion of the six components;
   * the trapezoid's own error is bounded by half the sum of |dF| |dq|. The
   * bound of one phase of the load, a push-in in one step say, is no excuse for
   * a fault in another one: each is judged by what is gathered in it.
   */
  class EnergyBalance
  {
  public:
    /** Notes an accepted state: the position is the chuck's, and what is stored
     *  that of bodies and interface. */
    void
    add(const EnergyState &state);
    /** Begins a new account: steps after the last state are judged by
     * themselves.
     */
    void
    begin_phase();

    bool
    has_state() const
    {
      return started;
    }
    /** The last state that was noted, zero before the first one. */
    const EnergyState &
    state() const
    {
      return last;
    }

    double
    work() const
    {
      return W;
    } ///< [N mm]
    /** (W - E_bulk - E_interface - D) / max |W|, 0 while W = 0. */
    double
    defect() const;
    /** Bound of the trapezoid's share in defect(). */
    double
    defect_bound() const
    {
      return max_W > 0. ? bound / max_W : 0.;
    }
    /** Work that is neither stored nor dissipated in this phase, and the bound
     *  of the part of it that the size of the steps accounts for, over max |W|.
     */
    double
    missing_share() const
    {
      return max_W > 0. ? missing() / max_W : 0.;
    }
    double
    missing_share_bound() const
    {
      return max_W > 0. ? missing_bound() / max_W : 0.;
    }
    /** Dissipated more in this phase than was put in, beyond the bound? */
    bool
    dissipates_too_much() const;
    /** True if sliding gave energy back: @p step_dissipation is
     *  InterfaceWork::step_dissipation. */
    bool
    is_given_back(const double step_dissipation) const
    {
      return step_dissipation < -1e-9 * max_W;
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &started &first &last &W &max_W &bound;
      archive &phase.stored &phase.dissipated &phase.work &phase.bound;
    }

  private:
    double
    missing() const;
    double
    missing_bound() const;

    bool        started = false;
    EnergyState first, last;
    double      W = 0, max_W = 0, bound = 0;
    /** Where the phase began [N mm]. */
    struct
    {
      double stored = 0, dissipated = 0, work = 0, bound = 0;
    } phase;
  };



  /**
   * Finds steps that jump to another branch of equilibrium. What the machine
   * puts in is stored by its spring, the bodies and the interface, or
   * dissipated by friction along its law; a step that follows a path of
   * equilibrium leaves nothing else. A step that leaves more than the errors of
   * these sums can explain has released it without equilibrium: in nature it
   * would become motion and heat.
   */
  class ReleasedEnergy
  {
  public:
    /** Notes an accepted state: the position is that of the machine, which
     *  stores energy, too, and what is dissipated the work of friction. Returns
     *  what the step to it has released [N mm]; 0 if it followed equilibrium.
     */
    double
    add(const EnergyState &state);

    /** True if a force fell so far in the last step that a jump could not be
     * told from a steep fall. */
    bool may_hide_a_jump = false;
    /** By how much the law dissipates more in the last step than there was
     *  [N mm]; 0 if bounds account for it. */
    double       missing = 0.;
    double       total   = 0.; ///< sum over all steps [N mm]
    unsigned int n_jumps = 0;  ///< steps that jumped

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &started &last &last_change &last_motion &greatest
        &may_hide_a_jump &largest_work &work &at_start &total &n_jumps;
    }

  private:
    bool
    falls_steeply(const EnergyState &now, const Chuck::Vector6 &dq) const;

    bool        started = false;
    EnergyState last;
    /** Of forces and position in the last step, absolute. */
    Chuck::Vector6 last_change  = Chuck::Vector6::Zero(),
                   last_motion  = Chuck::Vector6::Zero();
    Chuck::Vector6 greatest     = Chuck::Vector6::Zero(); ///< forces, absolute
    double         largest_work = 0, work = 0, at_start = 0;
  };
} // namespace Debond
