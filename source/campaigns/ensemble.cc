#include <debond/campaigns/ensemble.h>
#include <debond/input/csv_table.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    using Angles = ReferenceCurve; // angle [deg], torque [N mm]

    /** Differences of angles below this are rounding errors [deg]. */
    double
    tolerance_of(const Angles &curve)
    {
      double lowest = curve.front().first, highest = lowest;
      for (const auto &[angle, torque] : curve)
        {
          lowest  = std::min(lowest, angle);
          highest = std::max(highest, angle);
        }
      return 1e-9 * std::max(1., highest - lowest);
    }



    /** The rows with an angle of their own, the last of those that share one.
     *  @p direction: +1 or -1, as it turns; 0 if it turns back. */
    Angles
    without_repeated_angles(const Angles &curve, int &direction)
    {
      const double tolerance = tolerance_of(curve);
      Angles       rows{curve.front()};
      direction = 0;
      for (const auto &row : curve)
        {
          const double turned = row.first - rows.back().first;
          if (std::abs(turned) <= tolerance)
            {
              rows.back().second = row.second;
              continue;
            }
          const int now = (turned > 0. ? 1 : -1);
          if (direction != 0 && now != direction)
            {
              direction = 0;
              return rows;
            }
          direction = now;
          rows.push_back(row);
        }
      return rows;
    }



    /** Torque at an angle, linear between rows in ascending order; NaN beside
     *  them. */
    double
    torque_at(const Angles &rows, const double angle, const double tolerance)
    {
      if (angle < rows.front().first - tolerance ||
          angle > rows.back().first + tolerance)
        return SampleStatistics::undefined;
      const auto above = std::lower_bound(rows.begin(),
                                          rows.end(),
                                          Angles::value_type(angle, -HUGE_VAL));
      if (above == rows.begin())
        return rows.front().second;
      if (above == rows.end())
        return rows.back().second;
      const auto &[angle_0, torque_0] = *(above - 1);
      const auto &[angle_1, torque_1] = *above;
      const double part               = (angle - angle_0) / (angle_1 - angle_0);
      return part == 1. ? torque_1 : torque_0 + part * (torque_1 - torque_0);
    }
  } // namespace



  TorqueBand::TorqueBand(const std::vector<ReferenceCurve> &curves)
  {
    std::vector<Angles> ascending;
    std::vector<double> grid;
    for (const ReferenceCurve &curve : curves)
      {
        int    direction = 0;
        Angles one_way;
        if (!curve.empty())
          one_way = without_repeated_angles(curve, direction);
        if (direction == 0)
          {
            left_out += (one_way.size() > 1);
            continue;
          }
        if (one_way.size() > grid.size())
          {
            grid.clear();
            for (const auto &[angle, torque] : one_way)
              grid.push_back(angle);
          }
        if (direction < 0)
          std::reverse(one_way.begin(), one_way.end());
        ascending.push_back(std::move(one_way));
      }
    if (grid.empty())
      return;

    const double tolerance =
      1e-9 * std::max(1., std::abs(grid.back() - grid.front()));
    for (const double angle : grid)
      {
        std::vector<double> torques;
        for (const Angles &curve : ascending)
          torques.push_back(torque_at(curve, angle, tolerance));
        rows.push_back({angle, sample_statistics(std::move(torques))});
      }
  }



  namespace
  {
    /** A member of summary.json that is NAME_UNIT, so that its statistics are
     *  NAME_mean_UNIT and so on. */
    struct Quantity
    {
      std::string name, unit;
    };

    const Quantity quantities[] = {{"T_max", "_Nmm"},
                                   {"theta_max", "_deg"},
                                   {"theta_full", "_deg"},
                                   {"T_inf", "_Nmm"},
                                   {"E_deb", "_Nm"},
                                   {"W_adh", "_Nm"},
                                   {"w_adh", "_N_per_m"},
                                   {"D_adh", "_Nm"},
                                   {"initial_stiffness", "_Nm_per_rad"},
                                   {"largest_bonded_patch", "_mm2"}};



    using Fields = std::vector<std::string>;



    void
    add_names(const Quantity &quantity, Fields &fields)
    {
      for (const char *const what : {"_mean", "_sd", "_p05", "_p50", "_p95"})
        fields.push_back(quantity.name + what + quantity.unit);
    }



    void
    add_statistics(const SampleStatistics &s, Fields &fields)
    {
      for (const double value : {s.mean, s.sd, s.p05, s.p50, s.p95})
        fields.push_back(std::isfinite(value) ? to_text(value) : "nan");
    }



    double
    number(const EnsembleMember &member, const std::string &name)
    {
      const auto found = member.summary.find(name);
      return found == member.summary.end() ? SampleStatistics::undefined :
                                             found->second;
    }
  } // namespace



  Ensemble::Ensemble(const std::vector<std::string>    &entries,
                     const std::vector<EnsembleMember> &members)
  {
    Fields names = entries;
    names.insert(names.end(), {"angle_deg", "members"});
    add_names({"torque", "_Nmm"}, names);
    curve_table = csv_line(names);
    names       = entries;
    names.insert(names.end(), {"members", "failed"});
    for (const Quantity &quantity : quantities)
      add_names(quantity, names);
    summary_table = csv_line(names);

    std::vector<std::vector<std::string>>     order;
    std::map<std::vector<std::string>, Group> groups;
    for (const EnsembleMember &member : members)
      {
        Group &group = groups[member.values];
        if (group.empty())
          order.push_back(member.values);
        group.push_back(&member);
      }
    for (const auto &values : order)
      {
        std::string place;
        for (std::size_t i = 0; i < entries.size(); ++i)
          place += (i == 0 ? " of " : "; ") + entries[i] + " = " + values[i];
        add_curves(groups[values], place);
        add_summary(groups[values]);
      }
  }



  void
  Ensemble::add_curves(const Group &group, const std::string &place)
  {
    std::vector<ReferenceCurve> curves;
    for (const EnsembleMember *const member : group)
      if (member->converged)
        curves.push_back(member->curve);
    const TorqueBand band(curves);
    for (const TorqueBand::Row &row : band.rows)
      {
        Fields fields = group.front()->values;
        fields.insert(fields.end(),
                      {to_text(row.angle_deg), std::to_string(row.torque.n)});
        add_statistics(row.torque, fields);
        curve_table += csv_line(fields);
      }
    if (band.left_out > 0)
      left_out += "ensemble.csv leaves out " + std::to_string(band.left_out) +
                  " of " + std::to_string(curves.size()) + " members" + place +
                  ": their rotation reverses, so that an angle has more than "
                  "one torque\n";
  }



  void
  Ensemble::add_summary(const Group &group)
  {
    const auto n_converged = std::count_if(group.begin(),
                                           group.end(),
                                           [](const EnsembleMember *member) {
                                             return member->converged;
                                           });
    Fields     fields      = group.front()->values;
    fields.insert(fields.end(),
                  {std::to_string(n_converged),
                   std::to_string(group.size() - n_converged)});
    for (const Quantity &quantity : quantities)
      {
        std::vector<double> values;
        for (const EnsembleMember *const member : group)
          if (member->converged)
            values.push_back(number(*member, quantity.name + quantity.unit));
        add_statistics(sample_statistics(values), fields);
      }
    summary_table += csv_line(fields);
  }
} // namespace Debond
