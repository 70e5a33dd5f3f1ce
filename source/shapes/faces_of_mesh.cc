#include <debond/shapes/boundary.h>
#include <debond/shapes/faces_of_mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>

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



  namespace
  {
    bool
    is_contact(const dealii::Triangulation<3>::cell_iterator &cell,
               const unsigned int                             face)
    {
      return cell->at_boundary(face) &&
             cell->face(face)->boundary_id() == Boundary::contact;
    }
  } // namespace



  std::vector<dealii::Triangulation<3>::active_cell_iterator>
  cells_at_contact_face(const dealii::Triangulation<3> &triangulation)
  {
    std::vector<dealii::Triangulation<3>::active_cell_iterator> result;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (is_contact(cell, face))
          {
            result.push_back(cell);
            break;
          }
    return result;
  }



  ContactFace
  contact_face_of(const dealii::Triangulation<3>::cell_iterator &cell,
                  const Side                                     side)
  {
    for (const unsigned int face : cell->face_indices())
      if (is_contact(cell, face))
        return ContactFace::of(face, side);
    AssertThrow(false, dealii::ExcInternalError());
    return {};
  }



  namespace
  {
    /** Coefficients of the Bernstein polynomials that take these values at the
     *  ends and in the middle. */
    void
    interpolate(Eigen::Ref<Eigen::Matrix3Xd> x)
    {
      if (x.cols() == 3)
        x.col(1) = 2. * x.col(1) - 0.5 * (x.col(0) + x.col(2));
    }
  } // namespace



  // Nodes are those of FE_Q: faces share what they have in common.
  NurbsSurface
  contact_surface_of(const FileMesh    &mesh,
                     const unsigned int degree,
                     const Side         side)
  {
    const unsigned int    n = degree + 1;
    const dealii::FE_Q<3> fe(degree);
    const dealii::FE_Q<3> second_order(2);
    dealii::DoFHandler<3> dofs(mesh.triangulation);
    dofs.distribute_dofs(fe);
    std::vector<unsigned int>                    number_of(dofs.n_dofs(),
                                        dealii::numbers::invalid_unsigned_int);
    std::vector<std::vector<unsigned int>>       faces;
    std::vector<Eigen::Vector3d>                 points;
    std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
    // number of the function of FE_Q at a place of the unit cell
    const auto function_at = [](const dealii::FE_Q<3>  &element,
                                const dealii::Point<3> &place) {
      unsigned int a = 0;
      while (element.unit_support_point(a).distance(place) > 1e-10)
        ++a;
      return a;
    };
    for (const auto &cell : cells_at_contact_face(mesh.triangulation))
      {
        const ContactFace face   = contact_face_of(cell, side);
        const auto        places = mesh.points_of_second_order(cell);
        dealii::DoFHandler<3>::active_cell_iterator(&mesh.triangulation,
                                                    cell->level(),
                                                    cell->index(),
                                                    &dofs)
          ->get_dof_indices(indices);
        std::vector<unsigned int> control_points;
        Eigen::Matrix3Xd          X(3, n * n);
        for (unsigned int k = 0; k < n * n; ++k)
          {
            dealii::Point<3> p;
            p[face.axes[0]]      = double(k % n) / degree;
            p[face.axes[1]]      = double(k / n) / degree;
            p[face.across()]     = face.number % 2;
            const auto &x        = places[function_at(second_order, p)];
            X.col(k)             = Eigen::Vector3d(x[0], x[1], x[2]);
            unsigned int &number = number_of[indices[function_at(fe, p)]];
            if (number == dealii::numbers::invalid_unsigned_int)
              {
                number = points.size();
                points.emplace_back();
              }
            control_points.push_back(number);
          }
        for (unsigned int j = 0; j < n; ++j)
          interpolate(X.middleCols(n * j, n));
        for (unsigned int i = 0; i < n; ++i)
          {
            Eigen::Matrix3Xd column(3, n);
            for (unsigned int j = 0; j < n; ++j)
              column.col(j) = X.col(i + n * j);
            interpolate(column);
            for (unsigned int j = 0; j < n; ++j)
              points[control_points[i + n * j]] = column.col(j);
          }
        faces.push_back(std::move(control_points));
      }
    ControlNet net(3, points.size());
    for (unsigned int A = 0; A < points.size(); ++A)
      net.col(A) = points[A];
    return NurbsSurface(degree, faces, net);
  }
} // namespace Debond
