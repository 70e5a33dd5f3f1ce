#pragma once

// What tests of VTU files share: linear bodies under a uniform strain.

#include <debond/bulk/body.h>

#include <memory>

/** Displacement gradient in the frame of the body. */
inline const Eigen::Matrix3d uniform_gradient =
  (Eigen::Matrix3d() << 1., -2., 0.5, 0.3, -1.2, 2., 0.7, 0.2, -0.4)
    .finished() *
  1e-3;

inline std::unique_ptr<Debond::Body>
strained_body(Debond::BodyParameters parameters, const Debond::Side side)
{
  parameters.material           = Debond::Material::linear;
  auto                     body = Debond::make_body(parameters, side);
  const Debond::BulkSpace &mesh = body->mesh();
  Eigen::VectorXd          v(3 * mesh.n_nodes());
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    v.segment<3>(3 * node) = uniform_gradient * mesh.reference_position(node);
  body->correct(v);
  return body;
}
