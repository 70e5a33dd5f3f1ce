#include <debond/input/entry_table.h>
#include <debond/scene/lame_fit.h>
#include <debond/scene/scene.h>
#include <debond/shapes/body_mesh.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Debond
{
  namespace
  {
    /** Beyond, lengths have another unit, or everything has another size. */
    bool
    has_size(const Scene &scene)
    {
      const double R = scene.implant.characteristic_radius();
      return R >= 0.1 && R <= 100.;
    }



    /** Notes a warning if it is one: its name, and its text. */
    using Note = std::function<
      void(bool is_one, const std::string &, const std::string &)>;



    void
    judge_voxels(const Scene &scene, const VoxelImage &voxels, const Note &note)
    {
      const std::string &file = scene.bone.voxel_file;
      for (const std::string &remark : voxels.remarks)
        note(true, "Voxel file", file + ": " + remark);
      const auto  &size    = scene.bone.size;
      const double largest = *std::max_element(voxels.spacing.begin(),
                                               voxels.spacing.end()),
                   extent  = *std::min_element(size.begin(), size.end());
      note(largest > 0.5 * extent,
           "size of voxels",
           file + ": voxels of " + to_text(largest) + " mm in a bone of " +
             to_text(extent) + " mm: is the file in um?");
    }



    void
    judge_bodies(const Scene &scene, const Note &note)
    {
      for (const bool is_bone : {true, false})
        {
          const BodyParameters &body = is_bone ? scene.bone : scene.implant;
          const std::string     name = is_bone ? "Bone / " : "Implant / ";
          // What tables have in GPa: bone 0.1 to 30, polymers 1 to 10, metals
          // and ceramics 50 to 400. A soft implant or a foam may be meant.
          const double E = body.young_modulus;
          const bool   in_GPa =
            is_bone ? E <= 30. : E < 10. || (E >= 50. && E < 400.);
          note(!body.is_rigid() && (in_GPa || E >= 1e8),
               name + "modulus",
               name + "Young modulus = " + to_text(E) + " MPa, where " +
                 (is_bone ? "bone has 100 to 30 000: " :
                            "implants have 1000 to 400 000: ") +
                 (in_GPa ? "is it that soft, or in GPa? Then write " :
                           "if it was meant in Pa, write ") +
                 to_text(in_GPa ? 1000. * E : 1e-6 * E));
          note(!body.is_rigid() && is_bone && !scene.implant.is_rigid() &&
                 E > 50000. && E > 2. * scene.implant.young_modulus,
               "moduli",
               "the bone, " + to_text(E) +
                 " MPa, is stiffer than the implant, " +
                 to_text(scene.implant.young_modulus) +
                 " MPa: are they swapped?");
          // A trilinear cell cannot bend without a change of its volume, which
          // a nearly incompressible material resists. Splines can:
          // doc/evidence/speed_and_accuracy.md, Other scenes.
          note(!body.is_rigid() && body.element == ElementKind::trilinear &&
                 body.poisson_ratio > 0.45,
               name + "locking",
               name + "Poisson ratio = " + to_text(body.poisson_ratio) +
                 ": trilinear cells lock as it approaches 0.5, so that the "
                 "body is too stiff: compare with finer Cells, or take "
                 "Element = spline");
        }
      const double hole = scene.bone.support_radius,
                   R    = 0.5 * scene.implant.width(0);
      note(hole > 0. && hole < R,
           "hole of the plate",
           "Bone / Support radius = " + to_text(hole) +
             " mm is less than the implant's radius, " + to_text(R) +
             " mm: it would be pushed onto the plate, which it does not meet "
             "here");
      if (scene.bone.modulus && scene.bone.modulus->voxels() != nullptr)
        judge_voxels(scene, *scene.bone.modulus->voxels(), note);
      for (const unsigned int d : {0, 1})
        note(!scene.implant.is_in_socket() &&
               scene.bone.shape != BodyShape::file &&
               scene.implant.width(d) == scene.bone.width(d),
             "width",
             "the implant is as wide as the bone, " +
               to_text(scene.bone.width(d)) + " mm in " + "xy"[d] +
               ": its rim leaves the bone as soon as it moves. If there is "
               "bone around it, enlarge Bone / Size");
    }



    // Of laws with strength in tension: whether cells are short enough for the
    // zone over which a bond opens, and a point as stiff on both sides of 0.
    void
    judge_tension(const Scene &scene, const Note &note)
    {
      const Tension bond = scene.interface.joint()->tension;
      if (bond.strength == 0.)
        return;
      const double length = bond.work / bond.strength;
      note(has_size(scene) &&
             length > 0.1 * scene.implant.characteristic_radius(),
           "opening of the bond",
           "the bond opens over some " + to_text(length, 3) +
             " mm (work over strength), more than a tenth of the radius: "
             "lengths are mm, 5 um is 0.005, and works N/mm, 68 N/m is 0.068");
      double E = 0., cell = 0.;
      for (const BodyParameters *body : {&scene.bone, &scene.implant})
        if (!body->is_rigid() && (E == 0. || body->young_modulus < E))
          {
            E    = body->young_modulus;
            cell = std::max(body->cell_width(0), body->cell_width(1));
          }
      const double zone = E * bond.work / (bond.strength * bond.strength);
      note(E > 0. && zone < cell && has_size(scene),
           "cohesive zone",
           "a bond that breaks along the face does so over some " +
             to_text(zone, 3) +
             " mm (E times the work of adhesion over strength^2), less than a "
             "cell of " +
             to_text(cell, 3) +
             " mm: forces depend on the mesh, unless all breaks at once. Finer "
             "Cells, or less strength with the same work");
      const double eps_n = scene.interface.normal_penalty,
                   ratio =
                     std::max(eps_n / bond.stiffness, bond.stiffness / eps_n);
      note(ratio > 10.,
           "stiffness of the bond",
           "pressed, the interface is as stiff as " + to_text(eps_n, 3) +
             " MPa/mm (Normal stiffness), pulled as " +
             to_text(bond.stiffness, 3) +
             " MPa/mm: they differ by a factor of more than ten");
    }



    void
    judge_points(const Scene &scene, const Note &note)
    {
      const unsigned int
        points =
          scene.interface.points_per_element(scene.bone, scene.implant).size(),
        fewest =
          scene.interface.fewest_points_per_element(scene.bone, scene.implant);
      note(points < fewest,
           "cells without points",
           "Expert / Interface / Quadrature points = " +
             std::to_string(points) +
             " leaves cells of the other body without a point, which makes "
             "the interface too soft: choose " +
             (fewest <= InterfaceParameters::most_points ?
                std::to_string(fewest) + " or more, or " :
                "") +
             "larger Cells there");
      const auto               cells   = scene.implant.lattice_of_cells();
      const unsigned int       n       = scene.implant.is_fitted() ?
                                           scene.implant.n_fitted_elements() :
                                           cells[0] * cells[1];
      const BondingParameters &bonding = scene.interface.bonding;
      note(bonding.pattern == BondingPatternKind::random &&
             bonding.resolution == BondingResolution::element && n < 50,
           "elements of the pattern",
           "Interface / Bonding / Pattern = random draws from " +
             std::to_string(n) +
             " elements of the implant, too few to scatter: Implant / Cells = "
             "20, 2 makes 400");
    }



    void
    judge_interface(const Scene &scene, const Note &note)
    {
      judge_tension(scene, note);
      const FrictionLaw &law  = *scene.interface.friction;
      const double       mu_b = law.coefficient({0.}, 0.).mu, // of no bond
        mu_ub                 = law.coefficient({}, 0.).mu;
      note(
        law.has_bond() && mu_ub < mu_b,
        "coefficients",
        "the bond lowers friction: Interface / Friction coefficient unbroken "
        "is less than broken, " +
          to_text(mu_b) + ". Are they swapped?");
      const double distance = law.characteristic_distance,
                   R        = scene.implant.characteristic_radius();
      note(!has_size(scene),
           "size of the implant",
           "the implant's face has a radius of " + to_text(R, 3) +
             " mm: lengths are mm. If it was meant in " +
             (R < 0.1 ? "m" : "um") + ", that is " +
             to_text((R < 0.1 ? 1e3 : 1e-3) * R, 3) + " mm");
      const double mu = std::max(mu_ub, mu_b);
      note(mu > 10.,
           "size of mu",
           "the friction coefficient is " + to_text(mu, 3) +
             ": it is a number, no per cent");
      // that of the paper is a hundredth of the radius
      note(law.has_bond() && has_size(scene) &&
             (distance > 0.5 * R || distance < 5e-5 * R),
           "length of the bond",
           "the bond breaks over a sliding distance of some " +
             to_text(distance, 3) + " mm, where the radius is " +
             to_text(R, 3) + " mm: lengths are mm, 22 um is 0.022");
      note(
        law.has_bond() && scene.interface.slave == Side::bone &&
          distance > 0.05 * R,
        "bond on the bone",
        "Expert / Interface / Slave = bone, and the bond breaks over some " +
          to_text(distance, 3) +
          " mm: how far a place has slid stays with the bone, which has no "
          "bond where it is beside the implant. Slave = implant takes both along");
      judge_points(scene, note);
    }



    /** Whether an expression gives something else after as long a time again.
     */
    bool
    changes_later(const ChuckComponentParameters &component,
                  const TimeFunction             &value_at,
                  const std::vector<double>      &times)
    {
      try
        {
          return !component.function && component.file.empty() &&
                 value_at(2. * times.back() - times.front()) !=
                   value_at(times.back());
        }
      catch (const InputError &)
        {
          return false; // no finite value there, where none is needed
        }
    }



    // Too large by far, or too small, is what has another unit.
    void
    judge_push(const Scene               &scene,
               const std::string         &entry,
               const std::vector<double> &values,
               const Note                &note)
    {
      const ChuckComponentParameters &z =
        scene.chuck.component[ChuckComponent::translation_z];
      const BodyParameters &bone = scene.bone, &implant = scene.implant;
      const auto [least, most] =
        std::minmax_element(values.begin(), values.end());
      note(*least >= 0. && *most > 0. &&
             scene.interface.law_choice.law == "friction",
           "direction of the push",
           entry +
             std::string(z.into_bone ? " is never positive" :
                                       " is never negative") +
             ": it pulls the implant off the bone. What presses is positive in "
             "Chuck / Press; Interface / Law = adhesive holds against a pull");
      const double push = -*least; // a machine's springs may take a larger one
      note(!z.is_unknown() && push > std::max(bone.penetration_limit(),
                                              implant.penetration_limit()),
           "depth of the push",
           entry + " presses the implant in by " + to_text(push, 3) +
             " mm, more than a tenth of its height and of the bone's: lengths "
             "are mm. If it was meant in um, that is " +
             to_text(1e-3 * push, 3) +
             " mm; if it is a force in N, set Control = force");
      const double limit = scene.interface.normal_penalty * push;
      note(!z.loaded && push > 0. && limit < 0.01,
           "pressure of the push",
           entry + " presses with less than " + to_text(limit, 3) +
             " MPa, the Normal stiffness times " + to_text(push, 3) +
             " mm: lengths are mm, stiffnesses MPa/mm");
      // Soft bodies may be meant to be pressed by little.
      const double p = push / (implant.width(0) * implant.width(1) *
                               implant.geometry().share_of_rectangle);
      note(z.loaded && push > 0. && has_size(scene) &&
             p < std::min({1e-3,
                           1e-6 * bone.young_modulus,
                           1e-6 * implant.young_modulus}),
           "force of the push",
           entry + " is a force of " + to_text(push, 3) +
             " N at most, a mean pressure of " + to_text(p, 3) +
             " MPa: is it a displacement in mm? That is Control = "
             "displacement");
    }



    // What carries and what does not changes in steps where the border of the
    // contact goes over cells and points, so that forces and moments ripple.
    // Measured ripples of moments are below these estimates:
    // doc/evidence/stability.md.
    void
    judge_crossing(const Scene               &scene,
                   const unsigned int         d,
                   const std::string         &entry,
                   const std::vector<double> &values,
                   const Note                &note)
    {
      const BodyParameters &bone = scene.bone, &implant = scene.implant;
      const auto [least, most] =
        std::minmax_element(values.begin(), values.end());
      const double way       = *most - *least;
      const double h         = bone.cell_width(d),
                   stiffness = scene.interface.normal_penalty * h /
                               bone.softest_modulus(),
                   share = h * bone.cell_width(1 - d) /
                           (implant.width(0) * implant.width(1) *
                            implant.geometry().share_of_rectangle),
                   ripple = share * stiffness / (1. + stiffness);
      note(!bone.is_rigid() && way > 0.5 * h && ripple > 0.02,
           "cells under the rim",
           entry + " moves the rim of the implant over cells of the bone of " +
             to_text(100. * share, 2) +
             " % of its face each, which are too coarse for so stiff an "
             "interface: forces and moments may ripple by some " +
             to_text(100. * ripple, 2) +
             " % from cell to cell. Finer Bone / Cells, or a smaller Normal "
             "stiffness");
      const bool over_edge = std::max(*most, -*least) + 0.5 * implant.width(d) >
                             0.5 * bone.width(d) * (1. + 1e-9);
      // the largest Gauss weight of n points tends to pi / n of 2
      const double row =
        0.5 * M_PI *
        (scene.interface.slave == Side::implant ? implant : bone)
          .cell_width(d) /
        (scene.interface.points_per_element(bone, implant).size() *
         implant.width(d));
      note(over_edge && way > 0. && row > 0.05,
           "cells over the edge",
           entry +
             " moves the implant over the edge of the bone, where a row "
             "of quadrature points, up to " +
             to_text(100. * row, 2) +
             " % of its face, loses its force at once: finer Cells, or more "
             "Expert / Interface / Quadrature points");
    }



    void
    judge_rotation(const Scene               &scene,
                   const std::string         &entry,
                   const std::vector<double> &values,
                   const Note                &note)
    {
      double way = 0.; // [deg]
      for (std::size_t i = 1; i < values.size(); ++i)
        way += std::abs(values[i] - values[i - 1]);
      const ChuckComponentParameters &rotation =
        scene.chuck.component[ChuckComponent::rotation_z];
      if (rotation.loaded || way == 0.)
        return;
      note(values[0] != 0. &&
             scene.has_friction_after(scene.load_steps.times.front()),
           "start of the rotation",
           entry + " begins with " + to_text(values[0], 4) +
             " degrees: the implant is placed so, which takes no torque. Is "
             "that meant? What begins with 0 is 10 * max(t - 1, 0), from t = 1 "
             "on, or a cycle, 5 * sin(pi * t)");
      const FrictionLaw &law      = *scene.interface.friction;
      const double       distance = law.characteristic_distance,
                   R              = scene.implant.characteristic_radius(),
                   way_of_rim     = way * M_PI / 180. * R;
      // Who wants to know what happens before the bond breaks takes few steps,
      // or turns to and fro; next to nothing is a sine whose turns lie between
      // the steps.
      const double span     = std::abs(values.back() - values.front());
      const bool   is_short = way > 0.01 && 2. * way_of_rim < distance;
      const bool   is_curve =
        scene.load_steps.adaptive || scene.load_steps.n_steps() > 20;
      note(law.has_bond() && distance < 0.5 * R && is_short && is_curve &&
             span > 0.999 * way && rotation.stiffness == 0.,
           "short rotation",
           entry + " turns by " + to_text(way, 4) +
             " degrees in all, in which the rim moves by " +
             to_text(way_of_rim, 3) + " mm; the bond breaks over some " +
             to_text(distance, 3) + " mm. If it was meant in rad, that is " +
             to_text(way * 180. / M_PI, 3) + " degrees");
    }



    void
    judge_chuck(const Scene &scene, const Note &note)
    {
      const std::vector<double> &times = scene.load_steps.times;
      for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
        {
          const ChuckComponentParameters &component = scene.chuck.component[k];
          const std::vector<double>       values    = scene.sampled_values(k);
          const std::string               entry =
            component.file.empty() ?
                            scene.chuck.entry_name(k, "Value") + " = " + component.value :
                            scene.chuck.entry_name(k, "File") + " = " + component.file;
          note(values == std::vector<double>(values.size(), values[0]) &&
                 changes_later(component, scene.value_over_time(k), times),
               entry,
               entry + " is " + to_text(values[0]) + " at all times from " +
                 to_text(times.front()) + " to " + to_text(times.back()) +
                 ", and changes later: do Load steps / Times end too early?");
          if (!scene.implant.is_in_socket() &&
              k < ChuckComponent::translation_z && !component.loaded)
            judge_crossing(scene, k, entry, values, note);
          if (!scene.implant.is_in_socket() &&
              k == ChuckComponent::translation_z)
            judge_push(scene, entry, values, note);
          // the bone stands on a plate with a hole, and is held there
          note(k == ChuckComponent::translation_z &&
                 scene.bone.support_radius > 0. &&
                 *std::max_element(values.begin(), values.end()) > 0.,
               "pull from the plate",
               entry +
                 " pulls the implant up, and the plate (Bone / Support "
                 "radius) holds the bone, where a plate only pushes: expected "
                 "Ends = held, or a push");
          if (k == ChuckComponent::rotation_z)
            judge_rotation(scene, entry, values, note);
        }
    }



    void
    judge_press_fit(const Scene &scene, const Note &note)
    {
      const auto fit = lame_fit(scene);
      if (fit && fit->bodies > 0.)
        note(fit->interface > fit->bodies,
             "spring of a press fit",
             "Interface / Normal stiffness = " +
               to_text(scene.interface.normal_penalty) + " MPa/mm takes up " +
               to_text(100. * fit->interface / (fit->interface + fit->bodies),
                       2) +
               " % of the Interference: the pressure is some " +
               to_text(fit->pressure(), 3) + " MPa" +
               (scene.interface.bone_layer.crushes() ?
                  " as far as the bone is not crushed" :
                  "") +
               ", where the bodies alone would have " +
               to_text(fit->half_interference / fit->bodies, 3) +
               " MPa; interfaces between hard faces have 1e4 to 1e6 MPa/mm");
    }
  } // namespace



  std::vector<Warning>
  Scene::warnings() const
  {
    std::vector<Warning> found;
    const Note           note = [&found](const bool         is_one,
                               const std::string &check,
                               const std::string &text) {
      if (is_one)
        found.push_back({check, text});
    };
    judge_bodies(*this, note);
    judge_interface(*this, note);
    judge_chuck(*this, note);
    judge_press_fit(*this, note);
    for (const Warning &unread : unread_entries(*this))
      found.push_back(unread);
    return found;
  }
} // namespace Debond
