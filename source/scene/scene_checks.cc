#include <debond/input/entry_table.h>
#include <debond/input/expression_parser.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/scene/reference_data.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>

#include <cmath>
#include <filesystem>
#include <utility>

namespace Debond
{
  namespace
  {
    void
    check_faces(const BodyParameters &bone, const BodyParameters &implant)
    {
      if (implant.geometry().is_in_bore() && bone.shape_row().is_lattice())
        throw EntryError("Implant / Shape",
                         "a " + implant.shape_row().name +
                           " is in the bone, and a " + bone.shape_row().name +
                           " is below it: expected Bone / Shape = " +
                           (implant.geometry().centre_of_sphere ? "cavity" :
                                                                  "sleeve"));
      for (unsigned int d = 0; d < 2; ++d)
        if (implant.width(d) > bone.width(d))
          throw EntryError("Implant / " + implant.shape_row().entries.front(),
                           "the implant is " + to_text(implant.width(d)) +
                             " mm wide in " + "xy"[d] +
                             ", wider than the bone below it (Bone / " +
                             bone.shape_row().entries.front() + ": " +
                             to_text(bone.width(d)) + " mm)");
    }



    /** Whether a component changes with time or carries a load; refuses
     *  expressions that cannot be read or have no finite value, and values that
     *  cannot be computed with. */
    bool
    check_component(const Scene               &scene,
                    const unsigned int         c,
                    const std::vector<double> &times)
    {
      const ChuckComponentParameters &component = scene.chuck.component[c];
      const double                    largest   = component.loaded ? 1e12 : 1e6;
      try
        {
          const TimeFunction function    = scene.value_over_time(c);
          const double       first_value = function(times.front());
          bool               varies      = false;
          for (const double time : times)
            {
              const double value = function(time);
              if (std::abs(value) > largest)
                throw InputError(
                  "it is " + to_text(component.into_bone ? -value : value) +
                  " at t = " + to_text(time) + ": expected at most " +
                  to_text(largest) +
                  (component.loaded ? " N or N mm" : " mm or degrees"));
              varies = varies || value != first_value;
            }
          return varies || (component.loaded && first_value != 0);
        }
      catch (const InputError &error)
        {
          throw EntryError(scene.chuck.entry_name(c, "Value"), error.what());
        }
    }



    /** The same of the interference. */
    bool
    check_interference(const Scene &scene, const std::vector<double> &times)
    {
      const char *const entry = "Interface / Interference";
      const double      R     = scene.implant.characteristic_radius();
      bool              moves = false, varies = false;
      try
        {
          const auto value =
            read_time_function(scene.interface.interference, R);
          for (const double time : times)
            {
              if (!(std::abs(value(time)) < R))
                throw InputError("it is " + to_text(value(time)) +
                                 " mm at t = " + to_text(time) +
                                 ": expected less than the implant's radius");
              moves  = moves || value(time) != 0.;
              varies = varies || value(time) != value(times.front());
            }
        }
      catch (const InputError &error)
        {
          throw EntryError(entry, error.what());
        }
      if (moves && !scene.implant.geometry().is_in_bore())
        throw EntryError(entry,
                         "a " + scene.implant.shape_row().name +
                           " is in no bore: expected 0",
                         scene.interface.interference);
      if (moves && scene.interface.joint()->pulls() &&
          read_time_function(scene.interface.interference, R)(times.front()) <
            0.)
        throw EntryError(entry,
                         "the bond is stretched from the beginning: with this "
                         "Interface / Law expected 0 or more at first",
                         scene.interface.interference);
      if (varies && (scene.load_steps.adaptive || scene.load_steps.follow_path))
        throw EntryError(entry,
                         "it changes with time: expected planned steps, Load "
                         "steps / Adaptive = false and Path following = none",
                         scene.interface.interference);
      return moves;
    }



