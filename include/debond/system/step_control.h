#pragma once

#include <debond/bulk/chuck.h>
#include <debond/system/load_step_parameters.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <string>

namespace Debond
{
  /** A step that is to be tried. */
  struct Step
  {
    /** Where it ends; a guess if the mean sliding distance is prescribed. */
    double time = 0;
    /** The end of what it is a part of: of a trial in the middle of a step the
     *  step's, else its own. */
    double whole_time = 0;
    /** Growth of the mean sliding distance that is prescribed instead of the
     *  time [mm]; 0: the time is. */
    double slip = 0;
    /** May start on the straight line through the last two states, of which it
     *  is the continuation. */
    bool extrapolate = false;
    /** Size relative to the step before, where the line is drawn over a path
     *  instead of the time. */
    double ratio = 0;

    bool
    by_slip() const
    {
      return slip > 0.;
    }
  };

  /** State of the system, as the control of steps knows it. */
  struct StepState
  {
    double         time = 0;
    Chuck::Vector6 forces; ///< of the chuck, generalised [N, N mm]
    /** Values that the scene prescribes, displacements and angles or loads. */
    Chuck::Vector6 drive;
    double         path_length = 0; ///< [mm]; known along a path only
    /** Derivatives of the forces by time; known with adaptive steps only. */
    Chuck::Vector6 force_rates = Chuck::Vector6::Zero();
    /** By how much the forces are off, going by steps of half the size; asked
     *  with adaptive steps only, as it takes time. */
    std::function<Chuck::Vector6()> error = {};
    /** Of the chuck [mm, rad], and how it changes with time, which is known
     *  with adaptive steps only. */
    Chuck::Vector6 position       = Chuck::Vector6::Zero(),
                   position_rates = Chuck::Vector6::Zero();
    /** Along a path: how much path_length can still grow [mm]. */
    double path_left = std::numeric_limits<double>::infinity();
    /** Along a path: a load has nothing left to act against. */
    bool is_detached = false;
    /** Part of the forces before that points carried which have left a face
     *  over its edge since: known with adaptive steps only. */
    Chuck::Vector6 let_go = Chuck::Vector6::Zero();
  };

  /**
   * Which steps lead from row to row. Who solves asks for the next() step and
   * tells what became of it: it was solved, take(), or could not be, reject().
   * At the end of a phase, and at the beginning, begin_phase() comes first.
   */
  class StepControl
  {
  public:
    explicit StepControl(const LoadSteppingParameters &parameters)
      : parameters(parameters)
    {}
    virtual ~StepControl() = default;

    virtual Step
    next() = 0;
    /** Judges a step that was solved in so many iterations, with the state at
     *  its end: false if it is not to be accepted, because it went too far or
     *  was a trial only. */
    virtual bool
    take(const Step &step, const StepState &state, unsigned int iterations) = 0;
    /** Makes the step smaller because it could not be solved; false if it
     *  cannot be smaller. @p has_edge: points may cross the edge of a face, and
     *  have no state where they do. */
    virtual bool
    reject(const Step &step, bool has_edge) = 0;

    /** True if the step that was taken is the last one of its row. */
    virtual bool
    row_is_complete() const
    {
      return true;
    }
    bool
    is_between_phases() const
    {
      return phase == 0 || time == end;
    }
    virtual bool
    is_finished() const
    {
      return phase == parameters.steps.size() && time == end;
    }
    /** Curve in the step that was taken: a straight line, the
     *  parabola with the rate at the end, or the cubic with the rates at both
     *  ends. */
    enum class StepShape
    {
      straight,
      parabola,
      cubic
    };
    virtual StepShape
    step_shape() const
    {
      return StepShape::straight;
    }
    /** Why there is no further step, for people. */
    virtual std::string
    reason_to_end() const
    {
      return "the last time is reached";
    }

    /** Goes to the beginning of the next phase, with the accepted state. */
    virtual void
    begin_phase(const StepState &accepted);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &phase &time &end &planned &has_previous;
    }

