#include <debond/geometry/cyclic_symmetry.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <iterator>

// Cyclic symmetry of a surface about the z axis. Whether it has it is asked,
// never taken for granted: of places, weights and functions, up to rounding.
namespace Debond
{
  namespace
  {
    constexpr double rounding = 1e-12; // of positions and functions, relative

    using Images = std::vector<CyclicSymmetry::Image>;



    /** About z by n / n_sectors of a whole turn. Quarters are exact. */
    Eigen::Matrix3d
    turn_by(const unsigned int n, const unsigned int n_sectors)
    {
      const double angle = 2. * M_PI * n / n_sectors;
      double       c = std::cos(angle), s = std::sin(angle);
      if (4 * n % n_sectors == 0)
        {
          c = std::round(c);
          s = std::round(s);
        }
      Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
      result.topLeftCorner<2, 2>() << c, -s, s, c;
      return result;
    }



    /** Where each of the @p places comes to by a turn; empty if one of them
     *  comes to where none is, or two to the same. */
    std::vector<unsigned int>
    turned(const Eigen::Matrix3Xd &places, const Eigen::Matrix3d &turn)
    {
      std::vector<dealii::Point<3>> known;
      for (const auto X : places.colwise())
        known.emplace_back(X[0], X[1], X[2]);
      const auto                tree   = dealii::pack_rtree_of_indices(known);
      const double              extent = places.colwise().norm().maxCoeff();
      std::vector<unsigned int> result, nearest;
      std::vector<bool>         is_taken(known.size(), false);
      for (const auto X : places.colwise())
        {
          const Eigen::Vector3d  y = turn * X;
          const dealii::Point<3> place(y[0], y[1], y[2]);
          nearest.clear();
          tree.query(boost::geometry::index::nearest(place, 1),
                     std::back_inserter(nearest));
          const unsigned int image = nearest.front();
          if (known[image].distance(place) > rounding * extent ||
              is_taken[image])
            return {};
          is_taken[image] = true;
          result.push_back(image);
        }
      return result;
    }



    /** Numbers the images of each thing, of which @p next is the next one.
     *  Empty if not all of them have as many as there are sectors, or one. */
    Images
    images_of(const std::vector<unsigned int> &next,
              const unsigned int               n_sectors)
    {
      Images result(next.size());
      for (unsigned int first = 0; first < next.size(); ++first)
        if (result[first].n == 0)
          {
            unsigned int n = 0, i = first;
            do
              {
                result[i] = {first, n++, 1};
                i         = next[i];
              }
            while (i != first);
            if (n != 1 && n != n_sectors)
              return {};
            for (unsigned int k = 0; k < n; ++k, i = next[i])
              result[i].n = n;
          }
      return result;
    }



    /** Whether the functions at a point are those at its image. */
    bool
    has_functions_of(const SurfaceBasis              &own,
                     const SurfaceBasis              &image,
                     const std::vector<unsigned int> &next)
    {
      for (unsigned int a = 0; a < own.size; ++a)
        {
          const auto *const        begin = image.control_point.data(),
                            *const end   = begin + image.size,
                            *const found =
                              std::find(begin, end, next[own.control_point[a]]);
          const double other = found == end ? 0. : image.N[found - begin];
          if (std::abs(own.N[a] - other) > rounding)
            return false;
        }
      return true;
    }
  } // namespace



  std::optional<CyclicSymmetry>
  CyclicSymmetry::of(const NurbsSurface                        &surface,
                     const std::vector<SurfaceQuadraturePoint> &points,
                     const unsigned int                         n_sectors)
  {
    CyclicSymmetry result;
    for (unsigned int n = 0; n < n_sectors; ++n)
      result.turn.push_back(turn_by(n, n_sectors));
    const auto next       = turned(surface.control_points(), result.turn[1]);
    result.control_points = images_of(next, n_sectors);
    if (result.control_points.empty())
      return {};
    const std::vector<double> &weights = surface.weights();
    for (unsigned int A = 0; A < next.size(); ++A)
      if (std::abs(weights[A] - weights[next[A]]) > rounding * weights[A])
        return {};

    Eigen::Matrix3Xd places(3, points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      places.col(q) = points[q].X;
    const auto next_point = turned(places, result.turn[1]);
    result.points         = images_of(next_point, n_sectors);
    if (result.points.empty())
      return {};
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const SurfaceQuadraturePoint &image = points[next_point[q]];
        if (std::abs(points[q].JxW - image.JxW) > rounding * image.JxW ||
            !has_functions_of(points[q].basis, image.basis, next))
          return {};
      }
    return result;
  }



  void
  CyclicSymmetry::average(ControlNet &vectors) const
  {
    ControlNet mean = ControlNet::Zero(3, vectors.cols());
    for (unsigned int A = 0; A < control_points.size(); ++A)
      {
        const Image &image = control_points[A];
        if (image.n == 1) // the mean over all turns is along the axis
          mean(2, A) = vectors(2, A);
        else
          mean.col(image.first) +=
            turn[image.turns].transpose() * vectors.col(A) / image.n;
      }
    for (unsigned int A = 0; A < control_points.size(); ++A)
      vectors.col(A) = turn[control_points[A].turns] *
                       mean.col(control_points[A].first).eval();
    if (vectors.cols() == Eigen::Index(control_points.size()))
      return;
    // a sum of vectors times gaps in a frame, which turn as well
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Eigen::Matrix3d &Q : turn)
      sum += Q * vectors.rightCols<3>() * Q.transpose() / turn.size();
    vectors.rightCols<4>() << -sum.rowwise().sum(), sum;
  }



  std::vector<bool>
  CyclicSymmetry::with_images(const std::vector<bool> &marked) const
  {
    std::vector<bool> of_first(marked.size(), false), result(marked.size());
    for (unsigned int A = 0; A < marked.size(); ++A)
      if (marked[A])
        of_first[control_points[A].first] = true;
    for (unsigned int A = 0; A < marked.size(); ++A)
      result[A] = of_first[control_points[A].first];
    return result;
  }
} // namespace Debond
