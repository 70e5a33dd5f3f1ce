#include <debond/geometry/quadratic_simplex.h>
#include <debond/geometry/surface_geometry.h>

#include <boost/pending/disjoint_sets.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

// Surfaces of several patches: which elements meet, and ways across their
// sides.
namespace Debond
{
  NurbsSurface::NurbsSurface(
    const unsigned int                            degree,
    const std::vector<std::vector<unsigned int>> &control_points_of_faces,
    const ControlNet                             &control_points,
    const std::vector<double>                    &weights)
    : knot_vectors{{KnotVector::graded(degree, 1),
                    KnotVector::graded(degree, 1)}}
    , points(control_points)
    , weight(weights.empty() ? std::vector<double>(control_points.cols(), 1.) :
                               weights)
    , is_rational(std::any_of(weight.begin(), weight.end(), [](const double w) {
      return w != 1.;
    }))
  {
    for (const auto &each : control_points_of_faces)
      {
        assert(each.size() == (degree + 1) * (degree + 1));
        Face &face          = faces.emplace_back();
        face.control_points = each;
        face.corners        = {{each.front(),
                                each[degree],
                                each[degree * (degree + 1)],
                                each.back()}};
      }
    if (faces.empty() || !points.allFinite())
      throw std::invalid_argument(
        "A surface has one face at least, and finite control points.");
    patch_knots = {knot_vectors};
    faces_at.resize(n_control_points());
    find_neighbours();
  }



