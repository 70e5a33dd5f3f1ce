#include <debond/models/closed_forms.h>
#include <debond/models/foundation.h>
#include <debond/models/simulation.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace Debond
{
  namespace
  {
    /** The scene with linear bodies and an interface that does not slip,
     * pressed by @p depth [mm] at time 1 and turned by @p angle [rad] at
     * time 2. */
    Scene
    sticking_scene(Scene scene, const double depth, const double angle)
    {
      for (BodyParameters *const body : {&scene.bone, &scene.implant})
        body->material = std::min(body->material, Material::linear);
      scene.interface.friction           = sticking_law();
      scene.interface.friction_starts_at = 0;
      scene.load_steps                   = LoadSteppingParameters();
      scene.load_steps.times             = {0., 1., 2.};
      scene.load_steps.steps             = {1, 1};
      scene.chuck                        = ChuckParameters();
      scene.chuck.component[ChuckComponent::translation_z].function =
        [depth](const double t) { return -depth * std::min(t, 1.); };
      scene.chuck.component[ChuckComponent::rotation_z].function =
        [angle](const double t) {
          return angle * 180. / M_PI * std::max(t - 1., 0.);
        };
      return scene;
    }



    /** Throws InputError if not all of the interface sticks in the next row. */
    const TorqueRow &
    next_row(Simulation &simulation)
    {
      try
        {
          simulation.advance();
          if (simulation.rows().back().share_stick < 1.)
            throw RunError("they do not touch all over");
        }
      catch (const RunError &error)
        {
          throw EntryError("Closed form",
                           "the stiffness of the foundation cannot be found "
                           "from the bodies of this scene: " +
                             std::string(error.what()));
        }
      return simulation.rows().back();
    }
  } // namespace



  FoundationStiffness
  foundation_stiffness(const Scene                     &scene,
                       std::shared_ptr<BodyPair> *const bodies)
  {
    if (bodies != nullptr && *bodies)
      (*bodies)->return_to_rest();
    const double R     = scene.implant.characteristic_radius();
    const double depth = 1e-6 * R, angle = 1e-6;
    Simulation   simulation(sticking_scene(scene, depth, angle),
                          bodies != nullptr ? *bodies : nullptr);
    if (bodies != nullptr)
      *bodies = simulation.system().bodies();
    const ContactInterface &interface = simulation.system().interface;
    const auto             &points    = interface.get_points();
    // [MPa], with the sign that a positive rotation gives the implant's
    const double sign = interface.slave_side() == Side::implant ? 1. : -1.;
    const auto   traction_about_axis = [sign](const SlavePoint &point) {
      const Eigen::Vector3d &X = point.X, &t = point.accepted_traction;
      const double           r = std::hypot(X[0], X[1]);
      return r > 0. ? sign * (X[0] * t[1] - X[1] * t[0]) / r : 0.;
    };
    simulation.advance(); // at rest

    // pressed: what this gives in tangential direction is not the rotation's
    FoundationStiffness stiffness;
    stiffness.normal = next_row(simulation).pressure_MPa / depth;
    for (const SlavePoint &point : points)
      stiffness.points.push_back(
        {std::hypot(point.X[0], point.X[1]),
         point.faces_implant ? point.JxW : 0.,
         point.phi_0,
         point.accepted.pressure / (stiffness.normal * depth),
         traction_about_axis(point)});

    // and turned
    stiffness.torsional =
      next_row(simulation).torque_Nmm / (0.5 * M_PI * std::pow(R, 4) * angle);
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        FoundationStiffness::Point &point = stiffness.points[i];
        point.stiffness = (traction_about_axis(points[i]) - point.stiffness) /
                          (point.radius * angle);
      }
    return stiffness;
  }



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
        TorsionModel::Disk disk;
        disk.radius    = 2. * point.radius; // anything larger
        disk.pressure  = pressure * point.pressure;
        disk.stiffness = point.stiffness;
        disk.phi_0     = point.phi_0;
        disk.friction  = friction;
        if (!(point.pressure > 0. && point.stiffness > 0.) ||
            !RigidBodiesTorsion::has_unique_solution(disk))
          return torques + TorsionModel::undefined;
        const RigidBodiesTorsion model(disk);
        torques +=
          point.area * point.radius * angles.unaryExpr([&](const double angle) {
            return model.point(point.radius, angle).traction;
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
        if (body->has_large_strains())
          strain =
            std::max(strain,
                     2. * largest_ratio * pressure / body->young_modulus);
      return strain *
             (1. - std::min(stiffness.normal /
                              scene.interface.law().normal->initial_stiffness(),
                            stiffness.torsional /
                              scene.interface.tangential_stiffness()));
    }
  } // namespace



  double
  foundation_error(const Scene                  &scene,
                   const std::vector<TorqueRow> &rows,
                   const FoundationStiffness    &stiffness,
                   const FoundationStiffness    &coarse,
                   const double                  cell_ratio)
  {
    Eigen::ArrayXd angles(rows.size());
    double         T_max = 0.;
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        angles[i] = rows[i].angle_deg * M_PI / 180.;
        T_max     = std::max(T_max, std::abs(rows[i].torque_Nmm));
      }
    const double pressure = rows.back().pressure_MPa;
    const double coarse_pressure =
      scene.chuck.component[ChuckComponent::translation_z].loaded ?
        pressure :
        pressure * coarse.normal / stiffness.normal;

    // With the points as they are, and with the same torsional stiffness
    // and pressure everywhere: on the same points, so that errors of the
    // quadrature cancel.
    const auto torques = [&](FoundationStiffness         points,
                             const double                mean_pressure,
                             const std::optional<double> torsional = {}) {
      if (torsional)
        for (FoundationStiffness::Point &point : points.points)
          {
            point.pressure  = 1.;
            point.stiffness = *torsional;
          }
      return torque_of_points(points,
                              scene.interface.friction,
                              mean_pressure,
                              angles);
    };
    const auto largest = [](const Eigen::ArrayXd &values) {
      return values.abs().maxCoeff<Eigen::PropagateNaN>();
    };
    const Eigen::ArrayXd uniform_fine =
      torques(stiffness, pressure, stiffness.torsional);
    const Eigen::ArrayXd distribution =
      torques(stiffness, pressure) - uniform_fine;
    const Eigen::ArrayXd distribution_on_coarse =
      torques(coarse, coarse_pressure) -
      torques(coarse, coarse_pressure, coarse.torsional);
    const double from_mesh =
      largest(torques(stiffness, coarse_pressure, coarse.torsional) -
              uniform_fine) +
      largest(distribution_on_coarse - distribution);
    return (2. * largest(distribution) + from_mesh / (cell_ratio - 1.)) /
             T_max +
           share_of_strains(scene, stiffness, pressure);
  }
} // namespace Debond
