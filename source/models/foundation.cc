#include <debond/models/foundation.h>
#include <debond/models/memory_estimate.h>
#include <debond/support/input_error.h>
#include <debond/system/coupled_system.h>
#include <debond/system/newton.h>

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
      scene.interface.friction.kind      = FrictionLawKind::coulomb;
      scene.interface.friction.mu_broken = 1e6;
      scene.interface.friction.starts_at = 0;
      scene.chuck                        = ChuckParameters();
      scene.chuck.component[ChuckComponent::translation_z].value =
        std::to_string(-1e9 * depth) + " * 1e-9 * min(t, 1)";
      scene.chuck.component[ChuckComponent::rotation_z].value =
        std::to_string(1e9 * angle * 180. / M_PI) + " * 1e-9 * max(t - 1, 0)";
      return scene;
    }



    void
    solve(CoupledSystem &system, const double time)
    {
      NewtonOptions options;
      options.stick_first     = true;
      options.touch_tolerance = 1e-12 * system.R;
      system.predict(time, false);
      const NewtonResult result = solve_newton(system, options);
      if (!result.converged || system.interface.summarise().share_stick < 1.)
        throw EntryError("Closed form",
                         std::string("the stiffness of the foundation cannot "
                                     "be found from the bodies of this scene") +
                           (result.converged ? ", which do not touch all over" :
                                               ": " + result.why));
      system.commit(time);
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
    const double        R     = scene.implant.characteristic_radius();
    const double        depth = 1e-6 * R, angle = 1e-6;
    dealii::TimerOutput timer(std::cout,
                              dealii::TimerOutput::never,
                              dealii::TimerOutput::wall_times);
    require_memory(scene);
    CoupledSystem system(sticking_scene(scene, depth, angle), timer);
    system.start(0.);
    solve(system, 1.);
    FoundationStiffness stiffness;
    stiffness.normal = system.chuck_resultant()[ChuckComponent::translation_z] /
                       (-depth * system.interface.implant_area());
    for (const SlavePoint &point : system.interface.get_points())
      stiffness.points.push_back(
        {std::hypot(point.X[0], point.X[1]),
         point.faces_implant ? point.JxW : 0.,
         point.phi_0,
         point.accepted_pressure / (stiffness.normal * depth),
         0.});
    const std::vector<double> pressed = traction_about_axis(system.interface);
    solve(system, 2.);
    stiffness.torsional = system.chuck_forces()[ChuckComponent::rotation_z] /
                          (0.5 * M_PI * std::pow(R, 4) * angle);
    const std::vector<double> turned = traction_about_axis(system.interface);
    for (std::size_t i = 0; i < turned.size(); ++i)
      stiffness.points[i].stiffness =
        (turned[i] - pressed[i]) / (stiffness.points[i].radius * angle);
    return stiffness;
  }
} // namespace Debond
