#include <debond/models/closed_forms.h>
#include <debond/models/foundation_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Debond
{
  Eigen::ArrayXd
  torque_of_points(const FoundationStiffness &stiffness,
                   const FrictionLawPointer  &friction,
                   const double               pressure,
                   const Eigen::ArrayXd      &angles)
  {
    double largest_radius = 0.;
    for (const FoundationStiffness::Point &point : stiffness.points)
      largest_radius = std::max(largest_radius, point.radius);
    Eigen::ArrayXd torques = Eigen::ArrayXd::Zero(angles.size());
    for (const FoundationStiffness::Point &point : stiffness.points)
      {
        if (point.area == 0. || point.radius < 1e-6 * largest_radius)
          continue; // nothing to add to the torque
        RigidBodiesTorsion::Parameters parameters;
        parameters.radius    = 2. * point.radius; // anything larger
        parameters.pressure  = pressure * point.pressure;
        parameters.stiffness = point.stiffness;
        parameters.phi_0     = point.phi_0;
        parameters.friction  = friction;
        if (!(point.pressure > 0. && point.stiffness > 0.) ||
            !RigidBodiesTorsion::has_unique_solution(parameters))
          return torques + std::numeric_limits<double>::quiet_NaN();
        const RigidBodiesTorsion model(parameters);
        torques +=
          point.area * point.radius * angles.unaryExpr([&](const double angle) {
            return model.traction(point.radius, angle);
          });
      }
    return torques;
  }



  namespace
  {
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
             (1. - std::min(stiffness.normal /
                              scene.interface.law().normal->initial_stiffness(),
                            stiffness.torsional /
                              scene.interface.tangential_stiffness()));
    }



    /** NaN if one of them is. */
    double
    largest_magnitude(const Eigen::ArrayXd &values)
    {
      return values.abs().maxCoeff<Eigen::PropagateNaN>();
    }
  } // namespace



  double
  foundation_error(const Scene                  &scene,
                   const std::vector<TorqueRow> &rows,
                   const FoundationStiffness    &stiffness,
                   const FoundationStiffness    &coarse,
                   const double                  cell_ratio)
  {
    Eigen::ArrayXd angles(rows.size()), torque(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        angles[i] = rows[i].angle_deg * M_PI / 180.;
        torque[i] = rows[i].torque_Nmm;
      }
    const double pressure = rows.back().pressure_MPa;
    const double coarse_pressure =
      scene.chuck.component[ChuckComponent::translation_z].loaded ?
        pressure :
        pressure * coarse.normal / stiffness.normal;

    // With the points as they are, and with the same torsional stiffness
    // and pressure everywhere: on the same points, so that errors of the
    // quadrature cancel.
    const auto torques = [&](const FoundationStiffness &points,
                             const double               mean_pressure) {
      return torque_of_points(points,
                              scene.interface.friction,
                              mean_pressure,
                              angles);
    };
    const auto uniform = [&](FoundationStiffness points,
                             const double        torsional,
                             const double        mean_pressure) {
      for (FoundationStiffness::Point &point : points.points)
        {
          point.pressure  = 1.;
          point.stiffness = torsional;
        }
      return torques(points, mean_pressure);
    };
    const Eigen::ArrayXd uniform_fine =
      uniform(stiffness, stiffness.torsional, pressure);
    const Eigen::ArrayXd distribution =
      torques(stiffness, pressure) - uniform_fine;
    const Eigen::ArrayXd distribution_on_coarse =
      torques(coarse, coarse_pressure) -
      uniform(coarse, coarse.torsional, coarse_pressure);
    const double from_mesh =
      largest_magnitude(uniform(stiffness, coarse.torsional, coarse_pressure) -
                        uniform_fine) +
      largest_magnitude(distribution_on_coarse - distribution);
    return (2. * largest_magnitude(distribution) +
            from_mesh / (cell_ratio - 1.)) /
             torque.abs().maxCoeff() +
           share_of_strains(scene, stiffness, pressure);
  }
} // namespace Debond
