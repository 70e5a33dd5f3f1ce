#include <debond/models/closed_form_solution.h>
#include <debond/models/forecast.h>
#include <debond/shapes/body_geometry.h>
#include <debond/support/number_text.h>
#include <debond/system/coupled_system.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace Debond
{
  namespace
  {
    /** The implant's face in rings, since mu is linear in phi_0, on a
     *  foundation [MPa/mm] that they have in common. Its own points, and many:
     *  those of the run may be few, or the bone's. */
    FoundationStiffness
    rings_of(const CoupledSystem &system, const double stiffness)
    {
      constexpr unsigned int n = 50;
      FoundationStiffness    rings;
      rings.points.resize(n, {0., 0., 0., 1., stiffness});
      for (const auto &point : surface_quadrature(system.implant.surface(), 8))
        {
          const double r = std::hypot(point.X[0], point.X[1]);
          auto        &ring =
            rings.points[std::min<unsigned int>(n * r / system.R, n - 1)];
          ring.area += point.JxW;
          const double share = point.JxW / ring.area;
          ring.radius += share * (r - ring.radius);
          ring.phi_0 +=
            share * (system.interface.bonding().at(point.xi) - ring.phi_0);
        }
      return rings;
    }



    std::string
    why_no_torque(const Scene &scene, const double pressure)
    {
      const InterfaceParameters &interface = scene.interface;
      if (interface.friction->depends_on_rate() || interface.viscosity > 0. ||
          interface.explicit_friction ||
          interface.slip_direction == SlipDirection::previous_gap)
        return "friction depends on the rate or on the steps";
      if (!(pressure > 0.))
        return "nothing is pressed at the end";
      if (scene.chuck.component[ChuckComponent::rotation_z].loaded)
        return "the rotation is not prescribed";
      return why_no_closed_form(scene);
    }



    // Whether the law has one solution at every point, with the mean pressure
    // for that of a point.
    void
    print_uniqueness(const Scene &scene, const double p, std::ostream &out)
    {
      const InterfaceParameters &interface = scene.interface;
      const double               eps_t     = interface.tangential_stiffness();
      const double               slope =
        interface.friction->steepest_fall({interface.bonding.initial_bonding});
      const double missing = slope * p - eps_t;
      if (slope == 0. || interface.explicit_friction)
        return;
      out << "  p / eps_t " << p / eps_t
          << " mm; the friction law has one solution below " << 1. / slope
          << " mm\n";
      if (missing >= 0. && interface.viscosity == 0.)
        out << "  so the run will be refused: Interface / Viscosity, a larger "
               "Tangential penalty stiffness, "
            << interface.friction->entries_against_fall() << " helps\n";
      else if (missing >= 0.)
        out << "  so Viscosity makes it unique in steps shorter than "
            << interface.viscosity / missing << " of time\n";
    }
  } // namespace



  Forecast::Forecast(const Scene &scene, const CoupledSystem &system)
  {
    constexpr auto push     = ChuckComponent::translation_z,
                   twist    = ChuckComponent::rotation_z;
    const double          R = scene.implant.radius, area = M_PI * R * R;
    const BodyParameters &bone = scene.bone, &implant = scene.implant;
    const auto            last = Chuck(scene.chuck, Eigen::Vector3d::Zero(), R)
                        .values(scene.load_steps.times.back());
    // Compliances [mm/MPa] of a layer of bone on a rigid base, on which a rigid
    // disk is pressed or twisted (Gazetas 1983, Soil Dyn. Earthq. Eng. 2, 2-42;
    // infinitely deep Boussinesq and Reissner-Sagoci), and of the implant as a
    // bar of its height.
    const auto of_bodies = [&](const double of_bone, const double of_implant) {
      return (bone.is_rigid() ? 0. : of_bone / bone.young_modulus) +
             (implant.is_rigid() ? 0. : of_implant / implant.young_modulus);
    };
    const double normal = of_bodies((1. - std::pow(bone.poisson_ratio, 2)) *
                                      M_PI * R / (2. + 2.56 * R / bone.size[2]),
                                    implant.height);
    const double torsional =
      of_bodies(3. * M_PI * R / 16. * (1. + bone.poisson_ratio),
                2. * (1. + implant.poisson_ratio) * implant.height);
    const double stiffness =
      1. / (torsional + 1. / scene.interface.tangential_stiffness());
    const ChuckComponentParameters &z = scene.chuck.component[push];
    const double                    p_over_depth =
      1. / (normal + 1. / scene.interface.law().normal->initial_stiffness() +
            (z.stiffness > 0. ? area / z.stiffness : 0.));
    // Held at its top, and by friction at its face, a short implant is stiffer
    // than a bar, and a narrow bone softer than a layer.
    const double in_implant =
      std::max(z.loaded ? 0. : of_bodies(0., implant.height) * p_over_depth,
               of_bodies(0.,
                         2. * (1. + implant.poisson_ratio) * implant.height) *
                 stiffness);
    error = 0.005 +
            0.15 * std::max(z.loaded ? 0. : normal * p_over_depth,
                            torsional * stiffness) +
            0.3 * in_implant * in_implant +
            (std::min(bone.size[0], bone.size[1]) < 2.3 * R ? 0.15 : 0.);
    if (bone.modulus)
      why = "Young's modulus of the bone is not the same everywhere";
    if (last[ChuckComponent::rotation_x] != 0. ||
        last[ChuckComponent::rotation_y] != 0.)
      why = "the implant is tilted";
    for (const unsigned int d : {0, 1})
      if (!scene.chuck.component[d].loaded &&
          std::abs(last[d]) + R > 0.5 * bone.size[d])
        why = "the contact face ends up beyond the bone";
    if (!why.empty())
      return;
    pressure =
      std::max(0., -last[push] * (z.loaded ? 1. / area : p_over_depth));
    torsional_stiffness = 0.5 * M_PI * std::pow(R, 4) * stiffness;
    why                 = why_no_torque(scene, pressure);
    if (!why.empty())
      return;

    // Denser where the torque has its maximum, however far it turns.
    const Eigen::ArrayXd angles =
      last[twist] * Eigen::ArrayXd::LinSpaced(301, 0., 1.).cube();
    const Eigen::ArrayXd torques = torque_of_points(rings_of(system, stiffness),
                                                    scene.interface.friction,
                                                    pressure,
                                                    angles);
    const double         machine = scene.chuck.component[twist].stiffness;
    if (torques.isNaN().any())
      why = "with the bodies in series the law softens too fast, and the "
            "torque may jump";
    else
      T_max = T_end = 0.;
    // The machine turns further than the implant, by the torque over its
    // stiffness; the last torque lies between two angles.
    const auto turned = [&](const unsigned int i) {
      return std::abs(angles[i] + (machine > 0. ? torques[i] / machine : 0.));
    };
    for (unsigned int i = 1; why.empty() && i < angles.size(); ++i)
      {
        const double part =
          (std::abs(last[twist]) - turned(i - 1)) / (turned(i) - turned(i - 1));
        T_end =
          torques[i - 1] + std::min(part, 1.) * (torques[i] - torques[i - 1]);
        T_max = std::max(T_max, std::abs(T_end));
        if (part < 1.)
          break;
      }
  }



  // Steps may have gone over the peak, or cells may be too coarse for it.
  std::string
  difference_from_forecast(const Scene                  &scene,
                           const CoupledSystem          &system,
                           const std::vector<TorqueRow> &rows)
  {
    // energy that a jump has released is not in the closed form, and a path may
    // end anywhere
    if (!scene.implant.geometry().has_closed_forms() ||
        rows.back().released_energy_Nmm > 0. || scene.load_steps.follow_path)
      return "";
    // points that lie badly or are few are another cause
    if (scene.interface.slave == Side::bone ||
        scene.interface.points_per_element(scene.bone, scene.implant) < 3 ||
        scene.interface.friction->is_frictionless())
      return "";
    const Forecast forecast(scene, system);
    double         T_max = 0.;
    for (const TorqueRow &row : rows)
      T_max = std::max(T_max, std::abs(row.torque_Nmm));
    // not so if there is no forecast
    if (std::abs(T_max - forecast.T_max) > forecast.error * forecast.T_max)
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
  print_forecast(const Scene         &scene,
                 const CoupledSystem &system,
                 std::ostream        &out)
  {
    const ClassicNumbers classic(out);
    const Forecast       forecast(scene, system);
    const double         p = forecast.pressure;
    if (std::isnan(p))
      {
        out << "Closed forms predict nothing: " << forecast.why << '\n';
        return;
      }
    out << "Closed forms predict (bodies as springs in series with the "
           "interface, to some "
        << std::ceil(1000. * forecast.error) / 10. << " %):\n"
        << "  mean pressure at the end " << p << " MPa, force "
        << p * M_PI * std::pow(scene.implant.radius, 2) << " N\n"
        << "  torsional stiffness while everything sticks "
        << forecast.torsional_stiffness << " N mm/rad\n";
    print_uniqueness(scene, p, out);
    if (forecast.why.empty())
      out << "  largest torque " << forecast.T_max << " N mm, at the end "
          << forecast.T_end << " N mm\n";
    else
      out << "  no torque: " << forecast.why << '\n';
  }
} // namespace Debond
