#include <debond/input/allowed_values.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

// What is read off a torque curve: peaks, stiffness, energies, with remarks
// where the rows do not tell.
namespace Debond
{
  namespace
  {
    using Rows     = std::vector<TorqueRow>;
    using Measures = nlohmann::ordered_json;

    /** A maximum that keeps a NaN. */
    void
    grow(double &maximum, const double value)
    {
      if (!std::isnan(maximum) && !(value <= maximum))
        maximum = value;
    }



    /** The largest magnitude of a value in the rows. */
    double
    largest_of(const Rows &rows, double TorqueRow::*const value)
    {
      double most = 0.;
      for (const TorqueRow &row : rows)
        grow(most, std::abs(row.*value));
      return most;
    }



    double
    radians(const double degrees)
    {
      return degrees * dealii::numbers::PI / 180.;
    }



    /** The last angle with |T| >= 0.999 T_max, linear between rows. Unlike the
     *  angle of the maximum itself, around which the curve is flat, it is a
     *  well-conditioned quantity. */
    double
    last_angle_near_maximum(const Rows &rows)
    {
      const double threshold = 0.999 * largest_of(rows, &TorqueRow::torque_Nmm);
      const auto   next =
        std::find_if(rows.rbegin(), rows.rend(), [&](const TorqueRow &row) {
          return std::abs(row.torque_Nmm) >= threshold;
        }).base();
      const TorqueRow &last = *std::prev(next);
      if (next == rows.end())
        return last.angle_deg;
      const double T = last.torque_Nmm;
      return last.angle_deg + (T - std::copysign(threshold, T)) /
                                (T - next->torque_Nmm) *
                                (next->angle_deg - last.angle_deg);
    }



    /** Why friction at the end of the curve does not tell what the bond has
     *  taken of E_deb, Eq.\ (20); empty: it does. @p theta_full_deg: what
     * E_fric is counted from; NaN if the torque is largest at the end. */
    std::string
    why_no_adhesion(const Rows          &rows,
                    const Rotation      &rotation,
                    const CurveSettings &settings,
                    const double         T_max,
                    const double         theta_full_deg)
    {
      const TorqueRow &start = rows[rotation.first_row - 1], &end = rows.back();
      if (!settings.is_bonded)
        return "nothing is bonded, or the friction law has no bond";
      if (end.adhesive_work_Nmm < 0.)
        return "the bond lowers friction";
      // The work of friction from theta_full on is several times that of the
      // bond. Before, friction of the push-in may be released.
      auto first = rows.begin() + rotation.first_row - 1;
      // beside the shear [MPa], what a force of 0 is solved to
      const double negligible =
        std::max(0., 1e-6 * T_max / std::pow(settings.contact_area_mm2, 1.5));
      for (const double largest_change : {0.1, 0.01})
        {
          const auto [least, most] =
            std::minmax_element(first,
                                rows.end(),
                                [](const TorqueRow &a, const TorqueRow &b) {
                                  return a.pressure_MPa < b.pressure_MPa;
                                });
          if (most->pressure_MPa <= negligible)
            return "nothing is pressed while it turns";
          if (most->pressure_MPa - least->pressure_MPa >
              largest_change * std::abs(most->pressure_MPa))
            return Text() << "the pressure goes from " << least->pressure_MPa
                          << " to " << most->pressure_MPa
                          << " MPa from there on: friction at the end is not "
                             "that before";
          while (first + 1 != rows.end() &&
                 rotation.direction * (first->angle_deg - theta_full_deg) < 0.)
            ++first;
        }
      if (std::isnan(theta_full_deg))
        return "the torque is largest at the end: no bond has broken yet, or "
               "friction is no less without it";
      if (rotation.direction * (end.angle_deg - theta_full_deg) <
          -rotation.tolerance)
        return "the run ends before Expert / Output / Friction energy from angle";
      // that much bond around the axis is some per cent of the torque
      if (end.phi_mean > 0.2 * start.phi_mean)
        return Text()
               << "the run ends before the bond is broken: of a mean phi "
                  "of "
               << start.phi_mean << ", " << end.phi_mean << " is left";
      return "";
    }



    /** The energies of Eqs.\ (20) and (21) [N mm]. */
    struct Energies
    {
      double E_deb = 0, E_fric = 0;
      double theta_full_deg; ///< NaN: the torque is largest at the end
      double from_deg;       ///< what E_fric is counted from