  protected:
    const LoadSteppingParameters parameters;
    unsigned int                 phase = 0; ///< from 1; 0: none has begun
    double time = 0, end = 0;    ///< of the accepted state, of the phase
    double planned      = 0;     ///< size of a planned step
    bool   has_previous = false; ///< a step of this phase has been taken
  };



  /**
   * The planned steps of a scene, each a row, and the sub-steps that they are
   * cut into. A sub-step is a power of two of its planned step, so that its end
   * is exact. One that fails is halved; after one that succeeds the next may be
   * twice as large. Their size is kept from one planned step to the next.
   */
  class PlannedSteps : public StepControl
  {
  public:
    using StepControl::StepControl;

    void
    begin_phase(const StepState &accepted) override;
    Step
    next() override;
    bool
    take(const Step &step, const StepState &, unsigned int) override;
    bool
    reject(const Step &, bool) override;
    bool
    row_is_complete() const override
    {
      return done == 1.;
    }
    std::string
    reason_to_end() const override
    {
      return "all planned steps are done";
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int version)
    {
      StepControl::serialize(archive, version);
      archive &current &done &size;
    }

  private:
    unsigned int current = 0;        ///< in the phase, from 1
    double       done = 1, size = 1; ///< exact: sums of powers of two
  };



  /**
   * Steps of a size that keeps the six chuck forces at the ends of the steps,
   * and the curves of what answers in between, cubics with the rates of change
   * at both ends, within a tolerance. A prescribed component answers with its
   * force, a loaded one with its position, and one that a compliant machine
   * drives with both.
   *
   * The tolerance is relative to the largest value of each curve; where the
   * machine holds still, for instance against the lateral forces of a bond on
   * one side, it is relative to a tenth of the largest of all forces if that is
   * more, and of all motions for a load that is constant.
   *
   * doc/explanation/solution.md says how both errors are estimated. In the
   * first step of a phase the rate at its beginning is not known: it is a
   * parabola, whose error a trial in the middle of the step tells.
   */
  class AdaptiveStepping : public StepControl
  {
  public:
    using Forces = Chuck::Vector6;

    /** @p radius makes forces of moments and lengths of angles, to compare them
     *  with [mm]. @p drive: what the scene prescribes at a time. */
    AdaptiveStepping(const LoadSteppingParameters        &parameters,
                     const double                         radius,
                     const ChuckParameters               &chuck,
                     const std::function<Forces(double)> &drive)
      : StepControl(parameters)
      , tolerance(std::min(parameters.tolerance, 0.1))
      , radius(radius)
      , chuck(chuck)
      , drive(drive)
    {}

    void
    begin_phase(const StepState &accepted) override;
    /** First of all a trial in the middle, in the first step of a phase. */
    Step
    next() override;
    /** Where the curves bend too much between the states before and @p state,
     *  the step has to be smaller, if it can. */
    bool
    take(const Step &, const StepState &state, unsigned int) override;
    /** Halves the step, or doubles the smallest one over an edge. */
    bool
    reject(const Step &, bool has_edge) override;
    /** Not where even the smallest step was too large: there is a jump, and a
     *  cubic would swing. */
    StepShape
    step_shape() const override
    {
      return !is_resolved ? StepShape::straight :
             second       ? StepShape::parabola :
                            StepShape::cubic;
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int version)
    {
      StepControl::serialize(archive, version);
      archive &size &turn &current &previous &second &is_resolved;
      archive &middle &bend &bend_before             &has_middle;
      archive &greatest &furthest &first_drive       &drive_change;
    }

  private:
    double
    smallest() const;
    double
    target_time() const;
    double
    first_turn(double begin, double end) const;
    /** An end of a step, with forces and their rates. */
    struct Node
    {
      double time    = 0;
      Forces answers = Forces::Zero(), rates = Forces::Zero();

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &time &answers &rates;
      }
    };
    Forces
    difference(const Node &last) const;
    std::array<Forces, 2>
    differences_of_parabola(const Node &last) const;
    Forces
    answers(const Forces &forces, const Forces &positions) const;
    double
    relative(const Forces    &difference,
             const StepState &state,
             bool             of_answers,
             double           of_whole = 0.1) const;
    Forces
    expected_rates(double h) const;
    struct ErrorBetween
    {
      double smooth; ///< if the curve is
      double drawn;  ///< with the kink or jump that there may be
    };
    ErrorBetween
    error_between(const StepState &state, const Node &last) const;
    double
    error_at_end(const StepState &state) const;
    void
    set_size(double new_size);

    /** The part of the forces that points let go of, if it is little. */
    Forces
    passed_over(const StepState &state, const Node &last) const;
    Node
    node_of(const StepState &state) const;
    void
    grow(const StepState &state);

    /** Steps that are coarser than 0.1 do not see what they leave out. */
    const double                        tolerance;
    const double                        radius;
    const ChuckParameters               chuck;
    const std::function<Forces(double)> drive;
    double                              size = 0;
    double turn = 0;            ///< next time at which something turns back
    Node   current;             ///< at the beginning of the step
    Node   previous;            ///< one step before
    bool   second      = false; ///< previous is where the phase began
    bool   is_resolved = true;  ///< the error was below the tolerance
    Node   middle;              ///< of the first step of a phase
    /** Errors of the last two steps, if smooth, over the tolerance and the
     * fourth power of the step. */
    double bend = 0, bend_before = 0;
    bool   has_middle = false;
    bool   leaps      = false; ///< over an edge: is doubled until it is solved
    Forces greatest = Forces::Zero(), furthest = Forces::Zero(); ///< so far
    Forces first_drive  = Forces::Zero();
    Forces drive_change = Forces::Zero(); ///< largest so far
  };



  /**
   * The steps along a path of equilibrium that may snap back. Where points
   * slide, a step prescribes the mean sliding distance, which only grows, and
   * the time is found; where little slides, it prescribes the time. A step that
   * cannot be solved, or whose state is too far away, is tried again with the
   * other control, and then smaller. No step goes further in time than a
   * planned one.
   */
  class PathFollowing : public StepControl
  {
  public:
    /** The path ends at a mean sliding distance of @p end_slip [mm]; no step is
     *  larger than @p largest_slip [mm]. */
    PathFollowing(const LoadSteppingParameters &parameters,
                  const double                  largest_slip,
                  const double                  end_slip)
      : StepControl(parameters)
      , largest_slip(largest_slip)
      , end_slip(end_slip)
    {}

    void
    begin_phase(const StepState &accepted) override;
    Step
    next() override;
    bool
    take(const Step      &step,
         const StepState &state,
         unsigned int     iterations) override;
    bool
    reject(const Step &step, bool) override;
    bool
    is_finished() const override
    {
      return StepControl::is_finished() || is_detached ||
             path_length >= end_slip;
    }
    std::string
    reason_to_end() const override;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int version)
    {
      StepControl::serialize(archive, version);
      archive &path_length &slip_size         &time_size;
      archive &last_time_step &last_slip_step &goes_to_end;
      archive &slip_failed &time_failed       &is_detached;
      archive                                 &path_left;
    }

  private:
    bool
    reject_time(const Step &step);

    const double largest_slip, end_slip; ///< [mm]
    double       path_length = 0;
    double       path_left   = std::numeric_limits<double>::infinity();
    bool         is_detached = false;
    double       slip_size = 0, time_size = 0; ///< of the next step
    double       last_time_step = 0, last_slip_step = 0;
    /** The last slip step would have left the phase. */
    bool goes_to_end = false;
    /** Controls that have failed since the last accepted step; the other
     * control is tried next. */
    bool slip_failed = false, time_failed = false;
  };
} // namespace Debond
