#include <debond/bulk/body.h>

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
      LinearBody(const BodyParameters &parameters, const Side side)
        : Body(parameters, side, &NeoHookean::linear_stress)
      {}

      // r_c = S v_c + f_c.
      //
      // R = K v, of which the condensed part is S v_c: the interior is in
      // equilibrium, whatever v_c, and has no residual. The energy follows from
      // the work of the surface, 1/2 v_c . S v_c.
      Residual
      residual(const ControlNet &contact_force) const override
      {
        const Eigen::VectorXd v_c = v(unknown_dofs);
        Residual              result;
        result.condensed         = own_bulk->product(v_c);
        result.energy            = 0.5 * v_c.dot(result.condensed);
        const unsigned int first = 3 * body_mesh.n_vertices();
        for (unsigned int k = 0; k < n_unknowns(); ++k)
          if (unknown_dofs[k] >= first)
            result.condensed[k] +=
              contact_force.data()[unknown_dofs[k] - first];
        result.norm_squared = result.condensed.squaredNorm();
        return result;
      }

      // The contact unknowns are enough: nobody asks where the interior is
      // before the end of the step.
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv, const Residual &) const override
      {
        Eigen::VectorXd change = Eigen::VectorXd::Zero(v.size());
        change(unknown_dofs)   = dv;
        return change;
      }

    protected:
      // The equilibrium shape, v_i = -K_ii^-1 K_ic v_c, for pictures and for
      // the part of the surface that is not in contact.
      Eigen::VectorXd
      full_displacement(const Eigen::VectorXd &state) const override
      {
        return Body::full_displacement(
          n_unknowns() > 0 ? own_bulk->correction(state(unknown_dofs), {}) :
                             state);
      }

      // The resultants of the supports are m . K v, m the rigid modes of the
      // fixed degrees of freedom; condensing the row m K gives them per unit of
      // v_c. Six solves here, and none in the steps to come.
      bool
      linearise(const Eigen::VectorXd &state) override
      {
        if (!Body::linearise(state))
          return false;
        const Eigen::MatrixXd rows = own_bulk->product_at_rest(
          support_modes(Eigen::VectorXd::Zero(v.size())));
        reaction_operator.resize(6, n_unknowns());
        for (unsigned int k = 0; k < 6; ++k)
          reaction_operator.row(k) = own_bulk->condense(rows.col(k)).condensed;
        return true;
      }

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
     * Finite strains, Eq. (1). The condensed stiffness is an approximate
     * inverse of its bulk and the internal forces are the true ones: the
     * iteration of the whole system converges to the exact nonlinear solution,
     * and contracts about the strain until the bulk is linearised anew.
     */
    class NeoHookeanBody : public Body
    {
    public:
      NeoHookeanBody(const BodyParameters &parameters, const Side side)
        : Body(parameters, side, &NeoHookean::cauchy_stress)
      {}

      // r~_c = R_c + f - K_ci K_ii^-1 R_i, with the true internal forces
      // R = int P : dF/dv dV (Eq. 1), and K of the state that was condensed
      // last: what the interior is still out of balance is handed on to the
      // surface. The work of the contact forces is theirs, not the body's.
      Residual
      residual(const ControlNet &contact_force) const override
      {
        Residual result;
        result.internal_force.setZero(v.size());
        result.valid =
          own_bulk->internal_forces(v, result.internal_force, result.energy);
        if (!result.valid)
          return result;
        Eigen::VectorXd r = result.internal_force;
        r.tail(contact_force.size()) += contact_force.reshaped();
        static_cast<Bulk::Residual &>(result) = own_bulk->condense(r);
        return result;
      }

      bool
      has_small_strains() const override
      {
        return false;
      }

      // dv_i = -K_ii^-1 (R_i + K_ic dv_c): with every correction of the surface
      // the interior moves to where its balance would be if it were linear.
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv,
                 const Residual        &residual) const override
      {
        return own_bulk->correction(dv, residual);
      }

    protected:
      Eigen::Matrix<double, 6, 1>
      reaction_about_origin(const Residual &residual) const override
      {
        return support_modes(v).transpose() * residual.internal_force;
      }
    };
  } // namespace



  std::unique_ptr<Body>
  make_body(const BodyParameters &parameters, const Side side)
  {
    if (parameters.material == Material::linear)
      return std::make_unique<LinearBody>(parameters, side);
    if (parameters.material == Material::neo_hookean)
      return std::make_unique<NeoHookeanBody>(parameters, side);
    return std::make_unique<Body>(parameters, side);
  }
} // namespace Debond
