#include <debond/input/entry_table.h>
#include <debond/input/expression_parser.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/scene/finer_scenes.h>
#include <debond/scene/reference_data.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>

namespace Debond
{
  namespace
  {
    void
    check_faces(const BodyParameters &bone, const BodyParameters &implant)
    {
      // boxes of facets are wider or narrower than what they stand for: what
      // faces nothing is said where points are projected
      if (bone.shape == BodyShape::file || implant.shape == BodyShape::file)
        return;
      for (unsigned int d = 0; d < 2; ++d)
        if (implant.width(d) > (1. + 1e-9) * bone.width(d))
          throw EntryError("Implant / " + implant.shape_row().entries.front(),
                           "the implant is " + to_text(implant.width(d)) +
                             " mm wide in " + "xy"[d] +
                             ", wider than the bone below it (Bone / " +
                             bone.shape_row().entries.front() + ": " +
                             to_text(bone.width(d)) + " mm)");
    }



    /** Values at these times of what @p function_of gives; refuses expressions
     *  that cannot be read or have no finite value, and values beyond the
     *  limit. */
    std::vector<double>
    checked_values(const std::string                   &entry,
                   const std::function<TimeFunction()> &function_of,
                   const std::vector<double>           &times,
                   const double                         limit,
                   const std::string                   &limit_in_words)
    {
      std::vector<double> values;
      try
        {
          const TimeFunction function = function_of();
          for (const double time : times)
            {
              values.push_back(function(time));
              if (!(std::abs(values.back()) < limit))
                throw InputError("its magnitude is " +
                                 to_text(std::abs(values.back())) +
                                 " at t = " + to_text(time) +
                                 ": expected less than " + limit_in_words);
            }
        }
      catch (const InputError &error)
        {
          throw EntryError(entry, error.what());
        }
      return values;
    }



    bool
    varies(const std::vector<double> &values)
    {
      return values != std::vector<double>(values.size(), values.front());
    }



    /** Whether there is an interference. */
    bool
    check_interference(const Scene &scene, const std::vector<double> &times)
    {
      const InterfaceParameters &interface = scene.interface;
      const double               R      = scene.implant.characteristic_radius();
      const auto                 values = checked_values(
        "Interface / Interference",
        [&] { return read_time_function(interface.interference, R); },
        times,
        R,
        "the implant's radius");
      const auto refuse_if = [&](const bool is_wrong, const std::string &why) {
        if (is_wrong)
          throw EntryError("Interface / Interference",
                           why,
                           interface.interference);
      };
      const bool is_there = varies(values) || values.front() != 0.;
      refuse_if(is_there && !scene.implant.is_in_socket(),
                "a " + scene.implant.shape_row().name +
                  " is in no bore: expected 0");
      refuse_if(values.front() < 0. && interface.joint()->pulls(),
                "the bond is stretched from the beginning: with this Interface "
                "/ Law expected 0 or more at first");
      refuse_if(varies(values) && !scene.load_steps.rows_are_planned(),
                "it changes with time: expected planned steps, Load steps / "
                "Adaptive = false and Path following = none");
      return is_there;
    }



    void
    check_chuck(const Scene &scene)
    {
      const std::vector<double> times     = scene.load_steps.sample_times(true);
      const auto                values_of = [&](const unsigned int c) {
        const bool loaded = scene.chuck.component[c].loaded;
        return checked_values(
          scene.chuck.entry_name(c, "Value"),
          [&] { return scene.value_over_time(c); },
          times,
          loaded ? 1e12 : 1e6,
          loaded ? "1e12 N or N mm" : "1e6 mm or degrees");
      };
      scene.chuck.check();
      values_of(ChuckComponent::rotation_z); // tables may be over the angle
      scene.chuck.check_tables(times, scene.implant.characteristic_radius());
      bool moves = check_interference(scene, times);
      for (unsigned int c = 0; c < ChuckParameters::n_components; ++c)
        {
          const ChuckComponentParameters &component = scene.chuck.component[c];
          if (component.loaded && component.stiffness != 0)
            throw EntryError(scene.chuck.entry_name(c, "Stiffness"),
                             std::string(
                               "it has no effect where the machine prescribes "
                               "a load: it is for Control = ") +
                               (is_rotation(c) ? "angle" : "displacement"));
          const auto values = values_of(c);
          moves             = moves || varies(values) ||
                  (component.loaded && values.front() != 0.);
        }
      if (!moves)
        throw EntryError("",
                         "nothing moves in this scene: all six chuck "
                         "components have constant values and none carries a "
                         "load. Give for instance Chuck / Press / Value = "
                         "0.0049 * min(t, 1)");
    }



