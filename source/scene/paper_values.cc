#include <debond/input/entry_table.h>
#include <debond/scene/scene.h>

#include <algorithm>
#include <map>

// A scene of an implant of one's own should say what it is: what it does not
// say is the coin of the paper.
namespace Debond
{
  namespace
  {
    /** Entries that describe the test, as far as the scene reads them. */
    std::vector<std::string>
    physical_entries(const Scene &scene)
    {
      std::vector<std::string> names;
      const auto add = [&](const bool is_read, const std::string &name) {
        if (is_read)
          names.push_back(name);
      };
      const std::vector<std::string> sizes = scene.implant.shape_row().entries;
      for (const std::string &size :
           {std::string("Radius"), std::string("Height")})
        add(std::find(sizes.begin(), sizes.end(), size) != sizes.end(),
            "Implant / " + size);
      add(scene.bone.shape == BodyShape::block, "Bone / Size");
      for (const auto &[body, name] : {std::pair(&scene.bone, "Bone"),
                                       std::pair(&scene.implant, "Implant")})
        for (const char *const entry : {"Young modulus", "Poisson ratio"})
          add(!body->is_rigid(), std::string(name) + " / " + entry);
      add(true, "Interface / Normal stiffness");
      for (const SceneEntry &entry : scene.interface.friction_choice.entries())
        add(!scene.interface.friction->is_frictionless &&
              entry.subsections.size() == 1,
            entry.full_name());
      return names;
    }
  } // namespace



  std::string
  Scene::values_of_the_paper() const
  {
    std::map<std::string, std::string> values;
    for (const SceneEntry &entry : completed_entries())
      values[entry.full_name()] = entry.value;
    std::string list;
    for (const std::string &physical : physical_entries(*this))
      if (std::none_of(entries.begin(),
                       entries.end(),
                       [&](const SceneEntry &entry) {
                         return entry.full_name() == physical;
                       }))
        {
          std::string unit = default_entries().unit_of(physical);
          if (physical == "Bone / Young modulus") // it may be an expression
            unit = "MPa";
          list += (list.empty() ? "" : "; ") + physical + " = " +
                  values[physical] + (unit.empty() ? "" : " " + unit);
        }
    return list.empty() ? "" :
                          "As for the coin of the paper, for the scene does "
                          "not say otherwise: " +
                            list;
  }
} // namespace Debond
