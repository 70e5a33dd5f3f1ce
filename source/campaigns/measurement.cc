#include <debond/campaigns/measurement.h>
#include <debond/input/measured_table.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

// What an instrument has written, as a calibration fits it.
namespace Debond
{
  namespace
  {
    const std::string file_entry = "Output / Reference curve";



    MeasuredColumn
    measured_column(const CurveColumn &column)
    {
      if (column.kind == CurveColumn::time)
        return {column.name, Quantity::time};
      return {column.name,
              ChuckParameters::quantity(column.component,
                                        column.kind == CurveColumn::reaction)};
    }
  } // namespace



  CurveColumn::CurveColumn(const std::string &given, const std::string &entry)
    : name(given)
  {
    constexpr unsigned int twist = ChuckComponent::rotation_z;
    if (name == "time")
      return;
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      for (const Kind one : {reaction, position})
        {
          const bool is_torque = one == reaction && k == twist,
                     is_angle  = one == position && k == twist;
          if (name == ChuckParameters::column_name(k, one == reaction) ||
              (is_torque && name == "torque_Nmm") ||
              (is_angle && name == "angle_deg"))
            {
              kind           = one;
              component      = k;
              about_own_axis = name == "torque_Nmm";
            }
        }
    if (kind == time)
      throw EntryError(entry,
                       "there is no such curve: expected time, angle_deg, "
                       "torque_Nmm or a column of torque.csv that begins with "
                       "chuck_");
  }



  double
  CurveColumn::of(const TorqueRow &row) const
  {
    return kind == time     ? row.time :
           about_own_axis   ? row.torque_Nmm :
           kind == reaction ? row.chuck_reaction[component] :
                              row.chuck_position[component];
  }



  std::string
  CurveColumn::unit() const
  {
    switch (measured_column(*this).quantity)
      {
        case Quantity::angle:
          return "deg";
        case Quantity::moment:
          return "N mm";
        case Quantity::force:
          return "N";
        case Quantity::length:
          return "mm";
        default:
          return "";
      }
  }



  std::vector<int>
  branches_of(const Eigen::VectorXd &over, const double least)
  {
    std::vector<int> branch(over.size(), 0);
    if (over.size() == 0)
      return branch;
    const double tolerance = least * (over.maxCoeff() - over.minCoeff());
    int          direction = 0, n = 0;
    Eigen::Index extreme = 0;
    for (Eigen::Index i = 0; i < over.size(); ++i)
      {
        const double moved = over[i] - over[extreme];
        if (direction == 0 && std::abs(moved) > tolerance)
          direction = moved > 0. ? 1 : -1;
        if (direction * moved >= 0.)
          extreme = direction == 0 ? extreme : i;
        else if (std::abs(moved) > tolerance)
          {
            ++n;
            for (Eigen::Index k = extreme + 1; k < i; ++k)
              branch[k] = n;
            direction = -direction;
            extreme   = i;
          }
        branch[i] = n;
      }
    return branch;
  }



  bool
  has_known_noise(const CalibrationParameters &parameters)
  {
    return !parameters.noise_columns.empty() || parameters.noise[0] > 0.;
  }



  double
  Measurement::sd_of(const CalibrationParameters &parameters,
                     const unsigned int           c,
                     const double                 scale)
  {
    const auto  &noise = parameters.noise;
    const double known = noise[std::min<std::size_t>(c, noise.size() - 1)];
    return known > 0. ? known * scale : scale;
  }



  namespace
  {
    /** The place along @p over at each of @p times, as far as the scene
     *  prescribes it; else none. */
    std::vector<double>
    places_of(const Scene               &scene,
              const CurveColumn         &over,
              const std::vector<double> &times)
    {
      if (over.kind == CurveColumn::time)
        return times;
      if (over.kind == CurveColumn::reaction ||
          scene.chuck.component[over.component].loaded)
        return {};
      const Chuck         chuck(scene.chuck,
                        Eigen::Vector3d::Zero(),
                        scene.implant.characteristic_radius());
      const double        unit = is_rotation(over.component) ? 180. / M_PI : 1.;
      std::vector<double> places;
      for (const double time : times)
        places.push_back(chuck.values(time)[over.component] * unit);
      return places;
    }