  // Bezier extraction: what interpolates the functions at 3 x 3 points.
  void
  NurbsSurface::use_triangles(
    const std::vector<std::array<unsigned int, 6>> &nodes,
    const std::vector<unsigned int>                &first,
    const ControlNet                               &places)
  {
    assert(degree() == 2 && !is_one_patch() && nodes.size() == faces.size());
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        faces[f].control_points.assign(nodes[f].begin(), nodes[f].end());
        faces[f].first_corner = first[f];
      }
    points = places;
    weight.assign(places.cols(), 1.);
    Eigen::Matrix3d of_line; // polynomials by values
    of_line << 1., 0., 0., -0.5, 2., -0.5, 0., 0., 1.;
    for (const unsigned int corner : {0, 1, 2, 3})
      {
        const auto                  L = barycentric_corners<2>(corner);
        Eigen::Matrix<double, 6, 9> values;
        for (unsigned int k = 0; k < 9; ++k)
          {
            const double          s = 0.5 * (k % 3), t = 0.5 * (k / 3);
            const Eigen::Vector4d bilinear((1. - s) * (1. - t),
                                           s * (1. - t),
                                           (1. - s) * t,
                                           s * t);
            values.col(k) = quadratic_functions((L * bilinear).eval());
          }
        for (auto row : values.rowwise())
          {
            const Eigen::Matrix3d at = row.reshaped(3, 3);
            row = (of_line * at * of_line.transpose()).reshaped().transpose();
          }
        extraction.push_back(values);
      }
  }



  namespace
  {
    /** Number of a place among those that are known, which may be a new one. */
    unsigned int
    number_of(const Eigen::Vector3d        &X,
              const double                  tolerance,
              std::vector<Eigen::Vector3d> &places)
    {
      const auto found  = std::find_if(places.begin(),
                                      places.end(),
                                      [&](const Eigen::Vector3d &other) {
                                        return (X - other).norm() < tolerance;
                                      });
      const auto number = std::distance(places.begin(), found);
      if (found == places.end())
        places.push_back(X);
      return number;
    }



    /** First and last corner of a side of a face. */
    constexpr unsigned int ends_of_side[4][2] = {{0, 2},
                                                 {1, 3},
                                                 {0, 1},
                                                 {2, 3}};
  } // namespace



  void
  NurbsSurface::add_patch(const NurbsSurface              &patch,
                          const std::vector<unsigned int> &own_points,
                          const std::vector<unsigned int> &own_corners)
  {
    for (unsigned int e = 0; e < patch.n_elements(); ++e)
      {
        Face &face = faces.emplace_back();
        for (const unsigned int A : patch.element_control_points(e))
          face.control_points.push_back(own_points[A]);
        for (const unsigned int k : {0, 1, 2, 3})
          face.corners[k] = own_corners[patch.corner(e, k)];
        const unsigned int n = patch.knots(0).n_spans();
        face.patch           = patch_knots.size();
        face.span            = {{e % n, e / n}};
      }
    patch_knots.push_back(patch.knot_vectors);
  }



  NurbsSurface
  NurbsSurface::joined(const std::vector<NurbsSurface> &patches)
  {
    double size = 0.;
    for (const NurbsSurface &patch : patches)
      size = std::max(size, patch.points.cwiseAbs().maxCoeff());
    const double                 tolerance = 1e-9 * size;
    std::vector<Eigen::Vector3d> places, places_of_corners;
    std::vector<double>          weights;
    NurbsSurface                 result = patches.front();
    for (const NurbsSurface &patch : patches)
      {
        std::vector<unsigned int> own_points, own_corners;
        for (unsigned int A = 0; A < patch.n_control_points(); ++A)
          {
            own_points.push_back(
              number_of(patch.points.col(A), tolerance, places));
            if (own_points.back() == weights.size())
              weights.push_back(patch.weight[A]);
            assert(std::abs(weights[own_points.back()] - patch.weight[A]) <=
                   1e-9);
          }
        for (const double v : patch.knots(1).breakpoints())
          for (const double u : patch.knots(0).breakpoints())
            own_corners.push_back(
              number_of(patch.point({u, v}), tolerance, places_of_corners));
        result.add_patch(patch, own_points, own_corners);
        result.is_rational = result.is_rational || patch.is_rational;
      }
    result.points.resize(3, weights.size());
    for (unsigned int A = 0; A < weights.size(); ++A)
      result.points.col(A) = places[A];
    result.weight = weights;
    result.faces_at.resize(places_of_corners.size());
    result.find_neighbours();
    return result;
  }



  Eigen::Vector3d
  NurbsSurface::normal_at_side(const unsigned int face,
                               const unsigned int side) const
  {
    Eigen::Vector2d local(0.5, 0.5);
    local[side / 2] = side % 2;
    SurfaceBasis    basis;
    SurfaceGeometry geometry;
    evaluate_in_element(face, lowest_of_face(face) + local, basis);
    contract(basis, points, geometry);
    return geometry.a1.cross(geometry.a2).normalized();
  }



  // Corners are those of pieces from then on, so that neither sides nor corners
  // lead from one to another.
  void
  NurbsSurface::cut_at_edges(const double angle, const NurbsSurface &shape)
  {
    boost::disjoint_sets_with_storage<> connected(faces.size());
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int s = 0; s < 4; ++s)
        if (const Face::Neighbour &next = faces[f].across[s];
            next.face >= 0 &&
            shape.normal_at_side(f, s).dot(
              shape.normal_at_side(next.face, next.side)) > std::cos(angle))
          connected.union_set(f, unsigned(next.face));
    std::map<unsigned int, unsigned int>                          pieces;
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> corners;
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        Face &face = faces[f];
        face.piece =
          pieces.emplace(connected.find_set(f), pieces.size()).first->second;
        face.across = {};
        for (unsigned int &corner : face.corners)
          corner =
            corners.emplace(std::pair(face.piece, corner), corners.size())
              .first->second;
      }
    number_of_pieces = pieces.size();
    faces_at.assign(corners.size(), {});
    find_neighbours();
  }



  unsigned int
  NurbsSurface::corner(const unsigned int element,
                       const unsigned int which) const
  {
    if (!is_one_patch())
      return faces[element].corners[which];
    const unsigned int n = knot_vectors[0].n_spans();
    return element % n + which % 2 + (element / n + which / 2) * (n + 1);
  }



  bool
  NurbsSurface::is_border(const unsigned int element,
                          const unsigned int side) const
  {
    if (!is_one_patch())
      return faces[element].across[side].face < 0;
    const unsigned int n     = knot_vectors[0].n_spans(),
                       place = side < 2 ? element % n : element / n;
    return place == (side % 2 == 0 ? 0 : knot_vectors[side / 2].n_spans() - 1);
  }



  void
  NurbsSurface::find_neighbours()
  {
    n_in_row = std::ceil(std::sqrt(double(faces.size())));
    // by both of their corners: a face and its side
    std::map<std::pair<unsigned int, unsigned int>, std::pair<int, int>> sides;
    for (int f = 0; f < int(faces.size()); ++f)
      {
        for (const unsigned int corner : faces[f].corners)
          faces_at[corner].push_back(f);
        for (int s = 0; s < 4; ++s)
          {
            const unsigned int first = faces[f].corners[ends_of_side[s][0]],
                               last  = faces[f].corners[ends_of_side[s][1]];
            const auto [found, is_new] =
              sides.emplace(std::minmax(first, last), std::pair(f, s));
            if (is_new)
              continue;
            const auto [g, side] = found->second;
            if (g == f || faces[g].across[side].face >= 0)
              throw std::invalid_argument(
                "More than two faces, or one with itself, meet at a side.");
            const bool reversed =
              faces[g].corners[ends_of_side[side][0]] != first;
            faces[f].across[s]    = {g, side, reversed};
            faces[g].across[side] = {f, s, reversed};
          }
      }
  }



  NurbsSurface::Place
  NurbsSurface::across(const unsigned int face,
                       const unsigned int side,
                       const double       along) const
  {
    const Face::Neighbour &next = faces[face].across[side];
    Eigen::Vector2d        local;
    local[next.side / 2]     = next.side % 2;
    local[1 - next.side / 2] = next.reversed ? 1. - along : along;
    return {static_cast<unsigned int>(next.face),
            lowest_of_face(next.face) + local};
  }



  std::vector<NurbsSurface::Place>
  NurbsSurface::places_beside(const unsigned int     element,
                              const Eigen::Vector2d &xi) const
  {
    const auto         box = element_bounds(element);
    std::vector<Place> result;
    if (is_one_patch())
      {
        const unsigned int n         = knot_vectors[0].n_spans();
        const unsigned int index[2]  = {element % n, element / n};
        const unsigned int stride[2] = {1, n};
        for (unsigned int c = 0; c < 2; ++c)
          if (xi[c] == box[0][c] && index[c] > 0)
            result.push_back({element - stride[c], xi});
          else if (xi[c] == box[1][c] &&
                   index[c] + 1 < knot_vectors[c].n_spans())
            result.push_back({element + stride[c], xi});
        return result;
      }
    const Eigen::Vector2d local = xi - box[0];
    for (unsigned int side = 0; side < 4; ++side)
      if (local[side / 2] == side % 2 && faces[element].across[side].face >= 0)
        result.push_back(across(element, side, local[1 - side / 2]));
    const bool is_corner =
      (local[0] == 0. || local[0] == 1.) && (local[1] == 0. || local[1] == 1.);
    if (!is_corner)
      return result;
    const unsigned int corner =
      faces[element].corners[int(local[0] + 2 * local[1])];
    for (const unsigned int f : faces_at[corner])
      for (const unsigned int k : {0, 1, 2, 3})
        if (f != element && faces[f].corners[k] == corner &&
            std::none_of(result.begin(), result.end(), [&](const Place &place) {
              return place.element == f;
            }))
          result.push_back(
            {f, lowest_of_face(f) + Eigen::Vector2d(k % 2, k / 2)});
    return result;
  }



  std::array<int, 2>
  NurbsSurface::end_of_surface(const unsigned int     element,
                               const Eigen::Vector2d &xi) const
  {
    const Eigen::Vector2d local =
      is_one_patch() ? xi : (xi - lowest_of_face(element)).eval();
    std::array<int, 2> result{{0, 0}};
    for (unsigned int d = 0; d < 2; ++d)
      {
        const auto is_end = [&](const unsigned int side) {
          return is_one_patch() || faces[element].across[2 * d + side].face < 0;
        };
        result[d] = local[d] <= 0. && is_end(0) ? -1 :
                    local[d] >= 1. && is_end(1) ? 1 :
                                                  0;
      }
    return result;
  }



  Eigen::Vector2d
  NurbsSurface::bounded_step(const Eigen::Vector2d &xi,
                             const Eigen::Vector2d &step) const
  {
    const Eigen::Vector2d target  = xi + step;
    Eigen::Vector2d       bounded = clamped(target);
    if (!is_one_patch())
      {
        const unsigned int    face   = element_of(xi);
        const Eigen::Vector2d lowest = lowest_of_face(face);
        for (unsigned int d = 0; d < 2; ++d)
          {
            const double local = target[d] - lowest[d];
            const auto  &sides = faces[face].across;
            bounded[d] =
              (local < 0. && sides[2 * d].face < 0)     ? lowest[d] :
              (local > 1. && sides[2 * d + 1].face < 0) ? lowest[d] + 1. :
                                                          target[d];
          }
      }
    return bounded == target ? step : (bounded - xi).eval();
  }



  Eigen::Vector2d
  NurbsSurface::moved(const Eigen::Vector2d &xi,
                      const Eigen::Vector2d &step) const
  {
    if (is_one_patch() || !step.allFinite())
      return clamped(xi + step);
    Place           now{element_of(xi), clamped(xi)};
    Eigen::Vector2d rest = step;
    // a step over all faces crosses some rows of them
    for (unsigned int k = 0; k < 10 + 4 * n_in_row; ++k)
      {
        const auto            box    = element_bounds(now.element);
        const Eigen::Vector2d target = now.xi + rest;
        if (target == target.cwiseMax(box[0]).cwiseMin(box[1]))
          return target;
        // the side that is met first, after a share of the rest
        unsigned int first = 0;
        double       share = std::numeric_limits<double>::infinity();
        for (unsigned int d = 0; d < 2; ++d)
          for (const unsigned int end : {0, 1})
            if ((end == 0 && target[d] < box[0][d]) ||
                (end == 1 && target[d] > box[1][d]))
              if (const double s = (box[end][d] - now.xi[d]) / rest[d];
                  s < share)
                {
                  share = s;
                  first = 2 * d + end;
                }
        const unsigned int d = first / 2;
        now.xi += share * rest;
        now.xi[d] = box[first % 2][d];
        now.xi    = now.xi.cwiseMax(box[0]).cwiseMin(box[1]);
        rest *= 1. - share;
        const Face::Neighbour &next = faces[now.element].across[first];
        if (next.face < 0)
          {
            rest[d] = 0.;
            continue;
          }
        const double along      = now.xi[1 - d] - box[0][1 - d];
        const double inwards    = std::abs(rest[d]),
                     beside     = next.reversed ? -rest[1 - d] : rest[1 - d];
        now                     = across(now.element, first, along);
        rest[next.side / 2]     = next.side % 2 == 0 ? inwards : -inwards;
        rest[1 - next.side / 2] = beside;
      }
    return now.xi;
  }
} // namespace Debond
