#ifndef debond_interface_slip_problem_h
#define debond_interface_slip_problem_h

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_point_state.h>

#include <optional>

namespace Debond
{
  /** The unit normal of the master that points to the slave, Eq. (24). */
  struct MasterNormal
  {
    /** @p geometry must outlive this object. */
    MasterNormal(const SurfaceGeometry &geometry, double outward_sign);

    /** dn for changes of the tangents. */
    Eigen::Vector3d
    change(const Eigen::Vector3d &da1, const Eigen::Vector3d &da2) const;

    /** dn/d(a_1, a_2). */
    Eigen::Matrix<double, 3, 6>
    derivative() const;

    const SurfaceGeometry &geometry;
    Eigen::Vector3d        n;
    double                 scale; ///< n = scale * a_1 x a_2
  };



  /** The friction of a point in this step: what its law says of a distance,
   *  how sliding is resisted by its speed, and where it goes. */
  struct PointFriction
  {
    const FrictionLaw &law;
    FrictionState      start;
    bool               frictionless   = false;
    bool               is_explicit    = false;
    double             viscous        = 0.; ///< eta / dt [MPa/mm]
    Eigen::Vector3d    slip_direction = Eigen::Vector3d::Zero();

    /** mu and its slope once the point has slid by @p distance. */
    FrictionCoefficient
    after(const double distance) const
    {
      if (frictionless)
        return {};
      FrictionCoefficient result =
        law.coefficient(start, is_explicit ? 0. : distance);
      if (is_explicit)
        result.dmu = 0.;
      return result;
    }
  };



  /**
   * A sliding point with its xi_hat at a trial place: traction, the residual h
   * of Eqs. (29) and (30), and the derivatives of both.
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

    template <int N>
    struct Derivative
    {
      Eigen::Matrix<double, 3, N> traction;
      Eigen::Matrix<double, 2, N> h;
    };
    /** With respect to w, see ContactPointResult. */
    Derivative<15>
    along_w() const;
    /** With respect to the two parameters of the surface. */
    Derivative<2>
    along_surface() const;

    /** |d mu/d g_s| p / (eps_t + eta / dt) where the law softens. */
    double
    softening() const
    {
      return std::max(0., -coefficient.dmu) * pressure /
             (law.tangential_penalty + friction.viscous);
    }

    /** d(mu p + eta / dt * distance)/d(distance) [MPa/mm]. */
    double
    resistance_slope() const
    {
      return coefficient.dmu * pressure +
             (pressure > 0. ? friction.viscous : 0.);
    }

    Eigen::Vector2d     h;
    double              g_n;
    NormalResponse      normal_response;
    double              pressure; ///< what friction feels: p, or 0
    FrictionCoefficient coefficient;
    Eigen::Vector3d     slip;     ///< y - y_n [mm]
    double              distance; ///< its length
    Eigen::Vector3d     traction, tangential_traction, viscous_traction;

  private:
    void
    find_direction();
    void
    find_traction();

    /** Derivatives along N changes of x - y, x - y_n, n, and of a_1 and a_2
     *  as far as they change a_alpha . excess. */
    template <int N>
    Derivative<N>
    along(const Eigen::Matrix<double, 3, N> &dgap,
          const Eigen::Matrix<double, 3, N> &dtrial,
          const Eigen::Matrix<double, 3, N> &dn,
          const Eigen::Matrix<double, 2, N> &excess_da) const;

    const ContactPointLaw &law;
    const SurfaceGeometry &geometry;
    const PointFriction   &friction;
    const MasterNormal     normal;
    const Eigen::Vector3d  gap, trial_gap; ///< x - y and x - y_n [mm]

    /** What pulls the point: its part along n, the length of the rest, and tau,
     *  the direction of the rest; zero if there is none. */
    Eigen::Vector3d pull;
    double          pull_along_n, pull_along_surface;
    Eigen::Vector3d tau;
    bool            has_direction, direction_is_given;

    Eigen::Vector3d forward; ///< direction of y - y_n
    double          sense;   ///< -1 while a trial slides against the pull
    double          limit;   ///< mu p + eta / dt times the distance [MPa]
    Eigen::Vector3d excess;  ///< g - t_t / eps_t [mm]
  };



  enum class SlipOutcome
  {
    solved,
    left_patch,
    not_found
  };

  /** The local problem of one point: Newton iteration for xi_hat. */
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
    void
    evaluate(const Eigen::Vector2d &xi, SurfaceBasis &basis);
    double
    distance_error() const;
    bool
    search_along(const Eigen::Vector2d &step,
                 double                 error,
                 Eigen::Vector2d       &xi,
                 SurfaceBasis          &basis);

    const ContactPointLaw &law;
    const PointFriction   &friction;
    const PointHistory    &history;
    const Eigen::Vector3d &x, &y_old;
    const MasterSurface   &master;

    SurfaceGeometry              geometry;
    std::optional<SlipEquations> equations;
  };
} // namespace Debond
#endif