    /** Measured places are not smooth: what goes back by less than a twentieth
     *  of the range is no turn, unless the scene turns by less. */
    double
    least_turn_of(const Scene &scene, const CurveColumn &over)
    {
      constexpr double usual = 0.05, part = 0.4;
      const auto       places =
        places_of(scene, over, scene.load_steps.sample_times());
      if (places.empty())
        return usual;
      const Eigen::VectorXd all =
        Eigen::Map<const Eigen::VectorXd>(places.data(), places.size());
      const double range  = all.maxCoeff() - all.minCoeff();
      const auto   branch = branches_of(all, 1e-9);
      double       least  = usual;
      Eigen::Index begin  = 0;
      for (Eigen::Index i = 1; i < all.size() && branch.back() > 0; ++i)
        if (i + 1 == all.size() || branch[i + 1] != branch[i])
          {
            least =
              std::min(least, part * std::abs(all[i] - all[begin]) / range);
            begin = i;
          }
      return least;
    }



    // Rows of a measured curve beyond what the scene is led to mean nothing.
    // While the offset of the rig is an unknown some may come to lie beyond,
    // for which the curve goes on straight. Before the implant begins to turn
    // the curve is known: there is no load.
    std::pair<double, double>
    reach_of(const Scene       &scene,
             const CurveColumn &over,
             const double       largest_shift)
    {
      constexpr double rounding = 1e-9, infinite = HUGE_VAL;
      const auto       places =
        places_of(scene, over, scene.load_steps.sample_times());
      if (places.empty())
        return {-infinite, infinite};
      const auto [least, most] =
        std::minmax_element(places.begin(), places.end());
      const double margin = rounding * (*most - *least);
      const double turned =
        over.is(CurveColumn::position, ChuckComponent::rotation_z) ?
          largest_shift :
          0.;
      return {*least - margin - std::abs(turned), *most + margin + turned};
    }



    /** Rows in windows only. What the scene does not come to is left out, too,
     *  if that can be told from what it prescribes. */
    std::vector<std::size_t>
    used_rows(const Scene                    &scene,
              const std::vector<CurveColumn> &columns,
              const CurveColumn              &over,
              const Eigen::MatrixXd          &table,
              const std::vector<int>         &branch,
              const double                    largest_shift)
    {
      constexpr auto        twist  = ChuckComponent::rotation_z;
      const Eigen::VectorXd places = table.col(0);
      // where the implant is while the machine shows that place
      Eigen::VectorXd implant = places;
      if (over.is(CurveColumn::position, twist))
        for (std::size_t c = 0; c < columns.size(); ++c)
          if (columns[c].is(CurveColumn::reaction, twist))
            implant -= scene.calibration.machine_compliance * table.col(c + 1);

      const auto &windows      = scene.calibration.windows;
      const auto [least, most] = reach_of(scene, over, largest_shift);
      std::vector<std::size_t> used;
      for (Eigen::Index i = 0; i < places.size(); ++i)
        {
          bool inside = windows.empty();
          for (std::size_t w = 0; w < windows.size(); w += 2)
            inside = inside ||
                     (places[i] >= windows[w] && places[i] <= windows[w + 1]);
          // of rows at the same place, as while it is pressed, the last one
          const bool stays =
            i + 1 < places.size() && places[i + 1] == places[i];
          // the one at a turn may belong to either side of it
          const bool turns =
            i + 1 < places.size() && i > 0 && branch[i + 1] != branch[i];
          if (inside && !stays && !turns && implant[i] >= least &&
              implant[i] <= most)
            used.push_back(i);
        }
      if (used.empty())
        throw EntryError(file_entry,
                         scene.output.reference_curve + ": none of its " +
                           std::to_string(places.size()) + " rows, " +
                           over.name + " from " +
                           to_text(places.minCoeff(), 4) + " to " +
                           to_text(places.maxCoeff(), 4) +
                           ", is in Calibration / Windows and what the scene "
                           "comes to, " +
                           to_text(least, 4) + " to " + to_text(most, 4));
      return used;
    }



