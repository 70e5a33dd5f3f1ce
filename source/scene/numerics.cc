#include <debond/input/entry_table.h>
#include <debond/input/expression_parser.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

// Cells, elements and steps of a scene that leaves them to the program.
namespace Debond
{
  namespace
  {
    /** Entries that are chosen, and whether the scene sets them. */
    struct Choice
    {
      const Scene            &scene;
      std::vector<SceneEntry> entries;

      bool
      is_open(const std::string &section, const std::string &name) const
      {
        const auto is_last = [&](const SceneEntry &entry) {
          return entry.full_name() == section + " / " + name;
        };
        const auto set =
          std::find_if(scene.entries.rbegin(), scene.entries.rend(), is_last);
        return set == scene.entries.rend() || set->value == "auto";
      }

      void
      choose(const std::string &section,
             const std::string &name,
             const std::string &value)
      {
        if (is_open(section, name))
          entries.push_back({{section}, name, value, ""});
      }
    };



    /** Whether it stays where cells that follow its rim are: within a tenth of
     *  its radius from the middle of the bone. */
    bool
    stays_in_place(const Scene &scene)
    {
      const double R = scene.implant.characteristic_radius();
      for (unsigned int k = ChuckComponent::translation_x;
           k < ChuckComponent::translation_z;
           ++k)
        {
          const auto &component = scene.chuck.component[k];
          const auto  values    = scene.sampled_values(k);
          if (component.loaded ||
              std::any_of(values.begin(), values.end(), [R](const double u) {
                return std::abs(u) > 0.1 * R;
              }))
            return false;
        }
      return true;
    }



    bool
    is_fitted_possible(const Choice &choice)
    {
      const Scene &scene             = choice.scene;
      const auto   is_spline_or_open = [&](const char *const     section,
                                         const BodyParameters &body) {
        return body.element == ElementKind::spline ||
               choice.is_open(section, "Element");
      };
      return scene.bone.shape == BodyShape::block &&
             !scene.has_soft_interface() &&
             (scene.implant.shape == BodyShape::coin ||
              scene.implant.shape == BodyShape::cap ||
              scene.implant.shape == BodyShape::ring) &&
             is_spline_or_open("Bone", scene.bone) &&
             is_spline_or_open("Implant", scene.implant) &&
             choice.is_open("Bone", "Cells") &&
             choice.is_open("Expert / Bone", "Layer grading") &&
             scene.bone.lateral_grading == 1. &&
             scene.bone.cells_under_implant == 0 &&
             scene.bone.contact_surface == SurfaceKind::nurbs &&
             (scene.bone.bulk_solver == BulkSolver::automatic ||
              scene.bone.bulk_solver == BulkSolver::direct) &&
             scene.implant.width(0) <
               0.998 * std::min(scene.bone.size[0], scene.bone.size[1]) &&
             Ranks::number() == 1 && stays_in_place(scene);
    }



    /** Cells of equal width, three to a radius of the implant. */
    std::vector<unsigned int>
    lattice_below(const Scene &scene)
    {
      const double width = scene.implant.characteristic_radius() / 3.;
      std::vector<unsigned int> n;
      for (const unsigned int d : {0, 1})
        n.push_back(std::ceil(scene.bone.size[d] / width - 1e-9));
      n.push_back(4);
      return n;
    }



    /** Cells that heed the edges of a block: in the order below it, beside it
     *  on one side, and layers. */
    void
    choose_around_block(Choice &choice)
    {
      const bool is_stiff = !choice.scene.has_soft_interface();
      choice.choose("Bone", "Cells", is_stiff ? "18, 18, 5" : "14, 14, 4");
      choice.entries.push_back(
        {{"Expert", "Bone"}, "Cells under implant", is_stiff ? "8" : "6", ""});
      if (is_stiff)
        choice.choose("Expert / Bone", "Rim grading", "2.5");
      choice.choose("Expert / Bone", "Layer grading", is_stiff ? "2.5" : "2");
    }



    /** Where the contact of a cap ends under its largest press [mm]: Hertz's
     *  a^2 = R d and F = 4 E* a^3 / (3 R) with the spring eps_n in between, up
     *  to 6 % of the load (2 % of a) from the solution of both. */
    double
    contact_radius_of(const Scene &scene)
    {
      const auto compliance = [](const BodyParameters &body) {
        return body.is_rigid() ?
                 0. :
                 (1. - std::pow(body.poisson_ratio, 2)) / body.young_modulus;
      };
      const double E_star =
                     1. / (compliance(scene.bone) + compliance(scene.implant)),
                   R   = scene.implant.cap_radius,
                   eps = scene.interface.normal_penalty;
      const bool is_force =
        scene.chuck.component[ChuckComponent::translation_z].loaded;
      const auto press = [&](const double a) {
        const double k = eps * a / E_star, a_2 = a * a / R;
        return is_force ? E_star * a * a_2 / (0.75 + 4. / (M_PI * k)) :
                          a_2 * (k + 1.) / (k + 2.);
      };
      const auto   values = scene.sampled_values(ChuckComponent::translation_z);
      const double most   = -*std::min_element(values.begin(), values.end());
      const double radius = scene.implant.radius;
      if (!(most > 0. && press(radius) > most))
        return radius;
      return boost::math::tools::bisect(
               [&](const double a) { return press(a) - most; },
               0.,
               radius,
               boost::math::tools::eps_tolerance<double>(40))
        .second;
    }



