// Stress at the vertices, for pictures: exact where the strain is uniform, in
// curved cells too, and where it varies linearly within the cells of a block
// (which tells whether every corner gets its own value). Zero in a rigid body.

#include <debond/bulk/body.h>

#include <cmath>
#include <iostream>
#include <string>

#include "cauchy_stress.h"
#include "checks.h"

using namespace Debond;

/** Largest relative deviation of a body's stresses from those that belong to
 *  the displacement @p u with the gradient @p H, both functions of X. */
template <typename Displacement, typename Gradient>
double
deviation(const BodyParameters &parameters,
          const Side            side,
          const Displacement   &u,
          const Gradient       &H)
{
  const auto      body = make_body(parameters, side);
  Eigen::VectorXd v(3 * body->mesh().n_nodes());
  for (unsigned int node = 0; node < body->mesh().n_nodes(); ++node)
    v.segment<3>(3 * node) = u(body->mesh().reference_position(node));
  const std::vector<Eigen::Matrix3d> stress = body->vertex_stress(v);

  const NeoHookean material =
    NeoHookean::from_young(parameters.young_modulus, parameters.poisson_ratio);
  double largest = 0, scale = 0;
  for (unsigned int vertex = 0; vertex < stress.size(); ++vertex)
    {
      const Eigen::Matrix3d gradient =
        H(body->mesh().reference_position(vertex));
      const Eigen::Matrix3d expected = parameters.material == Material::linear ?
                                         hooke_stress(material, gradient) :
                                         neo_hookean_stress(material, gradient);
      const double          difference = (stress[vertex] - expected).norm();
      if (!std::isnan(largest) && !(difference <= largest))
        largest = difference;
      scale = std::max(scale, expected.norm());
    }
  return largest / scale;
}



BodyParameters
block()
{
  BodyParameters parameters;
  parameters.size          = {{4, 3, 2}};
  parameters.cells         = {{3, 4, 3}};
  parameters.layer_grading = 1.5;
  return parameters;
}



BodyParameters
coin()
{
  BodyParameters parameters;
  parameters.shape = BodyShape::coin;
  parameters.cells = {{3, 3, 2}};
  return parameters;
}



int
main()
{
  Eigen::Matrix3d H;
  H << 1, -2, 3, 4, 5, -6, -7, 8, 9;
  H *= 1e-2;
  const auto uniform = [&H](const Eigen::Vector3d &X) -> Eigen::Vector3d {
    return H * X;
  };
  const auto uniform_gradient = [&H](const Eigen::Vector3d &) { return H; };
  // products of different coordinates are within reach of trilinear cells, and
  // vanish on the contact face
  const auto bending = [](const Eigen::Vector3d &X) {
    return Eigen::Vector3d(1e-3 * X[0] * X[2], -2e-3 * X[1] * X[2], 0);
  };
  const auto bending_gradient = [](const Eigen::Vector3d &X) {
    Eigen::Matrix3d gradient;
    gradient << X[2], 0, X[0], 0, -2 * X[2], -2 * X[1], 0, 0, 0;
    return Eigen::Matrix3d(1e-3 * gradient);
  };

  for (const Side side : {Side::bone, Side::implant})
    {
      std::cout << name_of(side) << std::endl;
      for (const Material material : {Material::linear, Material::neo_hookean})
        for (BodyParameters parameters : {block(), coin()})
          {
            parameters.material = material;
            report("  deviation under uniform strain",
                   deviation(parameters, side, uniform, uniform_gradient),
                   1e-12);
            // strains of 1e-9, which F - I knows to 1e-7 only
            report("  deviation under small uniform strain",
                   deviation(
                     parameters,
                     side,
                     [&H](const Eigen::Vector3d &X) -> Eigen::Vector3d {
                       return 1e-8 * H * X;
                     },
                     [&H](const Eigen::Vector3d &) { return 1e-8 * H; }),
                   1e-12);
          }
      BodyParameters parameters = block();
      parameters.material       = Material::linear;
      report("  deviation under linear strain",
             deviation(parameters, side, bending, bending_gradient),
             1e-12);
    }

  BodyParameters parameters = block();
  parameters.material       = Material::rigid;
  const auto body           = make_body(parameters, Side::bone);
  double     sum            = 0;
  for (const Eigen::Matrix3d &stress :
       body->vertex_stress(Eigen::VectorXd::Zero(3 * body->mesh().n_nodes())))
    sum += stress.norm();
  report("stress of a rigid body", sum, 1e-300);

  Eigen::Matrix3d shear = 2. * Eigen::Matrix3d::Identity();
  shear(0, 1) = shear(1, 0) = 3;
  report("deviation of the equivalent stress of shear under pressure",
         std::abs(von_mises(shear) - 3. * std::sqrt(3.)),
         1e-14);
}
