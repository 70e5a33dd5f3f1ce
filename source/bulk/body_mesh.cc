#include <debond/bulk/body_mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <cmath>

namespace Debond
{
  NurbsSurface
  make_contact_surface(const BodyParameters &parameters)
  {
    const NurbsSurface exact =
      parameters.shape == BodyShape::coin ?
        NurbsSurface::disk(parameters.radius, parameters.cells[0]) :
      parameters.shape == BodyShape::cap ?
        NurbsSurface::cap(parameters.radius,
                          parameters.cap_radius,
                          parameters.cells[0]) :
        NurbsSurface::rectangle(
          parameters.size[0],
          parameters.size[1],
          KnotVector::from_breakpoints(2, parameters.lateral_fractions(0)),
          KnotVector::from_breakpoints(2, parameters.lateral_fractions(1)));
    return parameters.contact_surface == SurfaceKind::nurbs ?
             exact :
             exact.bilinear_interpolant();
  }



  namespace
  {
    /** Layer k of n ends at the fraction (k/n)^g of the depth. */
    KnotVector
    make_layers(const BodyParameters &parameters)
    {
      const unsigned int  n = parameters.cells[2];
      std::vector<double> fractions;
      for (unsigned int k = 0; k <= n; ++k)
        fractions.push_back(
          std::pow(static_cast<double>(k) / n, parameters.layer_grading));
      return KnotVector::from_breakpoints(
        parameters.element == ElementKind::spline ? 2 : 1, fractions);
    }
  } // namespace



  BodyMesh::BodyMesh(const BodyParameters &parameters, const Side side)
    : body_parameters(parameters)
    , body_side(side)
    , contact_surface(make_contact_surface(parameters))
    , layer_knots(make_layers(parameters))
  {
    make_grid();
    number_nodes();
    complete_cells();
    make_constraints();
  }



  // The cells form a lattice. The triangulation is first made with lattice
  // indices as coordinates; then each vertex moves to its place: in the plane
  // where the knots of the contact surface are, along z by layers.
  void
  BodyMesh::make_grid()
  {
    const auto              &n = body_parameters.cells;
    dealii::Triangulation<3> triangulation;
    dealii::GridGenerator::subdivided_hyper_rectangle(triangulation,
                                                      {n[0], n[1], n[2]},
                                                      dealii::Point<3>(),
                                                      dealii::Point<3>(n[0],
                                                                       n[1],
                                                                       n[2]));
    const dealii::FESystem<3> fe(dealii::FE_Q<3>(1), 3);
    dealii::DoFHandler<3>     dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);