    void
    check_path_following(const Scene &scene)
    {
      if (!scene.load_steps.follow_path)
        return;
      const std::string entry = "Load steps / Path following";
      if (scene.model != ModelKind::finite_elements)
        throw EntryError(entry, "it is for Model = finite elements");
      if (scene.interface.is_viscous())
        throw EntryError(
          entry,
          "along a path of equilibrium the time may fall and is no clock for " +
            (scene.interface.viscosity > 0. ?
               "Interface / Viscosity = " + to_text(scene.interface.viscosity) :
               "Expert / Interface / Adhesive / Opening viscosity = " +
                 to_text(scene.interface.joint()->tension.viscosity)) +
            ": expected only one of them");
    }



    /** A step has friction or has none. */
    void
    check_start_of_friction(const InterfaceParameters    &interface,
                            const LoadSteppingParameters &load_steps)
    {
      const std::string          entry = "Interface / Friction starts at";
      const std::vector<double> &times = load_steps.times;
      if (!interface.friction->is_frictionless &&
          interface.friction_starts_at > times.back())
        throw EntryError(entry,
                         "this is after the last of Load steps / Times: use "
                         "Friction law = frictionless if none is wanted");

      if (interface.friction_starts_at <= times.front())
        return;
      const bool                is_planned = load_steps.rows_are_planned();
      const std::vector<double> ends       = // of what has friction or has none
        is_planned ? load_steps.planned_times() : times;
      const double tolerance = 1e-9 * (times.back() - times.front());
      if (std::none_of(ends.begin(), ends.end(), [&](const double end) {
            return std::abs(end - interface.friction_starts_at) <= tolerance;
          }))
        throw EntryError(
          entry,
          is_planned ? "this is inside a planned step: expected the end of "
                       "a step (Load steps / Times and Steps)" :
                       "this is inside a phase: with adaptive steps or Path "
                       "following one of Load steps / Times is expected");
    }



    /** Bone that is crushed under a constant pressure bears no larger force. */
    void
    check_crushing(const Scene &scene)
    {
      constexpr auto   push = ChuckComponent::translation_z;
      const BoneLayer &bone = scene.interface.bone_layer;
      const double     area = scene.implant.geometry().area;
      if (!bone.crushes() || bone.crushing_modulus > 0. || area == 0. ||
          !scene.chuck.component[push].loaded ||
          scene.implant.geometry().is_in_bore())
        return;
      const auto   values = scene.sampled_values(push);
      const double force  = -*std::min_element(values.begin(), values.end());
      if (force > bone.crushing_strength * area)
        throw EntryError("Interface / Crushing strength",
                         "with Crushing modulus = 0 the face, " +
                           to_text(area, 4) + " mm^2, bears " +
                           to_text(bone.crushing_strength * area, 4) +
                           " N at most, and the scene presses it with " +
                           to_text(force, 4) + " N",
                         to_text(bone.crushing_strength));
    }



    /** What has no rate. */
    void
    check_rate(const Scene &scene)
    {
      if (!scene.interface.friction->depends_on_rate)
        return;
      const std::pair<bool, const char *> without_rate[] = {
        {scene.load_steps.follow_path, "Load steps / Path following"},
        {scene.interface.explicit_friction, "Expert / Friction update"},
        {scene.output.friction_law_curve,
         "Expert / Output / Friction law curve"},
        {scene.model != ModelKind::finite_elements, "Model"}};
      for (const auto &[is_wanted, entry] : without_rate)
        if (is_wanted)
          throw EntryError(entry,
                           "it does not go with this Friction law, whose "
                           "coefficient depends on the sliding speed");
    }