      Energies(const Rows  &rows,
               const double direction,
               const double full_angle)
      {
        for (std::size_t i = 1; i < rows.size(); ++i)
          E_deb += 0.5 * (rows[i - 1].torque_Nmm + rows[i].torque_Nmm) *
                   radians(rows[i].angle_deg - rows[i - 1].angle_deg);
        const TorqueRow &end = rows.back();
        theta_full_deg       = last_angle_near_maximum(rows);
        if (theta_full_deg == end.angle_deg)
          theta_full_deg = std::numeric_limits<double>::quiet_NaN();
        from_deg = full_angle > 0. ? direction * full_angle : theta_full_deg;
        E_fric   = end.torque_Nmm * radians(end.angle_deg - from_deg);
      }

      double
      W_adh() const
      {
        return E_deb - E_fric;
      }
    };



    /** By how much W_adh changes if every second row of the rotation is left
     *  out, beginning with the first or the second: about what it is off if
     *  rows are so far apart that the curve's peak falls between them. */
    double
    change_with_fewer_rows(const Rows     &rows,
                           const Rotation &rotation,
                           const double    full_angle,
                           const double    W_adh)
    {
      // rows at the same angle, of which the last one counts, are one
      Rows turning;
      for (auto i = rotation.first_row - 1; i < rows.size(); ++i)
        {
          if (!turning.empty() &&
              std::abs(turning.back().angle_deg - rows[i].angle_deg) <=
                rotation.tolerance)
            turning.pop_back();
          turning.push_back(rows[i]);
        }
      double change = 0.;
      for (const unsigned int first : {1, 0})
        {
          Rows fewer;
          for (std::size_t i = 0; i < turning.size(); ++i)
            if (i == 0 || i % 2 == first || i + 1 == turning.size())
              fewer.push_back(turning[i]);
          grow(change,
               std::abs(
                 Energies(fewer, rotation.direction, full_angle).W_adh() -
                 W_adh));
        }
      return change;
    }



    void
    measure_energies(const Rows          &rows,
                     const Rotation      &rotation,
                     const CurveSettings &settings,
                     const double         T_max,
                     Measures            &measures)
    {
      const double   full_angle = settings.full_sliding_angle_deg;
      const Energies energies(rows, rotation.direction, full_angle);
      // The trapezoid over a jump holds what the jump releases as well.
      const double released = rows.back().released_energy_Nmm -
                              rows[rotation.first_row - 1].released_energy_Nmm;
      measures["E_deb_Nmm"]      = energies.E_deb - released;
      measures["theta_full_deg"] = energies.theta_full_deg;
      if (released > 0.)
        measures["remarks"].push_back("E_deb, W_adh: without the " +
                                      to_text(released, 4) +
                                      " N mm that jumps have released");
      const std::string why =
        why_no_adhesion(rows, rotation, settings, T_max, energies.from_deg);
      if (!why.empty())
        {
          measures["remarks"].push_back("E_fric, W_adh, w_adh: null, " + why);
          return;
        }
      const double angle = rotation.direction * full_angle;
      const auto   there = rows_at(rows, {angle}); // once, or not at all
      const double T = there.empty() ? T_max : std::abs(there[0].torque_Nmm);
      if (full_angle > 0. && T < 0.99 * T_max)
        measures["remarks"].push_back(
          "E_fric, W_adh, w_adh: of the largest torque there are " +
          to_text(100. * T / T_max, 3) + " % at " + to_text(angle) +
          " degrees, the Expert / Output / Friction energy from angle: is it that of another "
          "curve?");
      const double W_adh     = energies.W_adh() - released;
      measures["E_fric_Nmm"] = energies.E_fric;
      measures["W_adh_Nmm"]  = W_adh;
      const double change =
        change_with_fewer_rows(rows, rotation, full_angle, energies.W_adh());
      if (!(change < 0.05 * std::abs(W_adh)))
        measures["remarks"].push_back(
          "W_adh, w_adh: the rows may be too far apart; with every second one " +
          (std::isnan(change) ?
             "the torque is largest at the end" :
             "W_adh changes by " + to_text(100. * change / std::abs(W_adh), 2) +
               " %"));

      // 1 N mm / mm^2 = 1000 N / m
      const double w_adh_star        = 1e3 * W_adh / settings.contact_area_mm2;
      measures["w_adh_star_N_per_m"] = w_adh_star;
      if (settings.mean_phi_0 > 0.)
        measures["w_adh_N_per_m"] = w_adh_star / settings.mean_phi_0;
    }



