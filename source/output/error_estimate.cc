#include <debond/input/csv_table.h>
#include <debond/output/error_estimate.h>
#include <debond/output/result_files.h>
#include <debond/scene/finer_scenes.h>

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
                                            "E_interface_Nmm",
                                            "crushed_volume_mm3",
                                            "crushed_depth_mm",
                                            "crushed_Nmm",
                                            "effective_interference_mm",
                                            "share_crushed",
                                            "share_sheared",
                                            "sheared_mm",
                                            "sheared_Nmm",
                                            "beyond_strength_mm3",
                                            "motion_mean_um",
                                            "motion_95_um"};



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

      /** Largest load over the way from the first place. */
      double
      steepest(const std::vector<TorqueRow> &rows) const
      {
        double result = 0.;
        for (const TorqueRow &row : rows)
          if (const double way = row.chuck_position[axes.position] -
                                 rows[0].chuck_position[axes.position];
              std::abs(way) > 1e-12)
            result = std::max(result, std::abs(load(row) / way));
        return result;
      }

      /** What is next to nothing beside all forces, or beside the size of the
       *  implant. */
      double
      noise(const std::vector<TorqueRow> &rows, const double R) const
      {
        const bool turns = is_rotation(is_position ? axes.position : axes.load);
        if (is_position)
          return 1e-9 * (turns ? 180. / M_PI : R);
        double force = 0.;
        for (const TorqueRow &row : rows)
          for (unsigned int k = 0; k < 6; ++k)
            force = std::max(force,
                             std::abs(row.chuck_reaction[k]) /
                               (is_rotation(k) ? R : 1.));
        return 1e-6 * force * (turns ? R : 1.);
      }

      double
      load(const TorqueRow &row) const
      {
        return axes.is_torsion() ? row.torque_Nmm :
                                   row.chuck_reaction[axes.load];
      }

      double
      of(const TorqueRow &row) const
      {
        return is_position ? row.chuck_position[axes.position] : load(row);
      }

      double
      largest(const std::vector<TorqueRow> &rows) const
      {
        double result = 0.;
        for (const TorqueRow &row : rows)
          result = std::max(result, std::abs(of(row)));
        return result;
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



    /** What straight lines between planned rows leave out, over the largest
     *  load: without every other row they are off at these by as much or more.
     *  Of a phase with one row more than that it changes is not known. */
    double
    error_of_chords(const Scene                  &scene,
                    const std::vector<TorqueRow> &rows,
                    const Answer                 &answer,
                    const double                  largest)
    {
      const std::vector<double> &times = scene.load_steps.times;
      double                     error = 0.;
      for (std::size_t i = 1; i < rows.size(); ++i)
        {
          const double before = answer.of(rows[i - 1]), at = answer.of(rows[i]);
          const auto   begin =
            std::find(times.begin(), times.end(), rows[i - 1].time);
          const bool ends =
            std::count(times.begin(), times.end(), rows[i].time);
          const auto &next = rows[std::min(i + 1, rows.size() - 1)];
          if (next.released_energy_Nmm > rows[i - 1].released_energy_Nmm)
            continue; // there is no value within a jump
          if (!ends && i + 1 < rows.size())
            {
              const double t = rows[i - 1].time, h = rows[i + 1].time - t,
                           after = answer.of(rows[i + 1]),
                           part  = scene.load_steps.follow_path ?
                                     0.5 :
                                     (rows[i].time - t) / h;
              error              = std::max(error,
                               std::abs(at - before - part * (after - before)));
            }
          else if (begin != times.end() && ends &&
                   !scene.is_press(begin - times.begin()))
            error = std::max(error, std::abs(at - before));
        }
      return error / largest;
    }



    /** What is left of the difference of two runs, whose cells have the ratio
     *  1.6, as they become smaller: half of it. Twice of it where they are of
     *  first order, at a rim or a modulus that cells do not follow, or
     *  trilinear; all of it where a bond ends across cells, and where one body
     *  is of a file, or both have coarser ones; a quarter where both are
     *  trilinear elements of the same files, far worse than quadratic ones. */
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
      const auto is_of_file = [](const BodyParameters &body) {
        return body.shape == BodyShape::file || body.is_rigid();
      };
      if (is_of_file(bone) && is_of_file(implant) &&
          !has_coarser_files(scene) &&
          (bone.shape == BodyShape::file || implant.shape == BodyShape::file))
        return 0.25;
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
    // more cells where there cannot be fewer: the error of the coarser of two
    // (trilinear cells of tetrahedra are more, and worse)
    const bool is_finer =
      number_in(other, "unknowns") > number_in(summary, "unknowns") &&
      !scene.bone.has_tetrahedra() && !scene.implant.has_tetrahedra();
    const double share = share_left(scene) + (is_finer ? 1. : 0.);
    bodies             = of_linear_bodies(summary);
    compare(scene, rows, coarser, share);
    find_members(rows, summary, other, share);
    const Answer answer(scene);
    if (why_unknown.empty())
      find_places(scene, rows, summary);
    total = cells + steps + bodies;
    // of the curve's largest value and of its first slope, which may be next to
    // nothing beside what it is later
    const bool is_torsion = answer.axes.is_torsion();
    const auto none       = nlohmann::ordered_json::object();
    const auto values     = is_torsion ? summary : summary.value("curve", none),
               errors     = is_torsion ? members : members.value("curve", none);
    const double steepest = answer.steepest(rows);
    for (const auto &[name, least] :
         {std::pair<std::string, double>(is_torsion ? "T_max_Nmm" : "largest",
                                         0.),
          {is_torsion ? "initial_stiffness_Nmm_per_rad" : "initial_stiffness",
           is_torsion ? steepest * 180. / M_PI : steepest}})
      if (const double error =
            number_in(errors, name + "_error") /
            std::max(std::abs(number_in(values, name)), least);
          error > total)
        total = error;
  }



  void
  ErrorEstimate::find_members(const std::vector<TorqueRow> &rows,
                              const nlohmann::ordered_json &summary,
                              const nlohmann::ordered_json &other,
                              const double                  share)
  {
    // Where something happens the scene prescribes, or steps find it. A
    // difference may vanish by chance: half of the curve's is the least, and
    // twice as much of energies, which are squares.
    const auto error = [&](const std::string            &name,
                           const nlohmann::ordered_json &own,
                           const nlohmann::ordered_json &coarser) {
      const double value  = number_in(own, name),
                   square = name == "E_bulk_Nmm" || name == "E_interface_Nmm" ?
                              2. :
                              1.;
      const bool is_position =
        name == "at" || name == "pull_max_mm" || name.rfind("theta", 0) == 0;
      const double difference =
        share * std::abs(value - number_in(coarser, name));
      return is_position ?
               difference :
               std::max(difference, 0.5 * square * cells * std::abs(value)) +
                 square * (steps + bodies) * std::abs(value);
    };
    for (const std::string &name : measured)
      if (summary.contains(name))
        members[name + "_error"] = error(name, summary, other);
    // of work and dissipation, what their balance lacks
    for (const std::string name : {"work_Nmm", "dissipation_Nmm"})
      if (auto &one = members[name + "_error"]; one.is_number())
        one = one.get<double>() +
              std::abs(rows.back().energy_defect * rows.back().work_Nmm);
    // a difference of two areas that are each off
    const double W     = number_in(summary, "W_adh_Nmm"),
                 areas = (number_in(members, "E_deb_Nmm_error") +
                          number_in(members, "E_fric_Nmm_error")) /
                         std::abs(W);
    for (const std::string name :
         {"W_adh_Nmm", "w_adh_N_per_m", "w_adh_star_N_per_m"})
      members[name + "_error"] =
        std::fmax(number_in(members, name + "_error"),
                  areas * std::abs(number_in(summary, name)));
    if (!summary.contains("curve") || !other.contains("curve"))
      return;
    members["curve"] = summary["curve"];
    for (const std::string name : {"largest", "at", "end", "initial_stiffness"})
      members["curve"][name + "_error"] =
        error(name, summary["curve"], other["curve"]);
  }



  // Steps may find a flat peak anywhere within their error, and the end of one
  // where the curve falls through 99.9 % of it within that; cells move the
  // curve as a whole. A load that the scene prescribes has no error, its place
  // has.
  void
  ErrorEstimate::find_places(const Scene                  &scene,
                             const std::vector<TorqueRow> &rows,
                             const nlohmann::ordered_json &summary)
  {
    if (scene.chuck.component[ChuckComponent::translation_z].loaded)
      for (const char *const name : {"force_end_N_error", "pressure_MPa_error"})
        members.erase(name);
    const Answer answer(scene);
    const bool   is_torsion = answer.axes.is_torsion();
    auto        &errors = is_torsion ? members : members["curve"]; // or null
    const auto   values =
      is_torsion ? summary :
                     summary.value("curve", nlohmann::ordered_json::object());
    const double      top   = answer.largest(rows);
    const std::string place = is_torsion ? "theta_max_deg" : "at";
    // of rows whose share of the largest load is this, but for an error
    const auto grow =
      [&](const std::string &name, const double share, const double error) {
        const double at = number_in(values, name);
        if (!std::isfinite(at))
          return;
        double far = number_in(errors, name + "_error");
        for (const TorqueRow &row : rows)
          if (const double there = row.chuck_position[answer.axes.position];
              std::abs(std::abs(answer.load(row)) / top - share) <= error &&
              (share == 1. || std::abs(there) > number_in(values, place)))
            far = std::fmax(far, std::abs(there - at));
        errors[name + "_error"] = far;
      };
    if (!errors.is_object())
      return;
    if (!answer.is_position)
      {
        grow(place, 1., steps);
        grow("theta_full_deg", 0.999, steps);
        return;
      }
    for (const char *const name :
         {"T_max_Nmm_error", "T_inf_Nmm_error", "largest_error", "end_error"})
      errors.erase(name);
    errors[place + "_error"] = std::fmax(number_in(errors, place + "_error"),
                                         (0.5 * cells + steps + bodies) *
                                           std::abs(number_in(values, place)));
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
    const History history         = answer.history_in(coarser);
    column                        = answer.column();
    const double largest          = answer.largest(rows);
    double       largest_of_other = 0.;
    for (const auto &[time, value] : history)
      largest_of_other = std::max(largest_of_other, std::abs(value));
    if (largest <= answer.noise(rows, scene.implant.characteristic_radius()))
      {
        why_unknown = "the curve has no load";
        return;
      }
    const bool is_straight = !scene.load_steps.draws_curve();
    steps = is_straight ? error_of_chords(scene, rows, answer, largest) :
            scene.load_steps.adaptive ? scene.load_steps.tolerance :
                                        0.;
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
    double     before = 0., after = 0.;
    const auto add = [&](const double time, const double difference) {
      if (time <= begin)
        before = std::max(before, difference / largest);
      else if (time >= end)
        after = std::max(after, difference / largest);
    };
    History own_history;
    for (const TorqueRow &row : rows)
      {
        const double difference =
          share * std::abs(answer.of(row) - value_at(history, row.time));
        own_history.emplace_back(row.time, answer.of(row));
        of_rows.push_back(difference + (steps + bodies) * largest);
        if (!is_straight)
          add(row.time, difference);
      }
    if (is_straight) // where the coarser run has rows: between is for steps
      for (const auto &[time, value] : history)
        add(time, share * std::abs(value_at(own_history, time) - value));
    cells = std::max(before, after);
    if (!own.is_there())
      return;
    members["error_before_jump"]      = before + steps + bodies;
    members["error_after_jump"]       = after + steps + bodies;
    members["error_of_jump_position"] = std::abs(own.position - other.position);
  }
} // namespace Debond
