#include <debond/campaigns/experiment.h>
#include <debond/input/allowed_values.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/simulation.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/runtime.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <set>

// An experiment of a calibration: what a scene predicts where something has
// been measured, for unknowns that change from one call to the next, and how
// that changes with them.
namespace Debond
{
  namespace
  {
    constexpr double degree = M_PI / 180.;
    constexpr auto   push   = ChuckComponent::translation_z;
    constexpr auto   twist  = ChuckComponent::rotation_z;

    const std::string calibration = "Calibration / ";



    /** As a member of a constructor: errors say where the scene has it. */
    template <typename Make>
    auto
    placed(const Scene &scene, const Make &make)
    {
      try
        {
          return make();
        }
      catch (const InputError &error)
        {
          throw scene.with_place(error);
        }
    }



    std::vector<CurveColumn>
    columns_of(const Scene &scene)
    {
      return placed(scene, [&] {
        std::vector<CurveColumn> columns;
        for (const std::string &name : scene.calibration.curves)
          columns.emplace_back(name, calibration + "Curves");
        return columns;
      });
    }



    /** By how much the rig may show more than the implant has turned, within
     *  the bounds of the unknowns. */
    double
    largest_shift(const Unknowns    &unknowns,
                  const unsigned int number,
                  const Scene       &scene)
    {
      Eigen::VectorXd lower = unknowns.starts(), upper = lower;
      for (Eigen::Index j = 0; j < lower.size(); ++j)
        {
          lower[j] = unknowns.list[j].lower;
          upper[j] = unknowns.list[j].upper;
        }
      double offset = scene.calibration.angle_offset,
             slack  = scene.calibration.slack;
      for (const auto &values : {lower, upper})
        for (const SceneEntry &entry : unknowns.varied_entries(number, values))
          for (double *const part : {&offset, &slack})
            if (entry.full_name() ==
                calibration + (part == &offset ? "Angle offset" : "Slack"))
              *part = std::max(*part, read_number(entry.value).value_or(*part));
      return offset + slack;
    }



    /** What the scene predicts needs neither the measured curve nor a
     *  directory. */
    std::vector<SceneEntry>
    without_reference(const std::vector<SceneEntry> &entries)
    {
      return with_overrides(
        entries,
        {"Task=simulate", "Output/Reference curve=", "Output/Console=quiet"});
    }
  } // namespace



  Experiment::Experiment(const Unknowns    &unknowns,
                         const unsigned int number,
                         const std::string &name)
    : scene(
        Scene::from_entries(unknowns.entries(number, unknowns.starts()), name))
    , columns(columns_of(scene))
    , over(placed(scene,
                  [&] {
                    return CurveColumn(scene.calibration.over,
                                       calibration + "Over");
                  }))
    , measured(
        placed(scene,
               [&] {
                 return Measurement(scene,
                                    columns,
                                    over,
                                    largest_shift(unknowns, number, scene));
               }))
    , unknowns(unknowns)
    , number(number)
    , varying(without_reference(unknowns.entries(number, unknowns.starts())),
              name)
    , has_elastic_bodies(scene.bone.material != Material::rigid ||
                         scene.implant.material != Material::rigid)
  {
    if (scene.model == ModelKind::automatic)
      throw scene.with_place(
        EntryError("Model",
                   "a calibration compares curves of one model: choose it"));
    find_changes();
    why_no_closed_form = find_why_no_closed_form();
  }



  // Values that are not allowed within the bounds show now, and not in the
  // middle of a search.
  void
  Experiment::check_bounds()
  {
    for (std::size_t j = 0; j < unknowns.list.size(); ++j)
      for (const double bound :
           {unknowns.list[j].lower, unknowns.list[j].upper})
        {
          Eigen::VectorXd at_bound = unknowns.starts();
          at_bound[j]              = bound;
          try
            {
              scene_at(at_bound).check();
            }
          catch (const EntryError &error)
            {
              if (!error.place.empty())
                throw;
              unknowns.list[j].entry.refuse("at the bound " + to_text(bound) +
                                            ": " + error.what());
            }
        }
  }