    /** Pressure at the end of the last phase before the angle first changes. */
    double
    pressure_before_rotation(const Rows                &rows,
                             const Rotation            &rotation,
                             const std::vector<double> &phase_times)
    {
      const unsigned int last =
        rotation.direction == 0. ? rows.size() - 1 : rotation.first_row - 1;
      for (unsigned int i = last; i > 0; --i)
        for (const double time : phase_times)
          if (std::abs(rows[i].time - time) <=
              1e-9 * (phase_times.back() - phase_times.front()))
            return rows[i].pressure_MPa;
      // without rotation what there is; with it, no phase ends before
      if (rotation.direction == 0. || rows[0].pressure_MPa > 0.)
        return rows[rotation.direction == 0. ? last : 0].pressure_MPa;
      return std::numeric_limits<double>::quiet_NaN();
    }



    /** Work spent on the bond by its area, and the largest pull. */
    void
    measure_bond(const Rows          &rows,
                 const CurveSettings &settings,
                 const double         T_max,
                 Measures            &measures)
    {
      const double bonded = settings.contact_area_mm2 * settings.mean_phi_0;
      if (bonded > 0.)
        for (const std::string part : {"normal", "tangential"})
          measures["w_" + part + "_N_per_m"] =
            1e3 * double(measures["D_adh_" + part + "_Nmm"]) / bonded;
      // less is what a force that is held at 0 is solved to
      double force = T_max / std::sqrt(settings.contact_area_mm2);
      for (const TorqueRow &row : rows)
        for (unsigned int k = 0; k < 3; ++k)
          grow(force, std::abs(row.chuck_reaction[k]));
      const auto pull =
        std::min_element(rows.begin(),
                         rows.end(),
                         [](const TorqueRow &a, const TorqueRow &b) {
                           return a.force_N < b.force_N;
                         });
      if (!(-pull->force_N > 1e-3 * force))
        return;
      measures.update({{"pull_max_N", -pull->force_N},
                       {"pull_max_mm", pull->chuck_position[2]}});
      if (pull + 1 == rows.end())
        measures["remarks"].push_back(
          "pull_max_N: the pull is largest at the end: it may grow on");
    }



    /** What is read off a curve that is no torque over an angle. */
    nlohmann::ordered_json
    measures_of(const ReferenceCurve &curve, const CurveAxes &axes)
    {
      const ReferenceCurve branch = main_branch(curve);
      const auto           peak =
        std::max_element(branch.begin(),
                         branch.end(),
                         [](const auto &a, const auto &b) {
                           return std::abs(a.second) < std::abs(b.second);
                         });
      const auto moved =
        std::find_if(branch.begin(), branch.end(), [&](const auto &point) {
          return std::abs(point.first - branch.front().first) > 1e-12;
        });
      return {{"over", axes.position_column()},
              {"load", axes.load_column()},
              {"largest", peak->second},
              {"at", peak->first},
              {"end", curve.back().second},
              {"initial_stiffness",
               moved == branch.end() ?
                 std::numeric_limits<double>::quiet_NaN() :
                 (moved->second - std::prev(moved)->second) /
                   (moved->first - std::prev(moved)->first)}};
    }



    /** Stiffness, and between which rows the bond begins to break. */
    void
    measure_beginning(const Rows                   &rows,
                      const std::vector<TorqueRow> &steps,
                      const Rotation               &rotation,
                      const CurveSettings          &settings,
                      Measures                     &measures)
    {
      const TorqueRow &first  = rows[rotation.first_row],
                      &before = rows[rotation.first_row - 1];
      measures["initial_stiffness_Nmm_per_rad"] =
        (first.torque_Nmm - before.torque_Nmm) /
        radians(first.angle_deg - before.angle_deg);
      // the stiffness of a face that sticks is asked for
      const TorqueRow &end_of_step =
        *std::find_if(steps.begin(), steps.end(), [&](const TorqueRow &row) {
          return row.time >= first.time;
        });
      if (end_of_step.share_slip > 0.1)
        measures["remarks"].push_back(
          "initial_stiffness_Nmm_per_rad is too small: " +
          to_text(100. * end_of_step.share_slip, 2) +
          " % of the face slides in the first row that has turned");
      // The bonding state is not known between them.
      const auto breaks =
        std::find_if(steps.begin(), steps.end(), [&](const TorqueRow &row) {
          return row.phi_mean < steps.front().phi_mean * (1. - 1e-12);
        });
      if (settings.is_bonded && settings.phi_only_falls &&
          breaks != steps.end())
        {
          measures["theta_bonded_deg"]    = std::prev(breaks)->angle_deg;
          measures["theta_debonding_deg"] = breaks->angle_deg;
        }
    }
  } // namespace



