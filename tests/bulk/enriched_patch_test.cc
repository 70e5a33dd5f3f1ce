// Constant stress: with the displacement of a linear field, forces vanish at
// inner nodes and are the traction at the contact face, to rounding where the
// surface is polynomial. Under 2x2x2 points the rational functions of the disk
// leave an error of a known size, which falls with the mesh, and so does that
// of the volume of the coin.

#include <debond/bulk/enriched_cells.h>
#include <debond/bulk/neo_hookean.h>
#include <debond/geometry/surface_geometry.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <string>
#include <vector>

#include "checks.h"

using namespace Debond;

struct Error
{
  double inside = 0, face = 0, resultant = 0, volume = 0;
};

/** Largest unbalanced force at inner nodes, and at control points inside the
 *  contact face, relative to the stress times the area of a surface element;
 *  |sum of all forces| and the error of the volume, relative as well. */
Error
patch_test(const BodyParameters &parameters, const Side side)
{
  const BulkSpace     mesh(parameters, side);
  const NeoHookean    material = NeoHookean::from_young(18000., 0.3);
  const EnrichedCells cells(mesh, material);
  const double        H[3][3] = {{2e-3, -1e-3, 3e-3},
                                 {4e-3, 1e-3, -2e-3},
                                 {1e-3, 5e-3, -3e-3}};
  double              P[3][3];
  material.stress(H, P);
  Eigen::Matrix3d gradient, stress;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      {
        gradient(i, j) = H[i][j];
        stress(i, j)   = P[i][j];
      }

  Eigen::VectorXd v(3 * mesh.n_nodes());
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    v.segment<3>(3 * node) = gradient * mesh.reference_position(node);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(v.size());
  double          energy;
  cells.internal_forces(v, force, energy);
  mesh.condense(force);

  const NurbsSurface &surface = mesh.surface();
  const bool          coin    = parameters.shape == BodyShape::coin;
  const double area      = coin ? M_PI * parameters.radius * parameters.radius :
                                  parameters.size[0] * parameters.size[1];
  const double thickness = parameters.thickness();
  const double scale     = stress.norm() * area / surface.n_elements();
  const auto   is_inside = [&](const Eigen::Vector3d &X) {
    return coin ? X.head<2>().norm() < 0.999 * parameters.radius :
                    std::abs(X[0]) < 0.4999 * parameters.size[0] &&
                    std::abs(X[1]) < 0.4999 * parameters.size[1];
  };

  Error           error;
  Eigen::Vector3d sum          = Eigen::Vector3d::Zero();
  unsigned int    n_inner      = 0;
  double          largest_area = 0;
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    sum += force.segment<3>(3 * node);
  for (unsigned int node = 0; node < mesh.n_inner_nodes(); ++node)
    {
      const Eigen::Vector3d &X = mesh.reference_position(node);
      if (std::abs(X[2]) > 0.01 * thickness &&
          std::abs(X[2]) < 0.99 * thickness && is_inside(X))
        {
          ++n_inner;
          grow(error.inside, force.segment<3>(3 * node).norm() / scale);
        }
    }

  // control points: traction times the integral of their functions
  Eigen::VectorXd integral = Eigen::VectorXd::Zero(surface.n_control_points());
  for (const auto &point : surface_quadrature(surface, dealii::QGauss<1>(10)))
    for (unsigned int a = 0; a < point.basis.size; ++a)
      integral[point.basis.control_point[a]] += point.basis.N[a] * point.JxW;
  const Eigen::Vector3d traction = mesh.outward_sign() * stress.col(2);
  const unsigned int    n[]{surface.knots(0).n_basis_functions(),
                            surface.knots(1).n_basis_functions()};
  for (unsigned int j = 1; j + 1 < n[1]; ++j)
    for (unsigned int i = 1; i + 1 < n[0]; ++i)
      {
        const unsigned int A = i + n[0] * j;
        grow(error.face,
             (force.segment<3>(3 * mesh.control_point_node(A)) -
              integral[A] * traction)
                 .norm() /
               scale);
        largest_area = std::max(largest_area, integral[A]);
      }
  if (n_inner == 0 || largest_area == 0.)
    std::cout << "NO inner nodes" << std::endl;
  error.resultant = sum.norm() / scale;
  error.volume    = cells.volume() / (area * thickness) - 1.;
  return error;
}



void
check_exact(const std::string    &name,
            const BodyParameters &parameters,
            const Side            side)
{
  const Error error = patch_test(parameters, side);
  std::cout << name << std::endl;
  report("  forces at inner nodes", error.inside, 1e-12);
  report("  forces at the contact face", error.face, 1e-12);
  report("  sum of all forces", error.resultant, 1e-12);
  if (parameters.shape == BodyShape::block)
    report("  relative error of the volume", std::abs(error.volume), 1e-13);
}



