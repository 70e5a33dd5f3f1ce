#include <debond/input/entry_table.h>
#include <debond/input/input_file.h>
#include <debond/scene/reference_data.h>
#include <debond/scene/scene.h>
#include <debond/shapes/body_mesh.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <ostream>

namespace Debond
{
  namespace
  {
    // A program that makes a scene chooses its cells and steps itself.
    Scene
    scene_to_be_read()
    {
      Scene scene;
      scene.accuracy = 0.01;
      return scene;
    }



    /** Lines that tell the contents of all files that make the results. */
    std::string
    identities(const Scene &scene)
    {
      std::string text = scene.interface.bonding.identity +
                         identity_of(scene.interface.friction->file) +
                         identity_of(scene.interface.pressure_dependence.table);
      for (const ChuckComponentParameters &component : scene.chuck.component)
        text += identity_of(component.file);
      for (const BodyParameters *const body : {&scene.bone, &scene.implant})
        if (body->mesh)
          text += body->mesh->identity;
      if (scene.bone.modulus && scene.bone.modulus->voxels())
        text += scene.bone.modulus->voxels()->identity;
      return text;
    }



    /** What is wrong with the reference as a curve of these axes, or nothing.
     */
    std::optional<EntryError>
    why_no_curve(const OutputParameters &output, const CurveAxes &axes)
    {
      try
        {
          read_reference_curve(output.reference_curve,
                               output.reference_columns,
                               axes);
          return {};
        }
      catch (const EntryError &error)
        {
          return error;
        }
    }



    // Torque over angle where the chuck may turn about z, else the load and the
    // position of the component that it moves most.
    // What is moved comes before what is loaded. An angle counts as what it
    // moves at the rim, and a press not where another way follows it.
    CurveAxes
    usual_curve(const Scene &scene, const bool with_press = false)
    {
      const std::vector<double> times = scene.load_steps.sample_times();
      const bool                skips = !with_press && scene.is_press(0);
      const auto                begin = std::lower_bound(times.begin(),
                                          times.end(),
                                          scene.load_steps.times[skips]) -
                         times.begin();
      std::array<double, ChuckParameters::n_components> way;
      for (unsigned int k = 0; k < way.size(); ++k)
        {
          const std::vector<double> values = scene.sampled_values(k);
          const auto [least, most] =
            std::minmax_element(values.begin() + begin, values.end());
          way[k] = (is_rotation(k) ?
                      scene.implant.characteristic_radius() * M_PI / 180. :
                      1.) *
                   (scene.chuck.component[k].loaded ? 1e-9 : 1.) *
                   (*most - *least);
        }
      const auto furthest = std::max_element(way.begin(), way.end());
      if (skips && *furthest == 0.)
        return usual_curve(scene, true);
      const unsigned int k = furthest - way.begin();
      return way[ChuckComponent::rotation_z] > 0. || *furthest == 0. ?
               CurveAxes() :
               CurveAxes{k, k};
    }



    // A measured curve of angles and torques says itself which curve it is.
    // Fits read their curves themselves, which may be others.
    void
    take_curve(Scene &scene)
    {
      OutputParameters &output  = scene.output;
      const auto        named   = CurveAxes::read(output.curve);
      const auto       &changed = scene.changed_entries;
      const bool        is_fit =
        std::any_of(changed.begin(), changed.end(), [](const auto &entry) {
          return entry.name == "Task";
        });
      output.axes               = named ? *named : usual_curve(scene);
      const bool is_other_curve = !named && !output.axes.is_torsion();
      if (is_fit && !is_other_curve)
        return;
      const auto why = why_no_curve(output, output.axes);
      if (why && is_other_curve && !why_no_curve(output, CurveAxes()))
        output.axes = CurveAxes();
      else if (why && !is_fit)
        throw *why;
    }



    void
    take_entries(Scene &scene, const std::vector<SceneEntry> &entries)
    {
      scene.completed_parameters = scene_text(entries) + identities(scene);
      scene.values.clear();
      for (const SceneEntry &entry : entries)
        scene.values.push_back(entry.value);
    }



    /** What is solved, in lines. Files are named without their directories,
     *  which may be others on another machine: their content counts. */
    std::vector<std::string>
    lines_to_compare(const Scene &scene)
    {
      std::vector<std::string> lines;
      for (const SceneEntry &entry : scene.completed_entries())
        lines.push_back(entry.full_name() + " = '" + entry.value + "'");
      Classic<std::istringstream> contents(identities(scene));
      for (std::string line; std::getline(contents, line);)
        {
          const std::string of_file = line.substr(2); // see identity_of()
          const std::string file    = of_file.substr(0, of_file.rfind(": "));
          lines.push_back("the file " + of_file);
          for (std::string &each : lines)
            boost::replace_all(each,
                               file,
                               std::filesystem::path(file).filename().string());
        }
      // a program may give motions that no entry tells of
      for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
        {
          lines.push_back(std::string("Chuck / ") + ChuckParameters::names[k] +
                          " over time:");
          for (const double value : scene.sampled_values(k))
            lines.back() += " " + to_text(value, 17);
        }
      return lines;
    }
  } // namespace



