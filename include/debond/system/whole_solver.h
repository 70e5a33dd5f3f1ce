#pragma once

#include <debond/bulk/whole_bulk.h>
#include <debond/system/coupled_tangent.h>

namespace dealii
{
  class TimerOutput;
}

namespace Debond
{
  /** Cycles of multigrid so far. */
  struct MultigridEffort
  {
    unsigned int systems     = 0; ///< linear systems
    unsigned int cycles      = 0; ///< of all of them
    unsigned int most_cycles = 0; ///< of one

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &systems &cycles &most_cycles;
    }
  };

  /** Solution of solve_whole(), and whether it is one. */
  struct WholeSolution
  {
    bool            converged = false;
    unsigned int    cycles    = 0; ///< of multigrid
    Eigen::VectorXd unknowns;      ///< of the coupled system
    Eigen::VectorXd bone;          ///< all that this rank owns of it
  };

  /**
   * Solves (B + C) x = b to |b - A x| <= @p relative_tolerance |b|, where the
   * @p bone is a WholeBulk: by GMRES for bone, implant, chuck and interface at
   * once, preconditioned from the right by a V-cycle for the bone and S^-1 for
   * the implant.
   *
   * @p b: in the unknowns; what it has for the bone is left aside for @p
   * b_of_bone, which is what this rank owns. Seconds go to the sections
   * `multigrid`, all of them, and `cycles` and `contact tangent`, parts of
   * these. Collective.
   */
  WholeSolution
  solve_whole(const CoupledTangent  &A,
              const WholeBulk       &bone,
              const Eigen::VectorXd &b,
              const Eigen::VectorXd &b_of_bone,
              double                 relative_tolerance,
              dealii::TimerOutput   *timer);
} // namespace Debond
