#include <debond/bulk/body.h>
#include <debond/bulk/bulk_solvers.h>
#include <debond/support/input_error.h>
#include <debond/support/ranks.h>

#include <deal.II/base/exceptions.h>

#include <Eigen/Geometry>

#include <utility>

// A body as the coupled system sees it: a contact face and its resistance. The
// rigid one is all here; what a linear and a Neo-Hookean one do differently
// stands in body_kinds.cc.
//
// Displacements v [mm] are those in the body's own frame, x = Q (X + v) + c.
// The frame of the implant turns with its chuck, so that v stays of the size of
// the elastic deformation, and a stiffness formed at rest stays good in a turn
// of 360 degrees.
namespace Debond
{
  // Without a bulk the body is rigid: its control points are where the mesh has
  // them, and no unknowns of the coupled system are its own.
  Body::Body(const BodyParameters &parameters, const Side side)
    : body_mesh(parameters, side)
    , own_bulk(parameters.is_rigid() ? nullptr : make_bulk(body_mesh))
    , condensing_bulk(dynamic_cast<const CondensingBulk *>(own_bulk.get()))
    , whole_bulk(dynamic_cast<const WholeBulk *>(own_bulk.get()))
    , v(Eigen::VectorXd::Zero(3 * body_mesh.n_nodes()))
    , accepted(v)
    , unknown_numbers(3 * body_mesh.surface().n_control_points(), -1)
    , is_contact(body_mesh.surface().n_control_points(), false)
  {
    body_mesh.release_triangulation();
  }



  // Choosing the unknowns is what makes a body ready: K is formed, factorised
  // and condensed. It is done at the start, and again when contact spreads.
  // Bodies that several variants of a study share come here again with the same
  // unknowns, at rest, and need nothing.
  void
  Body::set_contact_control_points(const std::vector<bool> &contact)
  {
    const bool linearised_at_rest =
      linearised_at->size() > 0 && linearised_at->isZero(0.);
    if (!own_bulk || (contact == is_contact && linearised_at_rest &&
                      v.isZero(0.) && accepted.value.isZero(0.)))
      return;
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(v.size());
    complete_surface(); // what was interior may become an unknown
    number_unknowns(contact);
    // A linear body has one K. A Neo-Hookean one is linearised at the accepted
    // state: it is near, and the trial state may be anything. The reference is
    // always there to fall back on: the matrix only leads to the solution and
    // does not define it. At rest K is that of linear elasticity, and not
    // positive definite only if the mesh or the material is wrong: that is the
    // fault of an entry of the scene.
    if (!linearise(has_small_strains() ? at_rest : accepted.value) &&
        !linearise(at_rest))
      throw EntryError(
        std::string(body_mesh.side() == Side::bone ? "Bone" : "Implant") +
          (body_mesh.parameters().shape == BodyShape::file ? " / Mesh file" :
                                                             " / Cells"),
        "the stiffness of this body is not positive definite: its cells are "
        "too thin, or its Poisson ratio is too close to 0.5");
  }



  // What was condensed stays, where it is that of a body at rest.
  void
  Body::return_to_rest()
  {
    v.setZero();
    accepted         = AcceptedState<Eigen::VectorXd>(v);
    surface_is_stale = false;
  }



  // The bulk says which degrees of freedom it leaves to the coupled system; the
  // interface needs those of the control points by their place. Control points
  // come after all vertices, so that 3 (control point) + component is the
  // number of a degree of freedom less that of the first one.
  void
  Body::number_unknowns(const std::vector<bool> &contact)
  {
    is_contact   = contact;
    unknown_dofs = own_bulk->set_contact(contact);
    unknown_numbers.assign(unknown_numbers.size(), -1);
    const unsigned int first = 3 * body_mesh.n_inner_nodes();
    for (unsigned int k = 0; k < unknown_dofs.size(); ++k)
      if (unknown_dofs[k] >= first)
        unknown_numbers[unknown_dofs[k] - first] = k;
    // Whether there are free control points that are none: the rest of the
    // bone's face, beyond the reach of contact.
    beside_unknowns = false;
    for (unsigned int i = 0; i < unknown_numbers.size(); ++i)
      if (condensing_bulk && unknown_numbers[i] < 0 &&
          !body_mesh.is_fixed(body_mesh.control_point_node(i / 3), i % 3))
        beside_unknowns = true;
  }



  // K and S at a state, which is remembered: a resumed run has to go on with
  // the same matrix, down to the last digit. A checkpoint holds this state and
  // not the factor, which is far larger and can be made again from it.
  bool
  Body::linearise(const Eigen::VectorXd &state)
  {
    auto next = std::make_shared<const Eigen::VectorXd>(state);
    auto old =
      std::exchange(linearised_at, std::make_shared<const Eigen::VectorXd>());
    // what throws here leaves a K that belongs to no state
    const bool is_done = own_bulk->linearise(state);
    linearised_at      = is_done ? next : old;
    return is_done;
  }



