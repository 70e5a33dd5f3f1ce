#include <debond/input/entry_table.h>
#include <debond/scene/finer_scenes.h>
#include <debond/shapes/body_mesh.h>
#include <debond/support/input_error.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <map>

// A scene with other cells, and whether it is the same scene still.
namespace Debond
{
  unsigned int
  more_cells(const unsigned int n)
  {
    return (3 * n + 1) / 2;
  }

  unsigned int
  fewer_cells(const unsigned int n)
  {
    return std::max(1U, (4 * n + 3) / 6);
  }



  namespace
  {
    using Change = unsigned int (*)(unsigned int n);

    /** Numbers of cells of a body as its entry says them, each changed; with
     *  @p keeps_around but those around an axis. */
    std::vector<unsigned int>
    cells_of(const BodyParameters &body,
             const Change          change,
             const bool            keeps_around)
    {
      std::vector<unsigned int> n(body.cells.begin(), body.cells.end());
      if (body.is_fitted())
        {
          n.assign(body.fitted_cells.begin(), body.fitted_cells.end());
          if (n[2] == 0) // of an implant
            n.pop_back();
          n.push_back(body.cells[2]);
        }
      const bool         is_round = body.is_fitted() || body.mesh;
      const unsigned int unit     = is_round && n[0] % 4 == 0 ? 4 : 1,
                         under    = body.cells_under_implant,
                         fewest   = body.is_fitted() ? 4 :
                                    is_round         ? 8 :
                                                       2;
      for (unsigned int k = keeps_around ? 1 : 0; k < n.size(); ++k)
        if (under > 0 && k < 2) // as many on both sides
          n[k] = change(under) + 2 * change((n[k] - under) / 2);
        else if (k == 0 || (k == 1 && !is_round))
          n[k] = std::max(fewest, unit * change(n[k] / unit));
        else
          n[k] = change(n[k]);
      return n;
    }

    unsigned int
    same_number(const unsigned int n)
    {
      return n;
    }

    std::string
    text_of(const BodyParameters &body, const std::vector<unsigned int> &cells)
    {
      return (body.is_fitted() ? "fitted " : "") + entry_text(cells);
    }



    /** Whether fewer cells are fewer in each direction. */
    bool
    may_be_coarser(const Scene &scene)
    {
      const bool keeps_around = scene.is_axisymmetric();
      for (const BodyParameters *const body : {&scene.bone, &scene.implant})
        {
          const auto own   = cells_of(*body, same_number, keeps_around),
                     fewer = cells_of(*body, fewer_cells, keeps_around);
          for (unsigned int k = keeps_around ? 1 : 0; k < own.size(); ++k)
            if (fewer[k] == own[k] && !body->is_rigid() &&
                body->shape != BodyShape::file)
              return false;
        }
      return true;
    }



    /** Whether bodies from files may be trilinear: both, or the error of one
     *  would be missing. */
    bool
    has_trilinear_cells(const Scene &scene)
    {
      for (const BodyParameters *const body : {&scene.bone, &scene.implant})
        if (body->shape == BodyShape::file && !body->is_rigid() &&
            !(body->mesh && body->mesh->has_cells_of_corners))
          return false;
      return true;
    }



    using Changes = std::map<std::string, std::string>;

    // Cells of a file stay: with fewer of the other body they are those of
    // another file, or its elements are trilinear. Where each element has a
    // bond of its own, other cells would have another bond.
    Changes
    changed_cells(const Scene &scene, const Change change)
    {
      Changes changes;
      for (const auto &[section, body] : {std::pair("Bone", &scene.bone),
                                          std::pair("Implant", &scene.implant)})
        if (body->shape != BodyShape::file)
          changes[section + std::string(" / Cells")] =
            text_of(*body, cells_of(*body, change, scene.is_axisymmetric()));
        else if (change == fewer_cells && has_coarser_files(scene))
          {
            if (!body->coarser_mesh_file.empty())
              changes[section + std::string(" / Mesh file")] =
                body->coarser_mesh_file;
          }
        else if (change == fewer_cells && has_trilinear_cells(scene) &&
                 body->element == ElementKind::quadratic)
          changes[section + std::string(" / Element")] = "trilinear";
      if (const unsigned int under = scene.bone.cells_under_implant; under > 0)
        changes["Expert / Bone / Cells under implant"] =
          std::to_string(change(under));
      const BondingParameters &bonding = scene.interface.bonding;
      if (bonding.pattern == BondingPatternKind::file ||
          (bonding.pattern == BondingPatternKind::random &&
           bonding.correlation_length == 0.))
        for (const std::string name : {"Implant / Cells",
                                       "Implant / Element",
                                       "Bone / Element",
                                       "Implant / Mesh file",
                                       "Bone / Mesh file"})
          changes.erase(name);
      return changes;
    }



    Scene
    changed_scene(const Scene &scene, const Changes &changes)
    {
      std::vector<SceneEntry> entries = scene.completed_entries();
      for (SceneEntry &entry : entries)
        if (const auto change = changes.find(entry.full_name());
            change != changes.end())
          entry.value = change->second;
      Scene result = Scene::from_entries(entries, scene.name);
      result.changed_entries.clear(); // need not all be read
      return result;
    }



    /** With other choices, and else as it is. */
    Scene
    with_choices(const Scene &scene, const Changes &changes)
    {
      Scene result           = changed_scene(scene, changes);
      result.entries         = scene.entries;
      result.changed_entries = scene.changed_entries;
      result.output          = scene.output;
      result.note_choices(scene.chosen);
      return result;
    }



