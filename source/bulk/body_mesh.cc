#include <debond/bulk/body_mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

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



  struct BodyMesh::Grid
  {
    dealii::Triangulation<3>          triangulation;
    dealii::FESystem<3>               fe{dealii::FE_Q<3>(1), 3};
    dealii::DoFHandler<3>             dof_handler{triangulation};
    dealii::AffineConstraints<double> constraints;
  };



  BodyMesh::~BodyMesh() = default;



  BodyMesh::BodyMesh(const BodyParameters &parameters, const Side side)
    : body_parameters(parameters)
    , body_side(side)
    , contact_surface(make_contact_surface(parameters))
    , grid(std::make_unique<Grid>())
  {
    make_grid();
    number_nodes();
    collect_cells();
    make_constraints();
  }



  double
  BodyMesh::layer_height(const unsigned int layer,
                         const double       height_of_face) const
  {
    // z_k = -+ H (k/n)^g over a flat contact face at z_0 = 0
    const double fraction = std::pow(double(layer) / body_parameters.cells[2],
                                     body_parameters.layer_grading);
    const double end      = -outward_sign() * body_parameters.thickness();
    return height_of_face + (end - height_of_face) * fraction;
  }



  // The cells form a lattice. The triangulation is first made with lattice
  // indices as coordinates; then each vertex moves to its place: in the plane
  // where the knots of the contact surface are, along z by layers.
  void
  BodyMesh::make_grid()
  {
    const auto &n = body_parameters.cells;
    dealii::GridGenerator::subdivided_hyper_rectangle(grid->triangulation,
                                                      {n[0], n[1], n[2]},
                                                      dealii::Point<3>(),
                                                      dealii::Point<3>(n[0],
                                                                       n[1],
                                                                       n[2]));
    grid->dof_handler.distribute_dofs(grid->fe);

    lattice.resize(grid->dof_handler.n_dofs() / 3);
    for (const auto &cell : grid->dof_handler.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        {
          const dealii::Point<3> p = cell->vertex(v);
          auto &index              = lattice[cell->vertex_dof_index(v, 0) / 3];
          for (unsigned int d = 0; d < 3; ++d)
            index[d] = std::lround(p[d]);
          // count layers from the contact face, which is the bone's top
          if (body_side == Side::bone)
            index[2] = n[2] - index[2];
        }
  }



  void
  BodyMesh::number_nodes()
  {
    const auto &breaks_1 = contact_surface.knots(0).breakpoints();
    const auto &breaks_2 = contact_surface.knots(1).breakpoints();
    reference_positions.resize(n_nodes());
    for (unsigned int node = 0; node < n_vertices(); ++node)
      {
        const auto &index = lattice[node];
        reference_positions[node] =
          contact_surface.point({breaks_1[index[0]], breaks_2[index[1]]});
        reference_positions[node][2] =
          layer_height(index[2], reference_positions[node][2]);
      }
    for (unsigned int A = 0; A < contact_surface.n_control_points(); ++A)
      reference_positions[control_point_node(A)] =
        contact_surface.control_points().col(A);
  }



  void
  BodyMesh::collect_cells()
  {
    const unsigned int n_1 = body_parameters.cells[0];
    const unsigned int n_functions =
      (contact_surface.degree() + 1) * (contact_surface.degree() + 1);
    for (const auto &cell : grid->dof_handler.active_cell_iterators())
      {
        Cell                        info;
        unsigned int                lowest_layer = -1;
        std::array<unsigned int, 2> corner{
          {static_cast<unsigned int>(-1), static_cast<unsigned int>(-1)}};
        for (const unsigned int v : cell->vertex_indices())
          {
            for (unsigned int c = 0; c < 3; ++c)
              AssertThrow(cell->vertex_dof_index(v, c) ==
                            3 * (cell->vertex_dof_index(v, 0) / 3) + c,
                          dealii::ExcInternalError());
            info.vertices[v]  = cell->vertex_dof_index(v, 0) / 3;
            const auto &index = lattice[info.vertices[v]];
            lowest_layer      = std::min(lowest_layer, index[2]);
            for (unsigned int d = 0; d < 2; ++d)
              corner[d] = std::min(corner[d], index[d]);
          }
        info.enriched = (lowest_layer == 0);
        if (info.enriched)
          {
            info.surface_element = corner[0] + n_1 * corner[1];
            const auto control_points =
              contact_surface.element_control_points(info.surface_element);
            for (unsigned int a = 0; a < n_functions; ++a)
              info.nodes.push_back(control_point_node(control_points[a]));
            for (const unsigned int vertex : info.vertices)
              if (lattice[vertex][2] == 1)
                info.nodes.push_back(vertex);
          }
        else
          info.nodes.assign(info.vertices.begin(), info.vertices.end());
        bulk_cells.push_back(info);
      }
  }



  void
  BodyMesh::make_constraints()
  {
    const auto &n    = body_parameters.cells;
    const auto  n_cp = contact_surface.n_control_points_per_direction();
    fixed.assign(3 * n_nodes(), false);
    tied.assign(n_nodes(), false);

    const auto fix_sides = [&](const unsigned int                node,
                               const std::array<unsigned int, 2> index,
                               const std::array<unsigned int, 2> last) {
      if (body_side == Side::bone)
        for (unsigned int d = 0; d < 2; ++d)
          if (index[d] == 0 || index[d] == last[d])
            fixed[3 * node + d] = true;
    };

    for (unsigned int node = 0; node < n_vertices(); ++node)
      {
        const auto &index = lattice[node];
        tied[node]        = (index[2] == 0);
        if (index[2] == n[2])
          for (unsigned int c = 0; c < 3; ++c)
            fixed[3 * node + c] = true;
        else if (!tied[node])
          fix_sides(node, {{index[0], index[1]}}, {{n[0], n[1]}});
      }
    for (unsigned int A = 0; A < contact_surface.n_control_points(); ++A)
      fix_sides(control_point_node(A),
                {{A % n_cp[0], A / n_cp[0]}},
                {{n_cp[0] - 1, n_cp[1] - 1}});

    SurfaceBasis basis;
    for (unsigned int node = 0; node < n_nodes(); ++node)
      {
        if (tied[node])
          contact_surface.evaluate(
            {contact_surface.knots(0).breakpoints()[lattice[node][0]],
             contact_surface.knots(1).breakpoints()[lattice[node][1]]},
            basis,
            false);
        for (unsigned int c = 0; c < 3; ++c)
          if (tied[node])
            {
              grid->constraints.add_line(3 * node + c);
              for (unsigned int a = 0; a < basis.size; ++a)
                if (basis.N[a] != 0.)
                  grid->constraints.add_entry(
                    3 * node + c,
                    3 * control_point_node(basis.control_point[a]) + c,
                    basis.N[a]);
            }
          else if (is_fixed(node, c))
            grid->constraints.add_line(3 * node + c);
      }
    grid->constraints.close();
  }



  void
  BodyMesh::distribute(Eigen::VectorXd &v) const
  {
    for (const auto &line : grid->constraints.get_lines())
      {
        double value = 0.;
        for (const auto &[dof, weight] : line.entries)
          value += weight * v[dof];
        v[line.index] = value;
      }
  }



  unsigned int
  BodyMesh::n_dofs_as_published() const
  {
    return body_parameters.contact_surface == SurfaceKind::nurbs ?
             3 * n_nodes() :
             3 * n_vertices();
  }



  unsigned int
  BodyMesh::n_unknowns() const
  {
    unsigned int n_tied = 0;
    for (const bool is_tied : tied)
      n_tied += is_tied;
    return 3 * (n_nodes() - n_tied);
  }
} // namespace Debond
