#include <debond/interface/contact_point_state.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/run_report.h>
#include <debond/support/number_text.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

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
          const double   r     = R * (i + 0.5) / n;
          const auto     point = model.point(r, theta);
          InterfacePoint values;
          values << r, 0., r, model.disk.pressure, std::abs(point.traction),
            point.slip, point.phi, point.mu,
            double(point.sticks ? PointStatus::stick : PointStatus::slip),
            2. * M_PI * r * R / n, 1.,
            model.disk.friction->decay(point.slip).value,
            point.traction == 0. ? 0. : 90., 0., 0.;
          points.push_back(values);
        }
      return points;
    }
  } // namespace



  CurveSettings
  ClosedFormSolution::curve_settings() const
  {
    const BondingParameters bonding = scene.interface.bonding_of_law();
    CurveSettings           settings;
    settings.contact_area_mm2 = M_PI * std::pow(scene.implant.radius, 2);
    settings.mean_phi_0 = bonding.initial_bonding * bonding.bonded_fraction;
    settings.is_bonded =
      scene.model == ModelKind::crack || settings.mean_phi_0 > 0.;
    if (scene.model == ModelKind::prescribed_angles)
      settings.full_sliding_angle_deg = scene.closed_form.full_sliding;
    settings.phase_times = scene.load_steps.times;
    return settings;
  }



  void
  write_results(const ClosedFormSolution &solution, const dealii::Timer &clock)
  {
    const double          seconds_before_steps = clock.wall_time();
    const Scene          &scene                = solution.scene;
    const ResultDirectory directory(scene.output, scene.completed_parameters);
    RunReport report(scene, directory, [&solution](const TorqueRow &row) {
      return points_along_radius(*solution.model, row.angle_deg * M_PI / 180.);
    });
    const unsigned int n_steps = solution.rows.size() - 1;
    report.begin({});
    for (const Warning &warning : scene.warnings())
      report.console.warn(warning.check, warning.text);
    for (const TorqueRow &row : solution.rows)
      report.add(row, n_steps);
    for (const auto &jump : solution.jumps)
      report.console.warn(
        "jump",
        Text() << "the bond snaps back: at the machine's angle of "
               << jump.machine_angle * 180. / M_PI
               << " deg the torque jumps from " << jump.torque_before << " to "
               << jump.torque_after << " N mm, and " << jump.released_energy
               << " N mm of stored energy are released without equilibrium");

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
        facts["jumps"]               = solution.jumps.size();
        facts["released_energy_Nmm"] = solution.rows.back().released_energy_Nmm;
      }
    report.finish(solution.rows, solution.curve_settings(), facts);
  }



  void
  describe(const ClosedFormSolution &solution, std::ostream &out)
  {
    const ModelKind model = solution.scene.model;
    Text            text;
    text << "Model "
         << (model == ModelKind::foundation        ? "foundation" :
             model == ModelKind::prescribed_angles ? "prescribed angles" :
                                                     "crack")
         << ", pressure " << solution.model->disk.pressure << " MPa";
    if (solution.normal_stiffness > 0.)
      text << ", normal stiffness " << solution.normal_stiffness << " MPa/mm";
    if (solution.torsional_stiffness > 0.)
      text << ", torsional stiffness " << solution.torsional_stiffness
           << " MPa/mm";
    const TorqueRow &last = solution.rows.back();
    text << '\n'
         << solution.rows.size() - 1 << " planned steps from time "
         << solution.rows.front().time << " to " << last.time << '\n'
         << "at the end " << last.torque_Nmm << " N mm\n";
    out << std::string(text);
  }
} // namespace Debond