    void
    check_chuck(const Scene &scene)
    {
      const std::vector<double> times = scene.load_steps.sample_times(true);
      scene.chuck.check();
      check_component(scene, ChuckComponent::rotation_z, times);
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
          const bool this_moves = check_component(scene, c, times);
          moves                 = moves || this_moves;
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
          "along a path of equilibrium the time may fall and is "
          "no clock for Interface / " +
            (scene.interface.viscosity > 0. ?
               "Viscosity = " + to_text(scene.interface.viscosity) :
               "Adhesive / Opening viscosity = " +
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
      const bool is_planned = !load_steps.adaptive && !load_steps.follow_path;
      std::vector<double> ends      = times; // of what has friction or has none
      double              tolerance = 0.;
      if (is_planned)
        {
          ends      = load_steps.planned_times();
          tolerance = 1e-9 * (times.back() - times.front());
        }
      for (const double end : ends)
        if (std::abs(end - interface.friction_starts_at) <= tolerance)
          return;
      throw EntryError(entry,
                       is_planned ?
                         "this is inside a planned step: expected the end of a "
                         "step (Load steps / Times and Steps)" :
                         "this is inside a phase: with adaptive steps or Path "
                         "following one of Load steps / Times is expected");
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
        {scene.output.friction_law_curve, "Output / Friction law curve"},
        {scene.model != ModelKind::finite_elements, "Model"}};
      for (const auto &[is_wanted, entry] : without_rate)
        if (is_wanted)
          throw EntryError(entry,
                           "it does not go with this Friction law, whose "
                           "coefficient depends on the sliding speed");
    }



    /** Its error is of first order, and nothing estimates it. */
    void
    check_explicit_friction(const Scene &scene)
    {
      if (scene.load_steps.adaptive && scene.interface.explicit_friction)
        throw EntryError("Expert / Friction update",
                         "explicit depends on the size of the steps, which "
                         "Load steps / Adaptive = true chooses: compare it in "
                         "equal steps");
    }



    void
    check_references(const OutputParameters &output)
    {
      read_profiles(output.reference_profiles);
      if (!output.reference_profiles.empty() && output.profile_angles.empty())
        throw EntryError("Output / Reference profiles",
                         "it needs Output / Profile angles to compare at");
    }



    /** The results of an earlier run may be removed before the next begins. */
    void
    check_input_file(const std::string &file,
                     const std::string &entry,
                     const std::string &directory)
    {
      namespace fs = std::filesystem;
      std::error_code wrong;
      if (!file.empty() &&
          fs::weakly_canonical(file, wrong).parent_path() ==
            fs::weakly_canonical(directory, wrong) &&
          !wrong)
        throw EntryError(entry,
                         "this file is in the directory that the scene writes "
                         "its results to (Output / Directory): copy it "
                         "elsewhere first");
    }



    /** Such patterns are others on other meshes. */
    void
    check_pattern_of_auto(const BondingParameters &bonding)
    {
      const bool is_random = bonding.pattern == BondingPatternKind::random;
      if (bonding.pattern == BondingPatternKind::file ||
          (is_random && bonding.correlation_length == 0.))
        throw EntryError(
          "Interface / Bonding / Pattern",
          std::string("it belongs to one mesh, but Model = auto compares "
                      "several: use Model = finite elements, or ") +
            (is_random ? "give a Correlation length" : "another pattern"));
    }
  } // namespace



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
    for (const std::string section : {"Bone", "Implant"})
      {
        const BodyParameters &body = section == "Bone" ? bone : implant;
        check_input_file(body.mesh_file,
                         section + " / Mesh file",
                         output.directory);
        if (model == ModelKind::automatic && body.mesh)
          throw EntryError(section + " / Shape",
                           "Model = auto makes its own meshes: expected Model "
                           "= finite elements, or another shape");
      }
    if (bone.is_fitted() && implant.shape != BodyShape::coin &&
        implant.shape != BodyShape::cap)
      throw EntryError("Bone / Cells",
                       "cells are fitted to the rim of a coin or a cap, and "
                       "Implant / Shape is " +
                         implant.shape_row().name + ": expected numbers");
    interface.check(implant);
    check_bonding_pattern(interface.bonding,
                          implant,
                          interface.points_per_element(bone, implant));
    if (model == ModelKind::automatic)
      check_pattern_of_auto(interface.bonding);
    load_steps.check();
    check_start_of_friction(interface, load_steps);
    check_rate(*this);
    check_explicit_friction(*this);
    check_chuck(*this);
    check_path_following(*this);
    check_references(output);
    check_input_file(interface.bonding.file,
                     "Interface / Bonding / File",
                     output.directory);
    for (unsigned int c = 0; c < ChuckParameters::n_components; ++c)
      check_input_file(chuck.component[c].file,
                       chuck.entry_name(c, "File"),
                       output.directory);
    check_input_file(bone.voxel_file, "Bone / Voxel file", output.directory);
    if (bone.modulus && model != ModelKind::finite_elements)
      throw EntryError("Bone / Young modulus",
                       "one that varies is for Model = finite elements, and "
                       "closed forms know none: expected a number");
    if (bone.bulk_solver == BulkSolver::lattice && !why_not_lattice().empty())
      throw EntryError("Bone / Solver",
                       why_not_lattice() +
                         ": expected auto, direct or multigrid");
  }
} // namespace Debond
