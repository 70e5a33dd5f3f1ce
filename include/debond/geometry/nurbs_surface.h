#pragma once

#include <debond/geometry/bernstein.h>

#include <Eigen/Core>

#include <array>
#include <cassert>
#include <vector>

namespace Debond
{
  class NurbsSurface;

  /**
   * The basis functions of one surface element, evaluated at one parametric
   * point xi = (xi^1, xi^2). Derivatives are with respect to the parameters
   * of the patch (which run over one in both directions), not of the element.
   * Only the first @p size entries of each array are valid.
   */
  struct SurfaceBasis
  {
    static constexpr unsigned int max_size = 9 + 4;

    /** (p+1)^2: 9 biquadratic, 4 bilinear, or 6 of a triangle; and 4 of a
     *  SlavePoint over a gap. */
    unsigned int size    = 0;
    unsigned int element = 0; ///< element index, first parameter fastest
    std::array<unsigned int, max_size> control_point; ///< global indices

    std::array<double, max_size> N;        ///< values
    std::array<double, max_size> N_1, N_2; ///< d/dxi^1, d/dxi^2
  };

  /** With second derivatives, which only a search along the surface asks for.
   */
  struct CurvedBasis : SurfaceBasis
  {
    std::array<double, max_size> N_11, N_12, N_22;
  };

  /**
   * Control points as the columns of a 3 x n matrix [mm]; the same layout is
   * used for displacements of control points.
   */
  using ControlNet = Eigen::Matrix<double, 3, Eigen::Dynamic>;

  /** sum_a N_a p_a. */
  Eigen::Vector3d
  interpolate(const SurfaceBasis &basis, const ControlNet &control_points);

  /** A basis that is evaluated only where it is not known already. Surfaces
   *  must outlive it, and their parameters stay what they are. */
  struct KeptBasis : SurfaceBasis
  {
    void
    move_to(const NurbsSurface &new_surface, const Eigen::Vector2d &new_xi);

  private:
    const NurbsSurface *surface = nullptr;
    Eigen::Vector2d     xi;
  };

  /** Height [mm] at the distance @p r from the axis of a sphere that touches
   *  z = 0 at the origin from above. */
  double
  height_on_sphere(double r, double sphere_radius);

  /**
   * A NURBS patch with equal degree (1 or 2) in both directions, or several
   * that meet: knots, weights and the *reference* control points. Eqs. (34) and
   * (35) of the paper: Bezier extraction of each knot span times Bernstein
   * polynomials, made rational by the weights. The basis does not depend on
   * positions, so the deformed surface is the same basis over another
   * ControlNet.
   *
   * Parameters xi = (xi^1, xi^2) of one patch run over [0,1]^2. Where there are
   * several each element has its own, which lie side by side with gaps between,
   * [2 i, 2 i + 1] x [2 j, 2 j + 1], so that they say in which element a point
   * is.
   */
  class NurbsSurface
  {
  public:
    /** Tensor product surface; weights and points with the first index fastest.
     */
    NurbsSurface(const KnotVector          &knots_1,
                 const KnotVector          &knots_2,
                 const ControlNet          &control_points,
                 const std::vector<double> &weights);

    /** Patches of one element each, such as the faces of a mesh: of each its
     *  (p+1)^2 control points, first index fastest. No weights: they are 1.
     *  Patches meet where the control points at both ends of their sides are
     *  the same. Throws std::invalid_argument if more than two meet at a side.
     */
    NurbsSurface(unsigned int                                  degree,
                 const std::vector<std::vector<unsigned int>> &faces,
                 const ControlNet                             &control_points,
                 const std::vector<double>                    &weights = {});

    /** Makes the patches of degree 2 parts of quadratic triangles, each at the
     *  vertex 0 of one, which is its corner @p first: functions are those of
     *  quadratic_functions() in place of Bernstein polynomials, @p nodes of
     *  each face their control points, at @p places. */
    void
    use_triangles(const std::vector<std::array<unsigned int, 6>> &nodes,
                  const std::vector<unsigned int>                &first,
                  const ControlNet                               &places);
    bool
    has_triangles() const
    {
      return !extraction.empty();
    }

    /** One surface of several patches. Control points at the same place are
     *  one, and elements meet where corners of both are at the same place:
     *  there weights must be the same, too. */
    static NurbsSurface
    joined(const std::vector<NurbsSurface> &patches);

    /** Separates elements whose normals on @p shape, which has the same
     *  elements, differ by more than @p angle [rad] in the middle of a side,
     *  unless there is a smooth way around: pieces share control points at
     *  edges, and nothing slides from one to another. Of several patches. */
    void
    cut_at_edges(double angle, const NurbsSurface &shape);
    /** Parts of the surface that no element is between. */
    unsigned int
    n_pieces() const
    {
      return number_of_pieces;
    }
    unsigned int
    piece(const unsigned int element) const
    {
      return is_one_patch() ? 0 : faces[element].piece;
    }

