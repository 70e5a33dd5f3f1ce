#ifndef debond_interface_slip_problem_h
#define debond_interface_slip_problem_h

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_point_state.h>
#include <debond/interface/point_friction.h>

#include <Eigen/Dense>

#include <optional>

namespace Debond
{
  /** The unit normal of the master that points to the slave, Eq. (24), and how
   *  it turns. Pressure, the tangent plane and the direction of slip all depend
   *  on it, so that the tangent needs its derivatives; without them Newton's
   *  method would not be quadratic on curved or tilted faces. */
  struct MasterNormal
  {
    /** @p geometry must outlive this object. */
    MasterNormal(const SurfaceGeometry &geometry, double outward_sign);

    /** dn for changes of the tangents. */
    Eigen::Vector3d
    change(const Eigen::Vector3d &da1, const Eigen::Vector3d &da2) const;

    /** dn/d(a_1, a_2) [1/mm], the same as a matrix. */
    Eigen::Matrix<double, 3, 6>
    derivative() const;

    const SurfaceGeometry &geometry;
    Eigen::Vector3d        n;
    double                 scale; ///< n = scale * a_1 x a_2
  };



  // The tangents a_1 and a_2 follow from the parametrisation, Eq. (23), and so
  // does the side to which their cross product points. The normal, Eq. (24), is
  // to point to the slave whatever that is: on the disk's side it is turned.
  inline MasterNormal::MasterNormal(const SurfaceGeometry &geometry,
                                    const double           outward_sign)
    : geometry(geometry)
  {
    const Eigen::Vector3d m = geometry.a1.cross(geometry.a2);
    scale                   = outward_sign / m.norm();
    n                       = scale * m;
  }



  // The same as a matrix, for all six components of the tangents at once. With
  // skew(a) b = a x b the change of a_1 x a_2 is -skew(a_2) da_1 + skew(a_1)
  // da_2.
  inline Eigen::Matrix<double, 3, 6>
  MasterNormal::derivative() const
  {
    Eigen::Matrix<double, 3, 6> dm;
    dm << -scale * skew(geometry.a2), scale * skew(geometry.a1);
    return dm - n * (n.transpose() * dm);
  }



  /** The parts of a vector along the tangents, without that along the normal.
   */
  inline Eigen::Vector2d
  parts_along(const SurfaceGeometry &geometry, const Eigen::Vector3d &vector)
  {
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << geometry.a1, geometry.a2;
    return (tangents.transpose() * tangents).inverse() *
           (tangents.transpose() * vector);
  }



  /**
   * A sliding point with its xi_hat at a trial place: traction, the residual h
   * of Eqs. (29) and (30), and the derivatives of both.
   *
   * An object is one evaluation: it is made at a trial place and not changed
   * after that. Value and derivative are so found from the same numbers, and
   * Newton's method for a point and that for the whole system use the same
   * chain rule.
   */
  class SlipEquations
  {
  public:
    /** All that is referred to must outlive this object. @p y_old:
     *  y(xi_hat^n) on the current surface. */
    SlipEquations(const ContactPointLaw &law,
                  const PointFriction   &friction,
                  const PointHistory    &history,
                  const Eigen::Vector3d &x,
                  const Eigen::Vector3d &y_old,
                  const SurfaceGeometry &geometry,
                  double                 outward_sign);

    /** What changes with N quantities at once: traction [MPa] and h, one column
     *  for each. */
    template <int N>
    struct Derivative
    {
      Eigen::Matrix<double, 3, N> traction;
      Eigen::Matrix<double, 2, N> h;
      Eigen::Matrix<double, 1, N> distance;
    };
    /** With respect to w, see ContactPointResult: for the whole system. */
    Derivative<ContactPointResult::n_w>
    along_w() const;
    /** With respect to the two parameters of the surface: for this point. */
    Derivative<2>
    along_surface() const;

    /** |d mu/d g_s| p / (eps_t + eta / dt) where the law softens,
     *  dimensionless: how fast the limit falls with the slip, relative to how
     *  fast the springs let go. From 1 on the bond breaks in a jump. */
    double
    softening() const
    {
      return std::max(0., -coefficient.dmu) * pressure /
             (law.tangential_penalty + friction.viscous);
    }

    /** d(mu p + eta / dt * distance)/d(distance) [MPa/mm]: how the limit of
     *  the traction changes as the point slides; negative where the bond
     *  breaks. */
    double
    resistance_slope() const
    {
      return slope;
    }