  // What an unknown changes shows in the entries that hold it.
  void
  Experiment::find_changes()
  {
    const Eigen::VectorXd starts = unknowns.starts();
    const auto            before = unknowns.varied_entries(number, starts);
    for (Eigen::Index j = 0; j < starts.size(); ++j)
      {
        Eigen::VectorXd other = starts;
        const Unknown  &u     = unknowns.list[j];
        other[j] =
          0.5 * (starts[j] + (starts[j] < u.upper ? u.upper : u.lower));
        const auto after = unknowns.varied_entries(number, other);
        Changes    change;
        for (std::size_t e = 0; e < before.size(); ++e)
          if (before[e].value != after[e].value)
            {
              const std::string entry       = before[e].full_name();
              const auto        starts_with = [&](const std::string &text) {
                return boost::starts_with(entry, text);
              };
              const bool is_penalty =
                           entry.find("enalty stiffness") != std::string::npos,
                         is_bulk =
                           starts_with("Bone /") || starts_with("Implant /");
              change.model     = change.model || !starts_with(calibration);
              change.stiffness = change.stiffness || is_bulk || is_penalty;
              change.law =
                change.law || (starts_with("Interface /") && !is_penalty &&
                               !starts_with("Interface / Bonding"));
              keeps_bodies = keeps_bodies && !is_bulk;
            }
        changes.push_back(change);
      }
  }



  std::string
  Experiment::find_why_no_closed_form() const
  {
    Scene as_foundation = scene;
    as_foundation.model = ModelKind::foundation;
    std::string why     = Debond::why_no_closed_form(as_foundation);
    if (!why.empty())
      return why;
    if (scene.load_steps.follow_path)
      return "the scene follows a path";
    if (scene.chuck.component[twist].stiffness > 0.)
      return "the machine is compliant";
    const BondingPatternKind pattern = scene.interface.bonding_of_law().pattern;
    if (pattern != BondingPatternKind::homogeneous &&
        pattern != BondingPatternKind::disk)
      return "closed forms know homogeneous bonding and the disk";
    for (const SceneEntry &entry :
         unknowns.varied_entries(number, unknowns.starts()))
      if (entry.full_name() == "Implant / Radius")
        return "the radius is an unknown";
    if (!over.is(CurveColumn::position, twist))
      return "closed forms know curves over the angle";
    for (const CurveColumn &column : columns)
      if (!column.is(CurveColumn::reaction, twist) &&
          !column.is(CurveColumn::reaction, push))
        return "closed forms know torque and axial force";
    return "";
  }



  const Scene &
  Experiment::scene_at(const Eigen::VectorXd &values)
  {
    return varying.with(unknowns.varied_entries(number, values));
  }



  std::array<Eigen::VectorXd, 2>
  Experiment::moved(const Eigen::VectorXd &values,
                    const unsigned int     j,
                    const double           part) const
  {
    const Unknown &u = unknowns.list[j];
    const double   h =
      part * std::max(std::abs(values[j]), 1e-2 * (u.upper - u.lower));
    std::array<Eigen::VectorXd, 2> ends{{values, values}};
    ends[0][j] = std::max(values[j] - h, u.lower);
    ends[1][j] = std::min(values[j] + h, u.upper);
    return ends;
  }



  // The rig enters without rounding of iterations.
  std::array<Eigen::VectorXd, 2>
  Experiment::ends_of(const Eigen::VectorXd &values, const unsigned int j) const
  {
    return moved(values, j, changes[j].model ? 1e-3 : 1e-5);
  }



  namespace
  {
    /** What the rig adds, as numbers that have derivatives. */
    Eigen::Vector4d
    rig_of(const CalibrationParameters &c)
    {
      return {c.angle_offset, c.slack, c.machine_compliance, c.torque_offset};
    }
  } // namespace



  Eigen::Vector4d
  Experiment::rig_derivative(const Eigen::VectorXd &values,
                             const unsigned int     j)
  {
    const auto            ends   = moved(values, j, 1e-5);
    const Eigen::Vector4d before = rig_of(scene_at(ends[0]).calibration),
                          after  = rig_of(scene_at(ends[1]).calibration);
    return (after - before) / (ends[1][j] - ends[0][j]);
  }



  namespace
  {
    using RowDerivative = Experiment::RowDerivative;

    double
    rounding_of_torque(const std::vector<TorqueRow> &rows)
    {
      double largest = 0.;
      for (const TorqueRow &row : rows)
        largest = std::max(largest, std::abs(row.torque_Nmm));
      return 1e-9 * largest;
    }