    unsigned int
    degree() const
    {
      return knot_vectors[0].degree();
    }
    bool
    is_one_patch() const
    {
      return faces.empty();
    }
    /** Number of elements (knot spans of positive length) per direction, of one
     *  patch. */
    std::array<unsigned int, 2>
    n_elements_per_direction() const
    {
      assert(is_one_patch());
      return {{knot_vectors[0].n_spans(), knot_vectors[1].n_spans()}};
    }
    unsigned int
    n_elements() const
    {
      return is_one_patch() ?
               knot_vectors[0].n_spans() * knot_vectors[1].n_spans() :
               faces.size();
    }
    /** The fewest elements across one patch; of several about as many. */
    unsigned int
    n_elements_across() const;
    unsigned int
    n_control_points() const
    {
      return points.cols();
    }

    /** Whether its elements meet at angles. */
    bool
    has_ridges() const
    {
      return degree() == 1 || !is_one_patch();
    }

    /** Corners of elements. */
    unsigned int
    n_corners() const
    {
      return is_one_patch() ? (knot_vectors[0].n_spans() + 1) *
                                (knot_vectors[1].n_spans() + 1) :
                              faces_at.size();
    }
    /** The number of a corner of an element: at the lower ends of both
     *  parameters, at the upper end of the first, of the second, of both. */
    unsigned int
    corner(unsigned int element, unsigned int which) const;
    /** Whether nothing of the surface is beyond this side of an element: xi^1 =
     *  0, 1, xi^2 = 0, 1 of its own. */
    bool
    is_border(unsigned int element, unsigned int side) const;

    /** Whether it lies in a plane z = const. */
    bool
    is_level() const
    {
      return (points.row(2).array() == points(2, 0)).all();
    }

    /** Whether it lies in a plane. */
    bool
    is_flat() const;

    /** Of one patch; of several that of each. */
    const KnotVector &
    knots(const unsigned int direction) const
    {
      assert(direction < 2);
      return knot_vectors[direction];
    }
    const ControlNet &
    control_points() const
    {
      return points;
    }
    const std::vector<double> &
    weights() const
    {
      return weight;
    }

    /** Element that contains @p xi; points on an inner knot belong to the
     *  element on the right, xi = 1 to the last one. xi is clamped to its
     *  patch. */
    unsigned int
    element_of(const Eigen::Vector2d &xi) const;
    /** Lower left and upper right parameters of an element. */
    std::array<Eigen::Vector2d, 2>
    element_bounds(unsigned int element) const;
    /** The point of its patch that is nearest to @p xi. */
    Eigen::Vector2d
    clamped(const Eigen::Vector2d &xi) const;

    /** An element and a point of it. */
    struct Place
    {
      unsigned int    element;
      Eigen::Vector2d xi;
    };
    /** The same point in the other elements that it belongs to, if it is on
     *  the border of this one: across sides, first parameter first, and, where
     *  patches meet, those that have but a corner in common. Of one patch the
     *  first only. */
    std::vector<Place>
    places_beside(unsigned int element, const Eigen::Vector2d &xi) const;
    /** -1 and 1 for a parameter at the lower and the upper end of the surface,
     *  beyond which there is nothing; else 0. */
    std::array<int, 2>
    end_of_surface(unsigned int element, const Eigen::Vector2d &xi) const;
    /** The part of a step from @p xi along the parameters that does not leave
     *  the surface where its patch is at an end of it. */
    Eigen::Vector2d
    bounded_step(const Eigen::Vector2d &xi, const Eigen::Vector2d &step) const;
    /** Where a step leads: straight on, in the parameters of the next patch, or
     *  along the border of the surface. */
    Eigen::Vector2d
    moved(const Eigen::Vector2d &xi, const Eigen::Vector2d &step) const;

    /** Basis at @p xi (clamped to its patch), in the element that contains it.
     *  No allocation. */
    template <class Basis>
    void
    evaluate(const Eigen::Vector2d &xi, Basis &basis) const
    {
      const Eigen::Vector2d inside = clamped(xi);
      evaluate_in_element(element_of(inside), inside, basis);
    }

    /** The same in a given element, whose polynomials are used even when xi
     *  lies on its border (for quadrature and for one-sided values). */
    template <class Basis>
    void
    evaluate_in_element(unsigned int           element,
                        const Eigen::Vector2d &xi,
                        Basis                 &basis) const;

    unsigned int
    n_control_points_of_element() const
    {
      return has_triangles() ? 6 : (degree() + 1) * (degree() + 1);
    }
    /** Control points of an element, in the order of SurfaceBasis. */
    std::array<unsigned int, SurfaceBasis::max_size>
    element_control_points(unsigned int element) const;

    /** Reference position of a point of the surface. */
    Eigen::Vector3d
    point(const Eigen::Vector2d &xi) const;

    /** The same surface with one more knot (Boehm); repeated calls refine. */
    NurbsSurface
    insert_knot(unsigned int direction, double knot) const;

