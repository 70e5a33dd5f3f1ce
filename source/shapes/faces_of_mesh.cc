#include <debond/shapes/boundary.h>
#include <debond/shapes/faces_of_mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

#include <Eigen/QR>

#include <map>

namespace Debond
{
  // Coordinates of a cell are right-handed: those after that across a face, in
  // turn, have a product that points to the upper face.
  ContactFace
  ContactFace::of(const unsigned int number, const Side side)
  {
    const unsigned int across   = number / 2;
    const bool         is_upper = number % 2 == 1;
    ContactFace        result{number, {{(across + 1) % 3, (across + 2) % 3}}};
    if (is_upper != (side == Side::bone))
      std::swap(result.axes[0], result.axes[1]);
    return result;
  }



  std::vector<
    std::pair<dealii::Triangulation<3>::active_cell_iterator, unsigned int>>
  cells_at_contact_face(const dealii::Triangulation<3> &triangulation,
                        const FacesOfMesh               which)
  {
    std::vector<
      std::pair<dealii::Triangulation<3>::active_cell_iterator, unsigned int>>
      result;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face) &&
            (which == FacesOfMesh::all ||
             (cell->face(face)->boundary_id() == Boundary::contact) ==
               (which == FacesOfMesh::contact)))
          result.emplace_back(cell, face);
    return result;
  }



  namespace
  {
    /** Edges among the 3 x 3 nodes of a face. */
    constexpr int edges[][3] = {{0, 1, 2}, {6, 7, 8}, {0, 3, 6}, {2, 5, 8}};



    /** Weights of the 3 x 3 control points of a face with these nodes, whose
     *  edges are arcs: at corners 1, in the middle of edges the cosine of half
     *  the angle, whose half has the tangent t, in the middle of the face their
     *  geometric mean, that of a product where opposite edges are alike. */
    FaceWeights
    weights_of(const Eigen::Matrix3Xd &x)
    {
      FaceWeights w = FaceWeights::Ones();
      for (const auto &[first, middle, last] : edges)
        {
          const double t =
            (2. * x.col(middle) - x.col(first) - x.col(last)).norm() /
            (x.col(last) - x.col(first)).norm();
          w[middle] = (1. - t * t) / (1. + t * t);
        }
      w[4] = std::sqrt(w[1] * w[7] * w[3] * w[5]);
      return w;
    }



    /** Moves the control point in the middle of a face, and changes its weight,
     *  so that the patch is as close to a sphere as it can be: |N|^2 = R^2 D^2,
     *  with x = N/D from the centre, by least squares at inner points. Edges
     * stay arcs. The error falls with the fourth power of the size of the
     * faces, or the sixth; with the point on the sphere and the mean weight,
     * with the third. */
    void
    fit_to_sphere(Eigen::Matrix3Xd &x, FaceWeights &w, const BodyMesh &mesh)
    {
      const double          R = mesh.sphere_radius;
      const Eigen::Vector3d centre(mesh.sphere_centre[0],
                                   mesh.sphere_centre[1],
                                   mesh.sphere_centre[2]);
      // homogeneous coordinates N/R, D of the control points
      Eigen::Matrix<double, 4, 9> h;
      h.topRows<3>()           = (x.colwise() - centre) * w.asDiagonal() / R;
      h.row(3)                 = w.transpose();
      constexpr unsigned int n = 5;
      for (unsigned int iteration = 0; iteration < 4; ++iteration)
        {
          Eigen::Matrix<double, n * n, 4> J;
          Eigen::Matrix<double, n * n, 1> F;
          for (unsigned int i = 0; i < n * n; ++i)
            {
              const auto bernstein = [](const double s) {
                return Eigen::Vector3d((1. - s) * (1. - s),
                                       2. * s * (1. - s),
                                       s * s);
              };
              const Eigen::Matrix3d b =
                bernstein((i % n + 1.) / (n + 1)) *
                bernstein((i / n + 1.) / (n + 1)).transpose();
              Eigen::Vector4d p = h * Eigen::Map<const FaceWeights>(b.data());
              p[3]              = -p[3]; // of |N|^2 - D^2 the half gradient
              F[i]              = p.head<3>().squaredNorm() - p[3] * p[3];
              J.row(i)          = 2. * b(1, 1) * p.transpose();
            }
          h.col(4) -= J.colPivHouseholderQr().solve(F);
        }
      w[4]     = h(3, 4);
      x.col(4) = centre + R / w[4] * h.col(4).head<3>();
    }
  } // namespace



  void
  interpolate_nodes(Eigen::Matrix3Xd &x, const FaceWeights &w)
  {
    for (const auto &[first, middle, last] : edges)
      x.col(middle) = ((1. + w[middle]) * x.col(middle) -
                       0.5 * (x.col(first) + x.col(last))) /
                      w[middle];
    FaceWeights bernstein;
    bernstein << 1., 2., 1., 2., 4., 2., 1., 2., 1.;
    FaceWeights  rest = bernstein.cwiseProduct(w);
    const double all = rest.sum(), own = rest[4];
    rest[4]  = 0.;
    x.col(4) = (all * x.col(4) - x * rest) / own;
  }



  std::vector<unsigned int>
  vertices_of_face(const dealii::Triangulation<3>::active_cell_iterator &cell,
                   const ContactFace                                    &face)
  {
    std::vector<unsigned int> result;
    for (const unsigned int k : {0, 1, 2, 3})
      {
        const unsigned int c = face.number % 2 << face.across() |
                               (k & 1) << face.axes[0] |
                               (k >> 1) << face.axes[1];
        result.push_back(cell->vertex_index(c));
      }
    return result;
  }



  namespace
  {
    /** The same surface as one of quadratic triangles. */
    void
    use_triangles(const BodyMesh   &mesh,
                  const Side        side,
                  const FacesOfMesh which,
                  NurbsSurface     &surface)
    {
      std::map<unsigned int, unsigned int>     control_point_of;
      std::vector<std::array<unsigned int, 6>> nodes;
      std::vector<unsigned int>                first;
      for (const auto &[cell, number] :
           cells_at_contact_face(mesh.triangulation, which))
        {
          const auto part = mesh.part_of_simplex(
            vertices_of_face(cell, ContactFace::of(number, side)));
          first.push_back(part.first_corner);
          nodes.emplace_back();
          for (unsigned int k = 0; k < 6; ++k)
            nodes.back()[k] =
              control_point_of.emplace(part.nodes[k], control_point_of.size())
                .first->second;
        }
      ControlNet places(3, control_point_of.size());
      for (const auto &[vertex, A] : control_point_of)
        for (unsigned int c = 0; c < 3; ++c)
          places(c, A) = mesh.triangulation.get_vertices()[vertex][c];
      surface.use_triangles(nodes, first, places);
    }
  } // namespace



  // Control points are the functions of FE_Q on the face: cells share them.
  NurbsSurface
  contact_surface_of(const BodyMesh    &mesh,
                     const unsigned int degree,
                     const Side         side,
                     const FacesOfMesh  which)
  {
    using dealii::FETools::lexicographic_to_hierarchic_numbering;
    const auto function     = lexicographic_to_hierarchic_numbering<3>(degree),
               node         = lexicographic_to_hierarchic_numbering<3>(2);
    const unsigned int    n = degree + 1;
    const dealii::FE_Q<3> fe(degree);
    dealii::DoFHandler<3> dofs(mesh.triangulation);
    dofs.distribute_dofs(fe);
    std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
    std::map<dealii::types::global_dof_index, unsigned int> control_point_of;
    std::vector<std::vector<unsigned int>>                  faces;
    ControlNet                                              net(3, 0);
    std::vector<double>                                     weights;
    for (const auto &[cell, number] :
         cells_at_contact_face(mesh.triangulation, which))
      {
        const ContactFace face   = ContactFace::of(number, side);
        const auto        places = mesh.points_of_second_order(cell);
        dealii::DoFHandler<3>::active_cell_iterator(&mesh.triangulation,
                                                    cell->level(),
                                                    cell->index(),
                                                    &dofs)
          ->get_dof_indices(indices);
        std::vector<unsigned int> control_points;
        Eigen::Matrix3Xd          x(3, n * n);
        for (unsigned int k = 0; k < n * n; ++k)
          {
            std::array<unsigned int, 3> i;
            i[face.axes[0]]  = k % n;
            i[face.axes[1]]  = k / n;
            i[face.across()] = number % 2 * degree;
            const auto &place =
              places[node[2 / degree * (i[0] + 3 * i[1] + 9 * i[2])]];
            x.col(k) << place[0], place[1], place[2];
            const auto found = control_point_of.emplace(
              indices[function[i[0] + n * i[1] + n * n * i[2]]],
              control_point_of.size());
            control_points.push_back(found.first->second);
          }
        FaceWeights w = FaceWeights::Ones();
        if (degree == 2)
          {
            if (mesh.has_arcs)
              w = weights_of(x);
            interpolate_nodes(x, w);
            if (mesh.sphere_radius > 0.)
              fit_to_sphere(x, w, mesh);
          }
        net.conservativeResize(3, control_point_of.size());
        weights.resize(net.cols());
        for (unsigned int k = 0; k < n * n; ++k)
          {
            net.col(control_points[k]) = x.col(k);
            weights[control_points[k]] = w[k];
          }
        faces.push_back(std::move(control_points));
      }
    NurbsSurface result(degree, faces, net, weights);
    if (degree == 2 && mesh.has_tetrahedra())
      use_triangles(mesh, side, which, result);
    return result;
  }
} // namespace Debond
