#include <debond/models/closed_forms.h>
#include <debond/models/foundation_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Debond
{
  std::vector<double>
  torque_of_points(const FoundationStiffness &stiffness,
                   const FrictionParameters  &friction,
                   const double               pressure,
                   const std::vector<double> &angles)
  {
    double largest_radius = 0.;
    for (const FoundationStiffness::Point &point : stiffness.points)
      largest_radius = std::max(largest_radius, point.radius);
    const double        tiny = 1e-6 * largest_radius;
    std::vector<double> torques(angles.size(), 0.);
    for (const FoundationStiffness::Point &point : stiffness.points)
      {
        if (point.area == 0. || point.radius < tiny)
          continue; // nothing to add to the torque
        RigidBodiesTorsion::Parameters parameters;
        parameters.radius             = 2. * point.radius; // anything larger
        parameters.push_in            = 1.;
        parameters.normal_penalty     = pressure * point.pressure;
        parameters.tangential_penalty = point.stiffness;
        parameters.phi_0              = point.phi_0;
        parameters.friction           = friction;
        if (!(point.pressure > 0. && point.stiffness > 0.) ||
            !RigidBodiesTorsion::has_unique_solution(parameters))
          return std::vector<double>(angles.size(),
                                     std::numeric_limits<double>::quiet_NaN());
        const RigidBodiesTorsion model(parameters);
        for (std::size_t i = 0; i < angles.size(); ++i)
          torques[i] +=
            point.area * point.radius * model.traction(point.radius, angles[i]);
      }
    return torques;
  }



  namespace
  {
    /** The same points with the same pressure and @p torsional stiffness
     *  [MPa/mm] everywhere. */
    FoundationStiffness
    with_uniform_points(FoundationStiffness stiffness, const double torsional)
    {
      for (FoundationStiffness::Point &point : stiffness.points)
        {
          point.pressure  = 1.;
          point.stiffness = torsional;
        }
      return stiffness;
    }



    /** Bound of what large strains change of the stiffness: the largest strain
     *  times the share that the bodies have in the compliance. */
    double
    share_of_strains(const Scene               &scene,
                     const FoundationStiffness &stiffness,
                     const double               pressure)
    {
      double strain = 0., largest_ratio = 0.;
      for (const FoundationStiffness::Point &point : stiffness.points)
        largest_ratio = std::max(largest_ratio, point.pressure);
      for (const BodyParameters *const body : {&scene.bone, &scene.implant})
        if (body->material == Material::neo_hookean)
          strain =
            std::max(strain,
                     2. * largest_ratio * pressure / body->young_modulus);
      return strain *
             (1. - std::min(stiffness.normal / scene.interface.normal_penalty,
                            stiffness.torsional /
                              scene.interface.tangential_stiffness()));
    }



    /** NaN if one of them is. */
    double
    largest_magnitude(const std::vector<double> &values)
    {
      double largest = 0.;
      for (const double value : values)
        {
          if (std::isnan(value))
            return value;
          largest = std::max(largest, std::abs(value));
        }
      return largest;
    }



    std::vector<double>
    difference(std::vector<double> a, const std::vector<double> &b)
    {
      for (std::size_t i = 0; i < a.size(); ++i)
        a[i] -= b[i];
      return a;
    }
  } // namespace



  double
  foundation_error(const Scene                  &scene,
                   const std::vector<TorqueRow> &rows,
                   const FoundationStiffness    &stiffness,
                   const FoundationStiffness    &coarse,
                   const double                  cell_ratio)
  {
    const double pressure = rows.back().pressure_MPa;
    const double coarse_pressure =
      scene.chuck.component[ChuckComponent::translation_z].loaded ?
        pressure :
        pressure * coarse.normal / stiffness.normal;
    std::vector<double> angles;
    double              T_max = 0.;
    for (const TorqueRow &row : rows)
      {
        angles.push_back(row.angle_deg * M_PI / 180.);
        T_max = std::max(T_max, std::abs(row.torque_Nmm));
      }

    // all on the same points, so that errors of the quadrature cancel
    const auto torques = [&](const FoundationStiffness &points,
                             const double               mean_pressure) {
      return torque_of_points(points,
                              scene.interface.friction,
                              mean_pressure,
                              angles);
    };
    const auto uniform =
      torques(with_uniform_points(stiffness, stiffness.torsional), pressure);
    const auto uniform_of_coarse =
      torques(with_uniform_points(stiffness, coarse.torsional),
              coarse_pressure);
    const auto distribution = difference(torques(stiffness, pressure), uniform);
    const auto distribution_on_coarse =
      difference(torques(coarse, coarse_pressure),
                 torques(with_uniform_points(coarse, coarse.torsional),
                         coarse_pressure));

    const double from_mesh =
      largest_magnitude(difference(uniform_of_coarse, uniform)) +
      largest_magnitude(difference(distribution_on_coarse, distribution));
    return (2. * largest_magnitude(distribution) +
            from_mesh / (cell_ratio - 1.)) /
             T_max +
           share_of_strains(scene, stiffness, pressure);
  }
} // namespace Debond
