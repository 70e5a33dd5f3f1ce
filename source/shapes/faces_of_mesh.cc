#include <debond/shapes/boundary.h>
#include <debond/shapes/faces_of_mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

#include <map>
#include <utility>

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
  cells_at_contact_face(const dealii::Triangulation<3> &triangulation)
  {
    std::vector<
      std::pair<dealii::Triangulation<3>::active_cell_iterator, unsigned int>>
      result;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face) &&
            cell->face(face)->boundary_id() == Boundary::contact)
          result.emplace_back(cell, face);
    return result;
  }



  namespace
  {
    /** Weights of the control points in the middle of lines along both
     *  parameters of a face; opposite sides have the same. */
    std::array<double, 2>
    weights_along(const FileMesh                                       &mesh,
                  const dealii::Triangulation<3>::active_cell_iterator &cell,
                  const ContactFace                                    &face)
    {
      std::array<double, 2> result;
      const unsigned int    first = face.number % 2 << face.across();
      for (unsigned int d = 0; d < 2; ++d)
        {
          const auto found =
            mesh.weights.find(vertices_of({0, 1}, [&](const unsigned int c) {
              return cell->vertex_index(first + (c << face.axes[d]));
            }));
          result[d] = found == mesh.weights.end() ? 1. : found->second;
        }
      return result;
    }



    /** Of values at the n x n nodes of a face the control points, first one
     *  direction, then the other: those in the middle of a line have the
     *  weights @p w, those at its ends 1. */
    void
    interpolate(Eigen::Matrix3Xd            &x,
                const unsigned int           n,
                const std::array<double, 2> &w)
    {
      if (n == 3)
        for (const unsigned int d : {0, 1})
          for (unsigned int line = 0; line < 3; ++line)
            {
              const unsigned int step  = d == 0 ? 1 : 3,
                                 first = line * (4 - step);
              x.col(first + step) =
                ((1. + w[d]) * x.col(first + step) -
                 0.5 * (x.col(first) + x.col(first + 2 * step))) /
                w[d];
            }
    }
  } // namespace



  // Control points are the functions of FE_Q on the face: cells share them.
  NurbsSurface
  contact_surface_of(const FileMesh    &mesh,
                     const unsigned int degree,
                     const Side         side)
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
    for (const auto &[cell, number] : cells_at_contact_face(mesh.triangulation))
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
        const auto w = degree == 2 ? weights_along(mesh, cell, face) :
                                     std::array<double, 2>{{1., 1.}};
        interpolate(x, n, w);
        net.conservativeResize(3, control_point_of.size());
        weights.resize(net.cols());
        for (unsigned int k = 0; k < n * n; ++k)
          {
            net.col(control_points[k]) = x.col(k);
            weights[control_points[k]] =
              (k % n == 1 ? w[0] : 1.) * (k / n == 1 ? w[1] : 1.);
          }
        faces.push_back(std::move(control_points));
      }
    return NurbsSurface(degree, faces, net, weights);
  }
} // namespace Debond