    /** A flat face on a block of bone. Of a body whose cells are set nothing
     *  else of them is chosen. */
    void
    choose_on_block(Choice &choice)
    {
      const Scene          &scene   = choice.scene;
      const BodyParameters &implant = scene.implant;
      const bool            is_open = choice.is_open("Bone", "Cells"),
                 is_fitted          = is_open ? is_fitted_possible(choice) :
                                                scene.bone.is_fitted();
      if (is_open && is_fitted)
        choice.choose("Bone", "Cells", "fitted 8, 3, 5, 5");
      else if (is_open && implant.shape == BodyShape::block &&
               stays_in_place(scene))
        choose_around_block(choice);
      else if (is_open)
        {
          choice.choose("Bone", "Cells", entry_text(lattice_below(scene)));
          choice.choose("Expert / Bone", "Layer grading", "2");
        }
      const bool is_ring     = implant.shape == BodyShape::ring,
                 follows_rim = is_fitted && implant.shape != BodyShape::block &&
                               implant.contact_surface == SurfaceKind::nurbs;
      choice.choose("Implant",
                    "Cells",
                    follows_rim                       ? "fitted 8, 3, 3" :
                    is_ring                           ? "12, 2, 2" :
                    implant.shape == BodyShape::block ? "6, 3" :
                                                        "3, 3");
      if (follows_rim && implant.shape == BodyShape::cap)
        choice.choose("Expert / Implant",
                      "Contact radius",
                      to_text(contact_radius_of(scene), 6));
      choice.choose("Bone", "Element", "spline");
      choice.choose("Implant",
                    "Element",
                    is_ring && !(choice.is_open("Implant", "Cells") ?
                                   follows_rim :
                                   implant.is_fitted()) ?
                      "quadratic" :
                      "spline");
    }



    /** Cells about an axis, of quadratic elements, as wide as half the radius
     *  along it, or smaller towards its ends; six to a pitch. */
    void
    choose_about_axis(Choice &choice)
    {
      const BodyParameters &implant = choice.scene.implant,
                           &bone    = choice.scene.bone;
      const bool is_screw           = implant.shape == BodyShape::screw,
                 is_cup             = implant.shape == BodyShape::cup,
                 is_stiff = !choice.scene.has_soft_interface() && !is_screw;
      const auto along    = [&](const double height) {
        const double n = std::min(2. * height / implant.radius, 8.);
        return static_cast<unsigned int>(
          std::ceil(is_screw ? 6. * height / implant.pitch :
                    is_cup   ? 3. :
                    is_stiff ? n + 2. :
                               n));
      };
      const std::string around = is_screw                       ? "16, " :
                                 choice.scene.is_axisymmetric() ? "8, " :
                                                                  "12, ";
      const double      in_bone =
        bone.sleeve_height > 0. ? bone.sleeve_height : implant.height;
      choice.choose("Bone",
                    "Cells",
                    around +
                      (is_screw ? "2, " :
                       is_stiff ? "4, " :
                                  "3, ") +
                      std::to_string(along(in_bone)));
      choice.choose("Implant",
                    "Cells",
                    around + (implant.is_rigid() ? "1, " : "2, ") +
                      std::to_string(along(implant.height)));
      for (const std::string section : {"Bone", "Implant"})
        {
          choice.choose(section, "Element", "quadratic");
          if (!is_screw)
            choice.choose("Expert / " + section,
                          "Layer grading",
                          !is_stiff ? "1.5" :
                          is_cup    ? "2" : // more makes the cells too thin
                                      "2.5");
        }
    }



    /** Whether the interference stays what it is at first. */
    bool
    is_constant_fit(const Scene &scene)
    {
      const auto value =
        read_time_function(scene.interface.interference,
                           scene.implant.characteristic_radius());
      const auto times = scene.load_steps.sample_times();
      return std::all_of(times.begin(), times.end(), [&](const double time) {
        return value(time) == value(times[0]);
      });
    }



    // They are planned along a path, with a method whose error is not
    // estimated, and where the interference changes.
    void
    choose_steps(Choice &choice)
    {
      const Scene                  &scene   = choice.scene;
      const LoadSteppingParameters &steps   = scene.load_steps;
      const std::string             section = "Load steps";
      std::vector<unsigned int>     n;
      const bool                    is_planned = steps.follow_path ||
                              scene.interface.explicit_friction ||
                              !is_constant_fit(scene);
      for (unsigned int phase = 0; phase + 1 < steps.times.size(); ++phase)
        n.push_back(scene.is_press(phase)  ? 1 :
                    !is_planned            ? 10 :
                    is_constant_fit(scene) ? 100 :
                                             300); // straight lines
      choice.choose(section, "Steps", entry_text(n));
      if (is_planned)
        return;
      choice.choose(section, "Adaptive", "true");
      choice.choose(section,
                    "Tolerance",
                    to_text(std::max(0.25 * scene.accuracy, 1e-7), 6));
    }
  } // namespace



