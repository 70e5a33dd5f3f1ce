#include <debond/bulk/body.h>

namespace Debond
{
  namespace
  {
    /** No unknowns, no energy; whatever acts on it passes to its supports,
     *  which nobody asks for. */
    class RigidBody : public Body
    {
    public:
      RigidBody(const BodyParameters &parameters, const Side side)
        : Body(parameters, side, false)
      {}
      Residual
      residual(const ControlNet &) const override
      {
        return {};
      }
      bool
      has_current_lever_arms() const override
      {
        return true;
      }
      std::vector<Eigen::Matrix3d>
      vertex_stress(const Eigen::VectorXd &) const override
      {
        return std::vector<Eigen::Matrix3d>(body_mesh.n_vertices(),
                                            Eigen::Matrix3d::Zero());
      }

    protected:
      void
      move(const Eigen::VectorXd &, const Residual &) override
      {}
      Eigen::Matrix<double, 6, 1>
      reaction_about_origin(const Residual &) const override
      {
        return Eigen::Matrix<double, 6, 1>::Zero();
      }
    };



    /**
     * Small strains in the body's frame: condensed once, after which its
     * interior is not needed and is left where it is until somebody looks.
     */
    class LinearBody : public Body
    {
    public:
      LinearBody(const BodyParameters &parameters, const Side side)
        : Body(parameters, side, true)
      {}

      // R = K v, of which the condensed part is S v_c: the interior is in
      // equilibrium, whatever v_c.
      Residual
      residual(const ControlNet &contact_force) const override
      {
        const Eigen::VectorXd v_c = values(v);
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

      bool
      has_current_lever_arms() const override
      {
        return false;
      }

      std::vector<Eigen::Matrix3d>
      vertex_stress(const Eigen::VectorXd &state) const override
      {
        return own_bulk->vertex_stress(state, &NeoHookean::linear_stress);
      }

    protected:
      void
      move(const Eigen::VectorXd &dv, const Residual &) override
      {
        for (unsigned int k = 0; k < n_unknowns(); ++k)
          v[unknown_dofs[k]] += dv[k];
      }

      // v_i = -K_ii^-1 K_ic v_c
      Eigen::VectorXd
      full_displacement(const Eigen::VectorXd &state) const override
      {
        return Body::full_displacement(
          n_unknowns() > 0 ? own_bulk->correction(values(state), {}) : state);
      }

      // The resultants of the supports are m . K v; condensing the row m K
      // gives them per unit of v_c.
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
        beside_unknowns = false;
        for (unsigned int i = 0; i < unknown_numbers.size(); ++i)
          beside_unknowns =
            beside_unknowns ||
            (unknown_numbers[i] < 0 &&
             !body_mesh.is_fixed(body_mesh.control_point_node(i / 3), i % 3));
        return true;
      }

      Eigen::Matrix<double, 6, 1>
      reaction_about_origin(const Residual &) const override
      {
        return reaction_operator * values(v);
      }

      bool
      surface_is_condensed() const override
      {
        return beside_unknowns;
      }

    private:
      Eigen::VectorXd
      values(const Eigen::VectorXd &state) const
      {
        Eigen::VectorXd result(n_unknowns());
        for (unsigned int k = 0; k < n_unknowns(); ++k)
          result[k] = state[unknown_dofs[k]];
        return result;
      }

      /** Some of the contact surface's control points are no unknowns. */
      bool beside_unknowns = false;
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
        : Body(parameters, side, true)
      {}

      // r~_c = R_c + f - K_ci K_ii^-1 R_i
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
        r.tail(contact_force.size()) +=
          Eigen::Map<const Eigen::VectorXd>(contact_force.data(),
                                            contact_force.size());
        static_cast<Bulk::Residual &>(result) = own_bulk->condense(r);
        return result;
      }

      bool
      refactor() override
      {
        return linearise(v);
      }

      bool
      has_current_lever_arms() const override
      {
        return true;
      }

      std::vector<Eigen::Matrix3d>
      vertex_stress(const Eigen::VectorXd &state) const override
      {
        return own_bulk->vertex_stress(state, &NeoHookean::cauchy_stress);
      }

    protected:
      // dv_i = -K_ii^-1 (R_i + K_ic dv_c)
      void
      move(const Eigen::VectorXd &dv, const Residual &residual) override
      {
        v += own_bulk->correction(dv, residual);
      }

      // The trial state may be anything; the accepted one is near.
      Eigen::VectorXd
      linearisation_point() const override
      {
        return accepted.value;
      }

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
    switch (parameters.material)
      {
        case Material::linear:
          return std::make_unique<LinearBody>(parameters, side);
        case Material::neo_hookean:
          return std::make_unique<NeoHookeanBody>(parameters, side);
        case Material::rigid:
          break;
      }
    return std::make_unique<RigidBody>(parameters, side);
  }
} // namespace Debond
