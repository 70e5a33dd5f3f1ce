#pragma once

#include <debond/bulk/bulk_space.h>
#include <debond/bulk/enriched_cells.h>

#include <deal.II/lac/full_matrix.h>

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace Debond
{
  /**
   * The finite elements of a body and the solver for their stiffness K: what a
   * deformable body is built on. Another solver is another class of this kind
   * and a line in make_bulk().
   *
   * There are two kinds. A CondensingBulk brings some of its degrees of
   * freedom, c, into the coupled system and takes care of the others, i,
   * itself. A WholeBulk takes part with all of them.
   *
   * Vectors of displacements v [mm] and forces [N] have 3 n_nodes entries; what
   * stands in fixed ones is ignored, and is zero in what is returned. Nothing
   * is kept from one call to the next but what set_contact() and linearise()
   * say.
   */
  class Bulk
  {
  public:
    virtual ~Bulk() = default;

    /** Makes the free degrees of freedom of these control points unknowns of
     *  the coupled system, and returns those that are unknowns now, in order.
     *  linearise() is to follow. */
    virtual std::vector<unsigned int>
    set_contact(const std::vector<bool> &control_points) = 0;
    /** Makes the tangent at the displacement @p v the stiffness K of all that
     *  follows. False if it is not positive definite: the old one is kept. */
    virtual bool
    linearise(const Eigen::VectorXd &v) = 0;

    /** A residual r, as far as the coupled system is concerned. */
    struct Residual
    {
      /** r_c - K_ci K_ii^-1 r_i in the unknowns, or r_c of a WholeBulk. */
      Eigen::VectorXd condensed;
      /** Part of r_i that CondensingBulk::correction() goes on from, empty: r_i
       * = 0; or the part of this rank of the r of a WholeBulk. */
      Eigen::VectorXd interior;
      double          norm_squared     = 0; ///< |r|^2 [N^2]
      double          interior_squared = 0; ///< |r_i|^2 [N^2]
    };
    /** Internal forces [N] and strain energy [N mm] at the displacement v.
     *  False if a cell is turned inside out or a value is not finite. */
    virtual bool
    internal_forces(const Eigen::VectorXd &v,
                    Eigen::VectorXd       &force,
                    double                &energy) const;
    /** K x for a few columns x, K the tangent at rest over all degrees of
     *  freedom, fixed ones included. */
    Eigen::MatrixXd
    product_at_rest(Eigen::MatrixXd x) const;

    /**
     * Cauchy stress at the mesh vertices [MPa], in the body's frame and in the
     * numbering of the vertex nodes, for pictures: computed at the Gauss
     * points, where it is most accurate, extrapolated to the corners of each
     * cell and averaged there over the cells of the body.
     *
     * Nothing is differentiated at the corners: those of the disk are singular.
     */
    std::vector<Eigen::Matrix3d>
    vertex_stress(const Eigen::VectorXd &v, bool has_small_strains) const;

    /** Takes the number of a cell, a Gauss point of the unit cell, the Cauchy
     *  stress there [MPa], and the volume that it stands for [mm^3]. */
    using StressVisitor = std::function<void(unsigned int,
                                             const dealii::Point<3> &,
                                             const Eigen::Matrix3d &,
                                             double)>;
    /** Visits all Gauss points of the cells of this rank. */
    void
    for_each_stress(const Eigen::VectorXd &v,
                    bool                   has_small_strains,
                    const StressVisitor   &visit) const;
    /** Young's modulus of a cell [MPa], the mean over its Gauss points. */
    double
    young_modulus(const unsigned int cell) const
    {
      return mesh.parameters().young_modulus *
             cells.stiffness_factors(cell).mean();
    }

  protected:
    Bulk(const BulkSpace &mesh, EnrichedCells &&cells)
      : mesh(mesh)
      , cells(std::move(cells))
    {}

    /** Degrees of freedom of a cell. */
    std::vector<dealii::types::global_dof_index>
    dofs_of(unsigned int cell) const;
    /** The stiffness K of the cell [N/mm] in state @p v, for
     *  distribute_local_to_global(). */
    dealii::FullMatrix<double>
    stiffness_of(unsigned int cell, const Eigen::VectorXd &v) const;
    /** Adds to sums over the cells of this rank those of others, one entry for
     *  each vertex. */
    virtual void
    add_up_at_vertices(std::vector<Eigen::Matrix3d> & /*stress*/,
                       std::vector<double> & /*n_cells*/) const
    {}

    const BulkSpace    &mesh;
    const EnrichedCells cells;
  };

  /** Equivalent stress of von Mises [MPa]. */
  inline double
  von_mises(const Eigen::Matrix3d &stress)
  {
    const Eigen::Matrix3d deviator =
      stress - stress.trace() / 3. * Eigen::Matrix3d::Identity();
    return std::sqrt(1.5) * deviator.norm();
  }
} // namespace Debond