    /** Where the torque T changes its sign the slack is passed at rest: adds a
     *  row just before and one just after, at the share s = T_a / (T_a - T_b)
     *  of a step. */
    void
    add_rows_without_torque(std::vector<TorqueRow>     &rows,
                            std::vector<RowDerivative> &derivatives)
    {
      const double rounding = rounding_of_torque(rows);
      for (std::size_t i = 1; i < rows.size(); ++i)
        {
          const TorqueRow a = rows[i - 1], b = rows[i];
          const double    T_a = a.torque_Nmm, T_b = b.torque_Nmm;
          if (!(T_a * T_b < 0.) || std::abs(T_a) < 2. * rounding ||
              std::abs(T_b) < 2. * rounding)
            continue;
          const double share = T_a / (T_a - T_b);
          const auto   mean  = [&](const double x, const double y) {
            return (1. - share) * x + share * y;
          };
          TorqueRow between = b;
          between.time      = mean(a.time, b.time);
          for (unsigned int k = 0; k < 6; ++k)
            {
              between.chuck_reaction[k] =
                mean(a.chuck_reaction[k], b.chuck_reaction[k]);
              between.chuck_position[k] =
                mean(a.chuck_position[k], b.chuck_position[k]);
            }
          TorqueRow before = between, after = between;
          before.torque_Nmm = std::copysign(2. * rounding, T_a);
          after.torque_Nmm  = std::copysign(2. * rounding, T_b);
          rows.insert(rows.begin() + i, {before, after});
          if (!derivatives.empty())
            {
              const RowDerivative d_a = derivatives[i - 1],
                                  d_b = derivatives[i];
              Eigen::Matrix<double, 13, 1> change;
              for (unsigned int k = 0; k < 6; ++k)
                {
                  change[k]     = b.chuck_reaction[k] - a.chuck_reaction[k];
                  change[6 + k] = b.chuck_position[k] - a.chuck_position[k];
                }
              change[12] = T_b - T_a;
              const RowDerivative d =
                (1. - share) * d_a + share * d_b +
                change * (T_a * d_b.row(12) - T_b * d_a.row(12)) /
                  std::pow(T_a - T_b, 2);
              derivatives.insert(derivatives.begin() + i, {d, d});
            }
          i += 2;
        }
    }
  } // namespace



  // The rows are joined by straight lines, seen from where the instruments
  // stand. A row of the measured curve lies on the line of its branch that
  // crosses its place x, at the share s = (x - x_a) / (x_b - x_a), and
  //
  //   dy = (1 - s) (dy_a - m dx_a) + s (dy_b - m dx_b),   m = (y_b - y_a) /
  //                                                           (x_b - x_a).
  //
  // Before the beginning of a branch the curve stays as it begins.
  PredictedCurves
  Experiment::at_measured_rows(std::vector<TorqueRow>       rows,
                               std::vector<RowDerivative>   row_derivatives,
                               const CalibrationParameters &rig,
                               const Eigen::MatrixXd &rig_derivatives) const
  {
    if (rig.slack != 0.)
      add_rows_without_torque(rows, row_derivatives);
    const unsigned int n_rows = rows.size(), n_measured = measured.over.size();
    const bool         differentiate = !row_derivatives.empty();
    const unsigned int n_unknowns    = differentiate ? unknowns.list.size() : 0;
    const bool         over_angle    = over.is(CurveColumn::position, twist);

    Eigen::VectorXd x(n_rows);
    Eigen::MatrixXd dx        = Eigen::MatrixXd::Zero(n_rows, n_unknowns);
    const auto      of_column = [&](const CurveColumn &column,
                               const unsigned int i) -> Eigen::RowVectorXd {
      if (column.kind == CurveColumn::time || n_unknowns == 0)
        return Eigen::RowVectorXd::Zero(n_unknowns);
      return row_derivatives[i].row(
        column.about_own_axis                ? 12 :
        column.kind == CurveColumn::position ? 6 + column.component :
                                               column.component);
    };
    const CurveColumn torque("torque_Nmm", "");
    const double      rounding = rounding_of_torque(rows);
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        x[i]                = over.of(rows[i]);
        dx.row(i)           = of_column(over, i);
        const double exact  = torque.of(rows[i]),
                     T      = std::abs(exact) > rounding ? exact : 0.;
        const double caught = T >= 0. ? 1. : 0.;
        if (over_angle)
          {
            x[i] += rig.angle_offset + caught * rig.slack +
                    rig.machine_compliance * T;
            if (differentiate)
              dx.row(i) += rig_derivatives.row(0) +
                           caught * rig_derivatives.row(1) +
                           T * rig_derivatives.row(2) +
                           rig.machine_compliance * of_column(torque, i);
          }
      }