  bool
  Scene::is_press(const unsigned int phase) const
  {
    const double begin = load_steps.times[phase],
                 end   = load_steps.times[phase + 1];
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      {
        const auto value    = value_over_time(k);
        const bool is_axial = k == ChuckComponent::translation_z;
        double     before   = value(begin);
        for (unsigned int i = 1; i <= 16; ++i)
          {
            const double now = value(begin + i / 16. * (end - begin));
            if (is_axial ? now > before : now != before)
              return false;
            before = now;
          }
      }
    return !implant.geometry().is_in_bore();
  }



  bool
  Scene::keeps_axis() const
  {
    for (const unsigned int k : {0, 1, 3, 4})
      {
        const std::vector<double> values = sampled_values(k);
        if (std::any_of(values.begin(), values.end(), [](const double value) {
              return value != 0.;
            }))
          return false;
      }
    return true;
  }



  bool
  Scene::is_axisymmetric() const
  {
    const auto is_round = [](const BodyParameters &body) {
      return body.shape != BodyShape::block && body.shape != BodyShape::file &&
             body.shape != BodyShape::screw;
    };
    return is_round(bone) && is_round(implant) && !bone.modulus &&
           interface.bonding_of_law().pattern ==
             BondingPatternKind::homogeneous &&
           keeps_axis();
  }



  bool
  Scene::has_soft_interface() const
  {
    return std::max(interface.normal_penalty,
                    interface.tangential_stiffness()) *
             implant.characteristic_radius() <
           0.2 * bone.softest_modulus();
  }



  // What is wrong in the scene is found by its checks, which say where.
  std::vector<SceneEntry>
  Scene::chosen_entries() const
  {
    if (accuracy == 0. || model != ModelKind::finite_elements)
      return {};
    Scene scene = *this; // functions of time are sampled in its phases
    scene.load_steps.steps.resize(load_steps.times.size() - 1, 10);
    Choice choice{scene, {}};
    for (const std::string section : {"Bone", "Implant"})
      choice.choose(section, "Material", "linear");
    try
      {
        if (bone.shape == BodyShape::block &&
            !implant.geometry().is_in_bore() &&
            implant.shape != BodyShape::file)
          choose_on_block(choice);
        else if (bone.shape != BodyShape::block &&
                 bone.shape != BodyShape::file)
          choose_about_axis(choice);
        for (const auto &[section, body] :
             {std::pair("Bone", &bone), std::pair("Implant", &implant)})
          if (body->shape == BodyShape::file)
            choice.choose(section, "Element", "quadratic");
        choose_steps(choice);
      }
    catch (const InputError &)
      {}
    return choice.entries;
  }



  void
  Scene::declare_limits(EntryTable &table)
  {
    table.enter_subsection("Expert");
    table.add(
      "Largest number of unknowns",
      most_unknowns,
      Allowed::whole_number(1, 100000000),
      "Largest number of unknowns of both bodies, up to which cells are made "
      "smaller for Accuracy. Memory grows with it: 1 GB for 105 000, some 3 "
      "GB for 250 000.");
    table.add("Largest minutes",
              most_minutes,
              Allowed::number_above(0, "min"),
              "Longest time [min] that a run may be expected to take with "
              "smaller cells for Accuracy.");
    table.leave_subsection();
  }



  void
  Scene::declare_accuracy(EntryTable &table)
  {
    // "0.01" or "1 %"; nothing of other texts
    const auto read = [](const std::string &text) -> std::optional<double> {
      const bool is_percent = !text.empty() && text.back() == '%';
      const auto number =
        read_number(is_percent ? text.substr(0, text.size() - 1) : text);
      if (!number || !(*number > 0.) || *number >= (is_percent ? 100. : 1.))
        return {};
      return is_percent ? *number / 100. : *number;
    };
    AllowedValues allowed = Allowed::text(
      "a share above 0 and below 1, as 0.01, or a percentage below 100 %, as 1 %",
      false);
    allowed.test = [read](const std::string &text) {
      return text == "none" || read(text);
    };
    allowed.hint = [](const std::string &text) {
      const auto number = read_number(text);
      return number && *number >= 1. ?
               "for " + text + " % write " + text + " %" :
               "";
    };
    allowed.description = "none, or " + allowed.description;
    table.add(
      "Accuracy",
      accuracy > 0. ? exact_text(accuracy) : "none",
      [this, read](const std::string &text) {
        accuracy = read(text).value_or(0.);
      },
      allowed,
      "Largest error, relative to the largest value, of curve, peak and "
      "stiffness: a share, 0.01, or a percentage, 1 %. Of cells, elements, "
      "materials and steps the program chooses what the scene leaves at "
      "`auto', and estimates the error by a second, coarser run. `none': "
      "`auto' means the mesh and the steps of the paper, and errors are not "
      "estimated.");
  }
} // namespace Debond
