#pragma once

#include <debond/bulk/bulk.h>

#include <vector>

namespace Debond
{
  /**
   * A bulk that condenses nothing: its stiffness K, over all degrees of freedom
   * and dealt out among the ranks, takes part in the coupled system as it is,
   *
   *   (K + C) v = -r,
   *
   * with C the interface's. It has products with K and, in the place of an
   * inverse, a V-cycle of algebraic multigrid. Its unknowns are those of
   * the control points that contact can reach, which all ranks know; the others
   * are found together with them (solve_whole()).
   *
   * Three kinds of vectors:
   *
   *   nodes    all 3 n_nodes; of forces the part of this rank's own cells, of
   *            displacements the values, which all ranks know;
   *   owned    the degrees of freedom that this rank owns, those of supports
   *            among them: sums over ranks are over these;
   *   unknowns the same on all ranks.
   */
  class WholeBulk : public Bulk
  {
  public:
    virtual unsigned int
    n_owned() const = 0;
    unsigned int
    n_unknowns() const
    {
      return unknowns.size();
    }

    /** The values of all ranks. Collective. */
    virtual Eigen::VectorXd
    at_nodes(const Eigen::VectorXd &owned) const = 0;
    /** The owned values among those at nodes; 0 in constrained ones. */
    virtual Eigen::VectorXd
    owned_of(const Eigen::VectorXd &nodes) const = 0;
    /** The same of the sums of all ranks' parts. Collective. */
    virtual Eigen::VectorXd
    assembled(Eigen::VectorXd nodes) const = 0;
    /** This rank's part of the values at the unknowns, 0 beside; to be added up
     *  over the ranks. */
    virtual void
    put_unknowns(const double *owned, double *unknowns) const = 0;
    /** The opposite: adds what this rank owns of the values at the unknowns. */
    virtual void
    add_unknowns(const double *unknowns, double *owned) const = 0;

    /** y = K x, and a V-cycle, or what stands in its place, for K y = x.
     *  Collective. */
    virtual void
    multiply(const double *x, double *y) const = 0;
    virtual void
    cycle(const double *x, double *y) const = 0;

    /** r, with norms over all ranks; `interior` is what is owned of it.
     *  Collective. */
    Residual
    whole_residual(Eigen::VectorXd owned) const;

    /** Over all ranks. Collective. */
    bool
    internal_forces(const Eigen::VectorXd &v,
                    Eigen::VectorXd       &force,
                    double                &energy) const override;

  protected:
    using Bulk::Bulk;

    void
    add_up_at_vertices(std::vector<Eigen::Matrix3d> &stress,
                       std::vector<double>          &n_cells) const override;

    std::vector<unsigned int> unknowns; ///< degrees of freedom at nodes
  };
} // namespace Debond
