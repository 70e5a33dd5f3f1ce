#include <debond/models/foundation.h>
#include <debond/models/simulation.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>
#include <iostream>

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
        if (body->material == Material::neo_hookean)
          body->material = Material::linear;
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
      std::string why;
      try
        {
          simulation.advance();
          if (simulation.rows().back().share_stick < 1.)
            why = ", which do not touch all over";
        }
      catch (const RunError &error)
        {
          why = std::string(": ") + error.what();
        }
      if (!why.empty())
        throw EntryError("Closed form",
                         "the stiffness of the foundation cannot be found from "
                         "the bodies of this scene" +
                           why);
      return simulation.rows().back();
    }



    /** Traction about the axis at each point [MPa], with the sign that a
     *  positive rotation gives the implant's. */
    std::vector<double>
    traction_about_axis(const ContactInterface &interface)
    {
      const double sign = interface.slave_side() == Side::implant ? 1. : -1.;
      std::vector<double> tractions;
      for (const SlavePoint &point : interface.get_points())
        {
          const Eigen::Vector3d &X = point.X, &t = point.accepted_traction;
          const double           r = std::hypot(X[0], X[1]);
          tractions.push_back(r > 0. ? sign * (X[0] * t[1] - X[1] * t[0]) / r :
                                       0.);
        }
      return tractions;
    }
  } // namespace



  FoundationStiffness
  foundation_stiffness(const Scene &scene)
  {
    const double            R     = scene.implant.characteristic_radius();
    const double            depth = 1e-6 * R, angle = 1e-6;
    Simulation              simulation(sticking_scene(scene, depth, angle));
    const ContactInterface &interface = simulation.system().interface;
    simulation.advance(); // at rest

    FoundationStiffness stiffness;
    stiffness.normal = next_row(simulation).pressure_MPa / depth;
    for (const SlavePoint &point : interface.get_points())
      stiffness.points.push_back(
        {std::hypot(point.X[0], point.X[1]),
         point.faces_implant ? point.JxW : 0.,
         point.phi_0,
         point.accepted_pressure / (stiffness.normal * depth),
         0.});
    const std::vector<double> pressed = traction_about_axis(interface);

    stiffness.torsional =
      next_row(simulation).torque_Nmm / (0.5 * M_PI * std::pow(R, 4) * angle);
    const std::vector<double> turned = traction_about_axis(interface);
    for (std::size_t i = 0; i < turned.size(); ++i)
      stiffness.points[i].stiffness =
        (turned[i] - pressed[i]) / (stiffness.points[i].radius * angle);
    return stiffness;
  }
} // namespace Debond
