#include <debond/interface/contact_point_state.h>
#include <debond/models/closed_form_results.h>
#include <debond/output/console.h>
#include <debond/output/profile_output.h>
#include <debond/output/result_files.h>
#include <debond/support/runtime.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <sstream>

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



    void
    warn_of_jumps(const ClosedFormSolution &solution, Console &console)
    {
      for (const auto &jump : solution.jumps())
        {
          std::ostringstream text;
          text << "the bond snaps back: at the machine's angle of "
               << jump.machine_angle * 180. / M_PI
               << " deg the torque jumps from " << jump.torque_before << " to "
               << jump.torque_after << " N mm, and " << jump.released_energy
               << " N mm of stored energy are released without equilibrium";
          console.warn("jump", text.str());
        }
    }



    CurveSettings
    curve_settings(const Scene &scene)
    {
      CurveSettings settings;
      settings.contact_area_mm2 = M_PI * std::pow(scene.implant.radius, 2);
      settings.mean_phi_0       = scene.output.observed_bonding > 0 ?
                                    scene.output.observed_bonding :
                                    scene.interface.bonding.initial_bonding *
                                scene.interface.bonding.bonded_fraction;
      settings.full_sliding_angle_deg = scene.output.full_sliding_angle;
      if (scene.model == ModelKind::analytical &&
          scene.output.full_sliding_angle == 0.)
        settings.full_sliding_angle_deg = scene.closed_form.full_sliding;
      settings.phase_times = scene.load_steps.times;
      settings.reference   = read_reference_curve(scene.output.reference_curve);
      return settings;
    }



    /** What only closed forms have in summary.json. */
    void
    add_closed_form(const ClosedFormSolution &solution,
                    nlohmann::ordered_json   &json)
    {
      const auto or_nothing = [](const double stiffness) {
        return stiffness > 0. ? stiffness : CurveMeasures::undefined;
      };
      json["normal_stiffness_MPa_per_mm"] =
        or_nothing(solution.normal_stiffness);
      json["torsional_stiffness_MPa_per_mm"] =
        or_nothing(solution.torsional_stiffness);
      if (solution.scene.chuck.component[ChuckComponent::rotation_z].stiffness >
          0.)
        {
          json["jumps"] = solution.jumps().size();
          json["released_energy_Nm"] =
            1e-3 * solution.rows().back().released_energy_Nmm;
        }
    }
  } // namespace



  void
  write_results(const ClosedFormSolution &solution, const dealii::Timer &clock)
  {
    const double          seconds_before_steps = clock.wall_time();
    const Scene          &scene                = solution.scene;
    const ResultDirectory directory(scene.output, scene.completed_parameters);
    Console               console(scene.output.console, std::cout);
    ProfileOutput         profiles(scene, directory);
    if (!scene.title.empty())
      console.headline(scene.title);
    const std::vector<TorqueRow> &rows = solution.rows();
    for (const TorqueRow &row : rows)
      {
        console.row(row, rows.size() - 1);
        profiles.write(row.angle_deg, [&] {
          return points_along_radius(solution.model(),
                                     row.angle_deg * M_PI / 180.);
        });
      }
    write_file(directory.file("torque.csv"), torque_table(rows));
    console.warn("profile", profiles.finish());
    warn_of_jumps(solution, console);

    const CurveSettings settings = curve_settings(scene);
    RunSummary          summary;
    summary.measures = measure_torque_curve(rows, settings);
    console.warn("reference",
                 warning_about_reference(summary.measures, settings));
    summary.steps               = rows.size() - 1;
    summary.converged           = true;
    summary.reason              = "all planned steps are done";
    summary.warnings            = console.warnings;
    summary.wall_seconds        = clock.wall_time();
    summary.seconds             = {{"before steps", seconds_before_steps},
                                   {"stepping",
                                    summary.wall_seconds - seconds_before_steps}};
    summary.profile_measures    = profiles.measures();
    summary.peak_memory_MB      = peak_memory_MB();
    nlohmann::ordered_json json = summary;
    add_closed_form(solution, json);
    write_json(directory.file("summary.json"), json);

    std::ostringstream text;
    text << "Largest torque " << summary.measures.T_max_Nmm << " N mm at "
         << summary.measures.theta_max_deg << " deg, at the end "
         << summary.measures.T_inf_Nmm << " N mm. Results are in "
         << directory.path();
    console.headline(text.str());
  }



  void
  describe(const ClosedFormSolution &solution, std::ostream &out)
  {
    out << "Model " << name_of_closed_form(solution.scene.model)
        << ", pressure " << solution.model().disk.pressure << " MPa";
    if (solution.normal_stiffness > 0.)
      out << ", normal stiffness " << solution.normal_stiffness << " MPa/mm";
    if (solution.torsional_stiffness > 0.)
      out << ", torsional stiffness " << solution.torsional_stiffness
          << " MPa/mm";
    const std::vector<TorqueRow> &rows = solution.rows();
    out << '\n'
        << rows.size() - 1 << " planned steps from time " << rows.front().time
        << " to " << rows.back().time << '\n'
        << "at the end " << rows.back().torque_Nmm << " N mm\n";
  }
} // namespace Debond
