#include <debond/input/allowed_values.h>
#include <debond/input/entry_table.h>
#include <debond/input/scene_file.h>
#include <debond/scene/scene.h>

#include <boost/tokenizer.hpp>

#include <debond_typical_values.h>

#include <algorithm>
#include <map>
#include <sstream>

// What a test is has no default: a scene that leaves some of it out is refused
// with the lines that it lacks.
namespace Debond
{
  namespace
  {
    /** Values that the literature has for entries, by their full names, from
     *  doc/reference/typical_values.csv. */
    const std::map<std::string, std::string> &
    typical_values()
    {
      static const auto values = [] {
        std::map<std::string, std::string> result;
        Classic<std::istringstream>        lines(debond_typical_values);
        for (std::string line; std::getline(lines, line);)
          {
            // quantity, value, unit, for, source, entries with values; they
            // may be in quotes
            const boost::tokenizer<boost::escaped_list_separator<char>> fields(
              line);
            const std::vector<std::string> field(fields.begin(), fields.end());
            for (const std::string &entry_and_values : split(field.at(5), ";"))
              {
                const std::vector<std::string> entry =
                  split(entry_and_values, ":");
                std::string &text = result[entry.front()];
                text += (text.empty() ? "" : "; ") + entry.back() + " (" +
                        (field[3].empty() ? "" : field[3] + ", ") + field[4] +
                        ")";
              }
          }
        return result;
      }();
      return values;
    }
  } // namespace



  bool
  Scene::asks_bodies() const
  {
    const bool knows_pressure =
      closed_form.normal_stiffness > 0. || closed_form.pressure > 0. ||
      chuck.component[ChuckComponent::translation_z].loaded;
    return model != ModelKind::finite_elements &&
           (!knows_pressure || (model == ModelKind::foundation &&
                                closed_form.torsional_stiffness == 0.));
  }



  bool
  Scene::sets(const std::string &full_name) const
  {
    return std::any_of(entries.begin(), entries.end(), [&](const auto &entry) {
      return entry.full_name() == full_name && !entry.value.empty();
    });
  }



  void
  Scene::require_physics() const
  {
    if (!interface.friction) // other entries are wrong, too
      return;
    std::vector<SceneEntry> missing;
    for (SceneEntry entry : default_entries().entries())
      {
        const std::string full_name = entry.full_name();
        if ((default_entries().has_default(full_name) &&
             !(full_name == "Bone / Outer radius" &&
               bone.shape == BodyShape::sleeve) &&
             !(full_name == "Implant / Inner radius" &&
               implant.shape == BodyShape::ring)) ||
            sets(full_name) || !lacking_reader(*this, full_name).empty())
          continue;
        const std::string unit    = default_entries().unit_of(full_name);
        const auto        typical = typical_values().find(full_name);
        entry.value =
          "  # " + (unit.empty() ? "" : "[" + unit + "] ") +
          (typical == typical_values().end() ? "" : typical->second);
        missing.push_back(entry);
      }
    if (!missing.empty())
      throw InputError(
        name +
        ": it does not say all that the results depend on. Expected "
        "values in these lines (of a coin, include prm/coin.prm takes those "
        "of Immel et al. 2020):\n" +
        scene_text(missing));
  }
} // namespace Debond
