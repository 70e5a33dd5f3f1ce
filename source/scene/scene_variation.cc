#include <debond/input/scene_file.h>
#include <debond/scene/scene_variation.h>

#include <map>

namespace Debond
{
  namespace
  {
    /** What of the model itself has no derivative here; empty: nothing. */
    std::string
    why_not_differentiable(const Scene &scene)
    {
      const InterfaceParameters &interface = scene.interface;
      if (scene.model != ModelKind::finite_elements)
        return "only Model = finite elements is differentiated step by step";
      for (const BodyParameters *body : {&scene.bone, &scene.implant})
        if (body->material == Material::neo_hookean)
          return std::string(body == &scene.bone ? "Bone" : "Implant") +
                 " / Material = neo-hookean is solved with the tangent of an "
                 "earlier state, which is not that of the solution: use "
                 "Material = linear";
      if (scene.load_steps.follow_path)
        return "along Load steps / Path following the times of the rows change "
               "with the parameter";
      if (interface.friction->depends_on_rate())
        return "a Friction law that depends on the rate keeps more of a point "
               "than is differentiated";
      if (interface.explicit_friction)
        return "Interface / Friction update = explicit is not differentiated: "
               "use implicit";
      if (interface.slip_direction == SlipDirection::previous_gap)
        return "the tangent of Interface / Slip direction = previous gap takes "
               "that direction as fixed: use integrated";
      return "";
    }



    /** All entries of a scene by their names, but with what may vary as in
     *  @p scene. */
    std::map<std::string, std::string>
    other_entries(Scene varied, const Scene &scene)
    {
      const auto take = [&](auto &mine, const auto &its) { mine = its; };
      take(varied.title, scene.title);
      take(varied.output, scene.output);
      take(varied.study, scene.study);
      take(varied.bone.young_modulus, scene.bone.young_modulus);
      take(varied.implant.young_modulus, scene.implant.young_modulus);
      InterfaceParameters       &mine = varied.interface;
      const InterfaceParameters &its  = scene.interface;
      if (mine.friction_choice.law == its.friction_choice.law)
        {
          take(mine.friction, its.friction);
          take(mine.friction_choice, its.friction_choice);
        }
      take(mine.normal_penalty, its.normal_penalty);
      take(mine.tangential_penalty, its.tangential_penalty);
      take(mine.viscosity, its.viscosity);
      take(mine.bonding.initial_bonding, its.bonding.initial_bonding);
      take(mine.bonding.bonded_fraction, its.bonding.bonded_fraction);
      for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
        {
          auto       &component = varied.chuck.component[k];
          const auto &original  = scene.chuck.component[k];
          take(component.value, original.value);
          if ((component.stiffness > 0.) == (original.stiffness > 0.))
            take(component.stiffness, original.stiffness);
        }
      varied.complete();
      std::map<std::string, std::string> result;
      for (const SceneEntry &entry :
           read_scene_text(varied.completed_parameters, "scene"))
        result[entry.full_name()] = entry.value;
      return result;
    }
  } // namespace



  // What may vary is made equal; what then still differs has no derivative.
  std::string
  why_not_differentiable(const Scene &scene, const SceneVariation &variation)
  {
    std::string why = why_not_differentiable(scene);
    if (!why.empty())
      return why;
    const auto entries = other_entries(scene, scene);
    for (const Scene *varied : {&variation.plus, &variation.minus})
      for (const auto &[name, value] : other_entries(*varied, scene))
        {
          const auto found = entries.find(name);
          if (found == entries.end() || found->second != value)
            return name +
                   " changes, which the derivatives of a run do not know: they "
                   "are by friction law, penalty stiffnesses, viscosity, "
                   "bonding, Young's moduli and motion of the chuck";
        }
    return "";
  }
} // namespace Debond
