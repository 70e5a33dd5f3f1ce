#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/output/interface_maps.h>
#include <debond/output/interface_tables.h>
#include <debond/output/result_files.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** phi and mu from g_s = 0 to 1.5 times the distance after which no bond is
     *  left. */
    std::string
    friction_law_table(const InterfaceParameters &interface)
    {
      constexpr unsigned int n        = 600;
      const FrictionLaw     &friction = *interface.friction;
      const PointStart       start{interface.bonding.initial_bonding};
      const double           end     = 1.5 * friction.kinks.back();
      const double           initial = friction.coefficient(start, 0.).mu;
      std::string            table   = "slip_mm,phi,mu,mu_over_initial\n";
      for (unsigned int i = 0; i <= n; ++i)
        {
          const double slip        = end * i / n;
          const auto   coefficient = friction.coefficient(start, slip);
          table += csv_line({slip,
                             coefficient.phi,
                             coefficient.mu,
                             initial > 0. ? coefficient.mu / initial : 0.});
        }
      return table;
    }



    /** In the order of their names in maps.csv. */
    constexpr std::array<const char *, 7> events{{"sliding has begun",
                                                  "half of the contact slides",
                                                  "all of the contact slides",
                                                  "half of the bond is broken",
                                                  "the bond is broken",
                                                  "largest load (within 0.1 %)",
                                                  "end"}};
    constexpr unsigned int                largest_load = 5, end = 6;



    /** What torque and forces along the face, or away from it, come to [N];
     *  @p radius R [mm] makes a force of a torque. */
    double
    load_of(const TorqueRow &row, const double radius)
    {
      const auto &F = row.chuck_reaction;
      return std::abs(row.torque_Nmm) / radius + std::hypot(F[0], F[1]) +
             std::max(0., -row.force_N);
    }
  } // namespace



  InterfaceTables::InterfaceTables(const Scene           &scene,
                                   const ResultDirectory &directory,
                                   Points                 points)
    : scene(scene)
    , directory(directory)
    , points(std::move(points))
    , has_maps(scene.output.report && scene.model == ModelKind::finite_elements)
    , reference(read_profiles(scene.output.reference_profiles))
    , angles_to_come(scene.output.profile_angles)
  {
    std::sort(angles_to_come.begin(), angles_to_come.end());
    if (scene.output.friction_law_curve)
      write_file(directory.file("friction_law.csv"),
                 friction_law_table(scene.interface));
  }



  void
  InterfaceTables::look(const TorqueRow &row)
  {
    const auto first_to_come =
      std::find_if(angles_to_come.begin(),
                   angles_to_come.end(),
                   [&](const double angle) {
                     return std::abs(row.angle_deg) < angle * (1. - 1e-9);
                   });
    if (first_to_come != angles_to_come.begin())
      {
        angles_to_come.erase(angles_to_come.begin(), first_to_come);
        for (const InterfacePoint &point : points(row))
          {
            std::vector<double> columns{row.angle_deg};
            columns.insert(columns.end(), point.begin(), point.end());
            profiles += csv_line(columns);
          }
      }
    if (!has_maps)
      return;
    if (std::isnan(first_phi))
      first_phi = row.phi_mean;
    // a load that grows by less looks the same, and snapshots take time
    constexpr double growth = 1.001, noise = 1e-6; // N
    const double     R  = scene.implant.characteristic_radius(),
                 closed = row.share_stick + row.share_slip,
                 before = snapshots.count(largest_load) > 0 ?
                            load_of(snapshots.at(largest_load).first, R) :
                            0.;
    const auto slides   = [&](const double share) {
      return row.share_slip >= share * closed && closed > 0.;
    };
    const auto is_left = [&](const double share) {
      return row.phi_mean <= share * first_phi && first_phi > 0.;
    };
    const std::array<bool, 6> happens{
      {slides(0.01),
       slides(0.5),
       slides(0.999),
       is_left(0.5),
       is_left(0.01),
       load_of(row, R) > std::max(noise, growth * before)}};
    for (unsigned int event = 0; event < happens.size(); ++event)
      if (happens[event] &&
          (event == largest_load || snapshots.count(event) == 0))
        snapshots[event] = {row, points(row)};
  }



  std::string
  InterfaceTables::write_profiles() const
  {
    if (scene.output.profile_angles.empty())
      return "";
    write_file(directory.file("profiles.csv"),
               "angle_deg," + std::string(interface_columns) + "\n" + profiles);
    return angles_to_come.empty() ?
             "" :
             "Output / Profile angles: " + to_text(angles_to_come.front(), 6) +
               " deg was never reached";
  }



  nlohmann::ordered_json
  InterfaceTables::measures() const
  {
    return compare_profiles(profiles.empty() || reference.empty() ?
                              Profiles() :
                              read_profiles(directory.file("profiles.csv")),
                            reference);
  }



  // Several events of one step share a map.
  void
  InterfaceTables::write_maps(const TorqueRow &last_row) const
  {
    if (!has_maps)
      return;
    auto all = snapshots;
    all[end] = {last_row, points(last_row)};
    std::map<unsigned int, std::pair<std::string, const Snapshot *>> by_step;
    for (const auto &[event, snapshot] : all)
      {
        auto &[names, shown] = by_step[snapshot.first.step];
        names += (names.empty() ? "" : " and ") + std::string(events[event]);
        shown = &snapshot;
      }
    std::vector<unsigned int> shown{3, 5, 6, 7, column_of_state};
    if (scene.interface.joint()->pulls())
      shown.insert(shown.end(), {10, 11, 12});
    const auto  names = split_list(interface_columns);
    std::string table = "event,step,time,angle_deg,x_mm,y_mm";
    for (const unsigned int column : shown)
      table += "," + names[column];
    table += "\n";
    for (const auto &[step, map] : by_step)
      table += lines_of_map(scene,
                            map.second->second,
                            map.first + "," + std::to_string(step) + "," +
                              to_text(map.second->first.time, 6) + "," +
                              to_text(map.second->first.angle_deg, 6),
                            shown);
    write_file(directory.file("maps.csv"), table);
  }
} // namespace Debond