    const std::vector<int> branch = branches_of(x, measured.least_turn);
    if (n_measured > 0 && branch.back() < measured.branch.back())
      throw EntryError("Output / Reference curve",
                       measured.file + " turns back " +
                         std::to_string(measured.branch.back()) +
                         " times, the computed curve " +
                         std::to_string(branch.back()) + " times");

    PredictedCurves result{Eigen::VectorXd(n_measured * columns.size()),
                           Eigen::MatrixXd(n_measured * columns.size(),
                                           n_unknowns)};
    for (unsigned int q = 0; q < n_measured; ++q)
      {
        // the rows of this branch, from the turning point that it begins with
        const int    b = measured.branch[q];
        unsigned int first =
          std::lower_bound(branch.begin(), branch.end(), b) - branch.begin();
        const unsigned int last =
          std::upper_bound(branch.begin(), branch.end(), b) - branch.begin() -
          1;
        first -= b > 0 ? 1 : 0;
        const double sign  = x[last] < x[first] ? -1. : 1.;
        const double place = measured.over[q];
        unsigned int end   = first;
        while (end < last && sign * x[end] < sign * place)
          ++end;
        // of rows that stay in a place, as while it is pressed, the last one
        const double stay = sign * place <= sign * x[first] ? x[first] : place;
        while (end < last && x[end + 1] == x[end] &&
               std::abs(x[end] - stay) <= 1e-9 * std::abs(stay))
          ++end;
        const unsigned int begin = end > first ? end - 1 : end;
        const double       width = x[end] - x[begin];
        // beyond the end the curve goes on straight
        const double share =
          width == 0. ? 1. : std::max(0., (place - x[begin]) / width);
        const bool is_beside = share == 0.;
        for (unsigned int c = 0; c < columns.size(); ++c)
          {
            const CurveColumn &column = columns[c];
            const double       y_a    = column.of(rows[begin]),
                         y_b          = column.of(rows[end]);
            const double slope =
              width == 0. || is_beside ? 0. : (y_b - y_a) / width;
            const bool is_torque  = column.is(CurveColumn::reaction, twist);
            const unsigned int at = c * n_measured + q;
            result.values[at]     = (1. - share) * y_a + share * y_b +
                                (is_torque ? rig.torque_offset : 0.);
            if (!differentiate)
              continue;
            result.derivatives.row(at) =
              (1. - share) *
                (of_column(column, begin) - slope * dx.row(begin)) +
              share * (of_column(column, end) - slope * dx.row(end));
            if (is_torque)
              result.derivatives.row(at) += rig_derivatives.row(3);
          }
      }
    if (!result.values.allFinite())
      throw RunError("the computed curve has no values where something has "
                     "been measured");
    return result;
  }



  PredictedCurves
  Experiment::predict(const Eigen::VectorXd &values,
                      const By               model,
                      const bool             with_derivatives)
  {
    if (model == By::closed_form)
      return predict_by_disk(values, with_derivatives);
    return with_derivatives ?
             predict_by_differences(values) :
             PredictedCurves{seen(curve_by_scene(values), values), {}};
  }



  Eigen::VectorXd
  Experiment::seen(const std::vector<TorqueRow> &curve,
                   const Eigen::VectorXd        &values)
  {
    return at_measured_rows(curve, {}, scene_at(values).calibration, {}).values;
  }



  // With the bodies of the run before, where they are the same.
  std::unique_ptr<Simulation>
  Experiment::simulation_of(const Scene &now)
  {
    if (bodies)
      bodies->return_to_rest();
    auto simulation = std::make_unique<Simulation>(now, bodies);
    if (keeps_bodies)
      bodies = simulation->system().bodies();
    return simulation;
  }



  void
  Experiment::choose_steps(const Eigen::VectorXd *const values)
  {
    ends_of_steps.clear();
    if (values == nullptr || scene.model != ModelKind::finite_elements ||
        !scene.load_steps.adaptive)
      return;
    // finer than for the curve alone: unknowns are told apart by less
    Scene now = scene_at(*values);
    now.load_steps.tolerance *= 0.1;
    const auto simulation = simulation_of(now);
    simulation->run();
    const auto &phases = scene.load_steps.times;
    ends_of_steps.resize(phases.size() - 1);
    for (const TorqueRow &row : simulation->rows())
      if (row.step > 0)
        ends_of_steps[std::lower_bound(phases.begin(), phases.end(), row.time) -
                      phases.begin() - 1]
          .push_back(row.time);
  }



  std::vector<TorqueRow>
  Experiment::curve_by_scene(const Eigen::VectorXd &values)
  {
    Scene now = scene_at(values);
    if (scene.model != ModelKind::finite_elements)
      return ClosedFormSolution(now).rows;
    if (!ends_of_steps.empty())
      {
        now.load_steps.adaptive = false;
        now.load_steps.ends     = ends_of_steps;
        for (std::size_t i = 0; i < ends_of_steps.size(); ++i)
          now.load_steps.steps[i] = ends_of_steps[i].size();
      }
    now.calibration       = scene.calibration; // no part of the run
    const auto simulation = simulation_of(now);
    simulation->run();
    return now.load_steps.draws_curve() ? fine_curve(simulation->rows()) :
                                          simulation->rows();
  }



  // Central ones. What changes the rig alone needs no runs.
  PredictedCurves
  Experiment::predict_by_differences(const Eigen::VectorXd &values)
  {
    std::vector<Eigen::VectorXd> places{values};
    for (Eigen::Index j = 0; j < values.size(); ++j)
      for (const Eigen::VectorXd &end : ends_of(values, j))
        if (changes[j].model)
          places.push_back(end);
    for (Experiment *helper : helpers)
      helper->ends_of_steps = ends_of_steps;
    std::vector<std::vector<TorqueRow>> curves(places.size());
    for_each_at_once(places.size(),
                     1 + helpers.size(),
                     [&](const unsigned int i, const unsigned int worker) {
                       Experiment &experiment =
                         worker == 0 ? *this : *helpers[worker - 1];
                       curves[i] = experiment.curve_by_scene(places[i]);
                     });

    PredictedCurves result{seen(curves[0], values), {}};
    result.derivatives.resize(result.values.size(), values.size());
    std::size_t next = 1;
    for (Eigen::Index j = 0; j < values.size(); ++j)
      {
        const auto            ends   = ends_of(values, j);
        const unsigned int    moves  = changes[j].model ? 1 : 0;
        const Eigen::VectorXd before = seen(curves[moves * next], ends[0]),
                              after = seen(curves[moves * (next + 1)], ends[1]);
        result.derivatives.col(j) =
          (after - before) / (ends[1][j] - ends[0][j]);
        next += 2 * moves;
      }
    return result;
  }



  // By what the bodies are more compliant than the interface alone [mm/MPa].
  Eigen::Vector2d
  Experiment::exact_compliance(const Eigen::VectorXd &values)
  {
    const Scene &now = scene_at(values);
    if (!keeps_bodies)
      linear_bodies.reset();
    const FoundationStiffness stiffness =
      foundation_stiffness(now, &linear_bodies);
    return {1. / stiffness.normal - 1. / now.interface.normal_penalty,
            1. / stiffness.torsional -
              1. / now.interface.tangential_stiffness()};
  }



  void
  Experiment::centre_closed_form(const Eigen::VectorXd &values)
  {
    // searches begin there again and again
    if (begin.unknowns.size() > 0 && begin.unknowns == values)
      {
        centre = begin;
        return;
      }
    centre                            = {values,
                                         Eigen::Vector2d::Zero(),
                                         Eigen::Matrix2Xd::Zero(2, values.size())};
    const ClosedFormParameters &given = scene.closed_form;
    if (!has_elastic_bodies ||
        (given.torsional_stiffness > 0. && given.normal_stiffness > 0.))
      return; // no compliance of bodies
    centre.compliance = exact_compliance(values);
    for (Eigen::Index j = 0; j < values.size(); ++j)
      if (changes[j].stiffness)
        {
          const Unknown  &u     = unknowns.list[j];
          Eigen::VectorXd other = values;
          const double    h =
            1e-2 * std::max(std::abs(values[j]), 1e-2 * (u.upper - u.lower));
          other[j] += values[j] + h > u.upper ? -h : h;
          centre.slopes.col(j) =
            (exact_compliance(other).array() / centre.compliance.array())
              .log() /
            (other[j] - values[j]);
        }
    if (begin.unknowns.size() == 0)
      begin = centre;
  }



  Eigen::Vector2d
  Experiment::foundation(const Scene &now, const Eigen::VectorXd &values) const
  {
    // far away the straight line must not leave what is possible
    const Eigen::Array2d exponent =
      (centre.slopes * (values - centre.unknowns)).array().max(-2.).min(2.);
    const Eigen::Array2d compliance =
      centre.compliance.array() * exponent.exp();
    Eigen::Vector2d result{
      1. / (1. / now.interface.normal_penalty + compliance[0]),
      1. / (1. / now.interface.tangential_stiffness() + compliance[1])};
    if (now.closed_form.normal_stiffness > 0.)
      result[0] = now.closed_form.normal_stiffness;
    if (now.closed_form.torsional_stiffness > 0.)
      result[1] = now.closed_form.torsional_stiffness;
    return result;
  }



  // The disk on a foundation, at the angles of the measured rows and some
  // between. How the disk changes with the unknowns is the difference between
  // two disks; what its curve does with it is exact.
  PredictedCurves
  Experiment::predict_by_disk(const Eigen::VectorXd &values,
                              const bool             with_derivatives)
  {
    if (centre.unknowns.size() == 0)
      centre_closed_form(unknowns.starts());
    const auto disk_of = [&](const Scene &now, const Eigen::VectorXd &at) {
      const Eigen::Vector2d stiffness = foundation(now, at);
      return foundation_disk(now, stiffness[0], stiffness[1]);
    };
    const Scene                &now  = scene_at(values);
    const CalibrationParameters rig  = now.calibration;
    const TorsionModel::Disk    disk = disk_of(now, values);
    const double last = Chuck(now.chuck, Eigen::Vector3d::Zero(), disk.radius)
                          .values(now.load_steps.times.back())[twist];

    std::vector<DiskVariation> variations;
    Eigen::MatrixXd            rig_derivatives;
    if (with_derivatives)
      {
        rig_derivatives.resize(4, values.size());
        for (Eigen::Index j = 0; j < values.size(); ++j)
          {
            rig_derivatives.col(j) = rig_derivative(values, j);
            std::array<TorsionModel::Disk, 2> ends{{disk, disk}};
            const auto                        places = moved(values, j, 1e-5);
            if (changes[j].model)
              for (const unsigned int end : {0u, 1u})
                ends[end] = disk_of(scene_at(places[end]), places[end]);
            const double  width = places[1][j] - places[0][j];
            DiskVariation by;
            by.pressure  = (ends[1].pressure - ends[0].pressure) / width;
            by.stiffness = (ends[1].stiffness - ends[0].stiffness) / width;
            by.phi_0     = (ends[1].phi_0 - ends[0].phi_0) / width;
            if (disk.bonded_radius < disk.radius)
              by.bonded_radius =
                (ends[1].bonded_radius - ends[0].bonded_radius) / width;
            if (changes[j].law)
              {
                by.plus  = ends[1].friction;
                by.minus = ends[0].friction;
                by.width = width;
              }
            variations.push_back(by);
          }
      }

    std::set<double> angles{0., last};
    for (unsigned int i = 1; i < 100; ++i)
      angles.insert(last * i / 100.);
    for (const double place : measured.over)
      {
        const double angle = (place - rig.angle_offset - rig.slack) * degree;
        if (angle * last > 0. && std::abs(angle) < std::abs(last))
          angles.insert(angle);
      }
    std::vector<double> in_order(angles.begin(), angles.end());
    if (last < 0.)
      std::reverse(in_order.begin(), in_order.end());
    const TorsionCurve curve = torsion_curve(disk, in_order, variations);

    const double               area = M_PI * disk.radius * disk.radius;
    std::vector<TorqueRow>     rows(in_order.size());
    std::vector<RowDerivative> derivatives(
      with_derivatives ? rows.size() : 0,
      RowDerivative::Zero(RowDerivative::RowsAtCompileTime, values.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        rows[i].chuck_reaction[push]  = -disk.pressure * area;
        rows[i].chuck_reaction[twist] = rows[i].torque_Nmm = curve.torque[i];
        rows[i].chuck_position[twist] = in_order[i] / degree;
        if (!with_derivatives)
          continue;
        for (Eigen::Index j = 0; j < values.size(); ++j)
          derivatives[i](push, j) = -variations[j].pressure * area;
        derivatives[i].row(twist) = derivatives[i].row(12) =
          curve.derivative.row(i);
      }
    return at_measured_rows(rows, derivatives, rig, rig_derivatives);
  }
} // namespace Debond