    /** The exact disk of radius @p R around the origin in the plane z = 0 as
     * one rational biquadratic patch (theory: corners (+-R/sqrt2, +-R/sqrt2)
     *  weight 1; edge mid points (0, +-R sqrt2), (+-R sqrt2, 0) weight
     *  1/sqrt2; centre weight 1), refined to n x n elements. Oriented so that
     *  a_1 x a_2 points to +z. The four patch corners are singular. */
    static NurbsSurface
    disk(double R, unsigned int n);

    /** A disk in the plane z = 0 with a square core, and rings around it whose
     *  elements shrink towards the rim: @p n_around elements, a multiple of 4,
     *  around, @p n_rings from the core to the rim. Patches meet along the
     *  core and the diagonals; none is singular. */
    static NurbsSurface
    fitted_disk(double R, unsigned int n_around, unsigned int n_rings);
    /** A ring with a hole of radius @p hole, without a core; its elements
     *  shrink towards both rims. */
    static NurbsSurface
    fitted_ring(double       R,
                double       hole,
                unsigned int n_around,
                unsigned int n_rings);
    /** Such a disk with @p n_outside rings more, to the sides of the rectangle
     *  [-lx/2,lx/2] x [-ly/2,ly/2]; they shrink towards the rim. With a
     *  @p hole it is a disk of this radius and, around it, a ring with
     *  @p n_rings as well. */
    static NurbsSurface
    fitted_rectangle(double       lx,
                     double       ly,
                     double       R,
                     double       hole,
                     unsigned int n_around,
                     unsigned int n_rings,
                     unsigned int n_outside);

    /** This patch of the plane z = 0 with the heights of a sphere of that
     *  @p radius that touches z = 0 at the origin from above. The control
     *  points stand over those of the patch; the surface meets the sphere at
     *  the Greville abscissae and leaves it by the third order of the elements
     *  in between (rational biquadratic functions over a disk cannot be a part
     *  of a sphere). */
    NurbsSurface
    raised_to_sphere(double radius) const;

    /** The disk raised to a sphere of radius @p cap_radius > @p R. */
    static NurbsSurface
    cap(double R, double cap_radius, unsigned int n);
    /** The same over a fitted disk of the radius @p contact_radius, and around
     *  it, where that is less than @p R, @p n_rings to the rim. */
    static NurbsSurface
    fitted_cap(double       R,
               double       cap_radius,
               double       contact_radius,
               unsigned int n_around,
               unsigned int n_rings);

    /** The rectangle [-lx/2,lx/2] x [-ly/2,ly/2] in z = 0 of the given degree
     *  (2 or 1) with n1 x n2 elements, weights 1, open knot vectors and
     *  control points at the Greville abscissae, so that the map from
     *  parameters to positions is affine, whatever the grading (see
     *  KnotVector::graded()). a_1 x a_2 points to +z. */
    static NurbsSurface
    rectangle(double            lx,
              double            ly,
              const KnotVector &knots_1,
              const KnotVector &knots_2);

    /** Degree-1 surface with the same elements whose control points are the
     *  surface's points at the knots: the `bilinear` contact surface. */
    NurbsSurface
    bilinear_interpolant() const;

  private:
    /** Where parameters are [2 i, 2 i + 1] x [2 j, 2 j + 1]. */
    Eigen::Vector2d
    lowest_of_face(const unsigned int face) const
    {
      return {2. * (face % n_in_row), 2. * (face / n_in_row)};
    }
    void
    find_neighbours();

    /** An element of several patches: spans of the knots of its own. Sides are
     *  xi^1 = 0, 1, xi^2 = 0, 1, corners as in the control points. */
    struct Face
    {
      std::vector<unsigned int>   control_points;
      std::array<unsigned int, 4> corners{{0, 0, 0, 0}};
      unsigned int                patch = 0, piece = 0;
      unsigned int                first_corner = 0; ///< of part of a triangle
      std::array<unsigned int, 2> span{{0, 0}};
      struct Neighbour
      {
        int  face     = -1; ///< none
        int  side     = 0;
        bool reversed = false; ///< it runs the other way along the side
      };
      std::array<Neighbour, 4> across;
    };
    /** Of one patch to be joined with others, whose control points and corners
     *  are @p own_points and @p own_corners. */
    void
    add_patch(const NurbsSurface              &patch,
              const std::vector<unsigned int> &own_points,
              const std::vector<unsigned int> &own_corners);
    Place
    across(unsigned int face, unsigned int side, double along) const;
    Eigen::Vector3d
    normal_at_side(unsigned int face, unsigned int side) const;

    std::array<KnotVector, 2>              knot_vectors;
    ControlNet                             points;
    std::vector<double>                    weight;
    bool                                   is_rational; ///< a weight is not 1
    std::vector<Face>                      faces;       ///< empty: one patch
    std::vector<std::array<KnotVector, 2>> patch_knots; ///< of several
    unsigned int                           n_in_row = 1, number_of_pieces = 1;
    std::vector<std::vector<unsigned int>> faces_at; ///< corners
    /** Of triangles: functions x Bernstein polynomials, by first_corner. */
    std::vector<Eigen::Matrix<double, 6, 9>> extraction;
  };
} // namespace Debond
