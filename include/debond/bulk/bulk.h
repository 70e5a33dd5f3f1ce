#ifndef debond_bulk_bulk_h
#define debond_bulk_bulk_h

#include <debond/bulk/body_mesh.h>
#include <debond/bulk/neo_hookean.h>

#include <Eigen/Core>

#include <cmath>
#include <memory>
#include <vector>

namespace Debond
{
  /**
   * The finite elements of a body and the solver for their stiffness K: what a
   * deformable body is built on. Other elements, or another solver, are another
   * class of this kind and a line in make_bulk().
   *
   * A bulk brings some of its degrees of freedom c into the coupled system as
   * unknowns and takes care of the others, i, itself:
   *
   *   S = K_cc - K_ci K_ii^-1 K_ic.
   *
   * One that condenses nothing, for which K takes part as it is, is a
   * WholeBulk.
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

    /** S x, S^-1 b. */
    virtual Eigen::VectorXd
    product(const Eigen::VectorXd &x) const = 0;
    virtual Eigen::VectorXd
    solve(const Eigen::VectorXd &b) const = 0;
    /** The same for each column of @p B. */
    virtual Eigen::MatrixXd
    solve_all(const Eigen::MatrixXd &B) const
    {
      Eigen::MatrixXd X(B.rows(), B.cols());
      for (unsigned int j = 0; j < B.cols(); ++j)
        X.col(j) = solve(B.col(j));
      return X;
    }
    /** Whether there is S as a dense matrix; the coupled system must else do
     *  with products and solves. */
    virtual bool
    is_dense() const = 0;
    /** That matrix; formed at every call. */
    virtual Eigen::MatrixXd
    dense_stiffness() const = 0;

    /** Whether there are degrees of freedom that it takes care of itself; if
     *  not it is a WholeBulk. */
    virtual bool
    condenses() const
    {
      return true;
    }

    /** A residual r, as far as the coupled system is concerned. */
    struct Residual
    {
      /** r_c - K_ci K_ii^-1 r_i, in the unknowns. */
      Eigen::VectorXd condensed;
      /** What correction() needs to know of r_i; empty: r_i = 0. */
      Eigen::VectorXd interior;
      double          norm_squared     = 0; ///< |r|^2 [N^2]
      double          interior_squared = 0; ///< |r_i|^2 [N^2]
    };
    virtual Residual
    condense(const Eigen::VectorXd &r) const = 0;
    /** The displacement dv whose unknowns are @p dv_c and whose others follow,
     *  dv_i = -K_ii^-1 (r_i + K_ic dv_c). */
    virtual Eigen::VectorXd
    correction(const Eigen::VectorXd &dv_c, const Residual &r) const = 0;

    /** Internal forces [N] and strain energy [N mm] at the displacement v.
     *  False if a cell is turned inside out or a value is not finite. */
    virtual bool
    internal_forces(const Eigen::VectorXd &v,
                    Eigen::VectorXd       &force,
                    double                &energy) const = 0;
    /** K x for a few columns x, K the tangent at rest over all degrees of
     *  freedom, fixed ones included. */
    virtual Eigen::MatrixXd
    product_at_rest(const Eigen::MatrixXd &x) const = 0;

    /**
     * Cauchy stress at the mesh vertices [MPa], in the body's frame and in the
     * numbering of the vertex nodes, for pictures: computed by @p law at the
     * Gauss points, where it is most accurate, extrapolated to the corners of
     * each cell and averaged there over the cells of the body.
     *
     * Nothing is differentiated at the corners: those of the disk are singular.
     */
    virtual std::vector<Eigen::Matrix3d>
    vertex_stress(const Eigen::VectorXd &v, StressLaw law) const = 0;
    /** Young's modulus of a cell [MPa], the mean over its Gauss points. */
    virtual double
    young_modulus(unsigned int cell) const = 0;
  };

  /** Equivalent stress of von Mises [MPa]. */
  inline double
  von_mises(const Eigen::Matrix3d &stress)
  {
    const Eigen::Matrix3d deviator =
      stress - stress.trace() / 3. * Eigen::Matrix3d::Identity();
    return std::sqrt(1.5) * deviator.norm();
  }

  /** The bulk of a body with the given @p mesh, which must outlive it; direct
   *  unless the mesh asks for another solver (ModelParameters says whether it
   *  may). */
  std::unique_ptr<Bulk>
  make_bulk(const BodyMesh &mesh);
} // namespace Debond
#endif