    lattice.resize(dof_handler.n_dofs() / 3);
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        Cell info;
        for (const unsigned int v : cell->vertex_indices())
          {
            info.vertices[v] = cell->vertex_dof_index(v, 0) / 3;
            for (unsigned int c = 0; c < 3; ++c)
              AssertThrow(cell->vertex_dof_index(v, c) ==
                            3 * info.vertices[v] + c,
                          dealii::ExcInternalError());
            const dealii::Point<3> p     = cell->vertex(v);
            auto                  &index = lattice[info.vertices[v]];
            for (unsigned int d = 0; d < 3; ++d)
              index[d] = std::lround(p[d]);
            // count layers from the contact face, which is the bone's top
            if (body_side == Side::bone)
              index[2] = n[2] - index[2];
          }
        bulk_cells.push_back(info);
      }
  }



  // Below a point X_0 of the contact face a node is at the fraction f of its
  // layer or level at z_0 + (-+ H - z_0) f; z_0 = 0 on a flat face. For splines
  // f are Greville abscissae: the map is linear in the depth, and the sides of
  // a disk are those of a cylinder.
  void
  BodyMesh::number_nodes()
  {
    const std::vector<double> fractions = layer_knots.greville_abscissae();
    const double end  = -outward_sign() * body_parameters.thickness();
    const auto   push = [&](Eigen::Vector3d X, const unsigned int level) {
      X[2] += (end - X[2]) * fractions[level];
      reference_positions.push_back(X);
    };
    const ControlNet &control_points = contact_surface.control_points();
    if (has_splines())
      for (unsigned int level = 1; level < fractions.size(); ++level)
        for (unsigned int A = 0; A < control_points.cols(); ++A)
          push(control_points.col(A), level);
    else
      for (const auto &index : lattice)
        push(contact_surface.point(
               {contact_surface.knots(0).breakpoints()[index[0]],
                contact_surface.knots(1).breakpoints()[index[1]]}),
             index[2]);
    for (unsigned int A = 0; A < control_points.cols(); ++A)
      push(control_points.col(A), 0);
  }



  // The first vertex of a cell is the one with the least coordinates.
  void
  BodyMesh::complete_cells()
  {
    const unsigned int n_functions =
      (contact_surface.degree() + 1) * (contact_surface.degree() + 1);
    for (Cell &info : bulk_cells)
      {
        const auto &first    = lattice[info.vertices.front()],
                   &last     = lattice[info.vertices.back()];
        info.layer           = std::min(first[2], last[2]);
        info.enriched        = info.layer == 0;
        info.surface_element = first[0] + body_parameters.cells[0] * first[1];
        const auto control_points =
          contact_surface.element_control_points(info.surface_element);
        const auto add_level = [&](const unsigned int first_node) {
          for (unsigned int a = 0; a < n_functions; ++a)
            info.nodes.push_back(first_node + control_points[a]);
        };
        if (has_splines())
          {
            const unsigned int level =
              layer_knots.first_basis_function(info.layer);
            for (unsigned int k = level; k <= level + layer_knots.degree(); ++k)
              add_level(k == 0 ? control_point_node(0) :
                                 (k - 1) * contact_surface.n_control_points());
            continue;
          }
        if (info.enriched)
          add_level(control_point_node(0));
        for (const unsigned int vertex : info.vertices)
          if (!is_tied(vertex))
            info.nodes.push_back(vertex);
      }
  }



  BodyMesh::Place
  BodyMesh::place_of(const unsigned int node) const
  {
    const auto        &n   = body_parameters.cells;
    const unsigned int n_1 = contact_surface.knots(0).n_basis_functions(),
                       n_2 = contact_surface.knots(1).n_basis_functions();
    const bool is_inner    = node < n_inner_nodes();
    if (is_inner && !has_splines())
      return {lattice[node], n};
    const unsigned int in_level =
      is_inner ? node % (n_1 * n_2) : node - n_inner_nodes();
    return {
      {{in_level % n_1, in_level / n_1, is_inner ? 1 + node / (n_1 * n_2) : 0}},
      {{n_1 - 1, n_2 - 1, layer_knots.n_basis_functions() - 1}}};
  }



  // What does not move at all is held at the far face and, of the bone, normal
  // to its sides. Vertices of the contact face follow the control points.
  void
  BodyMesh::make_constraints()
  {
    fixed.assign(3 * n_nodes(), false);
    for (unsigned int node = 0; node < n_nodes(); ++node)
      {
        const auto [index, last] = place_of(node);
        if (is_tied(node))
          {
            const Eigen::Vector2d xi(
              contact_surface.knots(0).breakpoints()[index[0]],
              contact_surface.knots(1).breakpoints()[index[1]]);
            contact_surface.evaluate(xi, tied[node], false);
            continue;
          }
        for (unsigned int c = 0; c < 3; ++c)
          fixed[3 * node + c] =
            index[2] == last[2] || (body_side == Side::bone && c < 2 &&
                                    (index[c] == 0 || index[c] == last[c]));
      }
  }



  void
  BodyMesh::distribute(Eigen::VectorXd &v) const
  {
    const ControlNet moved = v.tail(3 * contact_surface.n_control_points())
                               .reshaped(3, Eigen::AutoSize);
    for (const auto &[vertex, basis] : tied)
      v.segment<3>(3 * vertex) = interpolate(basis, moved);
  }
} // namespace Debond
