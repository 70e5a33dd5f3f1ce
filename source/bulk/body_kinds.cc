#include <debond/bulk/body.h>
#include <debond/bulk/whole_bulk.h>
#include <debond/support/ranks.h>

#include <cmath>
#include <limits>

// The bodies that deform, from the cheaper to the more accurate one. The
// paper uses the Neo-Hookean law, Eq. (1), for both bodies. Their strains are
// about 1e-3 in the body's own frame, so that the Neo-Hookean law changes
// nothing that is visible in the torque, and takes up to four times as long
// (doc/evidence/speed_and_accuracy.md). Both have the same K at rest.
namespace Debond
{
  namespace
  {
    /**
     * Small strains in the body's frame: condensed once, after which its
     * interior is not needed and is left where it is until somebody looks.
     */
    class LinearBody : public Body
    {
    public:
      using Body::Body;

      // r_c = S v_c + f_c [N].
      //
      // R = K v, of which the condensed part is S v_c: the interior is in
      // equilibrium, whatever v_c, and has no residual. A residual is one
      // product with S, and neither cells nor the interior are touched.
      // The energy [N mm] follows from the work of the surface, 1/2 v_c . S
      // v_c.
      Residual
      residual(const ControlNet &contact_force) const override
      {
        const Eigen::VectorXd v_c = v(unknown_dofs);
        Residual              result;
        result.condensed         = condensing()->product(v_c);
        result.energy            = 0.5 * v_c.dot(result.condensed);
        const unsigned int first = 3 * body_mesh.n_inner_nodes();
        // Forces on control points that are no unknowns are left out: there is
        // no contact, as CoupledSystem extends the unknowns before.
        for (unsigned int k = 0; k < n_unknowns(); ++k)
          if (unknown_dofs[k] >= first)
            result.condensed[k] +=
              contact_force.data()[unknown_dofs[k] - first];
        result.norm_squared = result.condensed.squaredNorm();
        return result;
      }

      // The contact unknowns are enough: nobody asks where the interior is
      // before the end of the step. It would cost a solve with the large factor
      // in every iteration.
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv, const Residual &) const override
      {
        Eigen::VectorXd change = Eigen::VectorXd::Zero(v.size());
        change(unknown_dofs)   = dv;
        return change;
      }

      // In equilibrium the contact forces are -S v_c. With them, and the shape
      // of the linear body, a Neo-Hookean one has the condensed residual r
      // below. Energies alone would not do: in bending, the part of the third
      // order that is stretched cancels the one that is pressed.
      double
      change_at_large_strains() const override
      {
        const Eigen::VectorXd v_c = v(unknown_dofs),
                              f   = condensing()->product(v_c);
        Eigen::VectorXd forces    = Eigen::VectorXd::Zero(v.size());
        double          energy;
        if (!own_bulk->internal_forces(full_displacement(v), forces, energy))
          return std::numeric_limits<double>::infinity();
        const Eigen::VectorXd r = condensing()->condense(forces).condensed - f;
        return std::sqrt(r.dot(condensing()->solve(r)) / v_c.dot(f));
      }

    protected:
      // The equilibrium shape, v_i = -K_ii^-1 K_ic v_c, for pictures and for
      // the part of the surface that is not in contact: a correction by v_c
      // from rest, without a residual of the interior.
      Eigen::VectorXd
      full_displacement(const Eigen::VectorXd &state) const override
      {
        return Body::full_displacement(
          n_unknowns() > 0 ? condensing()->correction(state(unknown_dofs), {}) :
                             state);
      }

      // The resultants of the supports are m . K v, m the rigid modes of the
      // fixed degrees of freedom; condensing the row m K gives them per unit of
      // v_c,
      //
      //   m K v = (m K_c - m K_i K_ii^-1 K_ic) v_c,
      //
      // since the interior follows v_c. Six forward solves here, and none in
      // the steps to come. Without them each row of the torque curve would need
      // the interior for the check of the reactions.
      bool
      linearise(const Eigen::VectorXd &state) override
      {
        if (!Body::linearise(state))
          return false;
        const Eigen::MatrixXd rows = own_bulk->product_at_rest(
          support_modes(Eigen::VectorXd::Zero(v.size())));
        reaction_operator.resize(6, n_unknowns());
        for (unsigned int k = 0; k < 6; ++k)
          reaction_operator.row(k) =
            condensing()->condense(rows.col(k)).condensed;
        return true;
      }

      // [N, N mm] from the contact unknowns alone, not from the contact forces:
      // so it can be compared with them.
      Eigen::Matrix<double, 6, 1>
      reaction_about_origin(const Residual &) const override
      {
        return reaction_operator * v(unknown_dofs);
      }

    private:
      /** Supports' resultants about the origin per unit of v_c. */
      Eigen::Matrix<double, 6, Eigen::Dynamic> reaction_operator;
    };



    /**
     * Finite strains, Eq.\ (1). The condensed stiffness is an approximate
     * inverse of its bulk and the internal forces are the true ones: the
     * iteration of the whole system converges to the exact nonlinear solution,
     * and contracts about the strain until the bulk is linearised anew.
     */
    class LargeStrainBody : public Body
    {
    public:
      using Body::Body;

