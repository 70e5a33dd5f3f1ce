#include <debond/bulk/bulk_space.h>
#include <debond/geometry/quadratic_simplex.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>

// What of a body is held, and which nodes follow others.
namespace Debond
{
  namespace
  {
    const std::array<std::pair<dealii::types::boundary_id, unsigned int>, 5>
      supports{{{Boundary::held, 7}, // bit c: component c
                {Boundary::slides_x, 1},
                {Boundary::slides_y, 2},
                {Boundary::slides_z, 4},
                {Boundary::axial, 3}}};
  } // namespace



  // What does not move at all is held at the far face and, of the bone, normal
  // to its sides. Nodes of FE_Q on the contact face follow the control points;
  // deal.II's make_zero_boundary_constraints() knows nothing of these, so that
  // all functions that do not vanish on a held face are held here.
  void
  BulkSpace::make_constraints()
  {
    fixed.assign(3 * n_nodes(), false);
    tied.assign(n_nodes(), false);
    if (has_splines())
      hold_splines();
    else
      hold_and_tie_cells();
    tie_hanging_nodes();
    follow.close();
    hold_followed_nodes();
    for (const Cell &cell : bulk_cells)
      followers_in_cells =
        followers_in_cells ||
        std::any_of(cell.nodes.begin(),
                    cell.nodes.end(),
                    [&](const unsigned int node) { return tied[node]; });
    for (unsigned int dof = 0; dof < fixed.size(); ++dof)
      if (fixed[dof])
        all_constraints.add_line(dof);
    all_constraints.merge(follow);
    all_constraints.close();
  }



  void
  BulkSpace::hold_splines()
  {
    const bool is_bone = body_side == Side::bone;
    for (const Cell &cell : bulk_cells)
      {
        if (cell.layer == body_parameters.cells[2] - 1)
          hold(cell, is_bone ? 4 : 5, 7);
        for (unsigned int side = 0; side < 4; ++side)
          if (is_bone && contact_surface.is_border(cell.surface_element, side))
            hold(cell, side, 1U << direction_across(cell, side));
      }
  }



  // Of a side of a block: that along which it has the same place everywhere.
  unsigned int
  BulkSpace::direction_across(const Cell &cell, const unsigned int side) const
  {
    dealii::Point<3> first(0., 0., 0.), last(1., 1., 0.);
    first[side / 2] = last[side / 2] = side % 2;
    const CellFunctions   functions(*this, cell);
    const Eigen::Vector3d along =
      functions.position(last) - functions.position(first);
    return std::abs(along[0]) < std::abs(along[1]) ? 0 : 1;
  }



  void
  BulkSpace::hold_and_tie_cells()
  {
    for (const auto &cell : dofs.active_cell_iterators())
      {
        const Cell &info = bulk_cells[cell->active_cell_index()];
        if (has_tetrahedra())
          tie_middles(info);
        if (!cell->at_boundary())
          continue;
        for (const unsigned int f : cell->face_indices())
          for (const auto &[id, components] : supports)
            if (cell->at_boundary(f) && cell->face(f)->boundary_id() == id)
              hold(info, f, components);
        if (!info.enriched)
          continue;
        const auto nodes = nodes_of_fe(cell);
        tie(info.face, info.surface_element, nodes);
        const auto [first, end] =
          other_contact_faces.equal_range(cell->active_cell_index());
        for (auto other = first; other != end; ++other)
          tie(other->second.first, other->second.second, nodes);
      }
  }



  // The node moves as the others do, each by its weight.
  void
  BulkSpace::tie_node(const unsigned int                       node,
                      const unsigned int                      *others,
                      const Eigen::Ref<const Eigen::VectorXd> &weights)
  {
    tied[node] = true;
    for (unsigned int c = 0; c < 3; ++c)
      {
        follow.add_line(3 * node + c);
        for (unsigned int a = 0; a < weights.size(); ++a)
          if (weights[a] != 0.)
            follow.add_entry(3 * node + c, 3 * others[a] + c, weights[a]);
      }
  }