void
report_between(const std::string &what,
               const double       value,
               const double       lower,
               const double       upper)
{
  std::cout << what << " between " << lower << " and " << upper << ": ";
  if (lower < value && value < upper)
    std::cout << "yes" << std::endl;
  else
    std::cout << "NO, " << value << std::endl;
}



/** A cylinder, all of it; with 2x2x2 points its volume, and forces, have the
 *  errors of the quadrature of rational functions. */
void
check_spline_coin(BodyParameters coin)
{
  coin.element = ElementKind::spline;
  std::vector<Error> errors;
  for (const unsigned int n : {3, 6, 12})
    {
      coin.cells = {{n, n, 2}};
      errors.push_back(patch_test(coin, Side::implant));
    }
  std::cout << "Coin, splines" << std::endl;
  report("  sum of all forces", errors[0].resultant, 1e-12);
  report("  forces at inner nodes, 3 x 3 elements", errors[0].inside, 1e-3);
  report("  forces at the contact face, 3 x 3 elements", errors[0].face, 1e-3);
  report("  error of the volume, 3 x 3 elements",
         std::abs(errors[0].volume),
         1e-3);
  for (unsigned int k = 0; k < 2; ++k)
    {
      // next to the corners, where the disk is singular, forces fall slowly
      report("  forces at inner nodes, twice as many elements over before",
             errors[k + 1].inside / errors[k].inside,
             0.6);
      report("  forces at the contact face, the same",
             errors[k + 1].face / errors[k].face,
             0.6);
      report("  error of the volume, the same",
             errors[k + 1].volume / errors[k].volume,
             1. / 15.);
    }
}



int
main()
{
  BodyParameters block;
  block.size          = {{5., 4., 2.}};
  block.cells         = {{5, 3, 3}};
  block.layer_grading = 1.5;
  check_exact("Block", block, Side::bone);
  check_exact("Block as implant", block, Side::implant);
  block.contact_surface = SurfaceKind::bilinear;
  check_exact("Block, bilinear", block, Side::bone);
  block.lateral_grading = 2.;
  block.cells           = {{5, 4, 3}};
  check_exact("Block, graded, bilinear", block, Side::bone);
  block.contact_surface = SurfaceKind::nurbs;
  check_exact("Block, graded", block, Side::bone);
  block.element = ElementKind::spline;
  check_exact("Block, graded, splines", block, Side::bone);
  block.cells         = {{6, 4, 3}};
  block.element       = ElementKind::trilinear;
  block.coarser_below = true;
  check_exact("Block, graded, coarser below", block, Side::bone);
  check_exact("Block, graded, coarser below, as implant", block, Side::implant);
  block.element = ElementKind::quadratic;
  check_exact("Block, graded, coarser below, quadratic", block, Side::bone);
  block.coarser_below = false;
  check_exact("Block, graded, quadratic", block, Side::bone);
  check_exact("Block, graded, quadratic, as implant", block, Side::implant);
  block.lateral_grading     = 1.;
  block.cells               = {{8, 6, 3}};
  block.cells_under_implant = 4;
  block.rim                 = {{1.2, 0.9}};
  check_exact("Block with a rim, splines", block, Side::bone);
  check_exact("Block with a rim as implant, splines", block, Side::implant);
  BodyParameters coin;
  coin.shape           = BodyShape::coin;
  coin.cells           = {{3, 3, 2}};
  coin.contact_surface = SurfaceKind::bilinear;
  check_exact("Coin, bilinear", coin, Side::implant);

  coin.contact_surface = SurfaceKind::nurbs;
  check_spline_coin(coin);
  std::vector<Error> errors;
  for (const unsigned int n : {3, 6, 12})
    {
      coin.cells = {{n, n, 2}};
      errors.push_back(patch_test(coin, Side::implant));
    }
  std::cout << "Coin" << std::endl;
  report("  sum of all forces", errors[0].resultant, 1e-12);
  report_between("  forces at inner nodes, 3 x 3 elements",
                 errors[0].inside,
                 1e-4,
                 2e-4);
  report_between("  forces at inner nodes, 12 x 12 elements",
                 errors[2].inside,
                 1e-6,
                 3e-6);
  report_between("  forces at the contact face, 3 x 3 elements",
                 errors[0].face,
                 4e-4,
                 8e-4);
  report_between("  forces at the contact face, 12 x 12 elements",
                 errors[2].face,
                 3e-5,
                 6e-5);
  // all but the contact face is a polygon with corners on the circle
  report_between("  missing volume, 3 x 3 elements",
                 -errors[0].volume,
                 0.033,
                 0.035);
  for (unsigned int k = 0; k < 2; ++k)
    report_between("  falls with the mesh by",
                   errors[k].volume / errors[k + 1].volume,
                   3.9,
                   4.05);
}
