#include <debond/input/csv_table.h>
#include <debond/output/error_estimate.h>
#include <debond/output/result_files.h>

#include <algorithm>
#include <cmath>

// Errors by the difference of two runs.
namespace Debond
{
  namespace
  {
    /** Members of summary.json that have errors. */
    const std::vector<std::string> measured{"T_max_Nmm",
                                            "theta_max_deg",
                                            "theta_full_deg",
                                            "T_inf_Nmm",
                                            "initial_stiffness_Nmm_per_rad",
                                            "pressure_MPa",
                                            "pull_max_N",
                                            "pull_max_mm",
                                            "force_end_N",
                                            "E_deb_Nmm",
                                            "E_fric_Nmm",
                                            "W_adh_Nmm",
                                            "w_adh_N_per_m",
                                            "w_adh_star_N_per_m",
                                            "D_adh_Nmm",
                                            "D_adh_normal_Nmm",
                                            "D_adh_tangential_Nmm",
                                            "dissipation_Nmm",
                                            "work_Nmm",
                                            "E_start_Nmm",
                                            "E_bulk_Nmm",
                                            "E_interface_Nmm"};



    /** What answers the load, over time, linear between points. */
    using History = std::vector<std::pair<double, double>>;

    double
    value_at(const History &history, const double time)
    {
      const auto end = std::lower_bound(history.begin(),
                                        history.end(),
                                        time,
                                        [](const auto &point, double t) {
                                          return point.first < t;
                                        });
      if (end == history.end())
        return history.back().second;
      if (end == history.begin() || end->first == time)
        return end->second;
      const auto &[t, value] = *std::prev(end);
      return value + (time - t) / (end->first - t) * (end->second - value);
    }



    /** The load, or, where it is prescribed, the position. */
    struct Answer
    {
      const CurveAxes axes;
      const bool      is_position;

      std::string
      column() const
      {
        return is_position ? axes.position_column() : axes.load_column();
      }

      explicit Answer(const Scene &scene)
        : axes(scene.output.axes)
        , is_position(scene.chuck.component[axes.load].loaded)
      {}

      double
      of(const TorqueRow &row) const
      {
        return is_position       ? row.chuck_position[axes.position] :
               axes.is_torsion() ? row.torque_Nmm :
                                   row.chuck_reaction[axes.load];
      }

      History
      history_in(const std::string &directory) const
      {
        History history;
        for (const auto &row :
             read_csv_columns(finest_curve(directory), "", {"time", column()}))
          history.emplace_back(row[0], row[1]);
        return history;
      }
    };



    /** The step in which a curve jumps for the first time: the times of its
     *  ends, and the position behind it; none: infinite times. */
    struct Jump
    {
      double begin = std::numeric_limits<double>::infinity(), end = begin,
             position = ErrorEstimate::unknown;

      bool
      is_there() const
      {
        return begin < std::numeric_limits<double>::infinity();
      }

      void
      look(const double time_before,
           const double time,
           const double released,
           const double at)
      {
        if (released > 0. && !is_there())
          *this = {time_before, time, at};
      }
    };

    Jump
    first_jump(const std::vector<TorqueRow> &rows, const CurveAxes &axes)
    {
      Jump jump;
      for (std::size_t i = 1; i < rows.size(); ++i)
        jump.look(rows[i - 1].time,
                  rows[i].time,
                  rows[i].released_energy_Nmm,
                  rows[i].chuck_position[axes.position]);
      return jump;
    }

    Jump
    first_jump(const std::string &directory, const CurveAxes &axes)
    {
      Jump       jump;
      const auto rows = read_csv_columns(directory + "/" + axes.rows_file(),
                                         "",
                                         {"time",
                                          "released_energy_Nmm",
                                          axes.position_column()});
      for (std::size_t i = 1; i < rows.size(); ++i)
        jump.look(rows[i - 1][0], rows[i][0], rows[i][1], rows[i][2]);
      return jump;
    }



    /** What is left of the difference of two runs, whose cells have the ratio
     *  1.6, as they become smaller: half of it. Twice of it where they are of
     *  first order, at a rim or a modulus that cells do not follow, or
     *  trilinear; all of it where a bond ends across cells, and where one body
     * is of a file. */
    double
    share_left(const Scene &scene)
    {
      const BodyParameters &bone = scene.bone, &implant = scene.implant;
      const auto            is_trilinear = [](const BodyParameters &body) {
        return body.element == ElementKind::trilinear && !body.is_rigid();
      };
      const bool follows_rim =
        bone.is_fitted() || bone.is_rigid() || bone.shape != BodyShape::block ||
        bone.cells_under_implant > 0 || scene.has_soft_interface();
      if (is_trilinear(bone) || is_trilinear(implant) || !follows_rim ||
          bone.modulus)
        return 2.;
      return scene.interface.bonding_of_law().pattern !=
                   BondingPatternKind::homogeneous ||
                 bone.cells_under_implant > 0 ||
                 bone.shape == BodyShape::file ||
                 implant.shape == BodyShape::file ?
               1. :
               0.5;
    }
  } // namespace



