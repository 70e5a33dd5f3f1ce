// Cells with up to three faces on the contact face: a block of 2 x 2 x 2
// distorted hexahedra of a file, three of whose sides are contact, of the first
// and second order.
// - With any displacements of control points and nodes the cells have, on all
// of
//   their contact faces, those of the surface.
// - Linear displacements are reproduced, with their gradient.
// - The sides are three pieces, and share the control points of their edges.

#include <debond/bulk/bulk_space.h>
#include <debond/shapes/mesh_builder.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/grid_generator.h>

#include <random>

#include "checks.h"
#include "mesh_writer.h"

using namespace Debond;

BodyParameters
block(const unsigned int order)
{
  dealii::Triangulation<3> triangulation;
  dealii::GridGenerator::subdivided_hyper_cube(triangulation, 2, 0., 2.);
  for (const auto &face : triangulation.active_face_iterators())
    if (face->at_boundary())
      {
        const auto x = face->center();
        face->set_boundary_id(std::max({x[0], x[1], x[2]}) > 1.99 ?
                                Boundary::contact :
                              x[2] < 0.01 ? Boundary::held :
                                            Boundary::free);
      }
  std::vector<dealii::Triangulation<3>::active_cell_iterator> cells;
  for (const auto &cell : triangulation.active_cell_iterators())
    cells.push_back(cell);
  write_msh(
    triangulation,
    [&](const unsigned int cell, const dealii::Point<3> &p) {
      dealii::Point<3> x = cells[cell]->vertex(0);
      for (unsigned int d = 0; d < 3; ++d)
        x[d] += p[d];
      return dealii::Point<3>(x[0] + 0.1 * std::sin(x[1] + 2. * x[2]),
                              x[1] + 0.1 * std::sin(x[0] + x[2]),
                              x[2] + 0.1 * std::cos(x[0] * x[1]));
    },
    "block.msh",
    order);
  BodyParameters body;
  body.shape   = BodyShape::file;
  body.element = order == 1 ? ElementKind::trilinear : ElementKind::quadratic;
  body.mesh    = read_mesh_file("block.msh", "Bone / Mesh file");
  return body;
}

/** Displacement and its gradient at a point of the unit cell. */
std::pair<Eigen::Vector3d, Eigen::Matrix3d>
at(const BulkSpace        &space,
   const BulkSpace::Cell  &cell,
   const Eigen::VectorXd  &v,
   const dealii::Point<3> &point)
{
  const ShapeValues N = CellFunctions(space, cell).at(point);
  Eigen::Vector3d   u = Eigen::Vector3d::Zero();
  Eigen::Matrix3d   J = Eigen::Matrix3d::Zero(), H = J;
  for (unsigned int a = 0; a < N.rows(); ++a)
    {
      const Eigen::Vector3d v_a = v.segment<3>(3 * cell.nodes[a]);
      u += N(a, 0) * v_a;
      J += space.reference_position(cell.nodes[a]) * N.row(a).tail<3>();
      H += v_a * N.row(a).tail<3>();
    }
  return {u, H * J.inverse()};
}

int
main()
{
  const dealii::QGauss<2> on_face(3);
  const dealii::QGauss<3> in_cell(3);
  for (const unsigned int order : {1, 2})
    {
      const BulkSpace     space(block(order), Side::bone);
      const NurbsSurface &surface = space.surface();
      Eigen::VectorXd     v(3 * space.n_nodes());
      std::mt19937        random(order);
      for (double &one : v)
        one = random() / 4294967296. - 0.5;
      space.distribute(v);
      const ControlNet net =
        Eigen::Map<const ControlNet>(v.data() + 3 * space.control_point_node(0),
                                     3,
                                     surface.n_control_points());
      double       apart   = 0.;
      unsigned int element = 0;
      for (const auto &[cell, number] :
           cells_at_contact_face(space.dof_handler().get_triangulation()))
        {
          const ContactFace face = ContactFace::of(number, Side::bone);
          for (const auto &q : on_face.get_points())
            {
              dealii::Point<3> p;
              p[face.axes[0]]  = q[0];
              p[face.axes[1]]  = q[1];
              p[face.across()] = number % 2;
              SurfaceBasis basis;
              surface.evaluate_in_element(
                element,
                parameters_at(surface.element_bounds(element), q),
                basis);
              grow(apart,
                   (at(space, space.cells()[cell->active_cell_index()], v, p)
                      .first -
                    interpolate(basis, net))
                     .norm());
            }
          ++element;
        }
      const std::string name = "order " + std::to_string(order);
      report(name + ": faces of cells are the surface", apart, 1e-13);

      Eigen::Matrix3d A;
      A << 0.1, 0.2, -0.3, 0.5, -0.4, 0.7, 0.2, 0.1, 0.6;
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        v.segment<3>(3 * node) =
          A * space.reference_position(node) +
          (space.is_tied(node) ? 1e9 : 0.) * Eigen::Vector3d::Ones();
      space.distribute(v);
      double worst = 0.;
      for (const BulkSpace::Cell &cell : space.cells())
        for (const auto &p : in_cell.get_points())
          grow(worst, (at(space, cell, v, p).second - A).norm());
      report(name + ": linear displacements", worst, 1e-12);
      report(name + ": three pieces, with shared control points",
             surface.n_pieces() == 3 && surface.n_elements() == 12 &&
               surface.n_control_points() ==
                 (order == 1 ? 27u - 8u : 125u - 64u));
    }
}
