// Degrees of freedom of the paper's three meshes, unknowns, layers with
// grading, nodes of cells, and what is fixed and what is tied.

#include <debond/bulk/bulk_space.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "checks.h"

using namespace Debond;

BodyParameters
bone_parameters(const unsigned int n)
{
  BodyParameters bone;
  bone.cells = {{n, n, 2}};
  return bone;
}

BodyParameters
implant_parameters(const unsigned int n)
{
  BodyParameters implant;
  implant.shape = BodyShape::coin;
  implant.cells = {{n, n, 2}};
  return implant;
}



void
count(const std::string &name, BodyParameters bone, BodyParameters implant)
{
  for (const SurfaceKind kind : {SurfaceKind::nurbs, SurfaceKind::bilinear})
    {
      bone.contact_surface = implant.contact_surface = kind;
      const BulkSpace b(bone, Side::bone), i(implant, Side::implant);
      std::cout << name
                << (kind == SurfaceKind::nurbs ? ", NURBS: " : ", bilinear: ")
                << b.n_dofs_as_published() << " + " << i.n_dofs_as_published()
                << " = " << b.n_dofs_as_published() + i.n_dofs_as_published()
                << " degrees of freedom, " << b.n_unknowns() + i.n_unknowns()
                << " unknowns" << std::endl;
    }
}



/** Heights of the vertices that are not on the contact face, lowest |z| first,
 *  against -+ H (k/n)^g. */
double
layer_deviation(const BulkSpace &mesh, const double sign, const double grading)
{
  const unsigned int     n         = mesh.parameters().cells[2];
  const double           H         = mesh.parameters().thickness();
  double                 deviation = 0;
  std::set<unsigned int> found;
  for (unsigned int node = 0; node < mesh.n_vertices(); ++node)
    {
      const double z       = mesh.reference_position(node)[2];
      double       nearest = 1e9;
      unsigned int layer   = 0;
      for (unsigned int k = 0; k <= n; ++k)
        {
          const double z_k = sign * H * std::pow(double(k) / n, grading);
          if (std::abs(z - z_k) < nearest)
            {
              nearest = std::abs(z - z_k);
              layer   = k;
            }
        }
      grow(deviation, nearest);
      found.insert(layer);
      if (mesh.is_tied(node) != (layer == 0))
        deviation = 1e9;
    }
  return found.size() == n + 1 ? deviation : 1e9;
}



/** Cells: 13 nodes in the contact layer, 8 elsewhere; each surface element has
 *  one cell; the vertices of the opposite face lie above the element. */
