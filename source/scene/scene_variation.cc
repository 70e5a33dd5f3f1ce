#include <debond/input/entry_table.h>
#include <debond/input/scene_file.h>
#include <debond/scene/scene_variation.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

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



    /** Completed parameters of a scene, but with what may vary as in @p scene.
     */
    std::string
    what_may_not_vary(Scene varied, const Scene &scene)
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
      return varied.completed_parameters;
    }



    std::map<std::string, std::string>
    entries_of(const std::string &parameters)
    {
      std::map<std::string, std::string> result;
      for (const SceneEntry &entry : read_scene_text(parameters, "scene"))
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
    const std::string rest = what_may_not_vary(scene, scene);
    for (const Scene *varied : {&variation.plus, &variation.minus})
      {
        const std::string other = what_may_not_vary(*varied, scene);
        if (other == rest)
          continue;
        std::string name = "a file of the scene";
        auto        here = entries_of(rest);
        for (const auto &[entry, value] : entries_of(other))
          if (here[entry] != value)
            name = entry;
        return name +
               " changes, which the derivatives of a run do not know: they are "
               "by friction law, penalty stiffnesses, viscosity, bonding, "
               "Young's moduli and motion of the chuck";
      }
    return "";
  }



  namespace
  {
    [[noreturn]] void
    refuse(const std::string &why)
    {
      throw EntryError("Output / Sensitivities", why);
    }



    /** The scene with another value of an entry; nothing if that is not
     *  allowed. */
    std::optional<Scene>
    varied(Scene scene, SceneEntry entry, const std::string &value)
    {
      const FrictionLawChoice choice = scene.interface.friction_choice;
      EntryTable              table;
      scene.declare(table);
      entry.value = value;
      try
        {
          table.set(entry);
          if (scene.interface.friction_choice.entries != choice.entries)
            scene.interface.friction =
              create_friction_law(scene.interface.friction_choice);
        }
      catch (const InputError &)
        {
          return std::nullopt;
        }
      return scene;
    }



    // Central, or one-sided where a bound of the entry is in the way. With
    // finite elements it is data that are differences, and exact ones but for
    // rounding and h^2; closed forms are, which are integrals with 1e-8 or so
    // of errors.
    SceneVariation
    variation_by(const Scene &scene, const SceneEntry &entry)
    {
      const double h = scene.model == ModelKind::finite_elements ? 1e-5 : 1e-3;
      if (scene.bone.modulus && entry.full_name() == "Bone / Young modulus")
        { // one that varies, by a factor
          SceneVariation result{entry.full_name(), scene, scene, 2. * h};
          result.plus.bone.young_modulus *= 1. + h;
          result.minus.bone.young_modulus *= 1. - h;
          return result;
        }
      const bool is_factor =
        entry.subsections[0] == "Chuck" && entry.name == "Value";
      const auto   number = read_number(entry.value);
      const double value  = is_factor ? 1. : number.value_or(0.);
      if (value == 0.)
        refuse(entry.full_name() + " = '" + entry.value + "' is " +
               (number ? "0, and has no neighbours to take a difference of: "
                         "give it another value" :
                         "no number that could be varied"));
      const auto scene_at = [&](const double factor) {
        return varied(scene,
                      entry,
                      is_factor ?
                        exact_text(factor) + " * (" + entry.value + ")" :
                        exact_text(factor * value));
      };
      const auto plus = scene_at(1. + h), minus = scene_at(1. - h);
      if (!plus && !minus)
        refuse(entry.full_name() + " = " + entry.value + " cannot be varied");
      return {entry.full_name(),
              plus.value_or(scene),
              minus.value_or(scene),
              value * h * (int(plus.has_value()) + int(minus.has_value()))};
    }
  } // namespace



  std::vector<SceneVariation>
  variations_of(const Scene &scene)
  {
    std::vector<SceneVariation> result;
    if (scene.output.sensitivities.empty())
      return result;
    Scene copy = scene;
    copy.complete();
    const auto entries = read_scene_text(copy.completed_parameters, "scene");
    for (const std::string &name : scene.output.sensitivities)
      {
        const std::string wanted = read_override(name + "=").full_name();
        const auto        entry =
          std::find_if(entries.begin(), entries.end(), [&](const auto &e) {
            return e.full_name() == wanted;
          });
        if (entry == entries.end())
          refuse("there is no entry '" + wanted +
                 "' (debond --print-parameters lists all)");
        if (entry->subsections.empty())
          refuse(wanted + " = '" + entry->value +
                 "' is no number that could be varied");
        result.push_back(variation_by(scene, *entry));
      }
    return result;
  }



  // Closed forms are differentiated by differences of the whole, which can be
  // had of anything.
  void
  check_sensitivities(const Scene &scene)
  {
    if (scene.output.sensitivities.empty())
      return;
    if (scene.model == ModelKind::automatic)
      refuse("they are those of one model, which Model = auto has yet to "
             "choose");
    for (const SceneVariation &variation : variations_of(scene))
      if (scene.model == ModelKind::finite_elements)
        {
          const std::string why = why_not_differentiable(scene, variation);
          if (!why.empty())
            refuse(why);
        }
  }
} // namespace Debond
