#include <debond/models/foundation.h>
#include <debond/models/simulation.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>

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
      // no traction reaches it: Eq. (39) wants a linear solution
      scene.interface.friction           = modified_coulomb({1e6, 1e6});
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
    simulation.advance(); // at rest
    FoundationStiffness stiffness;
    stiffness.normal = next_row(simulation).pressure_MPa / depth;
    stiffness.torsional =
      next_row(simulation).torque_Nmm / (0.5 * M_PI * std::pow(R, 4) * angle);
    return stiffness;
  }
} // namespace Debond