  void
  Body::refuse_archive(const int solver) const
  {
    const std::string names[]{"auto", "direct", "lattice", "multigrid"};
    throw ForeignCheckpoint(
      "Expert / Bone / Solver: the run was begun with " + names[solver & 3] +
      ", and cannot go on with " + names[solver_in_archive()] +
      (solver == static_cast<int>(BulkSolver::multigrid) ?
         ": --set \"Expert/Bone/Solver=multigrid\" does" :
       Ranks::number() > 1 ? ": it takes one process" :
                             ": leave this entry as it was"));
  }



  // Going on from a checkpoint: the same unknowns, the same K as in the run
  // that wrote it. Another K would lead to the same states up to the tolerance,
  // but in other iterations and with other last digits.
  void
  Body::restore(const std::vector<bool> &contact, const Eigen::VectorXd &state)
  {
    v = accepted.value;
    if (!own_bulk || (contact == is_contact && state == *linearised_at))
      return;
    number_unknowns(contact);
    AssertThrow(linearise(state),
                dealii::ExcMessage(
                  "The stiffness of a body is not positive definite."));
  }



  // v at the control points, one in each column: a view on the end of the
  // vector, no copy. From these the coupled system has the positions of the
  // face.
  Eigen::Map<const ControlNet>
  Body::contact_displacement() const
  {
    return Eigen::Map<const ControlNet>(&v[3 * body_mesh.n_inner_nodes()],
                                        3,
                                        is_contact.size());
  }



  // A linear body carries its contact unknowns only from iteration to
  // iteration. The rest of its surface is in equilibrium with them, and costs a
  // solve with K_ii to know: that is done if an open point may face it. Else it
  // is left behind, which is noted, so that it can be made up for when a point
  // opens.
  void
  Body::commit(const double time, const bool surface_is_seen)
  {
    const bool is_behind = has_small_strains() && beside_unknowns;
    if (is_behind && surface_is_seen)
      v = full_displacement(v);
    surface_is_stale = is_behind && !surface_is_seen;
    accepted.commit(v, time);
  }



  // The same later, when a point that has opened looks at the surface beside
  // the contact unknowns. States before it get their shape as well: the line
  // through them is the next prediction. No history changes by that: the
  // contact unknowns, of which the shape is a linear function, stay as they
  // are.
  void
  Body::complete_surface()
  {
    for (Eigen::VectorXd *state : {&v, &accepted.value, &accepted.before})
      *state = full_displacement(*state);
    surface_is_stale = false;
  }



  // Vertices of the contact face follow the control points, v_vertex = sum_A
  // N_A(vertex) v_A, Eq. (33). A rigid and a Neo-Hookean body have all the rest
  // already.
  Eigen::VectorXd
  Body::full_displacement(const Eigen::VectorXd &state) const
  {
    Eigen::VectorXd full = state;
    body_mesh.distribute(full);
    return full;
  }



  // Cauchy stress [MPa] by the law of the body's kind, for pictures. A rigid
  // body has forces and no stress: zero stands for that.
  std::vector<Eigen::Matrix3d>
  Body::vertex_stress(const Eigen::VectorXd &state) const
  {
    if (own_bulk)
      return own_bulk->vertex_stress(state, has_small_strains());
    return std::vector<Eigen::Matrix3d>(body_mesh.n_vertices(),
                                        Eigen::Matrix3d::Zero());
  }



  void
  Body::for_each_stress(const Bulk::StressVisitor &visit) const
  {
    if (own_bulk)
      own_bulk->for_each_stress(full_displacement(),
                                has_small_strains(),
                                visit);
  }



  // Force [N] and moment [N mm] of the supports, in the body's frame: what a
  // test bench measures at the top of the implant. Known about the origin, it
  // is moved to the centre: M_C = M_O - C x F.
  Eigen::Matrix<double, 6, 1>
  Body::support_reaction(const Eigen::Vector3d &centre,
                         const Residual        &residual) const
  {
    Eigen::Matrix<double, 6, 1> reaction = reaction_about_origin(residual);
    reaction.tail<3>() -= centre.cross(reaction.head<3>().eval());
    return reaction;
  }



  // Rigid motions m of the supported degrees of freedom, by which their forces
  // R are summed up: m_k . R is the force in direction k, or the moment about
  // axis k through the origin. Six columns over all nodes, zero but at the
  // supports. A roller, as at the sides of the bone, has an entry for the
  // component that it holds only.
  Eigen::MatrixXd
  Body::support_modes(const Eigen::VectorXd &state) const
  {
    Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(state.size(), 6);
    for (unsigned int node = 0; node < body_mesh.n_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        if (body_mesh.is_fixed(node, c))
          {
            // Lever arms X + v; a linear body asks for those at rest.
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
