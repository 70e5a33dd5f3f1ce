// Splines on cells that follow the rim: a uniform strain leaves forces inside
// that fall with the cells (rational functions under 3 x 3 x 3 points), the sum
// of all forces vanishes, and the volume of a coin comes to its exact value;
// what is held of a block is its bottom and the normal directions of its sides.

#include <debond/bulk/bulk_space.h>
#include <debond/bulk/enriched_cells.h>
#include <debond/bulk/neo_hookean.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

#include "checks.h"
#include "uniform_strain.h"

using namespace Debond;

struct Error
{
  double inside = 0., sum = 0., volume = 0.;
};

Error
patch_test(const BodyParameters &body, const Side side, const double volume)
{
  const BulkSpace       mesh(body, side);
  const EnrichedCells   cells(mesh, NeoHookean::from_young(18000., 0.3));
  const Eigen::VectorXd force = forces_of_uniform_strain(mesh, cells);
  Error                 error;
  Eigen::Vector3d       sum     = Eigen::Vector3d::Zero();
  const double          largest = force.lpNorm<Eigen::Infinity>(),
               half             = 0.5 * std::min(body.size[0], body.size[1]);
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    {
      const Eigen::Vector3d X = mesh.reference_position(node);
      sum += force.segment<3>(3 * node);
      const bool is_inside =
        std::abs(X[2]) > 1e-6 && std::abs(X[2]) < body.thickness() - 1e-6 &&
        (side == Side::implant ?
           X.head<2>().norm() < 0.999 * body.radius :
           X.head<2>().lpNorm<Eigen::Infinity>() < half - 1e-6);
      if (is_inside)
        grow(error.inside, force.segment<3>(3 * node).norm() / largest);
    }
  error.sum    = sum.norm() / largest;
  error.volume = std::abs(cells.volume() / volume - 1.);
  return error;
}

void
check(const std::string &name,
      BodyParameters     coarse,
      const Side         side,
      const double       volume)
{
  BodyParameters fine = coarse;
  for (unsigned int &n : fine.fitted_cells)
    n *= 2;
  const Error one   = patch_test(coarse, side, volume),
              other = patch_test(fine, side, volume);
  std::cout << name << std::endl;
  report("  forces inside, of the largest", one.inside, 1e-3);
  report("  less than a quarter with half the size",
         4. * other.inside / one.inside,
         1.);
  report("  sum of all forces", other.sum, 1e-11);
  report("  volume", one.volume, 1e-5);
  report("  its order", 3.5 - std::log2(one.volume / other.volume), 0.);
}

void
check_supports(const BodyParameters &bone)
{
  const BulkSpace mesh(bone, Side::bone);
  unsigned int    wrong = 0;
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    {
      const Eigen::Vector3d X         = mesh.reference_position(node);
      const bool            is_bottom = std::abs(X[2] + bone.size[2]) < 1e-9;
      for (unsigned int c = 0; c < 3; ++c)
        wrong +=
          mesh.is_fixed(node, c) !=
          (is_bottom ||
           (c < 2 && std::abs(std::abs(X[c]) - 0.5 * bone.size[c]) < 1e-9));
    }
  report("bottom and sides are held, and nothing else", wrong == 0);
}

/** A modulus that depends on the place is that of the Gauss points. */
void
check_modulus(BodyParameters bone)
{
  bone.modulus_expression = "18000 * (1 + 0.05 * x - 0.01 * y * z)";
  bone.read_modulus(1.);
  const BulkSpace         mesh(bone, Side::bone);
  const EnrichedCells     cells(mesh, NeoHookean());
  const dealii::QGauss<3> quadrature(cells.n_along());
  double                  difference = 0.;
  for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        const Eigen::Vector3d X =
          CellFunctions(mesh, mesh.cells()[cell]).position(quadrature.point(q));
        grow(difference,
             std::abs(cells.stiffness_factors(cell)[q] * bone.young_modulus -
                      18000. * (1. + 0.05 * X[0] - 0.01 * X[1] * X[2])));
      }
  report("a modulus by the place [MPa]", difference, 1e-8);
}



int
main()
{
  BodyParameters coin = BodyParameters::default_implant(), bone;
  coin.element = bone.element = ElementKind::spline;
  coin.fitted_cells           = {{8, 2, 0}};
  coin.cells[2]               = 2;
  bone.fitted_cells           = {{8, 2, 3}};
  bone.cells[2]               = 2;
  bone.rim                    = {{coin.radius, coin.radius}};
  bone.size                   = {{12.5, 10., 5.}};
  check("coin",
        coin,
        Side::implant,
        M_PI * coin.radius * coin.radius * coin.height);
  check("bone", bone, Side::bone, bone.size[0] * bone.size[1] * bone.size[2]);
  check_supports(bone);
  check_modulus(bone);
}
