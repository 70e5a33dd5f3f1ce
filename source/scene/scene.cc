#include <debond/input/allowed_values.h>
#include <debond/input/scene_entries.h>
#include <debond/input/scene_file.h>
#include <debond/input/time_function.h>
#include <debond/output/profile_comparison.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/magnitudes.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>
#include <debond/system/load_stepping.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <ostream>
#include <sstream>

namespace Debond
{
  void
  AutoParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Auto");
    prm.declare_entry("Largest number of unknowns",
                      "250000",
                      Allowed::whole_number(1, 100000000),
                      "With Model = auto: unknowns of both bodies up to which "
                      "meshes are refined. The memory needed goes with it: "
                      "1 GB for 105 000, some 3 GB for 250 000.");
    prm.leave_subsection();
  }



  void
  AutoParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Auto");
    largest_number_of_unknowns = prm.get_integer("Largest number of unknowns");
    prm.leave_subsection();
  }



  void
  StudyParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Study");
    prm.declare_entry("Reference variant",
                      "0",
                      Allowed::whole_number(0, 100000),
                      "In a study, whose entries hold several values as in "
                      "{{a|b|c}}: number of the variant that the others' "
                      "torque curves are compared with in study.csv. 0: "
                      "they are compared with Output / Reference curve, if "
                      "there is one.");
    prm.declare_entry("Factors varied at once",
                      "0",
                      Allowed::whole_number(0, 1000),
                      "Of all combinations, only those in which at most this "
                      "many factors differ from their first value: 1 varies "
                      "one factor at a time, 2 also every pair. A factor is an "
                      "entry {{a|b|c}}, or all entries {{name: a|b|c}} with "
                      "one name. 0: all combinations.");
    prm.declare_entry("Repetitions",
                      "1",
                      Allowed::whole_number(1, 1000),
                      "Number of runs of each variant. In study.csv seconds "
                      "are then medians; all else is that of the last run. "
                      "Seconds mean something with --jobs 1 only.");
    prm.leave_subsection();
  }



  void
  StudyParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Study");
    reference_variant = prm.get_integer("Reference variant");
    factors_at_once   = prm.get_integer("Factors varied at once");
    repetitions       = prm.get_integer("Repetitions");
    prm.leave_subsection();
  }



  void
  Scene::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Title",
                      "",
                      Allowed::optional_text("any text"),
                      "Title of the scene, for people.");
    prm.declare_entry("Model",
                      "finite elements",
                      Allowed::choice("finite elements | foundation | "
                                      "analytical | mathieu | auto"),
                      "Model that is solved. `finite elements': two bodies "
                      "with an interface between them. The others are closed "
                      "forms for a coin that is pressed down and then turned: "
                      "`foundation': a rigid disk on a foundation with the "
                      "stiffness of interface and bodies in series, and the "
                      "full friction law. `analytical': Eq. (18) of the "
                      "paper. `mathieu': Eqs. (14) to (16). See subsection "
                      "Closed form. `auto': climbs from the cheapest of "
                      "`foundation', rigid, linear and the scene's own bodies "
                      "on finer and finer meshes until the error of the torque "
                      "curve is estimated to be within Load steps / Tolerance, "
                      "and answers with the cheapest model that is; the "
                      "program chooses the steps.");
    prm.declare_entry("Task",
                      "simulate",
                      Allowed::choice("simulate", "calibrate"),
                      "What to do with the model: run it once.");
    BodyParameters::declare_bone(prm);
    BodyParameters::declare_implant(prm);
    InterfaceParameters::declare(prm);
    ChuckParameters::declare(prm);
    LoadSteppingParameters::declare(prm);
    ClosedFormParameters::declare(prm);
    AutoParameters::declare(prm);
    StudyParameters::declare(prm);
    OutputParameters::declare(prm);
  }



  void
  Scene::parse(dealii::ParameterHandler &prm)
  {
    title                        = prm.get("Title");
    const std::string model_name = prm.get("Model");
    model = model_name == "foundation" ? ModelKind::foundation :
            model_name == "analytical" ? ModelKind::analytical :
            model_name == "mathieu"    ? ModelKind::mathieu :
            model_name == "auto"       ? ModelKind::automatic :
                                         ModelKind::finite_elements;
    bone.parse_bone(prm);
    implant.parse_implant(prm);
    interface.parse(prm);
    chuck.parse(prm);
    load_steps.parse(prm);
    if (model == ModelKind::automatic)
      load_steps.adaptive = true;
    closed_form.parse(prm);
    automatic.parse(prm);
    study.parse(prm);
    output.parse(prm);
  }



  namespace
  {
    void
    check_cells(const BodyParameters &body, const std::string &name)
    {
      const double n_cells =
        static_cast<double>(body.cells[0]) * body.cells[1] * body.cells[2];
      constexpr double largest_number = 2e6;
      if (n_cells > largest_number)
        throw InputError(name + " / Cells: " + to_text(n_cells) +
                         " cells are more than this program can solve for, " +
                         to_text(largest_number));

      const double thinnest = std::pow(1. / body.cells[2], body.layer_grading);
      if (thinnest < 1e-6)
        throw InputError(
          name + " / Layer grading = " + to_text(body.layer_grading) +
          " makes the first of " + std::to_string(body.cells[2]) +
          " layers thinner than a millionth of the body");

      for (unsigned int d = 0; d < 2; ++d)
        {
          const double n      = body.cells[d];
          const double g      = body.lateral_grading;
          const double centre = body.cells[d] % 2 == 1 ?
                                  std::pow(1. / n, g) :
                                  0.5 * std::pow(2. / n, g);
          const double border =
            n > 2 ? 0.5 * (1. - std::pow(1. - 2. / n, g)) : 1.;
          if (std::min(centre, border) < 1e-6)
            throw InputError(
              name + " / Lateral grading = " + to_text(g) + " makes some of " +
              std::to_string(body.cells[d]) +
              " cells across thinner than a millionth of the body");
        }

      // nine control points over one face: 2 x 2 Gauss points do not see all
      // their motions, and the stiffness is singular
      if (body.material != Material::rigid &&
          body.contact_surface == SurfaceKind::nurbs &&
          std::min(body.cells[0], body.cells[1]) < 2)
        throw InputError(name + " / Cells: one cell across is too few for "
                                "Contact surface = nurbs: expected at least 2");
    }



    void
    check_faces(const BodyParameters &bone, const BodyParameters &implant)
    {
      const bool is_round = implant.is_round();
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double width = implant.width(d);
          if (width > bone.size[d])
            throw InputError(
              std::string("Implant / ") + (is_round ? "Radius" : "Size") +
              ": the implant is " + to_text(width) + " mm wide in " + "xy"[d] +
              ", wider than the bone below it (Bone / Size: " +
              to_text(bone.size[d]) + " mm)");
        }
    }



    void
    check_cap(const BodyParameters &implant)
    {
      if (implant.shape != BodyShape::cap)
        return;
      if (implant.cap_radius <= implant.radius)
        throw InputError(
          "Implant / Cap radius = " + to_text(implant.cap_radius) +
          ": a cap is flatter than a hemisphere: expected more "
          "than Radius, " +
          to_text(implant.radius) + " mm");
      if (implant.rise() >= implant.height)
        throw InputError("Implant / Height = " + to_text(implant.height) +
                         ": the rim of the cap is " + to_text(implant.rise()) +
                         " mm above its centre: expected more than that");
    }



    void
    check_times(const LoadSteppingParameters &load_steps)
    {
      const std::vector<double> &times = load_steps.times;
      for (std::size_t i = 1; i < times.size(); ++i)
        if (!(times[i] > times[i - 1]))
          throw InputError("Load steps / Times: " + to_text(times[i]) +
                           " after " + to_text(times[i - 1]) +
                           ": times must increase");
      for (const double time : times)
        if (std::abs(time) > 1e100)
          throw InputError("Load steps / Times: " + to_text(time) +
                           ": expected -1e100 to 1e100");
      if (load_steps.steps.size() + 1 != times.size())
        throw InputError("Load steps / Steps: one number fewer than in Times "
                         "is expected: " +
                         std::to_string(times.size() - 1) + ", not " +
                         std::to_string(load_steps.steps.size()));
      const double n_steps =
        std::accumulate(load_steps.steps.begin(), load_steps.steps.end(), 0.);
      if (n_steps > 1e7)
        throw InputError("Load steps / Steps: " + to_text(n_steps) +
                         " steps are more than the 1e7 allowed");
      for (std::size_t i = 1; i < times.size(); ++i)
        if ((times[i] - times[i - 1]) / load_steps.steps[i - 1] <
            1e-9 * std::max(std::abs(times[i]), std::abs(times[i - 1])))
          throw InputError(
            "Load steps / Times: " + std::to_string(load_steps.steps[i - 1]) +
            " steps from " + to_text(times[i - 1], 17) + " to " +
            to_text(times[i], 17) +
            " are too small to tell their times apart: let the "
            "times begin at 0");
    }



    /** The planned times, or an even choice of them if there are many; first
     *  and last time of each phase included. */
    std::vector<double>
    sample_times(const LoadSteppingParameters &load_steps)
    {
      constexpr unsigned int largest_number = 1000;
      const unsigned int     n_phases       = load_steps.steps.size();
      const unsigned int     largest_in_phase =
        std::max(1U, largest_number / n_phases);

      std::vector<double> samples{load_steps.times[0]};
      for (unsigned int phase = 0; phase < n_phases; ++phase)
        {
          const double       begin = load_steps.times[phase];
          const double       end   = load_steps.times[phase + 1];
          const unsigned int n =
            std::min(load_steps.steps[phase], largest_in_phase);
          for (unsigned int i = 1; i < n; ++i)
            samples.push_back(begin + (end - begin) * i / n);
          samples.push_back(end);
        }
      return samples;
    }



    /** Whether a component changes with time or carries a load; refuses
     *  expressions that cannot be read or have no finite value. */
    bool
    check_component(const ChuckComponentParameters &component,
                    const std::string              &name,
                    const std::vector<double>      &times,
                    const double                    radius)
    {
      if (component.loaded && component.stiffness != 0)
        throw InputError(name +
                         " / Stiffness has no effect where the machine "
                         "prescribes a load: it is for Control = " +
                         (name.find("Rotation") == std::string::npos ?
                            "displacement" :
                            "angle"));
      try
        {
          const TimeFunction value = component.value_over_time(radius);
          const double       first_value = value(times.front());
          bool               varies      = false;
          for (const double time : times)
            {
              check_chuck_value(value(time), component.loaded, time);
              varies = (value(time) != first_value) || varies;
            }
          return varies || (component.loaded && first_value != 0);
        }
      catch (const InputError &error)
        {
          throw InputError(name + " / Value: " + error.what());
        }
    }



    void
    check_chuck(const Scene &scene)
    {
      const std::vector<double> times  = sample_times(scene.load_steps);
      const double              radius = scene.implant.characteristic_radius();
      bool                      moves  = false;
      for (unsigned int c = 0; c < ChuckParameters::n_components; ++c)
        moves =
          check_component(scene.chuck.component[c],
                          std::string("Chuck / ") + ChuckParameters::names[c],
                          times,
                          radius) ||
          moves;
      if (!moves)
        throw InputError("nothing moves in this scene: all six chuck "
                         "components have constant values and none carries a "
                         "load. Give for instance Chuck / Translation z / "
                         "Value = -0.0049 * min(t, 1)");
    }



    void
    check_path_following(const Scene &scene)
    {
      if (!scene.load_steps.follow_path)
        return;
      if (scene.load_steps.adaptive)
        throw InputError("Load steps / Path following = slip chooses its steps "
                         "itself: expected Load steps / Adaptive = false");
      if (scene.model != ModelKind::finite_elements)
        throw InputError("Load steps / Path following = slip is for Model = "
                         "finite elements");
      if (scene.interface.viscosity > 0.)
        throw InputError(
          "Load steps / Path following = slip and Interface / Viscosity = " +
          to_text(scene.interface.viscosity) +
          ": along a path of equilibrium the time may fall and is no clock for "
          "a viscosity: expected only one of them");
    }



    void
    check_viscosity(const InterfaceParameters &interface)
    {
      if (interface.friction->is_frictionless() && interface.viscosity != 0.)
        throw InputError("Interface / Viscosity = '" +
                         to_text(interface.viscosity) +
                         "' is not used by Friction law = frictionless: it "
                         "belongs to laws with friction");
    }



    void
    check_rate(const Scene &scene)
    {
      if (!scene.interface.friction->depends_on_rate())
        return;
      const auto refuse = [](const std::string &entry) {
        throw InputError(entry + " does not go with this Friction law, whose "
                                 "coefficient depends on the sliding speed");
      };
      if (scene.load_steps.follow_path)
        refuse("Load steps / Path following = slip");
      if (scene.interface.explicit_friction)
        refuse("Interface / Friction update = explicit");
      if (scene.output.friction_law_curve)
        refuse("Output / Friction law curve");
      if (scene.model != ModelKind::finite_elements)
        refuse("Model = finite elements is expected: any other Model");
    }



    void
    check_friction(const InterfaceParameters    &interface,
                   const LoadSteppingParameters &load_steps)
    {
      const double starts_at = interface.friction_starts_at;
      if (!interface.friction->is_frictionless() &&
          starts_at > load_steps.times.back())
        throw InputError(
          "Interface / Friction starts at = " + to_text(starts_at) +
          " is after the last of Load steps / Times: use "
          "Friction law = frictionless if none is wanted");

      // a step has friction or has none
      if (starts_at <= load_steps.times.front())
        return;
      if (load_steps.adaptive || load_steps.follow_path)
        {
          if (std::find(load_steps.times.begin(),
                        load_steps.times.end(),
                        starts_at) == load_steps.times.end())
            throw InputError(
              "Interface / Friction starts at = " + to_text(starts_at) +
              " is inside a phase: with adaptive steps or Path "
              "following one of "
              "Load steps / Times is expected");
          return;
        }
      const LoadStepping stepping(load_steps);
      const double       duration =
        load_steps.times.back() - load_steps.times.front();
      for (unsigned int step = 0; step <= stepping.n_steps(); ++step)
        if (std::abs(stepping.time(step) - starts_at) <= 1e-9 * duration)
          return;
      throw InputError(
        "Interface / Friction starts at = " + to_text(starts_at) +
        " is inside a planned step: expected the end of a step "
        "(Load steps / Times and Steps)");
    }



    void
    check_output(const OutputParameters &output)
    {
      // what cannot be read is refused before anything runs
      read_reference_curve(output.reference_curve);
      read_profiles(output.reference_profiles);
      if (!output.reference_profiles.empty() && output.profile_angles.empty())
        throw InputError("Output / Reference profiles = '" +
                         output.reference_profiles +
                         "' needs Output / Profile angles to compare at");
    }



    /** The results of an earlier run may be removed before the next begins. */
    void
    check_bonding_file(const std::string &file, const std::string &directory)
    {
      namespace fs = std::filesystem;
      std::error_code wrong;
      if (!file.empty() &&
          fs::weakly_canonical(file, wrong).parent_path() ==
            fs::weakly_canonical(directory, wrong) &&
          !wrong)
        throw InputError("Interface / Bonding / File = '" + file +
                         "' is in the directory that this scene writes its "
                         "results to (Output / Directory): copy it elsewhere "
                         "first");
    }



    /** Such patterns are others on other meshes. */
    void
    check_pattern_of_auto(const BondingParameters &bonding)
    {
      const bool is_independent_of_mesh =
        bonding.pattern != BondingPatternKind::file &&
        (bonding.pattern != BondingPatternKind::random ||
         bonding.correlation_length > 0.);
      if (!is_independent_of_mesh)
        throw InputError(
          "Interface / Bonding / Pattern = '" + name_of(bonding.pattern) +
          "' belongs to one mesh, but Model = auto compares several: use Model = "
          "finite elements, or " +
          (bonding.pattern == BondingPatternKind::random ?
             "give a Correlation length" :
             "another pattern"));
    }
  } // namespace



  void
  Scene::check() const
  {
    check_magnitudes(*this);
    check_cells(bone, "Bone");
    check_cells(implant, "Implant");
    check_cap(implant);
    check_faces(bone, implant);
    interface.bonding.check(implant);
    if (model == ModelKind::automatic)
      check_pattern_of_auto(interface.bonding);
    check_times(load_steps);
    check_viscosity(interface);
    check_friction(interface, load_steps);
    check_rate(*this);
    check_chuck(*this);
    check_path_following(*this);
    check_output(output);
    check_bonding_file(interface.bonding.file, output.directory);
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
    dealii::ParameterHandler prm;
    declare(prm);
    apply_entries(entries, prm);

    Scene scene;
    scene.entries = entries;
    scene.name    = name;
    try
      {
        scene.parse(prm);
        scene.check();
      }
    catch (const InputError &error)
      {
        throw InputError(scene.with_place(error.what()));
      }

    std::ostringstream completed;
    prm.print_parameters(completed,
                         dealii::ParameterHandler::ShortPRM |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    scene.completed_parameters = completed.str() +
                                 identity_of(scene.interface.bonding.file) +
                                 identity_of(scene.interface.friction->file());
    return scene;
  }



  std::string
  Scene::with_place(const std::string &message) const
  {
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry)
      {
        if (message.compare(0, entry->place.size() + 2, entry->place + ": ") ==
            0)
          return message; // it is there already
        const std::string full_name = entry->full_name();
        if (message.compare(0, full_name.size(), full_name) != 0)
          continue;
        const std::string rest = message.substr(full_name.size());
        // some messages show it themselves
        const bool shows_value =
          rest.find("'" + shortened(entry->value) + "'") != std::string::npos;
        if (rest[0] == ':' && !shows_value)
          return entry->place + ": " + full_name + " = '" +
                 shortened(entry->value) + "'" + rest;
        if (rest.empty() || rest[0] == ' ' || rest[0] == ':')
          return entry->place + ": " + message;
      }
    const bool has_name = message.compare(0, name.size() + 2, name + ": ") == 0;
    return has_name ? message : name + ": " + message;
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
    dealii::ParameterHandler prm;
    Scene::declare(prm);
    if (scene != nullptr)
      apply_entries(read_scene_text(scene->completed_parameters, "scene"), prm);
    print_entries(prm, out);
  }
} // namespace Debond