  // Corners of parts that are no nodes of the tetrahedron.
  void
  BulkSpace::tie_middles(const Cell &cell)
  {
    const auto L = barycentric_corners<3>(cell.first_corner);
    for (unsigned int v = 0; v < 8; ++v)
      if ((L.col(v).array() > 0.).count() > 2 && !tied[cell.vertices[v]])
        tie_node(cell.vertices[v],
                 cell.nodes.data(),
                 quadratic_functions(L.col(v).eval()).col(0));
  }



  // A node on the contact face that is held by a cell beside: what it follows
  // is. It has been found by its own cell, and functions are not negative.
  void
  BulkSpace::hold_followed_nodes()
  {
    for (const auto &line : follow.get_lines())
      if (fixed[line.index])
        {
          fixed[line.index] = false;
          for (const auto &[other, weight] : line.entries)
            fixed[other] = true;
        }
  }



  void
  BulkSpace::tie_hanging_nodes()
  {
    if (!body_parameters.coarser_below)
      return;
    dealii::AffineConstraints<double> hanging;
    dealii::DoFTools::make_hanging_node_constraints(dofs, hanging);
    hanging.close();
    for (const auto &line : hanging.get_lines())
      {
        // where it is, it follows them, too: cells fit together
        const unsigned int node = line.index / 3;
        if (!tied[node])
          {
            tied[node]                = true;
            reference_positions[node] = Eigen::Vector3d::Zero();
            for (const auto &[other, weight] : line.entries)
              reference_positions[node] +=
                weight * reference_positions[other / 3];
          }
        if (fixed[line.index])
          continue; // and so are those that it would follow
        follow.add_line(line.index);
        follow.add_entries(line.index, line.entries);
      }
  }



  // Functions that do not vanish on a face have no zero at a point of it that
  // is nothing special to them.
  void
  BulkSpace::hold(const Cell        &cell,
                  const unsigned int face,
                  const unsigned int components)
  {
    dealii::Point<3> point(0.3, 0.3, 0.3);
    point[face / 2]     = face % 2;
    const ShapeValues N = CellFunctions(*this, cell).at(point);
    for (unsigned int a = 0; a < N.rows(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        if (std::abs(N(a, 0)) > 1e-12 && (components >> c & 1) != 0)
          fixed[3 * cell.nodes[a] + c] = true;
  }



  // Nodes of FE_Q on a contact face follow the control points of its element.
  void
  BulkSpace::tie(const ContactFace               &face,
                 const unsigned int               element,
                 const std::vector<unsigned int> &nodes_of_fe)
  {
    const auto   bounds = contact_surface.element_bounds(element);
    SurfaceBasis basis;
    for (unsigned int a = 0; a < scalar_fe.n_dofs_per_cell(); ++a)
      if (const unsigned int node = nodes_of_fe[a];
          scalar_fe.has_support_on_face(a, face.number) && !tied[node])
        {
          const dealii::Point<3> &at = scalar_fe.unit_support_point(a);
          contact_surface.evaluate_in_element(
            element,
            parameters_at(bounds, {at[face.axes[0]], at[face.axes[1]]}),
            basis);
          tie_node(node,
                   nodes_of_element(element).data(),
                   Eigen::Map<const Eigen::VectorXd>(basis.N.data(),
                                                     basis.size));
        }
  }



  void
  BulkSpace::distribute(Eigen::Ref<Eigen::VectorXd> v) const
  {
    for (const auto &line : follow.get_lines())
      {
        v[line.index] = 0.;
        for (const auto &[other, weight] : line.entries)
          v[line.index] += weight * v[other];
      }
  }



  void
  BulkSpace::condense(Eigen::Ref<Eigen::VectorXd> force) const
  {
    if (!cells_have_followers())
      return;
    for (const auto &line : follow.get_lines())
      {
        for (const auto &[other, weight] : line.entries)
          force[other] += weight * force[line.index];
        force[line.index] = 0.;
      }
  }
} // namespace Debond
