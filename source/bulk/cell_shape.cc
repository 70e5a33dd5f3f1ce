#include <debond/bulk/cell_shape.h>

namespace Debond
{
  std::array<double, 4>
  bilinear(const double xi, const double eta)
  {
    const double x = 0.5 * (1. + xi), y = 0.5 * (1. + eta);
    return {{(1. - x) * (1. - y), x * (1. - y), (1. - x) * y, x * y}};
  }



  std::array<double, n_corners>
  trilinear(const Eigen::Vector3d &point)
  {
    const auto                    L     = bilinear(point[0], point[1]);
    const double                  upper = 0.5 * (1. + point[2]);
    std::array<double, n_corners> N;
    for (unsigned int a = 0; a < n_corners; ++a)
      N[a] = (a < 4 ? 1. - upper : upper) * L[a % 4];
    return N;
  }



  Eigen::Vector2d
  parameters_at(const std::array<Eigen::Vector2d, 2> &bounds,
                const double                          xi,
                const double                          eta)
  {
    const Eigen::Array2d t = 0.5 * (Eigen::Array2d(xi, eta) + 1.);
    return (1. - t) * bounds[0].array() + t * bounds[1].array();
  }



  CellShape
  shape_functions(const BodyMesh        &mesh,
                  const BodyMesh::Cell  &cell,
                  const Eigen::Vector3d &point)
  {
    CellShape shape;
    // a function of the face, its value and derivatives, times one of the third
    // coordinate
    const auto add = [&shape](const Eigen::Array3d &face,
                              const double          share,
                              const double          slope) {
      shape.N.push_back(share * face[0]);
      shape.derivative.emplace_back(share * face[1],
                                    share * face[2],
                                    slope * face[0]);
    };
    const auto add_bilinear = [&](const double share, const double slope) {
      const auto L = bilinear(point[0], point[1]);
      for (unsigned int a = 0; a < 4; ++a)
        {
          const Eigen::Vector3d s = corner(a);
          add({L[a],
               0.25 * s[0] * (1. + s[1] * point[1]),
               0.25 * s[1] * (1. + s[0] * point[0])},
              share,
              slope);
        }
    };

    const double upper = 0.5 * (1. + point[2]);
    if (!cell.enriched && !mesh.has_splines())
      {
        add_bilinear(1. - upper, -0.5);
        add_bilinear(upper, 0.5);
        return shape;
      }
    const double outward = mesh.outward_sign();
    const double near    = outward > 0. ? upper : 1. - upper;
    const auto   bounds  = mesh.surface().element_bounds(cell.surface_element);
    const Eigen::Vector2d half = 0.5 * (bounds[1] - bounds[0]);
    SurfaceBasis          basis;
    mesh.surface().evaluate_in_element(cell.surface_element,
                                       parameters_at(bounds,
                                                     point[0],
                                                     point[1]),
                                       basis,
                                       false);
    const auto add_level = [&](const double share, const double slope) {
      for (unsigned int a = 0; a < basis.size; ++a)
        add({basis.N[a], basis.N_1[a] * half[0], basis.N_2[a] * half[1]},
            share,
            slope);
    };
    if (mesh.has_splines())
      {
        const auto  &ends  = mesh.depth().breakpoints();
        const double begin = ends[cell.layer], end = ends[cell.layer + 1];
        const auto   splines =
          mesh.depth().evaluate(cell.layer, near * begin + (1. - near) * end);
        for (unsigned int k = 0; k <= mesh.depth().degree(); ++k)
          add_level(splines.B[k],
                    -0.5 * outward * (end - begin) * splines.dB[k]);
        return shape;
      }
    add_level(near, 0.5 * outward);
    add_bilinear(1. - near, -0.5 * outward);
    return shape;
  }
} // namespace Debond
