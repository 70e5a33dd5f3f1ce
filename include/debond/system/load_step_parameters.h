#pragma once

#include <debond/bulk/chuck.h>
#include <debond/interface/interface_parameters.h>
#include <debond/shapes/body_parameters.h>

#include <vector>

namespace Debond
{
  class EntryTable;

  /** The subsection `Load steps` of a scene. */
  struct LoadSteppingParameters
  {
    std::vector<double> times{0, 1, 2}; ///< first time and ends of the phases
    std::vector<unsigned int> steps{1, 1000}; ///< planned steps of each phase
    double                    smallest_step_fraction = 1e-4;
    double                    residual_tolerance     = 1e-8;
    bool                      adaptive               = false;
    double                    tolerance = 1e-3; ///< of the curves, if adaptive
    /** Follow the path of equilibrium by the mean sliding distance. */
    bool follow_path = false;
    /** Largest step of the mean sliding distance [mm]; 0: from the law. */
    double largest_slip_step = 0;
    /** Mean sliding distance at which the path ends [mm]; 0: the radius. */
    double path_ends_at_slip = 0;

    /** Ends of the planned steps of each phase, if they are not even: those
     * that another run has chosen. For scenes that a program makes; no entry of
     * a file. The curve between them is drawn as with adaptive steps. */
    std::vector<std::vector<double>> ends;

    /** True if the curve between rows is known. */
    bool
    draws_curve() const
    {
      return adaptive || !ends.empty();
    }

    /** Else each accepted step is a row. */
    bool
    rows_are_planned() const
    {
      return !adaptive && !follow_path;
    }

    /** Refuses times and steps that make no sense together. Throws EntryError.
     */
    void
    check() const;
    /** Number of planned steps; row 0, the first time, is not one of them. */
    unsigned int
    n_steps() const;
    /** Number within its phase, from 1, of planned step @p step; 0 for 0. */
    unsigned int
    step_in_phase(unsigned int step) const;
    /** End of a planned step of a phase (0, 1, ...), or the phase's beginning
     *  if it is 0. Steps are counted, not accumulated: the times of the phases
     *  are hit exactly. */
    double
    planned_time(unsigned int phase, unsigned int step_in_phase) const;
    /** The first time and the ends of all planned steps. */
    std::vector<double>
    planned_times() const;
    /** The same, or an even choice of them if there are many, first and last
     *  time of each phase included, and times between them, some thousand in
     *  all: at fractions of each step that are in tune with no wave. What
     *  functions of time are judged by. They ascend, or the planned ones come
     *  first: a message about the first wrong value has a time that is known.
     */
    std::vector<double>
    sample_times(bool planned_first = false) const;

    void
    declare(EntryTable &table);
  };



  /** The part of a scene that says what is solved: two bodies, the interface
   *  between them, the chuck that moves one of them, and in which steps. */
  struct ModelParameters
  {
    BodyParameters         bone;
    BodyParameters         implant = BodyParameters::default_implant();
    InterfaceParameters    interface;
    ChuckParameters        chuck;
    LoadSteppingParameters load_steps;

    /** Value that the scene prescribes to a component of the chuck, in the
     * units of its value, and that at the sample_times(). */
    TimeFunction
    value_over_time(unsigned int component) const;
    std::vector<double>
    sampled_values(unsigned int component) const;

    bool
    has_friction() const
    {
      return !interface.friction->is_frictionless;
    }
    /** True if a step that begins at @p time has friction. It starts at a
     *  planned time, up to rounding. */
    bool
    has_friction_after(const double time) const
    {
      return time >=
             interface.friction_starts_at -
               1e-9 * (load_steps.times.back() - load_steps.times.front());
    }

    /** Why the lattice solver cannot do the bone, as the rest of a sentence;
     *  empty: it can. */
    std::string
    why_not_lattice() const;
    /** What `Expert / Bone / Solver' comes to, never automatic, and in words.
     */
    BulkSolver
    bulk_solver() const;
    std::string
    bulk_solver_in_words() const;

    /** Refuses a bone that the ranks there are cannot solve, or not by the
     *  solver that is asked for. Throws EntryError. */
    void
    check_ranks() const;

  private:
    /** Why the bone is not solved on the lattice, as the rest of a sentence;
     *  empty: it is. */
    std::string
    why_off_lattice() const;
    /** Why it is solved by multigrid, in the same way. */
    std::string
    why_multigrid() const;
  };
} // namespace Debond