  double
  ErrorEstimate::of_linear_bodies(const nlohmann::ordered_json &summary)
  {
    const double in_bulk = number_in(summary, "E_bulk_Nmm"),
                 error   = number_in(summary, "change_at_large_strains") *
                         in_bulk /
                         (in_bulk + number_in(summary, "E_interface_Nmm"));
    return error > 0. ? error : 0.;
  }



  ErrorEstimate::ErrorEstimate(const Scene                  &scene,
                               const std::vector<TorqueRow> &rows,
                               const nlohmann::ordered_json &summary,
                               const std::string            &coarser)
  {
    const nlohmann::ordered_json other = read_json(coarser + "/summary.json");
    if (!other.value("converged", false))
      {
        why_unknown = other.value("reason", "there is no coarser run");
        return;
      }
    const double share = share_left(scene);
    steps  = scene.load_steps.adaptive ? scene.load_steps.tolerance : 0.;
    bodies = of_linear_bodies(summary);
    compare(scene, rows, coarser, share);
    find_members(summary, other, share);
    total = cells + steps + bodies;
    // of the curve's largest value and of its first slope
    const bool is_torsion = scene.output.axes.is_torsion();
    const auto none       = nlohmann::ordered_json::object();
    const auto values     = is_torsion ? summary : summary.value("curve", none),
               errors     = is_torsion ? members : members.value("curve", none);
    for (const std::string name :
         {is_torsion ? "T_max_Nmm" : "largest",
          is_torsion ? "initial_stiffness_Nmm_per_rad" : "initial_stiffness"})
      if (const double error = number_in(errors, name + "_error") /
                               std::abs(number_in(values, name));
          error > total)
        total = error;
  }



  void
  ErrorEstimate::find_members(const nlohmann::ordered_json &summary,
                              const nlohmann::ordered_json &other,
                              const double                  share)
  {
    // Where something happens the scene prescribes, or steps find it. A
    // difference may vanish by chance: half of the curve's is the least.
    const auto error = [&](const std::string            &name,
                           const nlohmann::ordered_json &own,
                           const nlohmann::ordered_json &coarser) {
      const double value = number_in(own, name);
      const bool   is_position =
        name == "at" || name == "pull_max_mm" || name.rfind("theta", 0) == 0;
      const double difference =
        share * std::abs(value - number_in(coarser, name));
      return is_position ? difference :
                           std::max(difference, 0.5 * cells * std::abs(value)) +
                             (steps + bodies) * std::abs(value);
    };
    for (const std::string &name : measured)
      members[name + "_error"] = error(name, summary, other);
    if (!summary.contains("curve") || !other.contains("curve"))
      return;
    members["curve"] = summary["curve"];
    for (const std::string name : {"largest", "at", "end", "initial_stiffness"})
      members["curve"][name + "_error"] =
        error(name, summary["curve"], other["curve"]);
  }



  // At equal times. Times around a jump are left out: there is no value within
  // one. Along a path time is no measure, and peaks are compared.
  void
  ErrorEstimate::compare(const Scene                  &scene,
                         const std::vector<TorqueRow> &rows,
                         const std::string            &coarser,
                         const double                  share)
  {
    const Answer  answer(scene);
    const History history = answer.history_in(coarser);
    column                = answer.column();
    double largest = 0., largest_of_other = 0.;
    for (const TorqueRow &row : rows)
      largest = std::max(largest, std::abs(answer.of(row)));
    for (const auto &[time, value] : history)
      largest_of_other = std::max(largest_of_other, std::abs(value));
    if (largest == 0.)
      {
        why_unknown = "the curve has no load";
        return;
      }
    if (scene.load_steps.follow_path)
      {
        cells = share * std::abs(largest - largest_of_other) / largest;
        return;
      }
    const Jump own   = first_jump(rows, answer.axes),
               other = first_jump(coarser, answer.axes);
    if (own.is_there() != other.is_there())
      {
        why_unknown = "only one of the two runs jumps";
        return;
      }
    const double begin = std::min(own.begin, other.begin),
                 end   = std::max(own.end, other.end);
    double before = 0., after = 0.;
    for (const TorqueRow &row : rows)
      {
        const double difference =
          share * std::abs(answer.of(row) - value_at(history, row.time));
        of_rows.push_back(difference + (steps + bodies) * largest);
        if (row.time <= begin)
          before = std::max(before, difference / largest);
        else if (row.time >= end)
          after = std::max(after, difference / largest);
      }
    cells = std::max(before, after);
    if (!own.is_there())
      return;
    members["error_before_jump"]      = before + steps + bodies;
    members["error_after_jump"]       = after + steps + bodies;
    members["error_of_jump_position"] = std::abs(own.position - other.position);
  }
} // namespace Debond