    const std::string choices_begin = "# chosen by Accuracy: ";
  } // namespace



  bool
  has_coarser_files(const Scene &scene)
  {
    bool result = false;
    for (const BodyParameters *const body : {&scene.bone, &scene.implant})
      if (!body->coarser_mesh_file.empty())
        result = true;
      else if (body->shape == BodyShape::file && !body->is_rigid())
        return false;
    return result;
  }



  // Cells that cannot be fewer tell nothing: then there are more of all.
  std::optional<Scene>
  coarser_scene(const Scene &scene)
  {
    Changes changes =
      changed_cells(scene, may_be_coarser(scene) ? fewer_cells : more_cells);
    if (changes.empty())
      return {};
    if (scene.load_steps.rows_are_planned())
      {
        std::vector<unsigned int> steps = scene.load_steps.steps;
        for (unsigned int &n : steps)
          n = (n + 1) / 2;
        changes["Load steps / Steps"] = entry_text(steps);
      }
    for (const auto &[entry, value] :
         Changes{{"Output / Directory", scene.output.directory + "/coarser"},
                 {"Output / Fields every", "none"},
                 {"Output / Report", "false"},
                 {"Output / Reference curve", "none"},
                 {"Output / Reference columns", "auto"},
                 {"Expert / Output / Console", "quiet"},
                 {"Expert / Output / Reference profiles", "none"},
                 {"Expert / Output / Curve angles", "none"},
                 {"Expert / Output / Profile angles", "none"},
                 {"Expert / Output / Friction law curve", "false"}})
      changes[entry] = value;
    Scene coarser                          = changed_scene(scene, changes);
    coarser.output.extendable              = false;
    coarser.output.overwrite_other_results = true;
    return coarser;
  }



  std::optional<Scene>
  finer_scene(const Scene &scene)
  {
    Changes changes = changed_cells(scene, more_cells);
    for (auto change = changes.begin(); change != changes.end();)
      change = is_among(scene.chosen, change->first) ? std::next(change) :
                                                       changes.erase(change);
    if (changes.empty())
      return {};
    return with_choices(scene, changes);
  }



  std::optional<Scene>
  with_large_strains(const Scene &scene)
  {
    Changes changes;
    for (const auto &[section, body] :
         {std::pair("Bone", &scene.bone), std::pair("Implant", &scene.implant)})
      if (const SceneEntry entry{{section}, "Material", "", ""};
          is_among(scene.chosen, entry.full_name()) &&
          body->material == Material::linear)
        changes[entry.full_name()] = "neo-hookean";
    return changes.empty() ? std::nullopt :
                             std::optional(with_choices(scene, changes));
  }



  std::string
  cells_in_words(const Scene &scene)
  {
    const auto same = [](const BodyParameters &body) {
      if (body.shape == BodyShape::file && body.mesh)
        return std::to_string(body.mesh->triangulation.n_active_cells()) +
               (body.element == ElementKind::trilinear ? " trilinear" : "");
      return text_of(body, cells_of(body, same_number, true));
    };
    return same(scene.bone) + " and " + same(scene.implant);
  }



  std::vector<SceneEntry>
  open_choices(const std::string &parameters)
  {
    const std::vector<std::string> chosen = choices_in(parameters);
    std::vector<SceneEntry> entries = read_scene_text(parameters, "parameters");
    const auto              was_chosen = [&](const SceneEntry &entry) {
      return is_among(chosen, entry.full_name());
    };
    entries.erase(std::remove_if(entries.begin(), entries.end(), was_chosen),
                  entries.end());
    return entries;
  }



  Scene
  with_choices_of(const Scene &scene, const std::string &parameters)
  {
    Changes changes;
    for (const SceneEntry &entry : read_scene_text(parameters, "parameters"))
      if (is_among(scene.chosen, entry.full_name()) &&
          entry.subsections[0] != "Load steps")
        changes[entry.full_name()] = entry.value;
    return changes.empty() ? scene : with_choices(scene, changes);
  }



  void
  Scene::note_choices(const std::vector<std::string> &entries)
  {
    chosen = entries;
    if (!chosen.empty())
      completed_parameters +=
        choices_begin + boost::algorithm::join(chosen, "; ") + "\n";
  }



  std::vector<std::string>
  choices_in(const std::string &parameters)
  {
    const auto begin = parameters.rfind(choices_begin);
    if (begin == std::string::npos)
      return {};
    const auto names = begin + choices_begin.size();
    return split(parameters.substr(names, parameters.find('\n', names) - names),
                 ";");
  }



  bool
  is_same_scene(const std::string &parameters, const std::string &earlier)
  {
    if (parameters == earlier)
      return true;
    const std::vector<std::string> chosen   = choices_in(parameters);
    const auto                     lines_of = [&](const std::string &text) {
      std::vector<std::string> lines;
      for (const SceneEntry &entry : read_scene_text(text, "parameters"))
        if (!is_among(chosen, entry.full_name()))
          lines.push_back(entry.full_name() + " = " + entry.value);
      for (const std::string &line : split(text, "\n"))
        if (line.rfind("# ", 0) == 0 &&
            !(chosen.empty() && line.rfind(choices_begin, 0) == 0))
          lines.push_back(line); // of files
      return lines;
    };
    try
      {
        return lines_of(parameters) == lines_of(earlier);
      }
    catch (const InputError &) // it has been changed
      {
        return false;
      }
  }
} // namespace Debond
