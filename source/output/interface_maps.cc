#include <debond/input/csv_table.h>
#include <debond/output/interface_maps.h>
#include <debond/output/result_files.h>
#include <debond/scene/scene.h>
#include <debond/shapes/body_geometry.h>
#include <debond/support/number_text.h>

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace Debond
{
  namespace
  {
    constexpr unsigned int n_across = 48; ///< places of the grid

    struct Column
    {
      const char  *name;
      unsigned int number; ///< in an InterfacePoint
    };
    constexpr std::array<Column, 5> columns{{{"pressure_MPa", 3},
                                             {"slip_mm", 5},
                                             {"phi", 6},
                                             {"mu", 7},
                                             {"state", 8}}};
    /** Of laws with strength in tension. */
    constexpr std::array<Column, 3> columns_of_opening{
      {{"left_by_opening", 10}, {"left_by_slip", 11}, {"mode_deg", 12}}};



    /** What torque and forces along the face, or away from it, come to [N]. */
    double
    load_of(const TorqueRow &row, const double radius)
    {
      const auto &F = row.chuck_reaction;
      return std::abs(row.torque_Nmm) / radius + std::hypot(F[0], F[1]) +
             std::max(0., -row.force_N);
    }
  } // namespace



  InterfaceMaps::InterfaceMaps(const Scene &scene)
    : wanted(scene.output.report && scene.model == ModelKind::finite_elements)
    , radius(scene.implant.characteristic_radius())
    , is_mesh(scene.implant.mesh != nullptr)
    , has_face_at([implant = scene.implant](const Eigen::Vector2d &place) {
      return implant.geometry().has_face_at(implant, place);
    })
    , box(scene.implant.geometry().box_of_face(scene.implant))
    , pulls(scene.interface.joint()->pulls())
  {}



  InterfaceMaps::Snapshot
  InterfaceMaps::snapshot(const std::string &event,
                          const TorqueRow   &row,
                          const Points      &points)
  {
    return {event, row.step, row.angle_deg, row.time, points()};
  }



  void
  InterfaceMaps::look(const TorqueRow &row, const Points &points)
  {
    if (!wanted)
      return;
    if (n_rows++ == 0)
      first_phi = row.phi_mean;
    const double closed = row.share_stick + row.share_slip;
    const auto   is_new = [&](const std::string &event, const bool is_so) {
      if (is_so && has_been.insert(event).second)
        snapshots.push_back(snapshot(event, row, points));
    };
    is_new("sliding has begun", row.share_slip >= 0.01 * closed && closed > 0.);
    is_new("half of the contact slides",
           row.share_slip >= 0.5 * closed && closed > 0.);
    is_new("all of the contact slides",
           row.share_slip >= 0.999 * closed && closed > 0.);
    is_new("half of the bond is broken",
           row.phi_mean <= 0.5 * first_phi && first_phi > 0.);
    is_new("the bond is broken",
           row.phi_mean <= 0.01 * first_phi && first_phi > 0.);
    // a load that grows by less looks the same, and snapshots take time
    constexpr double growth = 1.001, noise = 1e-6; // N
    const double     load = load_of(row, radius);
    if (load > std::max(noise, growth * largest_load))
      {
        largest_load = load;
        largest      = snapshot("largest load (within 0.1 %)", row, points);
      }
  }



  namespace
  {
    using Entry = std::pair<dealii::Point<2>, unsigned int>;

    dealii::RTree<Entry>
    tree_of(const std::vector<InterfacePoint> &points)
    {
      std::vector<Entry> entries;
      for (unsigned int i = 0; i < points.size(); ++i)
        entries.emplace_back(dealii::Point<2>(points[i][0], points[i][1]), i);
      return dealii::pack_rtree(entries);
    }



    /** The point closest to a place; null if there is none within reach, nor as
     *  near as the next point is to that one: on steep faces some are far
     * apart, seen from above. */
    const InterfacePoint *
    closest(const std::vector<InterfacePoint> &points,
            const dealii::RTree<Entry>        &tree,
            const dealii::Point<2>            &place,
            const double                       reach)
    {
      std::vector<Entry> nearest;
      tree.query(boost::geometry::index::nearest(place, 1),
                 std::back_inserter(nearest));
      if (nearest.empty())
        return nullptr;
      const auto [point, number] = nearest[0];
      if (point.distance(place) > reach)
        {
          std::vector<Entry> around; // itself, and the next one
          tree.query(boost::geometry::index::nearest(point, 2),
                     std::back_inserter(around));
          if (point.distance(place) >
              1.5 * std::max(point.distance(around.front().first),
                             point.distance(around.back().first)))
            return nullptr;
        }
      return &points[number];
    }
  } // namespace



  // Several events of one step are one snapshot.
  std::vector<InterfaceMaps::Snapshot>
  InterfaceMaps::in_order(const TorqueRow &last_row, const Points &points) const
  {
    std::vector<Snapshot> all = snapshots;
    if (largest_load > 0.)
      all.push_back(largest);
    all.push_back(snapshot("end", last_row, points));
    std::stable_sort(all.begin(), all.end(), [](const auto &a, const auto &b) {
      return a.step < b.step;
    });
    for (unsigned int i = 1; i < all.size();)
      if (all[i].step == all[i - 1].step)
        {
          all[i - 1].events += " and " + all[i].events;
          all.erase(all.begin() + i);
        }
      else
        ++i;
    return all;
  }



  void
  InterfaceMaps::write(const ResultDirectory &directory,
                       const TorqueRow       &last_row,
                       const Points          &points)
  {
    if (!wanted || n_rows == 0)
      return;
    const std::vector<Snapshot> all = in_order(last_row, points);
    std::vector<Column>         shown(columns.begin(), columns.end());
    if (pulls)
      shown.insert(shown.end(),
                   columns_of_opening.begin(),
                   columns_of_opening.end());
    std::string table = "event,step,time,angle_deg,x_mm,y_mm";
    for (const Column &column : shown)
      table += "," + std::string(column.name);
    table += "\n";
    const Eigen::Vector2d size = box[1] - box[0];
    const double          dx = size[0] / n_across, dy = size[1] / n_across;
    for (const Snapshot &one : all)
      {
        const auto        tree = tree_of(one.points);
        const std::string of_event =
          one.events + "," + std::to_string(one.step) + "," +
          to_text(one.time, 6) + "," + to_text(one.angle_deg, 6) + ",";
        const double reach =
          is_mesh ?
            std::max({dx, dy, std::sqrt(size.prod() / one.points.size())}) :
            std::numeric_limits<double>::infinity();
        for (unsigned int j = 0; j < n_across; ++j)
          for (unsigned int i = 0; i < n_across; ++i)
            {
              const dealii::Point<2> place(box[0][0] + (i + 0.5) * dx,
                                           box[0][1] + (j + 0.5) * dy);
              const auto *const      point =
                has_face_at({place[0], place[1]}) ?
                       closest(one.points, tree, place, reach) :
                       nullptr;
              table +=
                of_event + to_text(place[0], 6) + "," + to_text(place[1], 6);
              for (const Column &column : shown)
                table +=
                  "," + (point ? to_text((*point)[column.number], 4) : "nan");
              table += "\n";
            }
      }
    write_file(directory.file("maps.csv"), table);
  }
} // namespace Debond
