#ifndef debond_bulk_body_h
#define debond_bulk_body_h

#include <debond/bulk/body_mesh.h>
#include <debond/bulk/condensation.h>
#include <debond/bulk/enriched_cells.h>
#include <debond/support/accepted_state.h>

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <memory>
#include <vector>

namespace Debond
{
  /**
   * A body in its own frame: what the interface sees of it is a deformable
   * contact surface and the force it answers with.
   *
   * `rigid` has no unknowns. `linear` condenses its bulk once onto the control
   * points that contact can reach. `neo_hookean` uses the same condensed matrix
   * as an approximate inverse of its bulk and true internal forces, so that the
   * iteration of the whole program converges to the exact nonlinear solution.
   *
   * The displacement v is the *trial* state; commit() and rollback() are the
   * only ways to and from the accepted one.
   */
  class Body
  {
  public:
    Body(const BodyParameters &parameters, Side side);

    const BodyMesh &
    mesh() const
    {
      return body_mesh;
    }
    const NurbsSurface &
    surface() const
    {
      return body_mesh.surface();
    }
    Material
    material() const
    {
      return body_mesh.parameters().material;
    }
    bool
    deformable() const
    {
      return material() != Material::rigid;
    }
    const EnrichedCells *
    cells() const
    {
      return bulk.get();
    }

    /** @name Contact unknowns */
    //@{
    /** Makes the given control points (by index) contact unknowns and condenses
     *  everything else, at the accepted state. Does nothing if that has been
     *  done with the same ones and the body is still at rest. */
    void
    set_contact_control_points(const std::vector<bool> &is_contact);
    const std::vector<bool> &
    contact_control_points() const
    {
      return is_contact;
    }
    /** Number of contact unknowns. */
    unsigned int
    n_unknowns() const
    {
      return contact_unknowns.size();
    }
    /** For 3 (control point) + component: the number of the contact unknown, or
     *  -1 if the component is fixed or its control point is not in contact. */
    const std::vector<int> &
    unknown_of() const
    {
      return unknown_numbers;
    }
    /** Stiffness S condensed on the contact unknowns [N/mm]; formed at every
     *  call. */
    Eigen::MatrixXd
    condensed_stiffness() const
    {
      return condensation.schur_complement();
    }
    /** S x [N] for a displacement x [mm], and its inverse. */
    Eigen::VectorXd
    condensed_product(const Eigen::VectorXd &x) const
    {
      return condensation.schur_product(x);
    }
    Eigen::VectorXd
    condensed_solve(const Eigen::VectorXd &b) const
    {
      return condensation.schur_solve(b);
    }
    //@}

    /** @name Residual and correction */
    //@{
    struct Residual
    {
      bool   valid = true; ///< false if a cell is turned inside out
      double norm_squared =
        0; ///< of the whole residual, interior included [N^2]
      double interior_squared = 0; ///< of its interior part [N^2]
    };
    /** Residual under the nodal contact forces @p contact_force (3 x control
     *  points, in the body's frame, [N]), condensed on the contact unknowns:
     *  r_c - K_ci K_ii^-1 r_i. Keeps what correct() needs. */
    Residual
    residual(const ControlNet &contact_force, Eigen::VectorXd &condensed);
    /** Moves the contact unknowns by @p dv and the interior with them. */
    void
    correct(const Eigen::VectorXd &dv);
    /** Takes back all of the last correction but @p fraction of it. */
    void
    shorten_correction(double fraction);
    /** Forms the tangent at the trial state anew and condenses it. Returns
     *  false if it is not positive definite; the old one is then kept. */
    bool
    refactor();
    //@}

    /** @name State */
    //@{
    /** Displacements of the control points of the contact surface, body frame.
     *  Those of a linear body that are no contact unknowns follow at commit().
     */
    Eigen::Map<const ControlNet>
    contact_displacement() const;
    /** Accepts the trial state. @p surface_is_seen: whether anybody needs what
     *  lies beside the contact unknowns of a linear body; only then it is given
     *  its equilibrium shape. */
    void
    commit(double time, bool surface_is_seen);
    /** Whether what lies beside the contact unknowns has been left behind by
     *  commit(), and giving it, in trial and accepted states, the equilibrium
     *  shape that belongs to them: no history is changed. */
    bool
    surface_was_left_behind() const
    {
      return surface_is_stale;
    }
    void
    complete_surface();
    void
    rollback();
    /** Starts a step from the accepted state, extrapolated linearly to @p time
     *  if @p extrapolate and two states are known. */
    void
    predict(double time, bool extrapolate);
    //@}

    /** Strain energy of the trial state [N mm]. */
    double
    energy() const;
    /** What the supports exert on the body in its frame: force [N] and moment
     *  about @p centre [N mm]. Lever arms are the current ones for a
     *  Neo-Hookean body, those of the reference configuration for a linear one,
     *  which balances moments only with them. Zero for a rigid body. */
    Eigen::Matrix<double, 6, 1>
    support_reaction(const Eigen::Vector3d &centre);
    /** Trial displacement of all nodes, tied vertices and, for a linear body,
     *  the interior included: for output. */
    Eigen::VectorXd
    full_displacement()
    {
      return full_displacement(v);
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      std::vector<bool>               contact      = is_contact;
      Eigen::VectorXd                 condensed_at = state_of_condensation;
      archive &contact &condensed_at &accepted;
      if (Archive::is_loading::value)
        restore(contact, condensed_at);
      archive &surface_is_stale &strain_energy;
    }

  private:
    Eigen::VectorXd
    contact_values(const Eigen::VectorXd &state) const;
    Eigen::VectorXd
    full_displacement(const Eigen::VectorXd &state);
    SymmetricSparseMatrix
    assemble_free_tangent();
    bool
    condense();
    void
    number_contact_unknowns(const std::vector<bool> &contact);
    bool
    condense_at(const Eigen::VectorXd &state);
    void
    restore(const std::vector<bool> &contact,
            const Eigen::VectorXd   &condensed_at);
    void
    compute_reaction_operator();

    BodyMesh                       body_mesh;
    std::unique_ptr<EnrichedCells> bulk; ///< none for a rigid body

    dealii::SparsityPattern      sparsity;
    dealii::SparseMatrix<double> tangent;

    std::vector<int> free_number; ///< per degree of freedom, -1: fixed or tied
    std::vector<unsigned int> free_dofs;
    std::vector<bool>         is_contact;
    std::vector<int>          unknown_numbers;
    std::vector<int>          contact_unknowns; ///< free numbers, in order
    /** Linear bodies: some of the contact surface's control points are no
     *  contact unknowns. */
    bool surface_is_condensed = false;
    /** Those control points did not follow at the last commit(). */
    bool         surface_is_stale = false;
    Condensation condensation;
    /** The displacement whose tangent is condensed; empty: none yet. */
    Eigen::VectorXd state_of_condensation;

    Eigen::VectorXd                v; ///< trial displacement, 3 n_nodes [mm]
    Eigen::VectorXd                uncorrected; ///< v before the last correct()
    AcceptedState<Eigen::VectorXd> accepted;

    Eigen::VectorXd internal_force; ///< at the trial state
    double          strain_energy = 0;
    /** Linear bodies: supports' resultants about the origin per unit of v_c. */
    Eigen::Matrix<double, 6, Eigen::Dynamic> reaction_operator;
  };
} // namespace Debond
#endif