    /** Standard deviations that the file has itself, of the rows that are used:
     *  no columns if there are none. */
    Eigen::MatrixXd
    read_noise(const Scene                       &scene,
               const std::vector<MeasuredColumn> &of_curves,
               const std::vector<std::size_t>    &used)
    {
      const auto       &choice = scene.calibration.noise_columns;
      const std::string entry  = "Calibration / Noise columns";
      if (choice.empty())
        return {};
      if (choice.size() != of_curves.size())
        throw EntryError(entry, "expected one for each of Curves");
      const auto table = read_measured_table(
        scene.output.reference_curve, file_entry, of_curves, choice, entry);
      Eigen::MatrixXd sd(used.size(), of_curves.size());
      for (std::size_t i = 0; i < used.size(); ++i)
        for (std::size_t c = 0; c < of_curves.size(); ++c)
          {
            sd(i, c) = table[used[i]][c];
            if (!(sd(i, c) > 0.))
              throw EntryError(entry,
                               scene.output.reference_curve +
                                 ": the standard deviation of " +
                                 of_curves[c].name + " in row " +
                                 std::to_string(used[i] + 1) + " is " +
                                 to_text(sd(i, c), 4) +
                                 ": expected a number above 0");
          }
      return sd;
    }
  } // namespace



  Measurement::Measurement(const Scene                    &scene,
                           const std::vector<CurveColumn> &columns,
                           const CurveColumn              &along,
                           const double                    largest_shift)
    : file(scene.output.reference_curve)
    , values(0, columns.size())
    , scale(Eigen::VectorXd::Zero(columns.size()))
  {
    const CalibrationParameters &parameters = scene.calibration;
    if (parameters.windows.size() % 2 != 0)
      throw EntryError("Calibration / Windows",
                       "expected pairs of bounds, an even number of them");
    if (parameters.noise.size() != 1 &&
        parameters.noise.size() != columns.size())
      throw EntryError("Calibration / Noise",
                       "expected one number, or one for each of Curves");
    const auto &noise = parameters.noise;
    if (std::count(noise.begin(), noise.end(), 0.) % noise.size() != 0)
      throw EntryError("Calibration / Noise",
                       "either that of all curves is known, or that of none: "
                       "0");
    least_turn = least_turn_of(scene, along);
    if (file.empty())
      {
        propose_rows(scene, along);
        return;
      }
    std::vector<MeasuredColumn> of_curves;
    for (const CurveColumn &column : columns)
      of_curves.push_back(measured_column(column));
    std::vector<MeasuredColumn> wanted = of_curves;
    wanted.insert(wanted.begin(), measured_column(along));
    const auto table = read_measured_table(file,
                                           file_entry,
                                           wanted,
                                           scene.output.reference_columns,
                                           "Output / Reference columns");

    Eigen::MatrixXd all(table.size(), wanted.size());
    for (std::size_t i = 0; i < table.size(); ++i)
      all.row(i) =
        Eigen::Map<const Eigen::RowVectorXd>(table[i].data(), wanted.size());
    const auto in_branch = branches_of(all.col(0), least_turn);
    const auto used =
      used_rows(scene, columns, along, all, in_branch, largest_shift);
    n_left_out = table.size() - used.size();
    over.resize(used.size());
    values.resize(used.size(), columns.size());
    for (std::size_t i = 0; i < used.size(); ++i)
      {
        over[i]       = all(used[i], 0);
        values.row(i) = all.row(used[i]).tail(columns.size());
        branch.push_back(in_branch[used[i]]);
      }
    // of the whole file, so that a window changes no weight
    sd                       = read_noise(scene, of_curves, used);
    const bool has_own_noise = sd.size() > 0;
    sd.resize(used.size(), columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
      {
        scale[c] = all.col(c + 1).cwiseAbs().maxCoeff();
        if (scale[c] == 0.)
          throw EntryError(file_entry,
                           file + ": all of " + columns[c].name + " is zero");
        if (!has_own_noise)
          sd.col(c).setConstant(sd_of(parameters, c, scale[c]));
      }
  }



  void
  Measurement::propose_rows(const Scene &scene, const CurveColumn &along)
  {
    constexpr unsigned int n     = 400;
    const auto            &steps = scene.load_steps;
    std::vector<double>    times;
    for (unsigned int i = 0; i <= n; ++i)
      times.push_back(steps.times.front() +
                      (steps.times.back() - steps.times.front()) * i / n);
    const auto          places = places_of(scene, along, times);
    std::vector<double> kept;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (i + 1 == places.size() || places[i + 1] != places[i])
        kept.push_back(places[i]);
    if (kept.empty())
      throw EntryError("Calibration / Over",
                       "what a test that has not been done is drawn over must "
                       "be prescribed by its scene");
    over   = Eigen::Map<const Eigen::VectorXd>(kept.data(), kept.size());
    branch = branches_of(over, least_turn);
  }
} // namespace Debond
