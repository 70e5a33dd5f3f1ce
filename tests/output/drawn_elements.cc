// What VTU files hold of bodies of all elements, and what bodies show at points
// that are asked for, against closed forms: both are uniformly strained, the
// modulus of the bone is linear in x, y and z, and so is its stress, which all
// elements have exactly; the frame of the coin has turned, and its stress with
// it.

#include <debond/bulk/body.h>
#include <debond/bulk/chuck.h>
#include <debond/output/body_points.h>
#include <debond/output/bulk_fields.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include "cauchy_stress.h"
#include "checks.h"
#include "strained_body.h"
#include "vtu_file.h"

using namespace Debond;

constexpr std::array<unsigned int, 3> n_bone{{6, 4, 3}};
constexpr unsigned int                n_coin = 3, n_layers = 2;

/** Of the bone [MPa]. */
double
modulus(const Eigen::Vector3d &X)
{
  return 5000. * (3. + X[0] / 10. + X[1] / 20. + X[2] / 30.);
}



/** The arrays of a file. */
struct Fields
{
  explicit Fields(const std::string &vtu)
    : X(read_array(vtu, ""))
    , u(read_array(vtu, "displacement"))
    , v(read_array(vtu, "displacement_in_frame"))
    , stress(read_array(vtu, "stress_MPa"))
    , mises(read_array(vtu, "von_Mises_MPa"))
    , body(read_array(vtu, "body"))
    , modulus(read_array(vtu, "young_modulus_MPa"))
    , types(read_array<std::uint8_t>(vtu, "types"))
    , offsets(read_array<std::int32_t>(vtu, "offsets"))
    , points(read_array<std::int32_t>(vtu, "connectivity"))
  {}

  Eigen::Vector3d
  vector(const std::vector<float> &values, const unsigned int i) const
  {
    return Eigen::Map<const Eigen::Vector3f>(&values[3 * i]).cast<double>();
  }

  const std::vector<float>        X, u, v, stress, mises, body, modulus;
  const std::vector<std::uint8_t> types;
  const std::vector<std::int32_t> offsets, points;
};



/** The modulus at the centre of the cell of the bone that has this point. */
double
modulus_of_cell(const BodyParameters &bone, const Eigen::Vector3d &point)
{
  const unsigned int layer = n_bone[2] * -point[2] / bone.thickness();
  Eigen::Vector3d    centre;
  for (unsigned int d = 0; d < 2; ++d)
    {
      const double wide  = bone.coarser_below && layer > 0 ? 2. : 1.,
                   width = wide * bone.width(d) / n_bone[d],
                   end   = -0.5 * bone.width(d);
      centre[d] = end + width * (std::floor((point[d] - end) / width) + 0.5);
    }
  centre[2] = -(layer + 0.5) * bone.thickness() / n_bone[2];
  return modulus(centre);
}



/** At points on the faces, on the rim (there is a corner of the disk, too,
 * where derivatives are singular) and inside, and where the body is not.
 *  @p E: of a point [MPa]. */
template <typename Modulus>
void
check_points(const std::string &name,
             const Body        &body,
             const Chuck       &chuck,
             const Modulus     &E)
{
  const BodyParameters &parameters = body.mesh().parameters();
  const bool            is_coin    = body.mesh().side() == Side::implant;
  const double depth = is_coin ? parameters.height : -parameters.thickness(),
               half  = is_coin ? parameters.radius : 0.5 * parameters.width(0);
  const double     corner = std::sqrt(0.5) * half;
  Eigen::Matrix3Xd points(3, 7);
  points << 0., half, 0.31 * half, -0.17 * half, -0.4 * half, corner, 0., //
    0., 0., -0.42 * half, 0.53 * half, 0.1 * half, corner, 0.,            //
    0.5 * depth, 0., 0., 0.31 * depth, depth, 0., 1.01 * depth;
  const Eigen::MatrixXd at = values_at_points(body, chuck, points);
  const Eigen::Matrix3d Q =
    is_coin ? chuck.rotation() : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  double displacement = 0., stress = 0.;
  for (unsigned int p = 0; p < 6; ++p)
    {
      const Eigen::Vector3d X = points.col(p), v = uniform_gradient * X;
      const Eigen::Matrix3d own =
        hooke_stress(NeoHookean::from_young(E(X), parameters.poisson_ratio),
                     uniform_gradient);
      grow(displacement,
           (at.col(p).head<3>() - (is_coin ? chuck.map(X, v) - X : v)).norm());
      grow(stress,
           (Eigen::Map<const Eigen::Matrix3d>(&at(3, p)) -
            Q * own * Q.transpose())
               .norm() /
             own.norm());
    }
  report("  displacement at points of the " + name + " [mm]",
         displacement,
         1e-9);
  report("  stress there, relative", stress, 1e-9);
  std::cout << "  beyond: " << at.col(6).head<3>().transpose() << std::endl;
}



