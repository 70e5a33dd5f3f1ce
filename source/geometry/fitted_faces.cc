#include <debond/geometry/nurbs_surface.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

// Disks, and faces whose elements follow the rim of one.
namespace Debond
{
  namespace
  {
    /** The four sides of a core, a circle or a rectangle around the origin,
     * from corner to corner: side k begins at corner k, and its middle control
     *  point, of weight 1/sqrt2, is middle k. */
    struct Outline
    {
      std::array<Eigen::Vector2d, 4> corner, middle;

      /** With a corner at (c_x, c_y), middle control points at the distances
       *  m_x and m_y on the axes. */
      Outline(const double c_x,
              const double c_y,
              const double m_x,
              const double m_y)
        : corner{{{c_x, -c_y}, {c_x, c_y}, {-c_x, c_y}, {-c_x, -c_y}}}
        , middle{{{m_x, 0.}, {0., m_y}, {-m_x, 0.}, {0., -m_y}}}
      {}
    };



    /** A patch with these 3 x 3 control points, first index fastest, cut at
     *  inner knots. */
    NurbsSurface
    patch_of(const std::array<Eigen::Vector2d, 9> &net,
             const std::array<double, 9>          &weights,
             const std::vector<double>            &breaks_1,
             const std::vector<double>            &breaks_2)
    {
      ControlNet points = ControlNet::Zero(3, 9);
      for (unsigned int A = 0; A < 9; ++A)
        points.col(A).head<2>() = net[A];
      const KnotVector one_span = KnotVector::graded(2, 1);
      NurbsSurface     result(one_span,
                          one_span,
                          points,
                          {weights.begin(), weights.end()});
      for (const auto &[d, breaks] :
           {std::pair(0U, breaks_1), std::pair(1U, breaks_2)})
        for (unsigned int i = 1; i + 1 < breaks.size(); ++i)
          result = result.insert_knot(d, breaks[i]);
      return result;
    }



    /** (i/n)^g, from 0 to 1; g makes the first ones short. */
    std::vector<double>
    graded_breaks(const unsigned int n, const double g)
    {
      std::vector<double> result;
      for (unsigned int i = 0; i <= n; ++i)
        result.push_back(std::pow(double(i) / n, g));
      return result;
    }



    /** Weight of the middle of a quarter circle; its control point is where the
     *  tangents of its ends meet. */
    const double s = std::sqrt(0.5);

    Outline
    circle(const double R)
    {
      return {R * s, R * s, R / s, R / s};
    }



    /** The patch within an outline. */
    NurbsSurface
    patch_within(const Outline             &outline,
                 const double               weight_of_middle,
                 const std::vector<double> &breaks)
    {
      const auto &[a, b] = std::tie(outline.corner, outline.middle);
      return patch_of(
        {{a[3], b[3], a[0], b[2], {0., 0.}, b[0], a[2], b[1], a[1]}},
        {{1, s, 1, s, weight_of_middle, s, 1, s, 1}},
        breaks,
        breaks);
    }



    /** Elements of fitted faces shrink towards the rim with this exponent, from
     *  both sides: what the pressure at the rim of stiff interfaces needs. */
    constexpr double rim_exponent = 2.5;



    /** The four patches between two outlines. */
    void
    add_ring(const Outline             &from,
             const Outline             &to,
             const std::vector<double> &across,
             const std::vector<double> &around,
             std::vector<NurbsSurface> &patches)
    {
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int             next = (k + 1) % 4;
          std::array<Eigen::Vector2d, 9> net{{from.corner[k],
                                              {0., 0.},
                                              to.corner[k],
                                              from.middle[k],
                                              {0., 0.},
                                              to.middle[k],
                                              from.corner[next],
                                              {0., 0.},
                                              to.corner[next]}};
          for (unsigned int j = 0; j < 3; ++j)
            net[3 * j + 1] = 0.5 * (net[3 * j] + net[3 * j + 2]);
          patches.push_back(
            patch_of(net, {{1, 1, 1, s, s, s, 1, 1, 1}}, across, around));
        }
    }



