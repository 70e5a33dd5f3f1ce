// The bonding pattern `disk` meets the bonded fraction of the area, by element
// and by quadrature point, bonds what is nearest to the centre, keeps the
// symmetry of the mesh, and says the same at quadrature points and between.

#include <debond/interface/bonding_pattern.h>
#include <debond/shapes/body_parameters.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "checks.h"

using namespace Debond;

// of radius 2.5 mm
const BodyParameters coin;



struct Deviation
{
  double fraction = 0, mean = 0, symmetry = 0, position = 0, between = 0;
  bool   in_range = true, one_share = true, sorted = true;
};



/** Points and elements by the distance of their centroids from the centre:
 *  first all with phi_0, then one group that shares, then none. */
void
check_order(const std::vector<SurfaceQuadraturePoint> &points,
            const BondingPattern                      &pattern,
            const BondingParameters                   &parameters,
            Deviation                                 &deviation)
{
  struct Part
  {
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    double          area = 0, phi_0 = 0;
  };
  std::map<unsigned int, Part> parts;
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      Part &part = parts[parameters.resolution == BondingResolution::element ?
                           points[q].element :
                           q];
      part.moment += points[q].JxW * points[q].X.head<2>();
      part.area += points[q].JxW;
      if (part.area > points[q].JxW && part.phi_0 != pattern.at(q))
        deviation.sorted = false; // not constant on an element
      part.phi_0 = pattern.at(q);
    }
  double bonded_to = 0, open_from = 1e9, shared_from = 1e9, shared_to = 0;
  for (const auto &[index, part] : parts)
    {
      const double r     = part.moment.norm() / part.area;
      const double share = part.phi_0 / parameters.initial_bonding;
      if (share == 1.)
        bonded_to = std::max(bonded_to, r);
      else if (share == 0.)
        open_from = std::min(open_from, r);
      else
        {
          shared_from = std::min(shared_from, r);
          shared_to   = std::max(shared_to, r);
        }
      deviation.in_range = deviation.in_range && share >= 0. && share <= 1.;
    }
  deviation.sorted = deviation.sorted && bonded_to < open_from;
  if (shared_from < 1e9)
    {
      deviation.one_share =
        deviation.one_share && shared_to - shared_from < 1e-8;
      deviation.sorted =
        deviation.sorted && bonded_to < shared_from && shared_to < open_from;
    }
}



void
check(const unsigned int n, const BondingResolution resolution)
{
  const unsigned int n_q     = 5;
  const double       R       = 2.5;
  const NurbsSurface surface = NurbsSurface::disk(R, n);
  const auto points = surface_quadrature(surface, dealii::QGauss<1>(n_q));

  // number of the i-th point in one, the j-th in the other direction
  const auto number = [&](const unsigned int i, const unsigned int j) {
    return ((j / n_q) * n + i / n_q) * n_q * n_q + (j % n_q) * n_q + i % n_q;
  };
  Deviation deviation;
  for (const double fraction :
       {0., 1e-3, 0.1, 0.25, 1. / 3., 0.5, 0.77, 0.999, 1.})
    {
      BondingParameters parameters;
      parameters.pattern         = BondingPatternKind::disk;
      parameters.bonded_fraction = fraction;
      parameters.initial_bonding = (fraction == 0.5 ? 0.6 : 1.);
      parameters.resolution      = resolution;
      const BondingPattern pattern(parameters,
                                   coin,
                                   surface,
                                   dealii::QGauss<1>(n_q));

      double bonded = 0, area = 0;
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          bonded += points[q].JxW * pattern.at(q);
          area += points[q].JxW;
          grow(deviation.between,
               std::abs(pattern.at(q) - pattern.at(points[q].xi)));
        }
      const double expected = fraction * parameters.initial_bonding;
      grow(deviation.fraction, std::abs(bonded / area - expected));
      grow(deviation.mean, std::abs(pattern.report().mean - expected));
      grow(deviation.mean, std::abs(pattern.report().area / area - 1.));

      for (unsigned int j = 0; j < n * n_q; ++j)
        for (unsigned int i = 0; i < n * n_q; ++i)
          {
            const unsigned int q = number(i, j);
            const unsigned int r = number(n * n_q - 1 - j, i);
            grow(deviation.position,
                 (points[r].X -
                  Eigen::Vector3d(-points[q].X[1], points[q].X[0], 0.))
                     .norm() /
                   R);
            grow(deviation.symmetry, std::abs(pattern.at(q) - pattern.at(r)));
          }
      check_order(points, pattern, parameters, deviation);
    }

  std::cout << n << " x " << n << " elements, by "
            << (resolution == BondingResolution::element ? "element" :
                                                           "quadrature point")
            << std::endl;
  report("  deviation of the bonded fraction", deviation.fraction, 1e-12);
  report("  deviation of mean and area", deviation.mean, 1e-12);
  report("  quadrature points turned by 90 degrees, deviation",
         deviation.position,
         1e-13);
  report("  phi_0 turned by 90 degrees, deviation", deviation.symmetry, 1e-14);
  report("  phi_0 in its range", deviation.in_range);
  report("  nearest to the centre first", deviation.sorted);
  report("  those that share have one radius", deviation.one_share);
  report("  points and places between them agree, deviation",
         deviation.between,
         1e-15);
}



int
main()
{
  for (const unsigned int n : {3, 6, 20})
    for (const BondingResolution resolution :
         {BondingResolution::element, BondingResolution::quadrature_point})
      check(n, resolution);

  const NurbsSurface surface = NurbsSurface::disk(2.5, 3);
  BondingParameters  parameters;
  parameters.initial_bonding = 0.4;
  const BondingPattern homogeneous(parameters,
                                   coin,
                                   surface,
                                   dealii::QGauss<1>(5));
  report("Homogeneous: mean, deviation",
         std::abs(homogeneous.report().mean - 0.4),
         1e-14);
  report("Area of the disk by quadrature, relative deviation",
         std::abs(homogeneous.report().area / (M_PI * 2.5 * 2.5) - 1.),
         1e-6);

  // between quadrature points each stands for a share of its element, so that
  // the mean over a fine grid comes close to the fraction as well
  parameters.pattern         = BondingPatternKind::disk;
  parameters.bonded_fraction = 0.3;
  parameters.resolution      = BondingResolution::quadrature_point;
  const BondingPattern pattern(parameters, coin, surface, dealii::QGauss<1>(5));
  double               mean    = 0;
  const unsigned int   samples = 400;
  for (unsigned int j = 0; j < samples; ++j)
    for (unsigned int i = 0; i < samples; ++i)
      {
        const Eigen::Vector2d xi((i + 0.5) / samples, (j + 0.5) / samples);
        SurfaceBasis          basis;
        surface.evaluate(xi, basis);
        Eigen::Vector3d a1 = Eigen::Vector3d::Zero(), a2 = a1;
        for (unsigned int a = 0; a < basis.size; ++a)
          {
            const auto P = surface.control_points().col(basis.control_point[a]);
            a1 += basis.N_1[a] * P;
            a2 += basis.N_2[a] * P;
          }
        mean += (a1[0] * a2[1] - a1[1] * a2[0]) * pattern.at(xi) /
                (samples * samples * M_PI * 2.5 * 2.5);
      }
  report("Mean over the area between the points, relative deviation",
         std::abs(mean / 0.12 - 1.),
         0.02);
}
