// What VTU files hold of bodies of splines: curved cells, by which the coin is
// round between the corners of its cells, with their points in the order that
// readers expect; a uniform strain and its stress, as quadratic splines have it
// exactly.

#include <debond/bulk/body.h>
#include <debond/bulk/chuck.h>
#include <debond/output/bulk_fields.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "checks.h"
#include "strained_body.h"
#include "vtu_file.h"

using namespace Debond;

/** Cells across and layers. */
constexpr unsigned int n_bone = 5, n_coin = 3, n_layers = 2;



int
main()
{
  BodyParameters bone, coin;
  bone.cells   = {{n_bone, n_bone, n_layers}};
  coin.shape   = BodyShape::coin;
  bone.element = coin.element = ElementKind::spline;
  bone.layer_grading = coin.layer_grading = 1.5;
  coin.cells                              = {{n_coin, n_coin, n_layers}};
  const auto body_of_bone                 = strained_body(bone, Side::bone),
             body_of_coin                 = strained_body(coin, Side::implant);
  const Chuck       chuck(ChuckParameters(),
                    Eigen::Vector3d(0, 0, coin.height),
                    coin.radius);
  const std::string vtu =
    BulkFields({{body_of_bone.get(), body_of_coin.get()}}, chuck).vtu();

  const auto X = read_array(vtu, ""), u = read_array(vtu, "displacement"),
             stress          = read_array(vtu, "stress_MPa"),
             of              = read_array(vtu, "body");
  const unsigned int n_cells = n_layers * (n_bone * n_bone + n_coin * n_coin);
  report("27 points in each cell", of.size() == 27 * n_cells);
  // 72: VTK_LAGRANGE_HEXAHEDRON
  const auto         types = read_array<std::uint8_t>(vtu, "types");
  const unsigned int n_curved =
    std::count(types.begin(), types.end(), std::uint8_t(72));
  report("cells are curved", types.size() == n_cells && n_curved == n_cells);

  // Points 16 to 19 are the middles of the edges from one end face to the
  // other; up to version 2.1 of the format, which deal.II 9.4 writes, those of
  // the last two corners stand in the other order. ParaView mixes them up in
  // files of several pieces. Cells of the bone have straight edges.
  const auto has_version = [&vtu](const std::string &version) {
    return vtu.find("type=\"UnstructuredGrid\" version=\"" + version + "\"") !=
           std::string::npos;
  };
  const bool swapped = has_version("0.1");
  report("version of the format", swapped || has_version("2.2"));
  report("one piece", vtu.find("<Piece") == vtu.rfind("<Piece"));
  const auto points_of_cells = read_array<std::int32_t>(vtu, "connectivity");
  const auto place           = [&](const unsigned int i) {
    return Eigen::Map<const Eigen::Vector3f>(&X[3 * points_of_cells[i]]);
  };
  float misplaced = 0.;
  for (unsigned int cell = 0; cell < n_layers * n_bone * n_bone; ++cell)
    for (unsigned int edge = 0; edge < 4; ++edge)
      {
        const unsigned int corner = edge < 2 || !swapped ? edge : 5 - edge,
                           first  = 27 * cell;
        misplaced =
          std::max(misplaced,
                   (place(first + 16 + edge) -
                    (place(first + corner) + place(first + corner + 4)) / 2)
                     .norm());
      }
  report("points in the middle of edges [mm]", misplaced, 1e-6);

  double       displacement = 0., stresses = 0., outside = 0.;
  unsigned int n_on_side = 0;
  for (unsigned int i = 0; i < of.size(); ++i)
    {
      const Eigen::Vector3d
        x   = Eigen::Map<const Eigen::Vector3f>(&X[3 * i]).cast<double>(),
        u_x = Eigen::Map<const Eigen::Vector3f>(&u[3 * i]).cast<double>();
      grow(displacement, (u_x - uniform_gradient * x).norm());
      const BodyParameters &body = of[i] == 1 ? coin : bone;
      const double          E = body.young_modulus, nu = body.poisson_ratio;
      const Eigen::Matrix3d strain =
        0.5 * (uniform_gradient + uniform_gradient.transpose());
      const Eigen::Matrix3d expected =
        E / (1. + nu) *
        (strain +
         nu / (1. - 2. * nu) * strain.trace() * Eigen::Matrix3d::Identity());
      grow(stresses,
           (Eigen::Map<const Eigen::Matrix3f>(&stress[9 * i]).cast<double>() -
            expected)
               .norm() /
             expected.norm());
      if (of[i] == 1)
        {
          const double r = x.head<2>().norm();
          grow(outside, r - coin.radius);
          n_on_side += std::abs(r - coin.radius) < 1e-6;
        }
    }
  report("Displacement of a uniform strain [mm]", displacement, 1e-8);
  report("Its stress, relative", stresses, 1e-5);
  report("Coin beyond its radius [mm]", outside, 1e-6);
  // nine of each outer face; those of a corner cell's common edge belong to two
  // faces, but to one cell
  report("All points of the side are on the circle",
         n_on_side == n_layers * (4 * n_coin * 9 - 4 * 3));
}