void
check(const std::string &name, const ElementKind element, const bool coarser)
{
  BodyParameters bone, coin;
  bone.cells              = n_bone;
  bone.coarser_below      = coarser;
  bone.modulus_expression = "5000 * (3 + x / 10 + y / 20 + z / 30)";
  bone.young_modulus      = 5000.;
  coin.shape              = BodyShape::coin;
  coin.cells              = {{n_coin, n_coin, n_layers}};
  bone.element = coin.element = element;
  bone.read_modulus(1.);
  const auto body_of_bone = strained_body(bone, Side::bone),
             body_of_coin = strained_body(coin, Side::implant);
  ChuckParameters motion;
  motion.component[5].value = "30 * t";
  Chuck chuck(motion, Eigen::Vector3d(0, 0, coin.height), coin.radius);
  chuck.prescribe(1.);
  const Eigen::Matrix3d Q = chuck.rotation();
  const Fields          fields(
    BulkFields({{body_of_bone.get(), body_of_coin.get()}}, chuck).vtu());

  double displacement = 0., in_frame = 0., stress = 0., mises = 0.;
  for (unsigned int i = 0; i < fields.body.size(); ++i)
    {
      const bool            is_coin = fields.body[i] == 1;
      const Eigen::Vector3d X       = fields.vector(fields.X, i),
                            v       = uniform_gradient * X;
      const double          E       = is_coin ? coin.young_modulus : modulus(X);
      const BodyParameters &body    = is_coin ? coin : bone;
      const Eigen::Matrix3d own =
        hooke_stress(NeoHookean::from_young(E, body.poisson_ratio),
                     uniform_gradient);
      Eigen::Matrix3d in_space = own;
      if (is_coin)
        in_space = Q * own * Q.transpose();
      grow(displacement,
           (fields.vector(fields.u, i) - (is_coin ? chuck.map(X, v) - X : v))
             .norm());
      grow(in_frame, (fields.vector(fields.v, i) - v).norm());
      grow(stress,
           (Eigen::Map<const Eigen::Matrix3f>(&fields.stress[9 * i])
              .cast<double>() -
            in_space)
               .norm() /
             own.norm());
      grow(mises, std::abs(fields.mises[i] / von_mises(own) - 1.));
    }
  double       moduli = 0.;
  unsigned int first = 0, n_of_bone = 0;
  for (const unsigned int end : fields.offsets)
    {
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (unsigned int k = first; k < first + 8; ++k)
        centre += fields.vector(fields.X, fields.points[k]) / 8.;
      const unsigned int point   = fields.points[first];
      const bool         is_coin = fields.body[point] == 1;
      n_of_bone += !is_coin;
      grow(moduli,
           std::abs(fields.modulus[point] / (is_coin ?
                                               coin.young_modulus :
                                               modulus_of_cell(bone, centre)) -
                    1.));
      first = end;
    }
  std::cout << name << std::endl
            << "  cells of the bone: " << n_of_bone
            << ", of degree 2: " // VTK_LAGRANGE_HEXAHEDRON
            << std::count(fields.types.begin(), fields.types.end(), 72)
            << " of " << fields.types.size() << std::endl;
  report("  displacement [mm]", displacement, 1e-6);
  report("  displacement in the frame [mm]", in_frame, 1e-8);
  report("  stress, relative", stress, 1e-5);
  report("  stress of von Mises, relative", mises, 1e-5);
  report("  modulus, relative", moduli, 1e-6);
  check_points("bone", *body_of_bone, chuck, modulus);
  check_points("coin", *body_of_coin, chuck, [&](const Eigen::Vector3d &) {
    return coin.young_modulus;
  });
}



int
main()
{
  check("trilinear", ElementKind::trilinear, false);
  check("trilinear, coarser below", ElementKind::trilinear, true);
  check("quadratic", ElementKind::quadratic, false);
  check("quadratic, coarser below", ElementKind::quadratic, true);
  check("splines", ElementKind::spline, false);
}
