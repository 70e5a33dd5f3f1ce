#include <debond/bulk/chuck.h>
#include <debond/interface/contact_point_state.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/run_report.h>
#include <debond/support/number_text.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace Debond
{
  namespace
  {
    /** Between the axis and the rim, where the traction of a bonded disk is
     *  infinite; both are left out. */
    std::vector<InterfacePoint>
    points_along_radius(const TorsionModel &model, const double theta)
    {
      constexpr unsigned int      n = 250;
      const double                R = model.disk.radius;
      std::vector<InterfacePoint> points;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double r     = R * (i + 0.5) / n;
          const auto   point = model.point(r, theta);
          points.push_back(
            {{r,
              0.,
              r,
              model.disk.pressure,
              std::abs(point.traction),
              point.slip,
              point.phi,
              point.mu,
              double(point.sticks ? PointStatus::stick : PointStatus::slip),
              2. * M_PI * r * R / n}});
        }
      return points;
    }
  } // namespace



  void
  write_results(const ClosedFormSolution &solution, const dealii::Timer &clock)
  {
    const double          seconds_before_steps = clock.wall_time();
    const Scene          &scene                = solution.scene;
    const ResultDirectory directory(scene.output, scene.completed_parameters);
    RunReport             report(scene, directory);
    const unsigned int    n_steps = solution.rows.size() - 1;
    report.begin({});
    for (const TorqueRow &row : solution.rows)
      report.add(row, n_steps, [&] {
        return points_along_radius(*solution.model,
                                   row.angle_deg * M_PI / 180.);
      });
    report.torque_curve->finish();
    for (const auto &jump : solution.jumps)
      report.console.warn(
        "jump",
        Text() << "the bond snaps back: at the machine's angle of "
               << jump.machine_angle * 180. / M_PI
               << " deg the torque jumps from " << jump.torque_before << " to "
               << jump.torque_after << " N mm, and " << jump.released_energy
               << " N mm of stored energy are released without equilibrium");

    CurveSettings settings;
    settings.contact_area_mm2 = M_PI * std::pow(scene.implant.radius, 2);
    settings.mean_phi_0       = scene.interface.bonding.initial_bonding *
                          scene.interface.bonding.bonded_fraction;
    if (scene.model == ModelKind::analytical)
      settings.full_sliding_angle_deg = scene.closed_form.full_sliding;

    const auto or_nothing = [](const double stiffness) {
      return stiffness > 0. ? stiffness :
                              std::numeric_limits<double>::quiet_NaN();
    };
    const double           seconds = clock.wall_time();
    nlohmann::ordered_json facts{
      {"steps", n_steps},
      {"newton_iterations", 0},
      {"dofs", 0},
      {"unknowns", 0},
      {"condensed_unknowns", 0},
      {"converged", true},
      {"reason", "all planned steps are done"},
      {"wall_seconds", seconds},
      {"seconds_before_steps", seconds_before_steps},
      {"seconds_stepping", seconds - seconds_before_steps},
      {"normal_stiffness_MPa_per_mm", or_nothing(solution.normal_stiffness)},
      {"torsional_stiffness_MPa_per_mm",
       or_nothing(solution.torsional_stiffness)}};
    if (scene.chuck.component[ChuckComponent::rotation_z].stiffness > 0.)
      {
        facts["jumps"] = solution.jumps.size();
        facts["released_energy_Nm"] =
          1e-3 * solution.rows.back().released_energy_Nmm;
      }
    report.finish(solution.rows, settings, facts);
  }



  void
  describe(const ClosedFormSolution &solution, std::ostream &out)
  {
    const ModelKind model = solution.scene.model;
    out << "Model "
        << (model == ModelKind::foundation ? "foundation" :
            model == ModelKind::analytical ? "analytical" :
                                             "mathieu")
        << ", pressure " << solution.model->disk.pressure << " MPa";
    if (solution.normal_stiffness > 0.)
      out << ", normal stiffness " << solution.normal_stiffness << " MPa/mm";
    if (solution.torsional_stiffness > 0.)
      out << ", torsional stiffness " << solution.torsional_stiffness
          << " MPa/mm";
    const TorqueRow &last = solution.rows.back();
    out << '\n'
        << solution.rows.size() - 1 << " planned steps from time "
        << solution.rows.front().time << " to " << last.time << '\n'
        << "at the end " << last.torque_Nmm << " N mm\n";
  }



  namespace
  {
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



    // Of rigid bodies on an interface with the compliance of all three in
    // series.
    void
    print_torque(const TorsionModel::Disk &disk,
                 const double              last_angle,
                 std::ostream             &out)
    {
      if (!RigidBodiesTorsion::has_unique_solution(disk))
        {
          out << "  no closed form of the torque: with the bodies in series "
                 "the law softens too fast, and the torque may jump\n";
          return;
        }
      const RigidBodiesTorsion form(disk);
      double                   T_max = 0.;
      for (unsigned int i = 1; i <= 1000; ++i)
        T_max = std::max(T_max, std::abs(form.torque(last_angle * i / 1000)));
      out << "  largest torque " << T_max << " N mm, at the end "
          << form.torque(last_angle) << " N mm\n";
    }
  } // namespace



  void
  print_forecast(const Scene &scene, std::ostream &out)
  {
    const double          R             = scene.implant.radius;
    const BodyParameters &bone          = scene.bone;
    const BodyParameters &implant       = scene.implant;
    const auto            shear_modulus = [](const BodyParameters &body) {
      return body.young_modulus / (2. * (1. + body.poisson_ratio));
    };
    // Stiffness per area [MPa/mm] of the interface, a half space of bone whose
    // surface a rigid punch presses or twists (Reissner-Sagoci), and the
    // implant as a bar of its height.
    const auto in_series = [&](const double of_interface,
                               const double of_bone,
                               const double of_implant) {
      return 1. / (1. / of_interface + (bone.is_rigid() ? 0. : 1. / of_bone) +
                   (implant.is_rigid() ? 0. : 1. / of_implant));
    };
    const double k_n =
      in_series(scene.interface.law().normal->initial_stiffness(),
                2. * bone.young_modulus /
                  ((1. - std::pow(bone.poisson_ratio, 2)) * M_PI * R),
                implant.young_modulus / implant.height);

    TorsionModel::Disk disk;
    disk.stiffness = in_series(scene.interface.tangential_stiffness(),
                               32. * shear_modulus(bone) / (3. * M_PI * R),
                               shear_modulus(implant) / implant.height);

    constexpr auto push  = ChuckComponent::translation_z,
                   twist = ChuckComponent::rotation_z;
    const auto last      = Chuck(scene.chuck, Eigen::Vector3d::Zero(), R)
                        .values(scene.load_steps.times.back());
    const double p = std::max(0.,
                              scene.chuck.component[push].loaded ?
                                -last[push] / (M_PI * R * R) :
                                -last[push] * k_n);
    out
      << "Closed forms predict (bodies as springs in series with the interface, "
         "to some 5 %):\n"
      << "  mean pressure at the end " << p << " MPa, force "
      << p * M_PI * R * R << " N\n"
      << "  torsional stiffness while everything sticks "
      << 0.5 * M_PI * std::pow(R, 4) * disk.stiffness << " N mm/rad\n";
    print_uniqueness(scene, p, out);
    if (p <= 0. || scene.interface.friction->depends_on_rate() ||
        scene.chuck.component[twist].loaded || last[twist] == 0.)
      return;

    disk.radius   = R;
    disk.pressure = p;
    disk.phi_0    = scene.interface.bonding.initial_bonding *
                 scene.interface.bonding.bonded_fraction;
    disk.friction = scene.interface.friction;
    print_torque(disk, last[twist], out);
  }
} // namespace Debond
