#include <debond/allowed_values.h>
#include <debond/bonding_pattern.h>

#include <deal.II/base/parameter_handler.h>

#include <Eigen/Geometry>

namespace Debond
{
  namespace
  {
    /** Entries of patterns that a later version brings: known, so that their
     *  defaults may be written down, but refused with any other value. */
    void
    declare_reserved_entries(dealii::ParameterHandler &prm)
    {
      prm.declare_entry("Seed",
                        "1",
                        Allowed::only("1"),
                        "Reserved: seed of the pattern random.");
      prm.declare_entry("Correlation length",
                        "0",
                        Allowed::only("0"),
                        "Reserved: correlation length [mm] of the pattern "
                        "random.");
      prm.declare_entry("Expression",
                        "1",
                        Allowed::only("1"),
                        "Reserved: phi_0 as an expression in x, y, r [mm] and "
                        "angle for the pattern expression.");
      prm.declare_entry("File",
                        "",
                        Allowed::only(""),
                        "Reserved: image or CSV file of the patterns image and "
                        "file.");
      prm.declare_entry("Threshold",
                        "-1",
                        Allowed::only("-1"),
                        "Reserved: grey level above which a pixel of the "
                        "pattern image is bonded.");
    }
  } // namespace



  void
  BondingParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Bonding");
    prm.declare_entry(
      "Pattern",
      "homogeneous",
      Allowed::choice("homogeneous | disk",
                      "annulus | random | expression | image | file"),
      "Where the implant's contact face is bonded at the start (phi_0, in "
      "reference coordinates). `homogeneous': everywhere. `disk': inside the "
      "concentric disk that holds Bonded fraction of the area of a coin or a cap.");
    prm.declare_entry("Initial bonding",
                      "1",
                      Allowed::number_between(0, 1, ""),
                      "Degree of osseointegration phi_0 of bonded points, "
                      "dimensionless: multiplies every pattern.");
    prm.declare_entry("Bonded fraction",
                      "1",
                      Allowed::number_between(0, 1, ""),
                      "Bonded part f of the area, dimensionless. Pattern disk: "
                      "r <= R sqrt(f). Must be 1 for the pattern homogeneous.");
    prm.declare_entry("Resolution",
                      "element",
                      Allowed::choice("element | quadrature point"),
                      "phi_0 is constant on each surface element of the "
                      "implant, or evaluated at each quadrature point.");
    declare_reserved_entries(prm);
    prm.leave_subsection();
  }



  void
  BondingParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Bonding");
    pattern         = prm.get("Pattern") == "disk" ? BondingPatternKind::disk :
                                                     BondingPatternKind::homogeneous;
    initial_bonding = prm.get_double("Initial bonding");
    bonded_fraction = prm.get_double("Bonded fraction");
    resolution      = prm.get("Resolution") == "element" ?
                        BondingResolution::element :
                        BondingResolution::quadrature_point;
    prm.leave_subsection();
  }
} // namespace Debond

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Debond
{
  std::vector<SurfaceQuadraturePoint>
  surface_quadrature(const NurbsSurface &surface, const unsigned int n)
  {
    const dealii::QGauss<2>             gauss(n);
    std::vector<SurfaceQuadraturePoint> points;
    points.reserve(surface.n_elements() * gauss.size());
    for (unsigned int element = 0; element < surface.n_elements(); ++element)
      {
        const auto            bounds = surface.element_bounds(element);
        const Eigen::Vector2d size   = bounds[1] - bounds[0];
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            SurfaceQuadraturePoint point;
            point.element = element;
            point.xi =
              bounds[0] + size.cwiseProduct(Eigen::Vector2d(gauss.point(q)[0],
                                                            gauss.point(q)[1]));
            surface.evaluate_in_element(element, point.xi, point.basis, false);
            Eigen::Vector3d a1 = Eigen::Vector3d::Zero(), a2 = a1;
            point.X = Eigen::Vector3d::Zero();
            for (unsigned int a = 0; a < point.basis.size; ++a)
              {
                const auto P =
                  surface.control_points().col(point.basis.control_point[a]);
                point.X += point.basis.N[a] * P;
                a1 += point.basis.N_1[a] * P;
                a2 += point.basis.N_2[a] * P;
              }
            point.JxW = a1.cross(a2).norm() * size.prod() * gauss.weight(q);
            points.push_back(point);
          }
      }
    return points;
  }



  namespace
  {
    // A part of the surface that has one phi_0: an element or a quadrature
    // point.
    struct Part
    {
      double          area   = 0;
      double          radius = 0; ///< of the centroid
      double          phi_0  = 0;
      Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    };



    // phi_0 = 1 for the parts nearest to the centre that make up the bonded
    // fraction of the area.
    void
    bond_disk(std::vector<Part> &parts, const double bonded_fraction)
    {
      std::vector<unsigned int> order(parts.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](unsigned int a, unsigned int b) {
                         return parts[a].radius < parts[b].radius;
                       });
      double remaining = 0., size = 0.;
      for (const Part &part : parts)
        {
          remaining += bonded_fraction * part.area;
          size = std::max(size, part.radius);
        }
      for (unsigned int first = 0; first < order.size();)
        {
          unsigned int last = first;
          double       area = 0.;
          for (; last < order.size() &&
                 parts[order[last]].radius - parts[order[first]].radius <=
                   1e-9 * size;
               ++last)
            area += parts[order[last]].area;
          const double share = std::clamp(remaining / area, 0., 1.);
          for (; first < last; ++first)
            parts[order[first]].phi_0 = share;
          remaining -= area;
        }
    }
  } // namespace



  BondingPattern::BondingPattern(const BondingParameters &parameters,
                                 const NurbsSurface      &implant,
                                 const unsigned int       n)
    : surface(implant)
    , n(n)
  {
    const auto points  = surface_quadrature(surface, n);
    const auto part_of = [&](const unsigned int point) {
      return parameters.resolution == BondingResolution::element ?
               points[point].element :
               point;
    };
    std::vector<Part> parts(part_of(points.size() - 1) + 1);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        Part &part = parts[part_of(q)];
        part.area += points[q].JxW;
        part.moment += points[q].JxW * points[q].X.head<2>();
      }
    for (Part &part : parts)
      part.radius = part.moment.norm() / part.area;

    switch (parameters.pattern)
      {
        case BondingPatternKind::homogeneous:
          for (Part &part : parts)
            part.phi_0 = 1.;
          break;
        case BondingPatternKind::disk:
          bond_disk(parts, parameters.bonded_fraction);
          break;
      }

    for (unsigned int q = 0; q < points.size(); ++q)
      {
        phi_0.push_back(parameters.initial_bonding * parts[part_of(q)].phi_0);
        total_area += points[q].JxW;
        area_mean += phi_0[q] * points[q].JxW;
      }
    area_mean /= total_area;

    const dealii::QGauss<1> gauss(n);
    for (unsigned int q = 0; q < n; ++q)
      shares.push_back((q == 0 ? 0. : shares.back()) + gauss.weight(q));
  }



  double
  BondingPattern::at(const Eigen::Vector2d &xi) const
  {
    const unsigned int          element = surface.element_of(xi);
    const auto                  bounds  = surface.element_bounds(element);
    std::array<unsigned int, 2> index;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const double local =
          (xi[d] - bounds[0][d]) / (bounds[1][d] - bounds[0][d]);
        index[d] = std::min<unsigned int>(n - 1,
                                          std::lower_bound(shares.begin(),
                                                           shares.end(),
                                                           local) -
                                            shares.begin());
      }
    return phi_0[element * n * n + index[1] * n + index[0]];
  }
} // namespace Debond
