#include <debond/bulk/body_mesh.h>
#include <debond/support/ranks.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <cmath>
#include <limits>

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
    : BodyMesh(parameters, side, make_contact_surface(parameters))
  {}



  BodyMesh::BodyMesh(const BodyParameters &parameters,
                     const Side            side,
                     const NurbsSurface   &face)
    : body_parameters(parameters)
    , body_side(side)
    , columns(columns_of_rank(
        parameters.cells,
        parameters.bulk_solver == BulkSolver::multigrid ? Ranks::own() : 0,
        parameters.bulk_solver == BulkSolver::multigrid ? Ranks::number() : 1))
    , contact_surface(face)
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
    const auto &[begin, end] = columns;
    dealii::GridGenerator::subdivided_hyper_rectangle(
      triangulation,
      {end[0] - begin[0], end[1] - begin[1], n[2]},
      dealii::Point<3>(begin[0], begin[1], 0),
      dealii::Point<3>(end[0], end[1], n[2]));
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
      for (unsigned int node = 0; node < n_inner_nodes(); ++node)
        {
          const auto i = place_of(node).index;
          push(control_points.col(
                 i[0] + contact_surface.knots(0).n_basis_functions() * i[1]),
               i[2]);
        }
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
        const auto add_face = [&] {
          for (unsigned int a = 0; a < n_functions; ++a)
            info.nodes.push_back(control_point_node(control_points[a]));
        };
        // functions begin with the number of their first cell
        const auto add_level = [&](const unsigned int level) {
          const auto        &begin = columns.begin, &end = columns.end;
          const unsigned int n_1 = end[0] - begin[0] + 2;
          for (unsigned int a = 0; a < n_functions; ++a)
            info.nodes.push_back((level - 1) * n_in_level() + first[0] -
                                 begin[0] + a % 3 +
                                 n_1 * (first[1] - begin[1] + a / 3));
        };
        if (has_splines())
          {
            const unsigned int level =
              layer_knots.first_basis_function(info.layer);
            for (unsigned int k = level; k <= level + layer_knots.degree(); ++k)
              if (k == 0)
                add_face();
              else
                add_level(k);
            continue;
          }
        if (info.enriched)
          add_face();
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
    const std::array<unsigned int, 3> last{
      {n_1 - 1, n_2 - 1, layer_knots.n_basis_functions() - 1}};
    if (!is_inner)
      {
        const unsigned int A = node - n_inner_nodes();
        return {{{A % n_1, A / n_1, 0}}, last};
      }
    const unsigned int n_here   = columns.end[0] - columns.begin[0] + 2,
                       in_level = node % n_in_level();
    return {{{columns.begin[0] + in_level % n_here,
              columns.begin[1] + in_level / n_here,
              1 + node / n_in_level()}},
            last};
  }



  namespace
  {
    /** Inner nodes of a whole body along x or y. */
    unsigned int
    n_across(const BodyMesh &mesh, const unsigned int direction)
    {
      return mesh.parameters().cells[direction] + (mesh.has_splines() ? 2 : 1);
    }
  } // namespace



  unsigned int
  BodyMesh::number_in_whole(const unsigned int node) const
  {
    const auto         i = place_of(node).index;
    const unsigned int n = n_across(*this, 0) * n_across(*this, 1);
    if (node >= n_inner_nodes())
      return n_nodes_of_whole() - n_nodes() + node;
    return i[0] + n_across(*this, 0) * i[1] +
           n * (has_splines() ? i[2] - 1 : i[2]);
  }



  unsigned int
  BodyMesh::n_nodes_of_whole() const
  {
    const unsigned int n_levels =
      layer_knots.n_basis_functions() - (has_splines() ? 1 : 0);
    return n_across(*this, 0) * n_across(*this, 1) * n_levels +
           contact_surface.n_control_points();
  }



  unsigned int
  BodyMesh::n_dofs_as_published() const
  {
    return 3 * (n_nodes_of_whole() -
                (body_parameters.contact_surface == SurfaceKind::nurbs ?
                   0 :
                   contact_surface.n_control_points()));
  }



  unsigned int
  BodyMesh::n_unknowns() const
  {
    const auto &n = body_parameters.cells;
    return 3 *
           (n_nodes_of_whole() - (has_splines() ? 0 : (n[0] + 1) * (n[1] + 1)));
  }



  // What several ranks have is the same on all of them.
  Eigen::VectorXd
  BodyMesh::gathered(const Eigen::VectorXd &v) const
  {
    Eigen::VectorXd whole =
      Eigen::VectorXd::Constant(3 * n_nodes_of_whole(),
                                -std::numeric_limits<double>::infinity());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      whole.segment<3>(3 * number_in_whole(node)) = v.segment<3>(3 * node);
    Ranks::take_largest(whole.data(), whole.size());
    return whole;
  }



  Eigen::VectorXd
  BodyMesh::own_part(const Eigen::VectorXd &whole) const
  {
    Eigen::VectorXd v(3 * n_nodes());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      v.segment<3>(3 * node) = whole.segment<3>(3 * number_in_whole(node));
    return v;
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
