#include <debond/bulk/body.h>
#include <debond/support/input_error.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace Debond
{
  namespace
  {
    // Rigid body mode k (three translations, three rotations about the origin)
    // at X.
    Eigen::Vector3d
    rigid_mode(const unsigned int k, const Eigen::Vector3d &X)
    {
      return k < 3 ? Eigen::Vector3d::Unit(k) :
                     Eigen::Vector3d::Unit(k - 3).cross(X);
    }



    std::vector<dealii::types::global_dof_index>
    cell_dofs(const EnrichedCells &cells, const unsigned int cell)
    {
      std::vector<dealii::types::global_dof_index> dofs;
      for (unsigned int a = 0; a < cells.n_nodes(cell); ++a)
        for (unsigned int c = 0; c < 3; ++c)
          dofs.push_back(3 * cells.nodes(cell)[a] + c);
      return dofs;
    }
  } // namespace



  Body::Body(const BodyParameters &parameters, const Side side)
    : body_mesh(parameters, side)
    , is_contact(body_mesh.surface().n_control_points(), false)
    , unknown_numbers(3 * body_mesh.surface().n_control_points(), -1)
    , v(Eigen::VectorXd::Zero(3 * body_mesh.n_nodes()))
    , accepted(v)
  {
    if (!deformable())
      return;
    bulk = std::make_unique<EnrichedCells>(
      body_mesh,
      NeoHookean::from_young(parameters.young_modulus,
                             parameters.poisson_ratio));

    free_number.assign(3 * body_mesh.n_nodes(), -1);
    for (unsigned int dof = 0; dof < 3 * body_mesh.n_nodes(); ++dof)
      if (!body_mesh.is_tied(dof / 3) && !body_mesh.is_fixed(dof / 3, dof % 3))
        {
          free_number[dof] = free_dofs.size();
          free_dofs.push_back(dof);
        }

    dealii::DynamicSparsityPattern pattern(3 * body_mesh.n_nodes());
    for (unsigned int cell = 0; cell < bulk->n_cells(); ++cell)
      body_mesh.get_constraints().add_entries_local_to_global(
        cell_dofs(*bulk, cell), pattern, false);
    sparsity.copy_from(pattern);
    tangent.reinit(sparsity);
  }



  SymmetricSparseMatrix
  Body::assemble_free_tangent()
  {
    tangent = 0.;
    Eigen::MatrixXd            K;
    dealii::FullMatrix<double> local;
    for (unsigned int cell = 0; cell < bulk->n_cells(); ++cell)
      {
        const auto dofs = cell_dofs(*bulk, cell);
        bulk->tangent(cell, v, K);
        local.reinit(dofs.size(), dofs.size());
        for (unsigned int i = 0; i < dofs.size(); ++i)
          for (unsigned int j = 0; j < dofs.size(); ++j)
            local(i, j) = K(i, j);
        body_mesh.get_constraints().distribute_local_to_global(local,
                                                               dofs,
                                                               tangent);
      }

    SymmetricSparseMatrix free;
    free.n = free_dofs.size();
    free.column_start.push_back(0);
    for (const unsigned int dof : free_dofs)
      {
        // deal.II stores a row's diagonal entry first, then by column
        for (auto entry = tangent.begin(dof); entry != tangent.end(dof);
             ++entry)
          if (free_number[entry->column()] >= free_number[dof])
            {
              free.row.push_back(free_number[entry->column()]);
              free.value.push_back(entry->value());
            }
        free.column_start.push_back(free.row.size());
      }
    return free;
  }



  bool
  Body::condense()
  {
    Condensation attempt;
    if (!attempt.factorise(assemble_free_tangent(), contact_unknowns))
      return false;
    condensation          = std::move(attempt);
    state_of_condensation = v;
    return true;
  }



  // Leaves the trial state as it is.
  bool
  Body::condense_at(const Eigen::VectorXd &state)
  {
    const Eigen::VectorXd trial = std::exchange(v, state);
    const bool            done  = condense();
    v                           = trial;
    return done;
  }



  void
  Body::set_contact_control_points(const std::vector<bool> &contact)
  {
    if (!deformable())
      return;
    const bool condensed_at_rest =
      state_of_condensation.size() > 0 && state_of_condensation.isZero(0.);
    if (condensed_at_rest && contact == is_contact && v.isZero(0.) &&
        accepted.value.isZero(0.))
      return;
    complete_surface(); // what was interior may become a contact unknown
    number_contact_unknowns(contact);
    // The stiffness of the undeformed body, or of the accepted state: the trial
    // state may be anything. The reference is always there to fall back on, for
    // a Neo-Hookean body this matrix being an operator and not the solution.
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(v.size());
    const bool            positive_definite =
      condense_at(material() == Material::linear ? at_rest : accepted.value) ||
      condense_at(at_rest);
    if (!positive_definite)
      throw EntryError(
        std::string(body_mesh.side() == Side::bone ? "Bone" : "Implant") +
          " / Cells",
        "the stiffness of this body is not positive definite: its cells are "
        "too thin, or its Poisson ratio is too close to 0.5");
    if (material() == Material::linear)
      compute_reaction_operator();
  }



  void
  Body::number_contact_unknowns(const std::vector<bool> &contact)
  {
    is_contact           = contact;
    surface_is_condensed = false;
    contact_unknowns.clear();
    for (unsigned int A = 0; A < is_contact.size(); ++A)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const int number =
            free_number[3 * body_mesh.control_point_node(A) + c];
          const bool unknown = is_contact[A] && number >= 0;
          unknown_numbers[3 * A + c] =
            unknown ? int(contact_unknowns.size()) : -1;
          if (unknown)
            contact_unknowns.push_back(number);
          else if (number >= 0 && material() == Material::linear)
            surface_is_condensed = true;
        }
  }



  void
  Body::restore(const std::vector<bool> &contact,
                const Eigen::VectorXd   &condensed_at)
  {
    v = accepted.value;
    if (!deformable() ||
        (contact == is_contact && condensed_at == state_of_condensation))
      return;
    number_contact_unknowns(contact);
    AssertThrow(condense_at(condensed_at),
                dealii::ExcMessage(
                  "The stiffness of a body is not positive definite."));
    if (material() == Material::linear)
      compute_reaction_operator();
  }



  void
  Body::complete_surface()
  {
    for (Eigen::VectorXd *state : {&v, &accepted.value, &accepted.before})
      *state = full_displacement(*state);
    surface_is_stale = false;
  }



  bool
  Body::refactor()
  {
    return material() != Material::neo_hookean || condense();
  }



  // Resultants of the supports are sums of m . (K v) over fixed nodes, m a
  // rigid mode; condensing the row K m gives them per unit of v_c.
  void
  Body::compute_reaction_operator()
  {
    Eigen::MatrixXd       K;
    Eigen::MatrixXd       rows = Eigen::MatrixXd::Zero(free_dofs.size(), 6);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(v.size());
    for (unsigned int cell = 0; cell < bulk->n_cells(); ++cell)
      {
        const unsigned int n     = bulk->n_nodes(cell);
        Eigen::MatrixXd    modes = Eigen::MatrixXd::Zero(3 * n, 6);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int c = 0; c < 3; ++c)
            {
              const unsigned int node = bulk->nodes(cell)[a];
              if (body_mesh.is_fixed(node, c))
                for (unsigned int k = 0; k < 6; ++k)
                  modes(3 * a + c, k) =
                    rigid_mode(k, body_mesh.reference_position(node))[c];
            }
        if (modes.isZero(0.))
          continue;
        bulk->tangent(cell, zero, K);
        const Eigen::MatrixXd product = K * modes;
        const auto            dofs    = cell_dofs(*bulk, cell);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (free_number[dofs[i]] >= 0)
            rows.row(free_number[dofs[i]]) += product.row(i);
      }
    reaction_operator.resize(6, n_unknowns());
    for (unsigned int k = 0; k < 6; ++k)
      reaction_operator.row(k) = condensation.forward(rows.col(k)).transpose();
  }



  Eigen::Map<const ControlNet>
  Body::contact_displacement() const
  {
    return Eigen::Map<const ControlNet>(&v[3 * body_mesh.n_vertices()],
                                        3,
                                        body_mesh.surface().n_control_points());
  }



  Body::Residual
  Body::residual(const ControlNet &contact_force, Eigen::VectorXd &condensed)
  {
    Residual                                result;
    const unsigned int                      first = 3 * body_mesh.n_vertices();
    const Eigen::Map<const Eigen::VectorXd> force(contact_force.data(),
                                                  contact_force.size());
    if (material() == Material::linear)
      {
        const Eigen::VectorXd v_c = contact_values(v);
        condensed                 = condensed_product(v_c);
        strain_energy             = 0.5 * v_c.dot(condensed);
        for (unsigned int k = 0; k < n_unknowns(); ++k)
          condensed[k] += force[free_dofs[contact_unknowns[k]] - first];
        result.norm_squared = condensed.squaredNorm();
      }
    else if (material() == Material::neo_hookean)
      {
        internal_force.setZero(v.size());
        result.valid = bulk->internal_forces(v, internal_force, strain_energy);
        if (!result.valid)
          return result;
        Eigen::VectorXd r(free_dofs.size());
        for (unsigned int i = 0; i < free_dofs.size(); ++i)
          {
            const unsigned int dof = free_dofs[i];
            r[i] =
              internal_force[dof] + (dof >= first ? force[dof - first] : 0.);
          }
        result.norm_squared     = r.squaredNorm();
        result.interior_squared = result.norm_squared;
        for (const int k : contact_unknowns)
          result.interior_squared -= r[k] * r[k];
        condensed = condensation.forward(r);
      }
    else
      condensed.resize(0);
    return result;
  }



  void
  Body::correct(const Eigen::VectorXd &dv)
  {
    uncorrected = v;
    if (material() == Material::linear)
      for (unsigned int k = 0; k < n_unknowns(); ++k)
        v[free_dofs[contact_unknowns[k]]] += dv[k];
    else if (material() == Material::neo_hookean)
      {
        // x = K^-1 (r - ...) with x_c = -dv, hence the signs
        const Eigen::VectorXd x = condensation.backward(-dv);
        for (unsigned int i = 0; i < free_dofs.size(); ++i)
          v[free_dofs[i]] -= x[i];
      }
  }



  void
  Body::shorten_correction(const double fraction)
  {
    v = uncorrected + fraction * (v - uncorrected);
  }



  void
  Body::commit(const double time, const bool surface_is_seen)
  {
    if (surface_is_condensed && surface_is_seen)
      v = full_displacement(v);
    surface_is_stale = surface_is_condensed && !surface_is_seen;
    accepted.commit(v, time);
  }



  void
  Body::rollback()
  {
    v = accepted.value;
  }



  void
  Body::predict(const double time, const bool extrapolate)
  {
    v = extrapolate ? accepted.extrapolated(time) : accepted.value;
  }



  double
  Body::energy() const
  {
    return strain_energy;
  }



  Eigen::Matrix<double, 6, 1>
  Body::support_reaction(const Eigen::Vector3d &centre)
  {
    Eigen::Matrix<double, 6, 1> about_origin =
      Eigen::Matrix<double, 6, 1>::Zero();
    if (material() == Material::linear)
      about_origin = reaction_operator * contact_values(v);
    else if (material() == Material::neo_hookean)
      for (unsigned int node = 0; node < body_mesh.n_nodes(); ++node)
        for (unsigned int c = 0; c < 3; ++c)
          if (body_mesh.is_fixed(node, c))
            {
              const Eigen::Vector3d x =
                body_mesh.reference_position(node) + v.segment<3>(3 * node);
              for (unsigned int k = 0; k < 6; ++k)
                about_origin[k] +=
                  internal_force[3 * node + c] * rigid_mode(k, x)[c];
            }
    about_origin.tail<3>() -= centre.cross(about_origin.head<3>().eval());
    return about_origin;
  }



  Eigen::VectorXd
  Body::contact_values(const Eigen::VectorXd &state) const
  {
    Eigen::VectorXd values(n_unknowns());
    for (unsigned int k = 0; k < n_unknowns(); ++k)
      values[k] = state[free_dofs[contact_unknowns[k]]];
    return values;
  }



  Eigen::VectorXd
  Body::full_displacement(const Eigen::VectorXd &state)
  {
    Eigen::VectorXd full = state;
    if (material() == Material::linear && n_unknowns() > 0)
      {
        const Eigen::VectorXd x = condensation.extend(contact_values(state));
        for (unsigned int i = 0; i < free_dofs.size(); ++i)
          full[free_dofs[i]] = x[i];
        // these are known without the rounding of the solve
        for (const int k : contact_unknowns)
          full[free_dofs[k]] = state[free_dofs[k]];
      }
    body_mesh.distribute(full);
    return full;
  }
} // namespace Debond