    // What the point has come to at the trial place. h has to vanish: it is the
    // part of the excess [mm] along a_alpha. Of the normal response friction
    // feels the pressure only, where a law with strength in tension may pull.
    // The coefficient is that at the updated sliding distance, Eq. (32).
    // Tractions are those that enter the slave's residual, in space [MPa],
    // t = -p n + t_t: minus those that act on the slave. The viscous part is
    // kept apart for the works.
    Eigen::Vector2d     h;
    double              g_n;
    NormalResponse      normal_response;
    double              pressure; ///< what friction feels: p, or 0
    FrictionCoefficient coefficient;
    Eigen::Vector3d     slip;     ///< y - y_n [mm]
    double              distance; ///< g_s - g_s^n [mm]
    Eigen::Vector3d     traction, tangential_traction, viscous_traction;
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

    /** A change of tangential traction and distance. */
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
    const ContactPointLaw &law;
    const SurfaceGeometry &geometry;
    const PointFriction   &friction;
    const MasterNormal     normal;
    const Eigen::Vector3d  gap, trial_gap; ///< x - y and x - y_n [mm]

    Eigen::Vector3d tau; ///< direction of the slip; zero if there is none
    // Where slip is not integrated, of what pulls the point: its part along n,
    // the length of the rest; whether there is a rest, and whether it is the
    // gap of the step before.
    double pull_along_n, pull_along_surface;
    bool   has_direction, is_previous_gap;
    // axes of the tangent plane, and the direction of the gap in it, for slip
    // that is integrated
    Eigen::Matrix<double, 3, 2> axes;
    Eigen::Vector3d             along_gap;

    // The length of the slip has a derivative along its own direction. What is
    // left of the gap beside the elastic t_t / eps_t, the excess, may have a
    // part along n only: Eq. (29).
    Eigen::Vector3d forward; ///< d(distance)/d(y - y_n)
    double          limit;   ///< mu p + eta / dt times the distance [MPa]
    double          slope;   ///< its derivative [MPa/mm]
    Eigen::Vector3d excess;  ///< g - t_t / eps_t [mm]

    /** How the tangential traction, and in the last row the distance, change
     *  with x - y, x - y_n, the gap of the step before, n, and the angle by
     *  which the way turns. */
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
    SlipProblem(const ContactPointLaw &law,
                const PointFriction   &friction,
                const PointHistory    &history,
                const Eigen::Vector3d &x,
                const Eigen::Vector3d &y_old,
                const MasterSurface   &master);

    /** From @p start; writes the basis and, if solved, xi_hat. */
    SlipOutcome
    solve(const Eigen::Vector2d &start, ContactPointResult &result);

    /** Writes the rest of the sliding point, the motion of xi_hat eliminated.
     */
    void
    report(ContactPointResult &result) const;

    /** Where the last iteration ended. */
    const SlipEquations &
    at_end() const
    {
      return *equations;
    }

  private:
    // Everything at a trial xi_hat; the distance [mm] by which the equations
    // are missed there; and the line search, which halves a step until that
    // distance is smaller.
    void
    evaluate(const Eigen::Vector2d &xi, SurfaceBasis &basis);
    void
    evaluate_in(const NurbsSurface::Place &place, SurfaceBasis &basis);
    double
    distance_error(const std::array<bool, 2> &held = {{false, false}}) const;
    double
    round_off() const;
    bool
    search_along(const Eigen::Vector2d &step,
                 double                 error,
                 Eigen::Vector2d       &xi,
                 SurfaceBasis          &basis);

    // Newton's step in an element, and how far it may go; the rest of it that
    // leads beyond a side where xi_hat lies.
    struct ElementStep
    {
      Eigen::Vector2d     step;
      std::array<bool, 2> beyond{{false, false}};
    };
    ElementStep
    step_in_element(const NurbsSurface::Place &place) const;
    SlipOutcome
    solve_with_ridges(const Eigen::Vector2d &start, ContactPointResult &result);

    const ContactPointLaw &law;
    const PointFriction   &friction;
    const PointHistory    &history;
    const Eigen::Vector3d &x, &y_old;
    const MasterSurface   &master;
    /** Parameters that a ridge of the master holds. */
    std::array<bool, 2> held{{false, false}};

    // The master at the last trial place, and the equations there. They refer
    // to the geometry, so that a new place needs new equations; they are made
    // in place, without allocation.
    SurfaceGeometry              geometry;
    std::optional<SlipEquations> equations;
  };
} // namespace Debond
#endif
