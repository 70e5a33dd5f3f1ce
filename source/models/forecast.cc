#include <debond/models/closed_form_solution.h>
#include <debond/models/forecast.h>
#include <debond/scene/lame_fit.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace Debond
{
  Forecast::Forecast(const Scene &scene)
  {
    const InterfaceParameters &interface = scene.interface;
    const auto                 fit       = lame_fit(scene);
    if (scene.bone.modulus)
      why = "Young's modulus of the bone is not the same everywhere";
    else if (interface.friction->depends_on_rate ||
             interface.explicit_friction ||
             interface.slip_direction == SlipDirection::previous_gap)
      why = "friction depends on the rate or on the steps";
    else if (scene.implant.geometry().has_closed_forms)
      of_flat_face(scene);
    else if (scene.implant.shape == BodyShape::ring &&
             (scene.chuck.component[ChuckComponent::rotation_z].is_unknown() ||
              interface.bonding_of_law().pattern !=
                BondingPatternKind::homogeneous))
      why = "a ring is turned by a moment or through a spring, or bonded in a "
            "part of its face";
    else if (scene.implant.shape == BodyShape::ring)
      of_flat_face(scene);
    else if (fit)
      of_press_fit(scene, *fit);
    else
      why = "they are for a coin, a ring, and the press fit of a pin in a "
            "sleeve or of a half sphere in a shell";
  }



  namespace
  {
    /** p [MPa]: where bone is crushed to c, p_c + H c is left of what the fit
     *  asks for. */
    double
    pressure_on(const BoneLayer &bone, const LameFit &fit)
    {
      const double p = fit.pressure(), H = bone.crushing_modulus;
      return bone.crushes() && p > bone.crushing_strength ?
               (H * fit.half_interference + bone.crushing_strength) /
                 (H * (fit.bodies + fit.interface) + 1.) :
               p;
    }
  } // namespace



  // All points slide at once, under the same pressure.
  void
  Forecast::of_press_fit(const Scene &scene, const LameFit &fit)
  {
    const InterfaceParameters &interface = scene.interface;
    const auto                 path      = [&](const unsigned int k) {
      const std::vector<double> values = scene.sampled_values(k);
      const bool one_way = std::is_sorted(values.begin(), values.end()) ||
                           std::is_sorted(values.rbegin(), values.rend());
      const ChuckComponentParameters &component = scene.chuck.component[k];
      if (component.loaded || component.stiffness > 0. || !one_way)
        why = "the chuck is loaded, has springs, or turns back";
      return values.back() - values.front();
    };
    const double turned = path(ChuckComponent::rotation_z) * M_PI / 180.,
                 pulled = path(ChuckComponent::translation_z),
                 way    = std::abs(turned) * fit.arm + std::abs(pulled);
    if ((turned != 0. && pulled != 0.) || !scene.keeps_axis() || pulled < 0. ||
        (pulled > 0. && scene.implant.shape != BodyShape::pin))
      why = "the implant is not only turned about its axis, or pulled along it";
    if (fit.changes)
      why = "the interference changes, or the bone is shorter than the implant";
    error = fit.error * fit.bodies / (fit.bodies + fit.interface);
    if (error > 0.2)
      why = "ends of the bone or of the implant matter";
    if (!why.empty())
      return;
    const BoneLayer &bone = interface.bone_layer;
    pressure              = pressure_on(bone, fit);
    // a pull takes some of the pressure off, which crushed bone does not
    // restore
    error += bone.crushes() && pulled > 0. ? 0.16 : 0.01;
    if (interface.law_choice.law != "friction" || interface.viscosity > 0. ||
        interface.bonding_of_law().pattern != BondingPatternKind::homogeneous)
      return;
    const double phi_0 = interface.bonding_of_law().initial_bonding;
    const double tau_b = bone.shears() ? bone.shear_strength : HUGE_VAL;
    const auto   limit = [&](const double phi) {
      return std::min(tau_b,
                      interface.friction->limit({}, phi, pressure, 0.).value);
    };
    const double most = limit(phi_0);
    double       slip = way - most / interface.tangential_stiffness();
    if (!(slip > 0.))
      return;
    if (most == tau_b && !bone.shear_wears_bond)
      slip = 0.; // of the interface
    // around the pole of a cup it slides less, or not at all: of the torque
    // the part within an angle x of it is 4 x^3 / (3 pi)
    if (scene.implant.shape == BodyShape::cup)
      error +=
        0.42 *
        std::pow(std::min(1.,
                          (most / interface.tangential_stiffness() +
                           (phi_0 > 0. ? interface.friction->kinks.back() :
                                         0.)) /
                            (std::abs(turned) * scene.implant.radius)),
                 3);
    // the distance slid in the end is known where the bond is gone by then
    const double decay =
      phi_0 > 0. ? interface.friction->decay(slip).value : 1.;
    if (turned != 0.)
      {
        T_max = fit.area * fit.arm * most;
        if (decay == 0. || decay == 1.)
          T_end = fit.area * fit.arm * limit(decay * phi_0);
      }
    else
      F_max = fit.area * most;
  }



  namespace
  {
    /** Rows of a coin of this radius on the foundation of @p scene. */
    std::vector<TorqueRow>
    rows_of_coin(Scene scene, const double radius)
    {
      scene.implant.shape  = BodyShape::coin;
      scene.implant.radius = radius;
      return ClosedFormSolution(scene).rows;
    }



    /** Of a ring: what the coin carries without the one inside, in equal
     *  steps, pressed as deep as its force asks for. */
    std::vector<TorqueRow>
    rows_of_ring(Scene scene, const double area)
    {
      constexpr auto          push  = ChuckComponent::translation_z;
      LoadSteppingParameters &steps = scene.load_steps;
      steps.adaptive                = false;
      steps.steps.assign(steps.times.size() - 1, 300);
      ChuckComponentParameters &z = scene.chuck.component[push];
      if (z.loaded)
        {
          z.function = [force     = scene.value_over_time(push),
                        per_depth = area * scene.closed_form.normal_stiffness](
                         const double t) { return force(t) / per_depth; };
          z.loaded = z.into_bone = false;
        }
      auto       rows   = rows_of_coin(scene, scene.implant.radius);
      const auto inside = rows_of_coin(scene, scene.implant.inner_radius);
      for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i].torque_Nmm -= inside[i].torque_Nmm;
      return rows;
    }
  } // namespace



  // What a point of a foundation carries depends on its own radius. On the bone
  // a ring acts like the coin of its radius.
  void
  Forecast::of_flat_face(Scene scene)
  {
    const BodyParameters      &bone = scene.bone, &implant = scene.implant;
    const InterfaceParameters &interface = scene.interface;
    ChuckComponentParameters  &z =
      scene.chuck.component[ChuckComponent::translation_z];
    const double R = implant.radius, nu = bone.poisson_ratio,
                 inside =
                   implant.shape == BodyShape::ring ? implant.inner_radius : 0.,
                 polar = 1. - std::pow(inside / R, 4);
    area               = M_PI * (R * R - inside * inside);

    // Compliances [mm/MPa] of a layer of bone on a rigid base, on which a rigid
    // disk is pressed or twisted (Gazetas 1983, Soil Dyn. Earthq. Eng. 2, 2-42;
    // infinitely deep Boussinesq and Reissner-Sagoci), and of the implant as a
    // bar of its height.
    const auto of_bodies = [&](const double of_bone, const double of_implant) {
      return (bone.is_rigid() ? 0. : of_bone / bone.young_modulus) +
             (implant.is_rigid() ? 0. : of_implant / implant.young_modulus);
    };
    const double bar = 2. * (1. + implant.poisson_ratio) * implant.height,
                 torsional =
                   of_bodies(3. * M_PI * R / 16. * (1. + nu) * polar, bar),
                 normal = of_bodies((1. - nu * nu) * area / R /
                                      (2. + 2.56 * R / bone.size[2]),
                                    implant.height);
    const double stiffness =
      1. / (torsional + 1. / interface.tangential_stiffness());
    const double p_over_depth =
      1. / (normal + 1. / interface.normal_penalty +
            (z.stiffness > 0. ? area / z.stiffness : 0.));
    torsional_stiffness = 0.5 * M_PI * std::pow(R, 4) * polar * stiffness;
    // Held at its top, and by friction at its face, a short implant is stiffer
    // than a bar, and a narrow bone softer than a layer.
    const double in_implant =
      std::max(z.loaded ? 0. : of_bodies(0., implant.height) * p_over_depth,
               of_bodies(0., bar) * stiffness);
    error = 0.005 +
            0.18 * std::max(z.loaded ? 0. : normal * p_over_depth,
                            torsional * stiffness) +
            0.3 * in_implant * in_implant +
            (std::min(bone.size[0], bone.size[1]) < 2.3 * R ? 0.15 : 0.) +
            (interface.bonding.pattern == BondingPatternKind::disk ? 0.03 : 0.);

    scene.model                           = ModelKind::foundation;
    scene.closed_form                     = ClosedFormParameters();
    scene.closed_form.normal_stiffness    = p_over_depth;
    scene.closed_form.torsional_stiffness = stiffness;
    scene.load_steps.adaptive             = true;
    scene.load_steps.tolerance            = 1e-3;
    z.stiffness                           = 0.; // in series above
    try
      {
        const auto rows =
          inside > 0. ? rows_of_ring(scene, area) : rows_of_coin(scene, R);
        pressure = rows.back().pressure_MPa;
        T_end    = rows.back().torque_Nmm;
        for (const TorqueRow &row : rows)
          T_max = std::fmax(T_max, std::abs(row.torque_Nmm)); // none at first
        // points trail by L = mu p / eps_t along arcs, T = 2/3 pi mu p R^3
        const double L = 1.5 * T_max /
                         (M_PI * (std::pow(R, 3) - std::pow(inside, 3))) /
                         interface.tangential_stiffness();
        error += 1.5 * std::pow(L / R, 2);
      }
    catch (const EntryError &refusal)
      {
        why = refusal.why.substr(0, refusal.why.find(" (Model"));
      }
  }



  // Steps may have gone over the peak, or cells may be too coarse for it.
  std::string
  difference_from_forecast(const Scene                  &scene,
                           const std::vector<TorqueRow> &rows)
  {
    // energy that a jump has released is not in the closed form, and a path may
    // end anywhere
    if (!scene.implant.geometry().has_closed_forms ||
        rows.back().released_energy_Nmm > 0. || scene.load_steps.follow_path)
      return "";
    // points that lie badly or are few, and a face of plane pieces, which is
    // smaller than the disk, are other causes
    if (scene.interface.slave == Side::bone ||
        scene.implant.contact_surface == SurfaceKind::bilinear ||
        scene.interface.points_per_element(scene.bone, scene.implant).size() <
          3 ||
        scene.interface.friction->is_frictionless)
      return "";
    // enough to find the peak, whatever the number of rows
    Scene coarser = scene;
    if (coarser.load_steps.ends.empty())
      for (unsigned int &n : coarser.load_steps.steps)
        n = std::min(n, 100u);
    const Forecast forecast(coarser);
    double         T_max = 0.;
    for (const TorqueRow &row : rows)
      T_max = std::max(T_max, std::abs(row.torque_Nmm));
    if (forecast.T_max > 0. &&
        std::abs(T_max - forecast.T_max) > forecast.error * forecast.T_max)
      return Text() << "the largest torque of all rows is " << T_max
                    << " N mm, where closed forms predict " << forecast.T_max
                    << " N mm to " << to_text(100. * forecast.error, 2)
                    << " %: "
                    << (T_max < forecast.T_max ?
                          "do the steps go over the peak?" :
                          "are the cells too coarse for the interface, or the "
                          "closed forms for these bodies?");
    return "";
  }



  void
  print_forecast(const Scene &scene, std::ostream &out)
  {
    const Forecast forecast(scene);
    Text           text;
    if (!forecast.why.empty())
      text << "Closed forms predict nothing: " << forecast.why << '\n';
    else
      text << "Closed forms predict (bodies as springs in series with the "
              "interface, to some "
           << std::ceil(1000. * forecast.error) / 10. << " %):\n"
           << "  mean pressure at the end " << forecast.pressure << " MPa";
    if (forecast.why.empty() && forecast.torsional_stiffness > 0.)
      text << ", force " << forecast.pressure * forecast.area << " N\n"
           << "  torsional stiffness while everything sticks "
           << forecast.torsional_stiffness << " N mm/rad";
    if (forecast.why.empty())
      text << '\n';
    if (forecast.T_max > 0.) // it turns
      text << "  largest torque " << forecast.T_max << " N mm";
    if (forecast.T_max > 0. && !std::isnan(forecast.T_end))
      text << ", at the end " << forecast.T_end << " N mm";
    if (forecast.T_max > 0.)
      text << '\n';
    if (forecast.F_max > 0.)
      text << "  largest force that pulls it out " << forecast.F_max << " N\n";
    out << std::string(text);
  }
} // namespace Debond
