#include <debond/bulk/body_mesh.h>

#include <algorithm>
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
    place_nodes();
    collect_cells();
    support_nodes();
  }



  template <typename Work>
  void
  BodyMesh::for_each_vertex(const Work &work) const
  {
    const auto  &n      = body_parameters.cells;
    unsigned int number = 0;
    for (unsigned int k = 0; k <= n[2]; ++k)
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i <= n[0]; ++i)
          work(number++, i, j, flipped(k));
  }



  Eigen::Vector2d
  BodyMesh::knots_at(const unsigned int i, const unsigned int j) const
  {
    return {contact_surface.knots(0).breakpoints()[i],
            contact_surface.knots(1).breakpoints()[j]};
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



  // Vertices stand in the plane where the knots of the contact surface are,
  // along z by layers.
  void
  BodyMesh::place_nodes()
  {
    reference_positions.resize(n_nodes());
    for_each_vertex([&](const unsigned int node,
                        const unsigned int i,
                        const unsigned int j,
                        const unsigned int layer) {
      Eigen::Vector3d &X = reference_positions[node];
      X                  = contact_surface.point(knots_at(i, j));
      X[2]               = layer_height(layer, X[2]);
    });
    for (unsigned int A = 0; A < contact_surface.n_control_points(); ++A)
      reference_positions[control_point_node(A)] =
        contact_surface.control_points().col(A);
  }



  void
  BodyMesh::collect_cells()
  {
    const auto        &n = body_parameters.cells;
    const unsigned int n_functions =
      (contact_surface.degree() + 1) * (contact_surface.degree() + 1);
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            Cell cell;
            for (unsigned int a = 0; a < 8; ++a)
              cell.vertices[a] =
                vertex({{i + (a & 1), j + (a >> 1 & 1), k + (a >> 2)}});
            const bool on_top = (body_side == Side::bone);
            cell.enriched     = (k == (on_top ? n[2] - 1 : 0));
            // the face opposite to the contact face, or both
            const unsigned int first = cell.enriched && !on_top ? 4 : 0;
            const unsigned int end   = cell.enriched && on_top ? 4 : 8;
            if (cell.enriched)
              {
                cell.surface_element = i + n[0] * j;
                const auto control_points =
                  contact_surface.element_control_points(cell.surface_element);
                for (unsigned int a = 0; a < n_functions; ++a)
                  cell.nodes.push_back(control_point_node(control_points[a]));
              }
            cell.nodes.insert(cell.nodes.end(),
                              cell.vertices.begin() + first,
                              cell.vertices.begin() + end);
            bulk_cells.push_back(cell);
          }
  }



  void
  BodyMesh::support_nodes()
  {
    const auto &n    = body_parameters.cells;
    const auto  n_cp = contact_surface.n_control_points_per_direction();
    fixed.assign(3 * n_nodes(), false);
    tied.assign(n_nodes(), false);
    // the bone's sides slide along themselves
    const auto fix_sides = [&](const unsigned int                node,
                               const std::array<unsigned int, 2> index,
                               const std::array<unsigned int, 2> last) {
      for (unsigned int d = 0; d < 2; ++d)
        if (body_side == Side::bone && (index[d] == 0 || index[d] == last[d]))
          fixed[3 * node + d] = true;
    };
    for_each_vertex([&](const unsigned int node,
                        const unsigned int i,
                        const unsigned int j,
                        const unsigned int layer) {
      tied[node] = (layer == 0);
      if (tied[node])
        {
          followers.emplace_back(node, SurfaceBasis());
          contact_surface.evaluate(knots_at(i, j),
                                   followers.back().second,
                                   false);
        }
      else if (layer == n[2])
        std::fill_n(fixed.begin() + 3 * node, 3, true);
      else
        fix_sides(node, {{i, j}}, {{n[0], n[1]}});
    });
    for (unsigned int A = 0; A < contact_surface.n_control_points(); ++A)
      fix_sides(control_point_node(A),
                {{A % n_cp[0], A / n_cp[0]}},
                {{n_cp[0] - 1, n_cp[1] - 1}});
  }



  void
  BodyMesh::distribute(Eigen::VectorXd &v) const
  {
    for (const auto &[node, basis] : followers)
      {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (unsigned int a = 0; a < basis.size; ++a)
          sum += basis.N[a] *
                 v.segment<3>(3 * control_point_node(basis.control_point[a]));
        v.segment<3>(3 * node) = sum;
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
    return 3 * (n_nodes() - followers.size());
  }
} // namespace Debond
