#include <debond/bulk/body.h>
#include <debond/support/input_error.h>

#include <deal.II/base/exceptions.h>

#include <Eigen/Geometry>

namespace Debond
{
  Body::Body(const BodyParameters &parameters,
             const Side            side,
             const bool            has_bulk)
    : body_mesh(parameters, side)
    , own_bulk(has_bulk ? make_bulk(body_mesh) : nullptr)
    , v(Eigen::VectorXd::Zero(3 * body_mesh.n_nodes()))
    , accepted(v)
    , unknown_numbers(3 * body_mesh.surface().n_control_points(), -1)
    , is_contact(body_mesh.surface().n_control_points(), false)
  {}



  void
  Body::set_contact_control_points(const std::vector<bool> &contact)
  {
    const bool linearised_at_rest =
      linearised_at.size() > 0 && linearised_at.isZero(0.);
    if (!own_bulk || (contact == is_contact && linearised_at_rest &&
                      v.isZero(0.) && accepted.value.isZero(0.)))
      return;
    complete_surface(); // what was interior may become an unknown
    number_unknowns(contact);
    // The reference is always there to fall back on, for a Neo-Hookean body
    // this matrix being an operator and not the solution.
    if (!linearise(linearisation_point()) &&
        !linearise(Eigen::VectorXd::Zero(v.size())))
      throw EntryError(
        std::string(body_mesh.side() == Side::bone ? "Bone" : "Implant") +
          " / Cells",
        "the stiffness of this body is not positive definite: its cells are "
        "too thin, or its Poisson ratio is too close to 0.5");
  }



  void
  Body::number_unknowns(const std::vector<bool> &contact)
  {
    is_contact   = contact;
    unknown_dofs = own_bulk->set_contact(contact);
    unknown_numbers.assign(unknown_numbers.size(), -1);
    const unsigned int first = 3 * body_mesh.n_vertices();
    for (unsigned int k = 0; k < unknown_dofs.size(); ++k)
      if (unknown_dofs[k] >= first)
        unknown_numbers[unknown_dofs[k] - first] = k;
  }



  bool
  Body::linearise(const Eigen::VectorXd &state)
  {
    if (!own_bulk->linearise(state))
      return false;
    linearised_at = state;
    return true;
  }



  void
  Body::restore(const std::vector<bool> &contact, const Eigen::VectorXd &state)
  {
    v = accepted.value;
    if (!own_bulk || (contact == is_contact && state == linearised_at))
      return;
    number_unknowns(contact);
    AssertThrow(linearise(state),
                dealii::ExcMessage(
                  "The stiffness of a body is not positive definite."));
  }



  Eigen::Map<const ControlNet>
  Body::contact_displacement() const
  {
    return Eigen::Map<const ControlNet>(&v[3 * body_mesh.n_vertices()],
                                        3,
                                        is_contact.size());
  }



  void
  Body::commit(const double time, const bool surface_is_seen)
  {
    if (surface_is_condensed() && surface_is_seen)
      v = full_displacement(v);
    surface_is_stale = surface_is_condensed() && !surface_is_seen;
    accepted.commit(v, time);
  }



  void
  Body::complete_surface()
  {
    for (Eigen::VectorXd *state : {&v, &accepted.value, &accepted.before})
      *state = full_displacement(*state);
    surface_is_stale = false;
  }



  Eigen::VectorXd
  Body::full_displacement(const Eigen::VectorXd &state) const
  {
    Eigen::VectorXd full = state;
    body_mesh.distribute(full);
    return full;
  }



  Eigen::Matrix<double, 6, 1>
  Body::support_reaction(const Eigen::Vector3d &centre,
                         const Residual        &residual) const
  {
    Eigen::Matrix<double, 6, 1> reaction = reaction_about_origin(residual);
    reaction.tail<3>() -= centre.cross(reaction.head<3>().eval());
    return reaction;
  }



  Eigen::MatrixXd
  Body::support_modes(const Eigen::VectorXd &state) const
  {
    Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(state.size(), 6);
    for (unsigned int node = 0; node < body_mesh.n_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        if (body_mesh.is_fixed(node, c))
          {
            const Eigen::Vector3d x =
              body_mesh.reference_position(node) + state.segment<3>(3 * node);
            // component c of e_k and of e_k x x, the latter (x x e_c)_k
            modes(3 * node + c, c) = 1.;
            modes.row(3 * node + c).tail<3>() =
              x.cross(Eigen::Vector3d::Unit(c)).transpose();
          }
    return modes;
  }
} // namespace Debond
