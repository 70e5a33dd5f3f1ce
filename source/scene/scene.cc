#include <debond/bulk/modulus_field.h>
#include <debond/input/entry_table.h>
#include <debond/input/scene_file.h>
#include <debond/scene/scene.h>
#include <debond/support/written_files.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <ostream>
#include <sstream>

namespace Debond
{
  std::string
  identity_of(const std::string &filename)
  {
    if (filename.empty())
      return "";
    const std::string  content = read_whole_file(filename).value_or("");
    boost::crc_32_type crc;
    crc.process_bytes(content.data(), content.size());
    std::ostringstream text;
    text << "# " << filename << ": " << content.size() << " bytes, CRC-32 "
         << std::hex << crc.checksum() << "\n";
    return text.str();
  }



  namespace
  {
    /** Of all files whose content makes the results. */
    std::string
    identities(const Scene &scene)
    {
      std::string text = identity_of(scene.interface.bonding.file) +
                         identity_of(scene.interface.friction->file());
      for (const ChuckComponentParameters &component : scene.chuck.component)
        text += identity_of(component.file);
      text += identity_of(scene.bone.voxel_file);
      if (scene.bone.modulus && scene.bone.modulus->voxels())
        text += identity_of(scene.bone.modulus->voxels()->data_file);
      return text;
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
    // the same for all scenes
    static const auto usual = read_scene_text(table.text(), "defaults");
    for (const SceneEntry &entry : entries)
      {
        table.set(entry);
        if (std::none_of(usual.begin(), usual.end(), [&](const SceneEntry &e) {
              return e.full_name() == entry.full_name() &&
                     e.value == entry.value;
            }))
          scene.changed_entries.push_back(entry);
      }
    if (scene.model == ModelKind::automatic)
      scene.load_steps.adaptive = true;
    try
      {
        scene.chuck.read_tables();
        scene.take_values();
        scene.check();
      }
    catch (const InputError &error)
      {
        throw scene.with_place(error);
      }
    scene.completed_parameters = table.text() + identities(scene);
    return scene;
  }



  void
  Scene::take_values()
  {
    interface.friction = create_friction_law(interface.friction_choice);
    bone.rim           = {{0.5 * implant.width(0), 0.5 * implant.width(1)}};
    bone.read_modulus(implant.characteristic_radius());
  }



  void
  Scene::complete()
  {
    EntryTable table;
    declare(table);
    completed_parameters = table.text() + identities(*this);
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
