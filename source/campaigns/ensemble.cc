#include <debond/campaigns/ensemble.h>
#include <debond/input/csv_table.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Debond
{
  TorqueBand::TorqueBand(const std::vector<ReferenceCurve> &curves)
  {
    // differences of angles below this are rounding errors [deg]
    const auto tolerance_of = [](const ReferenceCurve &curve) {
      const auto [lowest, highest] =
        std::minmax_element(curve.begin(), curve.end());
      return curve.empty() ?
               0. :
               1e-9 * std::max(1., highest->first - lowest->first);
    };
    std::vector<ReferenceCurve> ascending;
    ReferenceCurve              longest;
    for (const ReferenceCurve &curve : curves)
      {
        // of rows that share an angle the last one
        ReferenceCurve turning;
        const double   tolerance = tolerance_of(curve);
        for (const auto &row : curve)
          if (!turning.empty() &&
              std::abs(row.first - turning.back().first) <= tolerance)
            turning.back().second = row.second;
          else
            turning.push_back(row);
        if (turning.size() < 2)
          continue; // nothing turns
        const bool rises = std::is_sorted(turning.begin(), turning.end());
        if (!rises && !std::is_sorted(turning.rbegin(), turning.rend()))
          {
            ++left_out;
            continue;
          }
        if (turning.size() > longest.size())
          longest = turning;
        if (!rises)
          std::reverse(turning.begin(), turning.end());
        ascending.push_back(std::move(turning));
      }
    const double tolerance = tolerance_of(longest);
    for (const auto &[angle, torque] : longest)
      {
        std::vector<double> torques;
        for (const ReferenceCurve &curve : ascending)
          torques.push_back(torque_at(curve, angle, tolerance));
        rows.push_back({angle, sample_statistics(std::move(torques))});
      }
  }



  namespace
  {
    /** A member of summary.json that is NAME_UNIT, so that its statistics are
     *  NAME_mean_UNIT and so on. */
    using EnsembleQuantity = std::pair<std::string, std::string>;

    const EnsembleQuantity quantities[] = {{"T_max", "_Nmm"},
                                           {"theta_max", "_deg"},
                                           {"theta_full", "_deg"},
                                           {"T_inf", "_Nmm"},
                                           {"E_deb", "_Nmm"},
                                           {"W_adh", "_Nmm"},
                                           {"w_adh", "_N_per_m"},
                                           {"D_adh", "_Nmm"},
                                           {"initial_stiffness",
                                            "_Nmm_per_rad"},
                                           {"largest_bonded_patch", "_mm2"}};

    using Fields = std::vector<std::string>;



    void
    add_names(const EnsembleQuantity &quantity, Fields &fields)
    {
      for (const char *const what : {"_mean", "_sd", "_p05", "_p50", "_p95"})
        fields.push_back(quantity.first + what + quantity.second);
    }



    void
    add_statistics(const SampleStatistics &s, Fields &fields)
    {
      for (const double value : {s.mean, s.sd, s.p05, s.p50, s.p95})
        fields.push_back(std::isfinite(value) ? to_text(value) : "nan");
    }



    using Group = std::vector<const EnsembleMember *>;

    /** Members that agree in their values, in the order of the first ones. */
    std::vector<Group>
    groups_of(const std::vector<EnsembleMember> &members)
    {
      std::vector<Group>            groups;
      std::map<Fields, std::size_t> number_of;
      for (const EnsembleMember &member : members)
        {
          const auto known =
            number_of.emplace(member.values, groups.size()).first;
          groups.resize(number_of.size());
          groups[known->second].push_back(&member);
        }
      return groups;
    }
  } // namespace



  Ensemble::Ensemble(const std::vector<std::string>    &entries,
                     const std::vector<EnsembleMember> &members)
  {
    Fields of_curves = entries, of_summary = entries;
    of_curves.insert(of_curves.end(), {"angle_deg", "members"});
    add_names({"torque", "_Nmm"}, of_curves);
    of_summary.insert(of_summary.end(), {"members", "failed"});
    for (const EnsembleQuantity &quantity : quantities)
      add_names(quantity, of_summary);
    curves  = csv_line(of_curves);
    summary = csv_line(of_summary);

    for (const Group &group : groups_of(members))
      {
        const Fields               &values = group.front()->values;
        std::vector<ReferenceCurve> of_converged;
        for (const EnsembleMember *const member : group)
          if (member->converged)
            of_converged.push_back(member->curve);
        const std::size_t n = of_converged.size();
        of_summary          = values;
        of_summary.push_back(std::to_string(n));
        of_summary.push_back(std::to_string(group.size() - n));
        for (const auto &[name, unit] : quantities)
          {
            std::vector<double> numbers;
            for (const EnsembleMember *const member : group)
              if (member->converged)
                numbers.push_back(number_in(member->summary, name + unit));
            add_statistics(sample_statistics(std::move(numbers)), of_summary);
          }
        summary += csv_line(of_summary);

        const TorqueBand band(of_converged);
        for (const TorqueBand::Row &row : band.rows)
          {
            of_curves = values;
            of_curves.push_back(to_text(row.angle_deg));
            of_curves.push_back(std::to_string(row.torque.n));
            add_statistics(row.torque, of_curves);
            curves += csv_line(of_curves);
          }
        if (band.left_out == 0)
          continue;
        notes += Text() << "ensemble.csv leaves out " << band.left_out << " of "
                        << n << " members";
        for (std::size_t i = 0; i < entries.size(); ++i)
          notes += (i == 0 ? " of " : "; ") + entries[i] + " = " + values[i];
        notes += ": their rotation reverses, so that an angle has more than "
                 "one torque\n";
      }
  }
} // namespace Debond
