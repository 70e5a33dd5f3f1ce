#include <debond/interface/contact_interface.h>
#include <debond/output/profile_output.h>
#include <debond/shapes/body_geometry.h>
#include <debond/shapes/body_parameters.h>

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace Debond
{
  std::vector<InterfacePoint>
  profile_points(const ContactInterface &interface)
  {
    const BodyParameters       &implant = interface.implant();
    std::vector<InterfacePoint> points;
    for (const SlavePoint &point : interface.get_points())
      if (point.faces_implant)
        {
          const auto    &X           = point.X;
          const auto     place       = implant.geometry().on_face(X);
          const auto    &trial       = point.trial;
          const auto     traction    = interface.traction(point);
          const auto     coefficient = interface.friction(point);
          const auto     left = interface.get_law().left_by_each(trial.state);
          InterfacePoint values;
          values << place, std::hypot(X[0], X[1]), traction.pressure,
            traction.tangential.norm(), trial.state.slip, coefficient.phi,
            coefficient.mu, double(interface.status(point)), point.JxW, left[0],
            left[1], traction.mode_deg(), trial.state.crushed,
            trial.state.sheared;
          points.push_back(values);
        }
    return points;
  }



  namespace
  {
    using Position = dealii::Point<2>;

    /** Pressure [MPa] and sliding distance [mm] between scattered points. */
    class LocalFields
    {
    public:
      explicit LocalFields(const std::vector<ProfilePoint> &points)
        : points(points)
        , is_radial(std::all_of(points.begin(),
                                points.end(),
                                [](const ProfilePoint &p) { return p.y == 0; }))
      {
        std::vector<Entry> entries;
        for (unsigned int i = 0; i < points.size(); ++i)
          entries.emplace_back(position(points[i]), i);
        tree = dealii::pack_rtree(entries);
      }

      /** {pressure, slip} at a position. */
      Eigen::Array2d
      at(const ProfilePoint &point) const
      {
        namespace bgi                    = boost::geometry::index;
        constexpr unsigned int n_nearest = 20;
        const Position         centre    = position(point);
        std::vector<Entry>     nearest;
        tree.query(bgi::nearest(centre, n_nearest),
                   std::back_inserter(nearest));
        double radius = 0;
        for (const Entry &entry : nearest)
          radius = std::max(radius, centre.distance(entry.first));

        const unsigned int n = nearest.size();
        Eigen::MatrixXd    A(n, 6);
        Eigen::MatrixXd    b(n, 2);
        for (unsigned int i = 0; i < n; ++i)
          {
            const ProfilePoint &neighbour = points[nearest[i].second];
            const double        x = (nearest[i].first[0] - centre[0]) / radius;
            const double        y = (nearest[i].first[1] - centre[1]) / radius;
            // smooth, and small but not zero at the farthest point
            const double weight =
              std::pow(1. - 0.95 * std::min(1., x * x + y * y), 2);
            A.row(i) << 1., x, y, x * x, x * y, y * y;
            A.row(i) *= weight;
            b.row(i) << weight * neighbour.pressure, weight * neighbour.slip;
          }
        // of least norm: along a radius there is no y
        const Eigen::MatrixXd c = A.completeOrthogonalDecomposition().solve(b);
        return c.row(0).transpose();
      }

    private:
      using Entry = std::pair<Position, unsigned int>;

      Position
      position(const ProfilePoint &point) const
      {
        return is_radial ? Position(std::hypot(point.x, point.y), 0.) :
                           Position(point.x, point.y);
      }

      const std::vector<ProfilePoint> &points;
      const bool                       is_radial;
      dealii::RTree<Entry>             tree;
    };



    /** Mean square of the differences over the square of the reference's mean,
     *  of {pressure, slip}, at one angle. */
    Eigen::Array2d
    relative_mean_square(const std::vector<ProfilePoint> &points,
                         const LocalFields               &reference)
    {
      double         area = 0;
      Eigen::Array2d sum(0, 0), sum_of_squares(0, 0);
      for (const ProfilePoint &point : points)
        {
          const Eigen::Array2d expected = reference.at(point);
          const Eigen::Array2d actual(point.pressure, point.slip);
          area += point.area;
          sum += point.area * expected;
          sum_of_squares += point.area * (actual - expected).square();
        }
      return sum_of_squares / area / (sum / area).square();
    }
  } // namespace



  nlohmann::ordered_json
  compare_profiles(const Profiles &profiles, const Profiles &reference)
  {
    unsigned int   n_angles = 0;
    Eigen::Array2d sum(0, 0);
    for (const auto &[angle_deg, expected] : reference)
      for (const auto &[own_angle_deg, points] : profiles)
        // angles go from degrees to radians and back
        if (std::abs(own_angle_deg - angle_deg) <=
            1e-9 * std::max(1., std::abs(angle_deg)))
          {
            sum += relative_mean_square(points, LocalFields(expected));
            ++n_angles;
          }
    // no angle in both: 0 / 0, which is undefined
    const Eigen::Array2d rms = (sum / double(n_angles)).sqrt();
    return {{"pressure_difference_rms", rms[0]},
            {"slip_difference_rms", rms[1]},
            {"reference_angles_used", n_angles}};
  }
} // namespace Debond