  const EntryTable &
  default_entries()
  {
    struct Defaults
    {
      Defaults()
      {
        scene.declare(table);
      }

      Scene      scene = scene_to_be_read();
      EntryTable table;
    };
    static const Defaults defaults;
    return defaults.table;
  }



  std::vector<SceneEntry>
  Scene::completed_entries() const
  {
    if (values.empty()) // a program has made this scene
      {
        Scene copy = *this;
        copy.complete();
        return copy.completed_entries();
      }
    std::vector<SceneEntry> result = default_entries().entries();
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i].value = values[i];
    return result;
  }



  void
  Scene::complete()
  {
    EntryTable table;
    declare(table);
    std::vector<SceneEntry> entries = table.entries();
    for (std::size_t i = 0; i < values.size(); ++i)
      if (table.means(entries[i], values[i]) || // `auto', or its value
          (values[i].empty() && default_entries().has(entries[i])))
        entries[i].value = values[i];
    take_entries(*this, entries);
  }



  Scene
  Scene::from_entries(const std::vector<SceneEntry> &entries,
                      const std::string             &name)
  {
    Scene scene   = scene_to_be_read();
    scene.entries = entries;
    scene.name    = name;
    EntryTable table;
    scene.declare(table);
    std::vector<std::string> chosen;
    for (const SceneEntry &entry : entries)
      if (!entry.value.empty() ||
          default_entries().has_default(entry.full_name()))
        {
          table.set(entry);
          if (!default_entries().has(entry))
            scene.changed_entries.push_back(entry);
        }

    try
      {
        scene.chuck.read_tables();
        for (const SceneEntry &entry : scene.chosen_entries())
          {
            table.set(entry);
            chosen.push_back(entry.full_name());
          }
        scene.take_values();
        scene.check();
        take_curve(scene);
      }
    catch (const InputError &error)
      {
        // it may be one of what the scene does not say
        if (dynamic_cast<const EntryError *>(&error) != nullptr)
          scene.require_physics();
        throw scene.with_place(error);
      }
    scene.require_physics();
    std::vector<SceneEntry> completed = table.entries();
    for (SceneEntry &entry : completed) // what is not said stays open
      if (const std::string full_name = entry.full_name();
          !table.has_default(full_name) && !scene.sets(full_name))
        entry.value = "";
    take_entries(scene, completed);
    scene.note_choices(chosen);
    return scene;
  }



  void
  Scene::take_values()
  {
    chuck.take_press();
    interface.bonding.identity = identity_of(interface.bonding.file);
    // what is refused of the pressure leaves the law that was chosen
    interface.friction = create_friction_law(interface.friction_choice);
    interface.friction = interface.pressure_dependence.of(interface.friction);
    check_shapes();
    interface.take_slave(implant.geometry().is_in_bore());
    implant.make_mesh("Implant", implant);
    bone.make_mesh("Bone", implant);
    for (BodyParameters *const body : {&bone, &implant})
      body->take_rim(implant);
    bone.read_modulus(implant.characteristic_radius());
  }



  void
  Scene::require_same_on_all_ranks() const
  {
    if (Ranks::number() == 1)
      return;
    const std::vector<std::string> own   = lines_to_compare(*this),
                                   first = Ranks::of_first(own);
    Ranks::in_agreement([&] {
      const auto [ours, theirs] =
        std::mismatch(own.begin(), own.end(), first.begin(), first.end());
      if (ours != own.end() || theirs != first.end())
        throw InputError(
          "the processes that are to solve a scene together have different "
          "ones: " +
          (theirs == first.end() ? "nothing more" : shortened(*theirs)) +
          " on rank 0, " +
          (ours == own.end() ? "nothing more" : shortened(*ours)) +
          " on rank " + std::to_string(Ranks::own()) +
          ": expected the same on all; processes that work alone need no "
          "communicator");
    });
  }



  InputError
  Scene::with_place(const InputError &error) const
  {
    const auto *const mistake = dynamic_cast<const EntryError *>(&error);
    if (mistake == nullptr || !mistake->place.empty())
      return error;
    const std::string full_name = default_entries().placed(mistake->entry);
    const auto        entry =
      std::find_if(entries.begin(), entries.end(), [&](const SceneEntry &e) {
        return e.full_name() == full_name;
      });
    if (entry == entries.end())
      return EntryError(full_name, mistake->why, mistake->value, name);
    return EntryError(full_name, mistake->why, entry->value, entry->place);
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
    const EntryTable       &defaults = default_entries();
    std::vector<SceneEntry> values =
      scene != nullptr ? scene->completed_entries() : defaults.entries();
    for (SceneEntry &entry : values)
      if (scene == nullptr && !defaults.has_default(entry.full_name()))
        entry.value = "";
    out << defaults.explained(values);
  }
} // namespace Debond
