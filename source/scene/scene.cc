#include <debond/input/entry_table.h>
#include <debond/input/scene_file.h>
#include <debond/scene/scene.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <fstream>
#include <ostream>
#include <sstream>

namespace Debond
{
  void
  AutoParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Auto");
    table.add("Largest number of unknowns",
              largest_number_of_unknowns,
              Allowed::whole_number(1, 100000000),
              "With Model = auto: unknowns of both bodies up to which meshes "
              "are refined. The memory needed goes with it: 1 GB for 105 000, "
              "some 3 GB for 250 000.");
    table.leave_subsection();
  }



  void
  StudyParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Study");
    table.add("Reference variant",
              reference_variant,
              Allowed::whole_number(0, 100000),
              "In a study, whose entries hold several values as in {{a|b|c}}: "
              "number of the variant that the others' torque curves are "
              "compared with in study.csv. 0: they are compared with Output / "
              "Reference curve, if there is one.");
    table.add("Factors varied at once",
              factors_at_once,
              Allowed::whole_number(0, 1000),
              "Of all combinations, only those in which at most this many "
              "factors differ from their first value: 1 varies one factor at a "
              "time, 2 also every pair. A factor is an entry {{a|b|c}}, or all "
              "entries {{name: a|b|c}} with one name. 0: all combinations.");
    table.add("Repetitions",
              repetitions,
              Allowed::whole_number(1, 1000),
              "Number of runs of each variant. In study.csv seconds are then "
              "medians; all else is that of the last run. Seconds mean "
              "something with --jobs 1 only.");
    table.leave_subsection();
  }



  void
  Scene::declare(EntryTable &table)
  {
    table.add("Title",
              title,
              Allowed::optional_text("any text"),
              "Title of the scene, for people.");
    table.add("Model",
              model,
              Allowed::choice("finite elements | foundation | analytical | "
                              "mathieu | auto"),
              "Model that is solved. `finite elements': two bodies with an "
              "interface between them. The others are closed forms for a coin "
              "that is pressed down and then turned: `foundation': a rigid "
              "disk on a foundation with the stiffness of interface and bodies "
              "in series, and the full friction law. `analytical': Eq. (18) of "
              "the paper. `mathieu': Eqs. (14) to (16). See subsection Closed "
              "form. `auto': climbs from the cheapest of `foundation', rigid, "
              "linear and the scene's own bodies on finer and finer meshes "
              "until the error of the torque curve is estimated to be within "
              "Load steps / Tolerance, and answers with the cheapest model "
              "that is; the program chooses the steps.");
    table.reserve("Task",
                  "simulate",
                  "What to do with the model: run it once.");
    bone.declare_bone(table);
    implant.declare_implant(table);
    interface.declare(table);
    chuck.declare(table);
    load_steps.declare(table);
    closed_form.declare(table);
    automatic.declare(table);
    study.declare(table);
    output.declare(table);
  }



  namespace
  {
    /** A comment that tells one content of a file from another: results belong
     *  to the content, not to the name. */
    std::string
    identity_of(const std::string &filename)
    {
      if (filename.empty())
        return "";
      std::ostringstream bytes;
      bytes << std::ifstream(filename, std::ios::binary).rdbuf();
      const std::string  content = bytes.str();
      boost::crc_32_type crc;
      crc.process_bytes(content.data(), content.size());
      std::ostringstream text;
      text << "# " << filename << ": " << content.size() << " bytes, CRC-32 "
           << std::hex << crc.checksum() << "\n";
      return text.str();
    }
  } // namespace



  Scene
  Scene::from_entries(const std::vector<SceneEntry> &entries,
                      const std::string             &name)
  {
    Scene scene;
    scene.entries = entries;
    scene.name    = name;
    EntryTable table;
    scene.declare(table);
    for (const SceneEntry &entry : entries)
      table.set(entry);
    if (scene.model == ModelKind::automatic)
      scene.load_steps.adaptive = true;
    try
      {
        scene.interface.create_friction();
        scene.check();
      }
    catch (const InputError &error)
      {
        throw scene.with_place(error);
      }
    scene.completed_parameters = table.text() +
                                 identity_of(scene.interface.bonding.file) +
                                 identity_of(scene.interface.friction->file());
    return scene;
  }



  void
  Scene::complete()
  {
    EntryTable table;
    declare(table);
    completed_parameters = table.text() + identity_of(interface.bonding.file) +
                           identity_of(interface.friction->file());
  }



  InputError
  Scene::with_place(const InputError &error) const
  {
    const auto *const mistake = dynamic_cast<const EntryError *>(&error);
    if (mistake == nullptr || !mistake->place.empty())
      return error;
    const auto entry =
      std::find_if(entries.begin(), entries.end(), [&](const SceneEntry &e) {
        return e.full_name() == mistake->entry;
      });
    if (entry == entries.end())
      return EntryError(mistake->entry, mistake->why, mistake->value, name);
    return EntryError(mistake->entry, mistake->why, entry->value, entry->place);
  }



  Scene
  Scene::from_file(const std::string              &filename,
                   const std::vector<std::string> &overrides)
  {
    return from_entries(with_overrides(read_scene_file(filename), overrides),
                        filename);
  }



  Scene
  Scene::from_text(const std::string              &text,
                   const std::vector<std::string> &overrides,
                   const std::string              &name)
  {
    return from_entries(with_overrides(read_scene_text(text, name), overrides),
                        name);
  }



  void
  print_parameters(std::ostream &out, const Scene *scene)
  {
    Scene      defaults;
    EntryTable table;
    defaults.declare(table);
    if (scene != nullptr)
      for (const SceneEntry &entry :
           read_scene_text(scene->completed_parameters, "scene"))
        table.set(entry);
    table.print(out);
  }
} // namespace Debond