void
check_cells(const std::string    &name,
            const BodyParameters &parameters,
            const Side            side)
{
  std::cout << name << std::endl;
  const BulkSpace     mesh(parameters, side);
  const auto        &n      = mesh.parameters().cells;
  const unsigned int n_face = n[0] * n[1];
  const unsigned int n_functions =
    parameters.contact_surface == SurfaceKind::nurbs ? 9 : 4;

  std::set<unsigned int> elements;
  bool                   sizes = true, no_tied_nodes = true;
  double                 corners = 0;
  for (const BulkSpace::Cell &cell : mesh.cells())
    {
      sizes =
        sizes && cell.nodes.size() == (cell.enriched ? n_functions + 4 : 8);
      for (const unsigned int node : cell.nodes)
        no_tied_nodes = no_tied_nodes && !mesh.is_tied(node);
      if (!cell.enriched)
        continue;
      elements.insert(cell.surface_element);
      const auto bounds = mesh.surface().element_bounds(cell.surface_element);
      for (unsigned int corner = 0; corner < 4; ++corner)
        {
          Eigen::Vector3d X =
            mesh.reference_position(cell.nodes[n_functions + corner]);
          X[2] = 0.;
          grow(corners,
               (X - mesh.surface().point(
                      {bounds[corner % 2][0], bounds[corner / 2][1]}))
                 .norm());
        }
    }
  report("  13 or 8 nodes, bilinear 8", sizes);
  report("  one cell on each surface element",
         elements.size() == n_face && mesh.cells().size() == n_face * n[2]);
  report("  vertices that follow the control points are no nodes of cells",
         no_tied_nodes);
  report("  opposite face lies above the element, deviation", corners, 1e-14);

  bool right_fixed = true;
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    for (unsigned int c = 0; c < 3; ++c)
      {
        const Eigen::Vector3d &X = mesh.reference_position(node);
        const bool             held =
          std::abs(std::abs(X[2]) - parameters.thickness()) < 1e-12;
        const bool at_side =
          side == Side::bone && c < 2 &&
          std::abs(std::abs(X[c]) - 0.5 * parameters.size[c]) < 1e-12;
        if (!mesh.is_tied(node))
          right_fixed =
            right_fixed && mesh.is_fixed(node, c) == (held || at_side);
      }
  report("  held where the body is held, normal to the sides of the bone",
         right_fixed);

  unsigned int n_tied = 0, n_fixed = 0;
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    {
      n_tied += mesh.is_tied(node);
      for (unsigned int c = 0; c < 3; ++c)
        n_fixed += (!mesh.is_tied(node) && mesh.is_fixed(node, c));
    }
  std::cout << "  " << n_tied << " tied vertices, " << n_fixed
            << " fixed degrees of freedom" << std::endl;

  // a linear field on all nodes but the tied ones, which must follow
  Eigen::VectorXd v(3 * mesh.n_nodes());
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    {
      const Eigen::Vector3d &X = mesh.reference_position(node);
      v.segment<3>(3 * node)   = Eigen::Vector3d(1. + 2. * X[0] - X[1],
                                               0.3 * X[0] + X[2] - 1.,
                                               X[1] - 0.5 * X[0]);
      for (unsigned int c = 0; c < 3; ++c)
        if (mesh.is_fixed(node, c))
          v[3 * node + c] = 0.;
    }
  Eigen::VectorXd followed = v;
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    if (mesh.is_tied(node))
      followed.segment<3>(3 * node).setZero();
  mesh.distribute(followed);
  double     linear = 0;
  const auto limits = [&](const Eigen::Vector3d &X) {
    return side == Side::bone &&
           std::max(std::abs(X[0]) / parameters.size[0],
                    std::abs(X[1]) / parameters.size[1]) > 0.49;
  };
  for (unsigned int node = 0; node < mesh.n_vertices(); ++node)
    if (mesh.is_tied(node) && !limits(mesh.reference_position(node)))
      {
        const Eigen::Vector3d &X = mesh.reference_position(node);
        grow(linear,
             (followed.segment<3>(3 * node) -
              Eigen::Vector3d(1. + 2. * X[0] - X[1],
                              0.3 * X[0] + X[2] - 1.,
                              X[1] - 0.5 * X[0]))
               .norm());
      }
  report("  tied vertices follow the control points, deviation", linear, 1e-13);
}



int
main()
{
  count("Coarse", bone_parameters(15), implant_parameters(3));
  count("Medium", bone_parameters(30), implant_parameters(6));
  count("Fine", bone_parameters(60), implant_parameters(12));

  BodyParameters bone = bone_parameters(4), implant = implant_parameters(3);
  bone.cells[2] = implant.cells[2] = 5;
  for (const double grading : {1., 1.5})
    {
      bone.layer_grading = implant.layer_grading = grading;
      std::cout << "Layers with grading " << grading << std::endl;
      report("  bone, deviation",
             layer_deviation(BulkSpace(bone, Side::bone), -1., grading),
             1e-14);
      report("  implant, deviation",
             layer_deviation(BulkSpace(implant, Side::implant), 1., grading),
             1e-14);
    }

  bone.cells = {{5, 4, 3}};
  bone.size  = {{5., 8., 2.}};
  check_cells("Bone", bone, Side::bone);
  check_cells("Coin", implant, Side::implant);
  bone.contact_surface = implant.contact_surface = SurfaceKind::bilinear;
  check_cells("Bone, bilinear", bone, Side::bone);
  check_cells("Coin, bilinear", implant, Side::implant);
}