  void
  CurveSettings::take(const OutputParameters &output,
                      const ReferenceCurve   &curve)
  {
    if (output.observed_bonding > 0.)
      mean_phi_0 = output.observed_bonding;
    if (output.full_sliding_angle > 0.)
      full_sliding_angle_deg = output.full_sliding_angle;
    reference = curve;
    axes      = output.axes;
  }



  nlohmann::ordered_json
  empty_summary()
  {
    // how it ended; the curve; energies; how far from a reference; how well the
    // equations hold; the effort
    const char *const names =
      "converged reason warnings remarks "
      "T_max_Nmm theta_max_deg theta_full_deg T_inf_Nmm "
      "theta_bonded_deg theta_debonding_deg "
      "initial_stiffness_Nmm_per_rad pressure_MPa "
      "pull_max_N pull_max_mm force_end_N "
      "E_deb_Nmm E_fric_Nmm W_adh_Nmm w_adh_N_per_m w_adh_star_N_per_m "
      "D_adh_Nmm D_adh_normal_Nmm D_adh_tangential_Nmm "
      "w_normal_N_per_m w_tangential_N_per_m "
      "dissipation_Nmm viscous_dissipation_Nmm "
      "work_Nmm E_start_Nmm E_bulk_Nmm E_interface_Nmm "
      "e_mp e_rel difference_max difference_max_deg difference_mean "
      "reference_rows_used pressure_difference_rms slip_difference_rms "
      "reference_angles_used "
      "largest_energy_defect largest_reaction_defect "
      "steps smallest_step newton_iterations dofs unknowns condensed_unknowns "
      "wall_seconds peak_memory_MB";
    nlohmann::ordered_json summary;
    for (const std::string &name : split(names, " "))
      summary[name] = std::numeric_limits<double>::quiet_NaN();
    summary["reference_rows_used"] = summary["reference_angles_used"] = 0;
    summary["remarks"] = nlohmann::ordered_json::array();
    return summary;
  }



  nlohmann::ordered_json
  measure_torque_curve(const std::vector<TorqueRow> &steps,
                       const CurveSettings          &settings)
  {
    Measures measures = empty_summary();
    if (steps.empty())
      return measures;

    const Rows       rows = fine_curve(steps);
    const Rotation   rotation(curve_of(rows));
    const double     T_max = largest_of(rows, &TorqueRow::torque_Nmm);
    const TorqueRow &end   = rows.back();
    measures.update(
      {{"E_start_Nmm",
        steps.front().energy_bulk_Nmm + steps.front().energy_interface_Nmm},
       {"largest_energy_defect", largest_of(rows, &TorqueRow::energy_defect)},
       {"largest_reaction_defect",
        largest_of(rows, &TorqueRow::reaction_defect)},
       {"T_max_Nmm", T_max},
       {"pressure_MPa",
        pressure_before_rotation(rows, rotation, settings.phase_times)},
       {"T_inf_Nmm", end.torque_Nmm},
       {"D_adh_Nmm", end.adhesive_work_Nmm},
       {"D_adh_normal_Nmm", end.adhesive_normal_Nmm},
       {"D_adh_tangential_Nmm",
        end.adhesive_work_Nmm - end.adhesive_normal_Nmm},
       {"dissipation_Nmm", end.dissipation_Nmm},
       {"viscous_dissipation_Nmm", end.viscous_work_Nmm},
       {"force_end_N", end.force_N},
       {"work_Nmm", end.work_Nmm},
       {"E_bulk_Nmm", end.energy_bulk_Nmm},
       {"E_interface_Nmm", end.energy_interface_Nmm}});
    if (settings.is_bonded)
      measure_bond(rows, settings, T_max, measures);
    if (rotation.direction != 0. && !rotation.reverses)
      {
        measures["theta_max_deg"] =
          std::find_if(rows.begin(), rows.end(), [&](const TorqueRow &row) {
            return std::abs(row.torque_Nmm) == T_max;
          })->angle_deg;
        measure_beginning(rows, steps, rotation, settings, measures);
        measure_energies(rows, rotation, settings, T_max, measures);
      }
    else if (settings.axes.is_torsion())
      measures["remarks"].push_back(
        std::string("angles and energies of a rotation: null, ") +
        (rotation.reverses ? "the rotation reverses" : "nothing rotates"));
    const ReferenceCurve curve = curve_of(rows, settings.axes);
    if (!settings.axes.is_torsion())
      measures["curve"] = measures_of(curve, settings.axes);
    if (!settings.reference.empty())
      CurveComparison(curve, settings.reference, settings.axes)
        .put_into(measures); // Eqs. (19) and (50)
    return measures;
  }
} // namespace Debond