      // r~_c = R_c + f - K_ci K_ii^-1 R_i [N], with the true internal forces R
      // = int P : dF/dv dV (Eq. 1), and K of the state that was condensed last:
      // what the interior is still out of balance is handed on to the surface.
      // The work of the contact forces is theirs, not the body's.
      //
      // It vanishes, together with R_i, at the exact nonlinear solution,
      // whatever K is; K only says how much of R_i each node of the face feels.
      Residual
      residual(const ControlNet &contact_force) const override
      {
        Residual result;
        result.internal_force.setZero(v.size());
        result.valid =
          own_bulk->internal_forces(v, result.internal_force, result.energy);
        // A cell with J <= 0 has no ln J, and the attempt ends here. With
        // strains of 1e-3 only a step far off its target gets there.
        if (!result.valid)
          return result;
        Eigen::VectorXd r = result.internal_force;
        r.tail(contact_force.size()) += contact_force.reshaped();
        static_cast<Bulk::Residual &>(result) = condensing()->condense(r);
        return result;
      }

      // K depends on the state, so there is one to renew, and the lever arms of
      // the body's own balance of moments are X + v.
      bool
      has_small_strains() const override
      {
        return false;
      }

      // dv_i = -K_ii^-1 (R_i + K_ic dv_c): with every correction of the surface
      // the interior moves to where its balance would be if it were linear.
      // What is left is of the order of the strain, and is seen in the next
      // residual.
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv,
                 const Residual        &residual) const override
      {
        return condensing()->correction(dv, residual);
      }

    protected:
      // The internal forces at the supports are what these exert.
      Eigen::Matrix<double, 6, 1>
      reaction_about_origin(const Residual &residual) const override
      {
        return support_modes(v).transpose() * residual.internal_force;
      }
    };



    /**
     * A body whose bulk condenses nothing, of either law: its interior is part
     * of the residual and of the state in every iteration, and the coupled
     * system solves for all of it (solve_whole()). A rank has its part.
     */
    class WholeBody : public Body
    {
    public:
      WholeBody(const BodyParameters &parameters, const Side side)
        : Body(parameters, side)
        , bulk(*whole())
      {}

      // r = K v + f, or r = R(v) + f [N] with the true internal forces. Contact
      // forces are known to all ranks; one of them adds them.
      Residual
      residual(const ControlNet &contact_force) const override
      {
        Residual result;
        result.internal_force.setZero(v.size());
        if (!has_small_strains())
          result.valid =
            bulk.internal_forces(v, result.internal_force, result.energy);
        Eigen::VectorXd forces = result.internal_force;
        if (Ranks::is_first())
          forces.tail(contact_force.size()) += contact_force.reshaped();
        Eigen::VectorXd r = bulk.assembled(forces);
        if (has_small_strains())
          r += linear_forces(result.energy);
        static_cast<Bulk::Residual &>(result) =
          bulk.whole_residual(std::move(r));
        return result;
      }

      bool
      has_small_strains() const override
      {
        return !mesh().parameters().has_large_strains();
      }

      double
      change_at_large_strains() const override
      {
        double          energy, linear_energy;
        Eigen::VectorXd forces = Eigen::VectorXd::Zero(v.size());
        if (!bulk.internal_forces(v, forces, energy))
          return std::numeric_limits<double>::infinity();
        const Eigen::VectorXd r =
          bulk.assembled(forces) - linear_forces(linear_energy);
        Eigen::VectorXd x(r.size());
        bulk.cycle(r.data(), x.data()); // about K^-1 r
        return std::sqrt(Ranks::sum(r.dot(x)) / (2. * linear_energy));
      }

    protected:
      // As that of the other bodies, but each rank knows the forces of its own
      // cells only.
      bool
      linearise(const Eigen::VectorXd &state) override
      {
        if (!Body::linearise(state))
          return false;
        if (has_small_strains() && reaction_rows.size() == 0)
          reaction_rows = bulk.product_at_rest(
            support_modes(Eigen::VectorXd::Zero(v.size())));
        return true;
      }
      Eigen::Matrix<double, 6, 1>
      reaction_about_origin(const Residual &residual) const override
      {
        Eigen::Matrix<double, 6, 1> sum;
        if (has_small_strains())
          sum = reaction_rows.transpose() * v;
        else
          sum = support_modes(v).transpose() * residual.internal_force;
        Ranks::add_up(sum);
        return sum;
      }

    private:
      /** K v and the strain energy. */
      Eigen::VectorXd
      linear_forces(double &energy) const
      {
        const Eigen::VectorXd owned = bulk.owned_of(v);
        Eigen::VectorXd       forces(owned.size());
        bulk.multiply(owned.data(), forces.data());
        energy = 0.5 * Ranks::sum(owned.dot(forces));
        return forces;
      }

      const WholeBulk &bulk;
      /** Supports' resultants about the origin per unit of v. */
      Eigen::Matrix<double, Eigen::Dynamic, 6> reaction_rows;
    };
  } // namespace



  // `rigid` without unknowns, `linear` with those of its face, `neo-hookean`
  // with all of its nodes in the residual: each scene picks what it needs, for
  // each body by itself.
  std::unique_ptr<Body>
  make_body(const BodyParameters &parameters, const Side side)
  {
    if (parameters.is_rigid())
      return std::make_unique<Body>(parameters, side);
    if (parameters.bulk_solver == BulkSolver::multigrid)
      return std::make_unique<WholeBody>(parameters, side);
    if (parameters.has_large_strains())
      return std::make_unique<LargeStrainBody>(parameters, side);
    return std::make_unique<LinearBody>(parameters, side);
  }
} // namespace Debond
