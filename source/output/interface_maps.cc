#include <debond/output/interface_maps.h>
#include <debond/scene/scene.h>
#include <debond/shapes/body_geometry.h>
#include <debond/support/number_text.h>

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace Debond
{
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



    /** Values of an InterfacePoint; the first two are its place. */
    using Values = Eigen::Matrix<double, 13, 1>;



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
    Values
    interpolated(const std::vector<InterfacePoint> &points,
                 const unsigned int                 nearest,
                 const Eigen::Vector2d             &place,
                 const unsigned int                 n,
                 const double                       width)
    {
      const auto at = [&points](const unsigned int k) {
        return Eigen::Map<const Values>(points[k].data());
      };
      Values             values   = at(nearest);
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
            const unsigned int           k = first + i + j * n;
            Eigen::Matrix<double, 13, 4> corners;
            corners << at(k), at(k + 1), at(k + n), at(k + n + 1);
            if (std::abs(corners(0, 3) - corners(0, 0)) > 0.5 * width ||
                std::abs(corners(0, 2) - corners(0, 1)) > 0.5 * width)
              continue;
            const Eigen::Vector2d s =
              place_between(corners.topRows<2>(), place);
            const Eigen::Vector4d share((1. - s[0]) * (1. - s[1]),
                                        s[0] * (1. - s[1]),
                                        (1. - s[0]) * s[1],
                                        s[0] * s[1]);
            Values                sum  = corners * share;
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
    std::optional<Values>
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
      const Values values = interpolated(points, number, place, n, width);
      if (point.distance(at) <= reach ||
          (values.head<2>() - place).norm() < 1e-6 * width)
        return values;
      double next = 0.; // among itself and the next one
      for (const Entry &one : nearest_to(point, 2))
        next = std::max(next, point.distance(one.first));
      return point.distance(at) > 1.5 * next ? std::nullopt :
                                               std::make_optional(values);
    }
  } // namespace



  // With the bone as the slave, of whose elements not all points face the
  // implant, there is one point of an element.
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
          lines +=
            of_event + "," + to_text(place[0], 6) + "," + to_text(place[1], 6);
          for (const unsigned int column : shown)
            lines += "," + (values ? to_text((*values)[column], 4) : "nan");
          lines += "\n";
        }
    return lines;
  }
} // namespace Debond
