#pragma once

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/point_step.h>

#include <Eigen/Dense>

#include <optional>

namespace Debond
{
  /** The unit normal of the master that points to the slave, Eq.\ (24), and how
   *  it turns. Pressure, the tangent plane and the direction of slip all depend
   *  on it, so that the tangent needs its derivatives; without them Newton's
   *  method would not be quadratic on curved or tilted faces. */
  struct MasterNormal
  {
    /** @p geometry must outlive this object. */
    MasterNormal(const SurfaceGeometry &geometry, double outward_sign);

    /** dn/d(a_1, a_2) [1/mm]. */
    Eigen::Matrix<double, 3, 6>
    derivative() const;

    /** The parts of a vector along the tangents, without that along the normal.
     */
    Eigen::Vector2d
    parts(const Eigen::Vector3d &vector) const
    {
      return duals.transpose() * vector;
    }

    const SurfaceGeometry &geometry;
    Eigen::Vector3d        n;
    /** a^1 and a^2 in the tangent plane, a^alpha . a_beta = delta [1/mm]. */
    Eigen::Matrix<double, 3, 2> duals;
  };



  // The tangents a_1 and a_2 follow from the parametrisation, Eq. (23), and so
  // does the side to which their cross product points. The normal, Eq. (24), is
  // to point to the slave whatever that is: on the disk's side it is turned.
  inline MasterNormal::MasterNormal(const SurfaceGeometry &geometry,
                                    const double           outward_sign)
    : geometry(geometry)
  {
    const Eigen::Vector3d m     = geometry.a1.cross(geometry.a2);
    const double          scale = outward_sign / m.norm();
    n                           = scale * m;
    duals << scale * geometry.a2.cross(n), scale * n.cross(geometry.a1);
  }



  // As n stays a unit vector and normal to the tangents, n . da_alpha =
  // -a_alpha . dn says all of dn: dn = -a^alpha (n . da_alpha).
  inline Eigen::Matrix<double, 3, 6>
  MasterNormal::derivative() const
  {
    Eigen::Matrix<double, 3, 6> dn;
    dn << -duals.col(0) * n.transpose(), -duals.col(1) * n.transpose();
    return dn;
  }



  /**
   * A sliding point with its xi_hat at a trial place: traction, the residual h
   * of Eqs.\ (29) and (30), and the derivatives of both.
   *
   * An object is one evaluation: it is made at a trial place and not changed
   * after that. Value and derivative are so found from the same numbers, and
   * Newton's method for a point and that for the whole system use the same
   * chain rule.
   */
  class SlipEquations
  {
  public:
    /** Where the master has this @p geometry. Both must outlive the object. */
    SlipEquations(const PointStep &point, const SurfaceGeometry &geometry);

    /** What changes with N quantities at once, one column for each: traction
     *  [MPa] and, in the last row, distance; and h. */
    template <int N>
    struct Derivative
    {
      Eigen::Matrix<double, 4, N> traction_and_distance;
      Eigen::Matrix<double, 2, N> h;
    };
    /** With respect to w: for the whole system. */
    Derivative<W::size>
    along_w() const;
    /** With respect to the two parameters of the surface: for this point. */
    Derivative<2>
    along_surface() const;
    /** What of dh/dxi_hat vanishes with h: the excess along the surface. */
    Eigen::Matrix2d
    tangential_bend() const
    {
      return bend(excess - normal.n.dot(excess) * normal.n);
    }
    /** Traction, distance and h by the damage of the share that is held. */
    Derivative<1>
    along_damage() const;
    /** The same of g_n. */
    Eigen::Matrix<double, 1, W::size>
    gap_along_w() const;
    Eigen::Matrix<double, 1, 2>
    gap_along_surface() const;
    /** And of the normal. */
    Eigen::Matrix<double, 3, 2>
    normal_along_surface() const;

    // What the point has come to at the trial place. h has to vanish: it is
    // the part of g - t_t / eps_t [mm] along a_alpha, and of the excess. The
    // response is that at the updated sliding distance, Eq. (32). Tractions are
    // those that enter the slave's residual, in space [MPa], t = -p n + t_t:
    // minus those that act on the slave.
    Eigen::Vector2d    h;
    double             g_n; ///< [mm]
    InterfaceResponse  response;
    const MasterNormal normal;
    Eigen::Vector3d    slip;     ///< y - y_n [mm]
    double             distance; ///< g_s - g_s^n [mm]
    double             slope;    ///< d(L + eta / dt * distance) by it [MPa/mm]
    double             resistance; ///< eta / dt, if it resists [MPa/mm]
    Eigen::Vector3d    traction, tangential_traction;
    /** What the step comes to where slip is integrated over it. */
    std::optional<TowedGap> towed;

  private:
    // The two halves of the evaluation, in this order: the traction needs tau,
    // and tau no traction.
    void
    integrate_slip();
    void
    find_traction();

    /** @name What slip that is not integrated over the step has instead
     *  See compared_methods.cc. */
    //@{
    void
    find_direction();
    void
    find_distance();
    void
    find_changes_of_direction(const Eigen::Vector4d &by_distance);
    //@}

    /** What traction and distance change with. */
    void
    find_changes();

    Eigen::Matrix2d
    bend(const Eigen::Vector3d &v) const;

    /** A change of traction and distance. */
    static Eigen::Vector4d
    with(const Eigen::Vector3d &vector, const double number)
    {
      return {vector[0], vector[1], vector[2], number};
    }