    /** Sides of elements around, from one corner to the next. */
    std::vector<double>
    breaks_around(const unsigned int n_around)
    {
      assert(n_around >= 4 && n_around % 4 == 0);
      return graded_breaks(n_around / 4, 1.);
    }



    /** Adds the core of a disk of radius R and the rings around it to its rim.
     */
    void
    add_disk(const double               R,
             const unsigned int         n_around,
             const unsigned int         n_rings,
             std::vector<NurbsSurface> &patches)
    {
      // corners of the core at 0.55 R, its sides bulged by 1.4: half way
      // between straight lines and arcs of a circle. Other values hardly change
      // results.
      const double        c = 0.55 * R * s, m = 1.4 * c;
      const Outline       core(c, c, m, m);
      const auto          around = breaks_around(n_around);
      std::vector<double> inside = graded_breaks(n_rings, rim_exponent);
      for (double &x : inside)
        x = 1. - x;
      std::reverse(inside.begin(), inside.end());

      patches.push_back(patch_within(core, 0.5, around));
      add_ring(core, circle(R), inside, around, patches);
    }



    /** Adds the ring between two rims, whose elements shrink towards both. */
    void
    add_wall(const double               R,
             const double               hole,
             const unsigned int         n_around,
             const unsigned int         n_rings,
             std::vector<NurbsSurface> &patches)
    {
      std::vector<double> across;
      for (unsigned int i = 0; i <= n_rings; ++i)
        {
          const double s = 2. * i / n_rings - 1.;
          across.push_back(
            0.5 +
            std::copysign(0.5 - 0.5 * std::pow(1. - std::abs(s), rim_exponent),
                          s));
        }
      add_ring(
        circle(hole), circle(R), across, breaks_around(n_around), patches);
    }
  } // namespace



  NurbsSurface
  NurbsSurface::disk(const double R, const unsigned int n)
  {
    assert(R > 0. && n > 0);
    return patch_within(circle(R), 1., graded_breaks(n, 1.));
  }



  NurbsSurface
  NurbsSurface::fitted_disk(const double       R,
                            const unsigned int n_around,
                            const unsigned int n_rings)
  {
    std::vector<NurbsSurface> patches;
    add_disk(R, n_around, n_rings, patches);
    return joined(patches);
  }



  NurbsSurface
  NurbsSurface::fitted_cap(const double       R,
                           const double       cap_radius,
                           const double       contact_radius,
                           const unsigned int n_around,
                           const unsigned int n_rings)
  {
    std::vector<NurbsSurface> patches;
    add_disk(contact_radius, n_around, n_rings, patches);
    if (contact_radius < R)
      add_ring(circle(contact_radius),
               circle(R),
               graded_breaks(n_rings, rim_exponent),
               breaks_around(n_around),
               patches);
    for (NurbsSurface &patch : patches)
      patch = patch.raised_to_sphere(cap_radius);
    return joined(patches);
  }



  NurbsSurface
  NurbsSurface::fitted_ring(const double       R,
                            const double       hole,
                            const unsigned int n_around,
                            const unsigned int n_rings)
  {
    std::vector<NurbsSurface> patches;
    add_wall(R, hole, n_around, n_rings, patches);
    return joined(patches);
  }



  NurbsSurface
  NurbsSurface::fitted_rectangle(const double       lx,
                                 const double       ly,
                                 const double       R,
                                 const double       hole,
                                 const unsigned int n_around,
                                 const unsigned int n_rings,
                                 const unsigned int n_outside)
  {
    std::vector<NurbsSurface> patches;
    add_disk(hole > 0. ? hole : R, n_around, n_rings, patches);
    if (hole > 0.)
      add_wall(R, hole, n_around, n_rings, patches);
    add_ring(circle(R),
             Outline(0.5 * lx, 0.5 * ly, 0.5 * lx, 0.5 * ly),
             graded_breaks(n_outside, rim_exponent),
             breaks_around(n_around),
             patches);
    return joined(patches);
  }
} // namespace Debond
