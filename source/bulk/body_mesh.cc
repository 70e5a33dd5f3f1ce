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
        NurbsSurface::rectangle(parameters.size[0],
                                parameters.size[1],
                                parameters.cells[0],
                                parameters.cells[1],
                                2,
                                parameters.lateral_grading);
    return parameters.contact_surface == SurfaceKind::nurbs ?
             exact :
             exact.bilinear_interpolant();
  }



  BodyMesh::BodyMesh(const BodyParameters &parameters, const Side side)
    : body_parameters(parameters)
    , body_side(side)
    , contact_surface(make_contact_surface(parameters))
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



  // Layer k of n ends at z_0 + (-+ H - z_0) (k/n)^g, z_0 = 0 on a flat face.
  void
  BodyMesh::number_nodes()
  {
    const auto  &breaks_1 = contact_surface.knots(0).breakpoints();
    const auto  &breaks_2 = contact_surface.knots(1).breakpoints();
    const double end      = -outward_sign() * body_parameters.thickness();
    for (const auto &index : lattice)
      {
        const double fraction =
          std::pow(double(index[2]) / body_parameters.cells[2],
                   body_parameters.layer_grading);
        Eigen::Vector3d X =
          contact_surface.point({breaks_1[index[0]], breaks_2[index[1]]});
        X[2] += (end - X[2]) * fraction;
        reference_positions.push_back(X);
      }
    for (unsigned int A = 0; A < contact_surface.n_control_points(); ++A)
      reference_positions.push_back(contact_surface.control_points().col(A));
  }



  // The first vertex of a cell is the one with the least coordinates.
  void
  BodyMesh::complete_cells()
  {
    const unsigned int n_functions =
      (contact_surface.degree() + 1) * (contact_surface.degree() + 1);
    for (Cell &info : bulk_cells)
      {
        const auto &corner = lattice[info.vertices.front()];
        info.enriched =
          is_tied(info.vertices.front()) || is_tied(info.vertices.back());
        if (info.enriched)
          {
            info.surface_element =
              corner[0] + body_parameters.cells[0] * corner[1];
            const auto control_points =
              contact_surface.element_control_points(info.surface_element);
            for (unsigned int a = 0; a < n_functions; ++a)
              info.nodes.push_back(control_point_node(control_points[a]));
          }
        for (const unsigned int vertex : info.vertices)
          if (!is_tied(vertex))
            info.nodes.push_back(vertex);
      }
  }



  // What does not move at all is held at the far face and, of the bone, normal
  // to its sides. Vertices of the contact face follow the control points.
  void
  BodyMesh::make_constraints()
  {
    const auto        &n = body_parameters.cells;
    const unsigned int n_cp[]{contact_surface.knots(0).n_basis_functions(),
                              contact_surface.knots(1).n_basis_functions()};
    fixed.assign(3 * n_nodes(), false);
    for (unsigned int node = 0; node < n_nodes(); ++node)
      {
        const bool                  is_vertex = node < n_vertices();
        const unsigned int          A         = node - n_vertices();
        std::array<unsigned int, 3> index{{A % n_cp[0], A / n_cp[0], 0}};
        if (is_vertex)
          index = lattice[node];
        if (is_tied(node))
          {
            const Eigen::Vector2d xi(
              contact_surface.knots(0).breakpoints()[index[0]],
              contact_surface.knots(1).breakpoints()[index[1]]);
            contact_surface.evaluate(xi, tied[node], false);
            continue;
          }
        for (unsigned int c = 0; c < 3; ++c)
          {
            const unsigned int last = is_vertex ? n[c] : n_cp[c % 2] - 1;
            fixed[3 * node + c]     = (is_vertex && index[2] == n[2]) ||
                                  (body_side == Side::bone && c < 2 &&
                                   (index[c] == 0 || index[c] == last));
          }
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
