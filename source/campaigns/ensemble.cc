#include <debond/campaigns/ensemble.h>
#include <debond/campaigns/variant.h>
#include <debond/input/csv_table.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Debond
{
  namespace
  {
    /** Differences of angles below this are rounding errors [deg]. */
    double
    tolerance_of(const ReferenceCurve &curve)
    {
      const auto [lowest, highest] =
        std::minmax_element(curve.begin(), curve.end());
      return 1e-9 * std::max(1., highest->first - lowest->first);
    }



    /** The rows with an angle of their own, the last of those that share one.
     */
    ReferenceCurve
    without_repeated_angles(const ReferenceCurve &curve)
    {
      ReferenceCurve rows;
      const double   tolerance = curve.empty() ? 0. : tolerance_of(curve);
      for (const auto &row : curve)
        if (!rows.empty() &&
            std::abs(row.first - rows.back().first) <= tolerance)
          rows.back().second = row.second;
        else
          rows.push_back(row);
      return rows;
    }
  } // namespace



  TorqueBand::TorqueBand(const std::vector<ReferenceCurve> &curves)
  {
    std::vector<ReferenceCurve> ascending;
    ReferenceCurve              longest;
    for (const ReferenceCurve &curve : curves)
      {
        ReferenceCurve one_way = without_repeated_angles(curve);
        if (one_way.size() < 2)
          continue; // nothing turns
        const bool rises = std::is_sorted(one_way.begin(), one_way.end());
        if (!rises && !std::is_sorted(one_way.rbegin(), one_way.rend()))
          {
            ++left_out;
            continue;
          }
        if (one_way.size() > longest.size())
          longest = one_way;
        if (!rises)
          std::reverse(one_way.begin(), one_way.end());
        ascending.push_back(std::move(one_way));
      }
    for (const auto &row : longest)
      {
        std::vector<double> torques;
        for (const ReferenceCurve &curve : ascending)
          torques.push_back(torque_at(curve, row.first, tolerance_of(longest)));
        rows.push_back({row.first, sample_statistics(std::move(torques))});
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



    /** Members that agree in their values. */
    struct Group
    {
      Fields                              values;
      std::vector<const EnsembleMember *> converged;
      unsigned int                        n_failed = 0;
    };



    /** In the order of their first members. */
    std::vector<Group>
    groups_of(const std::vector<EnsembleMember> &members)
    {
      std::vector<Group>            groups;
      std::map<Fields, std::size_t> number_of;
      for (const EnsembleMember &member : members)
        {
          const auto [known, is_new] =
            number_of.emplace(member.values, groups.size());
          if (is_new)
            groups.push_back({member.values, {}, 0});
          if (member.converged)
            groups[known->second].converged.push_back(&member);
          else
            ++groups[known->second].n_failed;
        }
      return groups;
    }



    TorqueBand
    band_of(const Group &group)
    {
      std::vector<ReferenceCurve> curves;
      for (const EnsembleMember *const member : group.converged)
        curves.push_back(member->curve);
      return TorqueBand(curves);
    }



    std::string
    summary_of(const Group &group)
    {
      Fields fields = group.values;
      fields.push_back(std::to_string(group.converged.size()));
      fields.push_back(std::to_string(group.n_failed));
      for (const Quantity &quantity : quantities)
        {
          std::vector<double> numbers;
          for (const EnsembleMember *const member : group.converged)
            numbers.push_back(
              number(member->summary, quantity.name + quantity.unit));
          add_statistics(sample_statistics(std::move(numbers)), fields);
        }
      return csv_line(fields);
    }
  } // namespace



  Ensemble::Ensemble(const std::vector<std::string>    &entries,
                     const std::vector<EnsembleMember> &members)
  {
    Fields of_curves = entries, of_summary = entries;
    of_curves.insert(of_curves.end(), {"angle_deg", "members"});
    add_names({"torque", "_Nmm"}, of_curves);
    of_summary.insert(of_summary.end(), {"members", "failed"});
    for (const Quantity &quantity : quantities)
      add_names(quantity, of_summary);
    curves  = csv_line(of_curves);
    summary = csv_line(of_summary);

    for (const Group &group : groups_of(members))
      {
        summary += summary_of(group);
        const TorqueBand band = band_of(group);
        for (const TorqueBand::Row &row : band.rows)
          {
            Fields fields = group.values;
            fields.push_back(to_text(row.angle_deg));
            fields.push_back(std::to_string(row.torque.n));
            add_statistics(row.torque, fields);
            curves += csv_line(fields);
          }
        if (band.left_out == 0)
          continue;
        notes += "ensemble.csv leaves out " + std::to_string(band.left_out) +
                 " of " + std::to_string(group.converged.size()) + " members";
        for (std::size_t i = 0; i < entries.size(); ++i)
          notes +=
            (i == 0 ? " of " : "; ") + entries[i] + " = " + group.values[i];
        notes += ": their rotation reverses, so that an angle has more than "
                 "one torque\n";
      }
  }
} // namespace Debond
