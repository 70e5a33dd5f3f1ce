#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/output/interface_tables.h>
#include <debond/output/result_files.h>
#include <debond/scene/scene.h>
#include <debond/shapes/body_geometry.h>
#include <debond/support/number_text.h>

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

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



    using Entry = std::pair<dealii::Point<2>, unsigned int>;

    dealii::RTree<Entry>
    tree_of(const std::vector<InterfacePoint> &points)
    {
      std::vector<Entry> entries;
      for (unsigned int i = 0; i < points.size(); ++i)
        entries.emplace_back(dealii::Point<2>(points[i][0], points[i][1]), i);
      return dealii::pack_rtree(entries);
    }



    /** Where a place lies between four points, the columns of @p corner, from 0
     *  to 1 along each side: at the nearest border if it is beyond them.
     *  Newton's method on the bilinear map; the first parameter is the faster
     *  one. */
    Eigen::Vector2d
    place_between(const Eigen::Matrix<double, 2, 4> &corner,
                  const Eigen::Vector2d             &place)
    {
      const Eigen::Vector2d a = corner.col(1) - corner.col(0),
                            b = corner.col(2) - corner.col(0),
                            c = corner.col(3) - corner.col(1) - b;
      Eigen::Vector2d s(0.5, 0.5);
      for (unsigned int i = 0; i < 8; ++i)
        {
          Eigen::Matrix2d J;
          J << a + s[1] * c, b + s[0] * c;
          const Eigen::Vector2d rest =
            place - corner.col(0) - s[0] * a - s[1] * b - s[0] * s[1] * c;
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
      double             distance = (values.head<2>() - place).norm();
      const unsigned int first    = nearest / (n * n) * (n * n),
                         column   = (nearest - first) % n,
                         row      = (nearest - first) / n;
      for (unsigned int j = std::max(row, 1U) - 1; j < std::min(row + 1, n - 1);
           ++j)
        for (unsigned int i = std::max(column, 1U) - 1;
             i < std::min(column + 1, n - 1);
             ++i)
          {
            const unsigned int k = first + i + j * n;
            Eigen::Matrix<double, InterfacePoint::SizeAtCompileTime, 4> corners;
            corners << points[k], points[k + 1], points[k + n],
              points[k + n + 1];
            if (std::abs(corners(0, 3) - corners(0, 0)) > 0.5 * width ||
                std::abs(corners(0, 2) - corners(0, 1)) > 0.5 * width)
              continue;
            const Eigen::Vector2d s =
              place_between(corners.topRows<2>(), place);
            const Eigen::Vector4d share((1. - s[0]) * (1. - s[1]),
                                        s[0] * (1. - s[1]),
                                        (1. - s[0]) * s[1],
                                        s[0] * s[1]);
            InterfacePoint        sum  = corners * share;
            const double          rest = (sum.head<2>() - place).norm();
            if (rest >= distance)
              continue;
            distance             = rest;
            sum[column_of_state] = values[column_of_state];
            values               = sum.array().isNaN().select(values, sum);
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
          (values.head<2>() - place).norm() < 1e-6 * width)
        return values;
      double next = 0.; // among itself and the next one
      for (const Entry &one : nearest_to(point, 2))
        next = std::max(next, point.distance(one.first));
      return point.distance(at) > 1.5 * next ? std::nullopt :
                                               std::make_optional(values);
    }



    /** Lines of maps.csv: @p of_event, a place of a regular grid on the contact
     *  face, and the columns of @p shown; nan where there is none. With the
     *  bone as the slave, of whose elements not all points face the implant,
     *  there is one point of an element. */
    std::string
    lines_of_map(const Scene                       &scene,
                 const std::vector<InterfacePoint> &points,
                 const std::string                 &of_event,
                 const std::vector<unsigned int>   &shown)
    {
      constexpr unsigned int     n_across = 48;
      const BodyParameters      &implant  = scene.implant;
      const auto                 box      = implant.geometry().box_of_face();
      const Eigen::Vector2d      size = box[1] - box[0], d = size / n_across;
      const dealii::RTree<Entry> tree = tree_of(points);
      const unsigned int         n =
        scene.interface.slave == Side::implant ?
                  scene.interface.points_per_element(scene.bone, implant).size() :
                  1;
      const double reach =
        implant.mesh ?
          std::max(d.maxCoeff(), std::sqrt(size.prod() / points.size())) :
          std::numeric_limits<double>::infinity();
      std::string lines;
      for (unsigned int j = 0; j < n_across; ++j)
        for (unsigned int i = 0; i < n_across; ++i)
          {
            const Eigen::Vector2d place(box[0][0] + (i + 0.5) * d[0],
                                        box[0][1] + (j + 0.5) * d[1]);
            const auto            values =
              implant.geometry().has_face_at(place) ?
                           values_at(place, points, tree, reach, n, size[0]) :
                           std::nullopt;
            lines += of_event + "," + to_text(place[0], 6) + "," +
                     to_text(place[1], 6);
            for (const unsigned int column : shown)
              lines += "," + (values ? to_text((*values)[column], 4) : "nan");
            lines += "\n";
          }
      return lines;
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
             "Expert / Output / Profile angles: " +
               to_text(angles_to_come.front(), 6) + " deg was never reached";
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
    if (scene.interface.bone_layer.crushes())
      shown.push_back(13);
    if (scene.interface.bone_layer.shears())
      shown.push_back(14);
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
