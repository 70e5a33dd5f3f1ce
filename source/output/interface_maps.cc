#include <debond/input/csv_table.h>
#include <debond/output/interface_maps.h>
#include <debond/output/result_files.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

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
    constexpr unsigned int          number_of_state = 8;
    constexpr std::array<Column, 5> columns{{{"pressure_MPa", 3},
                                             {"slip_mm", 5},
                                             {"phi", 6},
                                             {"mu", 7},
                                             {"state", number_of_state}}};
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
    , has_face_at(
        [face = scene.implant.geometry()](const Eigen::Vector2d &place) {
          return face.has_face_at(place);
        })
    , box(scene.implant.geometry().box_of_face())
    , pulls(scene.interface.joint()->pulls())
    , n(scene.interface.slave == Side::implant ?
          scene.interface.points_per_element(scene.bone, scene.implant).size() :
          1)
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



    Eigen::Vector2d
    place_of(const InterfacePoint &point)
    {
      return {point[0], point[1]};
    }



    /** Where a place lies between four points, from 0 to 1 along each side: at
     *  the nearest border if it is beyond them. Newton's method on the bilinear
     *  map; the first parameter is the faster one of @p corner. */
    Eigen::Vector2d
    place_between(const std::array<Eigen::Vector2d, 4> &corner,
                  const Eigen::Vector2d                &place)
    {
      const Eigen::Vector2d a = corner[1] - corner[0],
                            b = corner[2] - corner[0],
                            c = corner[3] - corner[1] - b;
      Eigen::Vector2d s(0.5, 0.5);
      for (unsigned int i = 0; i < 8; ++i)
        {
          Eigen::Matrix2d J;
          J << a + s[1] * c, b + s[0] * c;
          const Eigen::Vector2d rest =
            place - corner[0] - s[0] * a - s[1] * b - s[0] * s[1] * c;
          s = (s + J.fullPivLu().solve(rest)).cwiseMax(0.).cwiseMin(1.);
        }
      return s;
    }



    /** The values at a place that a point is nearest to: bilinear between four
     *  of the @p n x @p n points of its element, which are one behind the
     * other, the place moved to the points that are outermost. Its own values
     * where there are no others, and next to the seam of a side that is
     * unrolled, where the four are more than half of @p width apart. The state
     * is that of the nearest. */
    InterfacePoint
    interpolated(const std::vector<InterfacePoint> &points,
                 const unsigned int                 nearest,
                 const Eigen::Vector2d             &place,
                 const unsigned int                 n,
                 const double                       width)
    {
      InterfacePoint     values   = points[nearest];
      double             distance = (place_of(values) - place).norm();
      const unsigned int first    = nearest / (n * n) * (n * n),
                         column   = (nearest - first) % n,
                         row      = (nearest - first) / n;
      for (unsigned int j = std::max(row, 1U) - 1; j < std::min(row + 1, n - 1);
           ++j)
        for (unsigned int i = std::max(column, 1U) - 1;
             i < std::min(column + 1, n - 1);
             ++i)
          {
            const unsigned int                          k = first + i + j * n;
            const std::array<const InterfacePoint *, 4> at{
              {&points[k], &points[k + 1], &points[k + n], &points[k + n + 1]}};
            std::array<Eigen::Vector2d, 4> corner;
            for (unsigned int c = 0; c < 4; ++c)
              corner[c] = place_of(*at[c]);
            if (std::abs(corner[3][0] - corner[0][0]) > 0.5 * width ||
                std::abs(corner[2][0] - corner[1][0]) > 0.5 * width)
              continue;
            const Eigen::Vector2d       s = place_between(corner, place);
            const std::array<double, 4> share{{(1. - s[0]) * (1. - s[1]),
                                               s[0] * (1. - s[1]),
                                               (1. - s[0]) * s[1],
                                               s[0] * s[1]}};
            InterfacePoint              sum{};
            for (unsigned int c = 0; c < 4; ++c)
              for (unsigned int m = 0; m < sum.size(); ++m)
                sum[m] += share[c] * (*at[c])[m];
            const double rest = (place_of(sum) - place).norm();
            if (rest >= distance)
              continue;
            distance = rest;
            for (unsigned int m = 0; m < sum.size(); ++m)
              if (m != number_of_state && !std::isnan(sum[m]))
                values[m] = sum[m];
          }
      return values;
    }



    /** The values at a place; none if it is not between points of an element
     *  and none of them is within reach, nor as near as the next point is to
     *  that one: on steep faces some are far apart, seen from above. */
    std::optional<InterfacePoint>
    values_at(const Eigen::Vector2d             &place,
              const std::vector<InterfacePoint> &points,
              const dealii::RTree<Entry>        &tree,
              const double                       reach,
              const unsigned int                 n,
              const double                       width)
    {
      const auto nearest_to = [&tree](const auto &at, const unsigned int k) {
        std::vector<Entry> found;
        tree.query(boost::geometry::index::nearest(at, k),
                   std::back_inserter(found));
        return found;
      };
      const dealii::Point<2>   at(place[0], place[1]);
      const std::vector<Entry> nearest = nearest_to(at, 1);
      if (nearest.empty())
        return {};
      const auto [point, number] = nearest[0];
      const InterfacePoint values =
        interpolated(points, number, place, n, width);
      if (point.distance(at) <= reach ||
          (place_of(values) - place).norm() < 1e-6 * width)
        return values;
      double next = 0.; // among itself and the next one
      for (const Entry &one : nearest_to(point, 2))
        next = std::max(next, point.distance(one.first));
      return point.distance(at) > 1.5 * next ? std::nullopt :
                                               std::make_optional(values);
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
              const Eigen::Vector2d place(box[0][0] + (i + 0.5) * dx,
                                          box[0][1] + (j + 0.5) * dy);
              const auto            point =
                has_face_at(place) ?
                             values_at(place, one.points, tree, reach, n, size[0]) :
                             std::nullopt;
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