    /** The results of an earlier run may be removed before the next begins. */
    void
    check_input_files(const Scene &scene)
    {
      namespace fs = std::filesystem;
      std::vector<std::pair<std::string, std::string>> files{
        {scene.bone.mesh_file, "Bone / Mesh file"},
        {scene.implant.mesh_file, "Implant / Mesh file"},
        {scene.bone.coarser_mesh_file, "Expert / Bone / Coarser mesh file"},
        {scene.implant.coarser_mesh_file,
         "Expert / Implant / Coarser mesh file"},
        {scene.bone.voxel_file, "Bone / Voxel file"},
        {scene.interface.bonding.file, "Interface / Bonding / File"}};
      for (unsigned int c = 0; c < ChuckParameters::n_components; ++c)
        files.emplace_back(scene.chuck.component[c].file,
                           scene.chuck.entry_name(c, "File"));
      std::error_code wrong;
      const fs::path  results =
        fs::weakly_canonical(scene.output.directory, wrong);
      for (const auto &[file, entry] : files)
        if (!file.empty() &&
            fs::weakly_canonical(file, wrong).parent_path() == results &&
            !wrong)
          throw EntryError(entry,
                           "this file is in the directory that the scene "
                           "writes its results to (Output / Directory): copy "
                           "it elsewhere first");
    }



  } // namespace



  void
  Scene::check_shapes() const
  {
    for (const auto &[own, entry] :
         {std::pair{&bone, "Expert / Implant / Coarser mesh file"},
          std::pair{&implant, "Expert / Bone / Coarser mesh file"}})
      if (!own->coarser_mesh_file.empty() && !has_coarser_files(*this))
        throw EntryError(entry,
                         "expected a file, as the other body has one: the "
                         "error comes from larger cells of both");
    if (implant.geometry().is_in_bore() && bone.shape_row().is_lattice())
      throw EntryError("Implant / Shape",
                       "a " + implant.shape_row().name +
                         " is in the bone, and a " + bone.shape_row().name +
                         " is below it: expected Bone / Shape = " +
                         (implant.geometry().centre_of_sphere ? "cavity" :
                                                                "sleeve"));
  }



  void
  Scene::check() const
  {
    // the table refuses values out of their ranges
    Scene      copy = *this;
    EntryTable table;
    copy.declare(table);

    bone.check("Bone");
    implant.check("Implant");
    check_faces(bone, implant);
    check_input_files(*this);
    if (bone.is_fitted() && implant.shape != BodyShape::coin &&
        implant.shape != BodyShape::cap && implant.shape != BodyShape::ring)
      throw EntryError(
        "Bone / Cells",
        "cells are fitted to the rim of a coin, cap or ring, and "
        "Implant / Shape is " +
          implant.shape_row().name + ": expected numbers");
    interface.check(implant);
    check_bonding_pattern(interface.bonding,
                          implant,
                          interface.points_per_element(bone, implant));
    // closed forms say themselves what else does not go with them
    if (bone.modulus && model != ModelKind::finite_elements)
      throw EntryError("Bone / Young modulus",
                       "one that varies is for Model = finite elements, and "
                       "closed forms know none: expected a number");
    load_steps.check();
    check_start_of_friction(interface, load_steps);
    check_rate(*this);
    check_crushing(*this);
    const std::vector<double> &marks = output.motion_between;
    if (!marks.empty() && (!std::is_sorted(marks.begin(),
                                           marks.end(),
                                           std::less_equal<double>()) ||
                           marks.front() < load_steps.times.front() ||
                           marks.back() > load_steps.times.back()))
      throw EntryError("Output / Motion between",
                       "expected times that ascend, within Load steps / Times",
                       entry_text(marks));
    // its error is of first order, and nothing estimates it
    if (load_steps.adaptive && interface.explicit_friction)
      throw EntryError("Expert / Friction update",
                       "explicit depends on the size of the steps, which Load "
                       "steps / Adaptive = true chooses: compare it in equal "
                       "steps");
    check_chuck(*this);
    check_path_following(*this);
    read_profiles(output.reference_profiles);
    if (!output.reference_profiles.empty() && output.profile_angles.empty())
      throw EntryError(
        "Expert / Output / Reference profiles",
        "it needs Expert / Output / Profile angles to compare at");
    if (bone.bulk_solver == BulkSolver::lattice && !why_not_lattice().empty())
      throw EntryError("Expert / Bone / Solver",
                       why_not_lattice() +
                         ": expected auto, direct or multigrid");
  }
} // namespace Debond