    /** Tangential traction and distance by what TowedGap says of tau and the
     *  distance. */
    Eigen::Matrix<double, 4, 3>
    by_towed() const;

    // Of the two gaps below the first is what the springs of the interface are
    // stretched by, Eq. (26), the second what they would be stretched by
    // without slip in this step. Their difference is the slip.
    const PointStep       &point;
    const double           eps_t; ///< [MPa/mm]
    const SurfaceGeometry &geometry;
    const Eigen::Vector3d  gap, trial_gap; ///< x - y and x - y_n [mm]

    Eigen::Vector3d tau; ///< direction of the slip; zero if there is none
    // Where slip is not integrated, of what pulls the point: its part along n,
    // the length of the rest; whether there is a rest, and whether it is the
    // gap of the step before.
    double pull_along_n, pull_along_surface;
    bool   has_direction, is_previous_gap;
    // axes of the tangent plane, the direction of the gap in it, and how the
    // limit without sliding changes with the gap, for slip that is integrated
    Eigen::Matrix<double, 3, 2> axes;
    Eigen::Vector3d             along_gap;
    double                      held_by_gap;        ///< [MPa/mm]
    double                      held_by_damage = 0; ///< [MPa]

    // The length of the slip has a derivative along its own direction. The
    // excess may have a part along n only, as g - t_t / eps_t in Eq. (29).
    Eigen::Vector3d forward; ///< d(distance)/d(y - y_n)
    double          limit;   ///< L + eta / dt times the distance [MPa]
    Eigen::Vector3d excess;  ///< g - t / eps_t [mm]
    Eigen::Matrix<double, 3, 2> tangents; ///< a_1, a_2

    /** How the traction, and in the last row the distance, change with x - y,
     *  x - y_n, the gap of the step before, n, and the angle by which the way
     *  turns. */
    struct
    {
      Eigen::Matrix<double, 4, 3> gap, trial, old_gap, normal;
      Eigen::Vector4d             turn;
    } change;
  };



  // How the local iteration ends: xi_hat found; at the edge of the master,
  // where the point opens; or without a solution, after which the caller tries
  // another start or gives the step up.
  enum class SlipOutcome
  {
    solved,
    left_patch,
    not_found
  };

  /**
   * The local problem of one point: Newton iteration for xi_hat.
   *
   * Two unknowns for each sliding point, solved for inside of the residual:
   * the alternative, xi_hat of all points as unknowns of the coupled system,
   * would make a system of twice as many unknowns as quadrature points, whose
   * equations change with every change between stick and slip.
   */
  class SlipProblem
  {
  public:
    /** Of a @p point that must outlive the object. */
    explicit SlipProblem(const PointStep &point)
      : point(point)
      , surface(*point.master.surface)
    {}

    /** Finds xi_hat, from @p start. */
    SlipOutcome
    solve(const Eigen::Vector2d &start);

    /** Writes the sliding point, the motion of xi_hat eliminated. */
    void
    report(ContactPointResult &result);

    /** Where the last iteration ended. */
    const SlipEquations &
    at_end() const
    {
      return *equations;
    }

  private:
    /** What changes there with xi_hat; once for each place. */
    const SlipEquations::Derivative<2> &
    along_surface()
    {
      if (!by_xi)
        by_xi = equations->along_surface();
      return *by_xi;
    }

    Eigen::Matrix2d
    inverse_along_surface();

    // Everything at a trial xi_hat; the distance [mm] by which the equations
    // are missed there; and the line search, which halves a step until that
    // distance is smaller.
    void
    evaluate(const Eigen::Vector2d &xi);
    void
    evaluate_in(const NurbsSurface::Place &place);
    double
    distance_error(const std::array<bool, 2> &held = {{false, false}}) const;
    double
    rounding_of_places() const;
    double
    round_off() const;
    bool
    search_along(const Eigen::Vector2d &step,
                 double                 error,
                 Eigen::Vector2d       &xi);

    // Newton's step in an element, and how far it may go; the rest of it that
    // leads beyond a side where xi_hat lies.
    struct ElementStep
    {
      Eigen::Vector2d     step;
      std::array<bool, 2> beyond{{false, false}};
    };
    ElementStep
    step_in_element(const NurbsSurface::Place &place);
    SlipOutcome
    solve_with_ridges(const Eigen::Vector2d &start);
    // On a side where two elements meet at an angle: the tangent of the other
    // one, and the local problem with the normal's turn as an unknown. False
    // at a corner, and if that has not been found.
    Eigen::Vector3d
    tangent_beside(const NurbsSurface::Place &place, bool is_last);
    bool
    turn_on_ridge(NurbsSurface::Place place);

    const PointStep    &point;
    const NurbsSurface &surface; ///< of the master
    /** Newton's step that is left where the search has ended, and where it
     *  leads. */
    Eigen::Vector2d last_step, xi_hat;
    /** Parameters that a ridge of the master holds. */
    std::array<bool, 2> held{{false, false}};
    /** On a ridge, the parameter across it and the width of its fillet. */
    unsigned int across = 0;
    double       fillet = 1.;

    // The master at the last trial place, and the equations there. They refer
    // to the geometry, so that a new place needs new equations; they are made
    // in place, without allocation.
    CurvedBasis                                 basis;
    SurfaceGeometry                             geometry;
    std::optional<SlipEquations>                equations;
    std::optional<SlipEquations::Derivative<2>> by_xi;
  };
} // namespace Debond
