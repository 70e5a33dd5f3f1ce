#include <debond/interface/slip_problem.h>

#include <cmath>

namespace Debond
{
  using Eigen::Vector2d;
  using Eigen::Vector3d;
  using Eigen::Vector4d;

  // The equations of a sliding point.
  //
  // While a point sticks its interacting point xi_hat is known, and so is all
  // that follows from it. While it slides xi_hat moves along the master, and
  // two equations, one for each parameter of the surface, say where to: the
  // tangential gap is as long as the elastic interface is stretched by what
  // friction can carry, and it points where the slip goes,
  //
  //     a_alpha . (g - t_t / eps_t) = 0,  alpha = 1, 2,     Eqs. (29), (30)
  //     t_t = (L + eta V) tau,  L = mu(g_s) p for friction under pressure.
  //
  // All of it is asked at one trial place, in the order in which one thing
  // needs the other. First comes the gap g = x - y, Eq. (26), and its part
  // along the normal there, Eq. (27), which gives the pressure; then the
  // direction of slip; then the traction that friction allows.
  inline SlipEquations::SlipEquations(const PointStep       &point,
                                      const SurfaceGeometry &geometry)
    : normal(geometry, point.master.outward_sign)
    , slip(geometry.y - point.y_old)
    , point(point)
    , eps_t(point.law.tangential_penalty)
    , geometry(geometry)
    , gap(point.x - geometry.y)
    , trial_gap(point.x - point.y_old)
  {
    g_n = normal.n.dot(gap);
    if (point.law.slip_direction == SlipDirection::integrated)
      integrate_slip();
    else
      find_direction();
    find_traction();
    find_changes();
  }



  // The direction of the slip, tau, and the distance that the point slides:
  // TowedGap in the tangent plane at xi_hat. What the point moves by, seen from
  // the master, is the trial gap less the gap of the step before. The string
  // ends as long as the gap is; that this is as long as friction holds it is
  // what the equations ask for.
  inline void
  SlipEquations::integrate_slip()
  {
    axes.col(0)                    = geometry.a1.normalized();
    axes.col(1)                    = normal.n.cross(axes.col(0));
    const Vector3d          g_t    = gap - g_n * normal.n;
    const double            length = g_t.norm();
    const InterfaceResponse held = point.joint().respond(point.start, g_n, 0.);
    held_by_gap                  = held.limit_by_gap;
    held_by_damage               = held.limit_by_damage;
    towed.emplace(TowedGap::Step{point.arc,
                                 axes.transpose() * point.old_gap,
                                 axes.transpose() * (trial_gap - point.old_gap),
                                 point.old_limit,
                                 held.limit / eps_t,
                                 length});
    tau       = axes * towed->direction;
    distance  = towed->distance;
    along_gap = Vector3d::Zero();
    if (length > 0.) // of a gap that is nothing but rounding a part is normal
      along_gap = (g_t - normal.n.dot(g_t) * normal.n) / length;
  }



  // The law is asked at the updated sliding distance, Eq. (32), at the end of
  // the step. At g_s^n it would lag behind: 50 steps of the main scene by 4 %
  // of the largest torque. The traction is the limit t_t = (L + eta V) tau,
  // Eq. (30), V being the distance over the duration of the step. What the gap
  // is more than the elastic t_t / eps_t must have no part in the surface,
  // Eq. (29); derivatives take all of t for t_t, as -p n has none.
  inline void
  SlipEquations::find_traction()
  {
    if (!towed)
      find_distance();
    response = point.joint().respond(point.start, g_n, distance);
    // It resists as fast as the faces slide, and pulls where a trial moves
    // backwards. Where the bone shears the faces slide by a part of the
    // distance, and both together hold what the bone bears, whatever the rest
    // of the distance is.
    resistance = response.resists ? point.start.viscous : 0.;
    limit      = response.limit + resistance * response.rubbed;
    slope      = response.limit_by_slip + (response.shears ? 0. : resistance);

    tangential_traction = limit * tau;
    traction            = -response.pressure * normal.n + tangential_traction;
    excess              = gap - traction / eps_t;
    tangents << geometry.a1, geometry.a2;
    h = tangents.transpose() * (gap - tangential_traction / eps_t);
  }



  // Their derivatives.
  //
  // Newton's method for xi_hat needs dh/dxi_hat; the Newton's method of the
  // whole system needs dt/dw and dh/dw, w being what the control points of both
  // bodies move. Both are the same chain rule. It starts with the changes of
  // four vectors: of the gap x - y, of the trial gap x - y_n, of the gap of the
  // step before, and of the normal n, which stays a unit vector.
  inline void
  SlipEquations::find_changes()
  {
    const Vector3d &n = normal.n;
    // with the sliding distance limit and pressure change, and it changes
    // itself
    const Vector4d by_distance =
      with(slope * tau - response.pressure_by_slip * n, 1.);
    // both change with g_n, and g_n with gap and normal
    Vector4d by_normal_gap =
      with(response.limit_by_gap * tau - response.pressure_by_gap * n, 0.);
    if (towed)
      {
        // In axes that tilt with the normal, but do not turn about it, the
        // parts of a vector v in the plane change by t . dv - (n . v) t . dn.
        const Eigen::Matrix<double, 4, 7> by = by_towed() * towed->derivative;
        const Eigen::Matrix<double, 4, 3> held =
                                            by.leftCols<2>() * axes.transpose(),
                                          moved = by.middleCols<2>(2) *
                                                  axes.transpose();
        const Vector3d &g = point.old_gap;
        by_normal_gap += held_by_gap / eps_t * by.col(4);
        change.old_gap = held - moved;
        change.trial   = moved;
        change.gap     = by.col(5) * along_gap.transpose();
        change.turn    = by.col(6);
        change.normal =
          -n.dot(g) * held - n.dot(trial_gap - g) * moved - g_n * change.gap;
      }
    else
      find_changes_of_direction(by_distance);
    change.gap.noalias() += by_normal_gap * n.transpose();
    change.normal.noalias() += by_normal_gap * gap.transpose();
    change.normal.noalias() -= with(limit * n, 0.) * tau.transpose();
    change.normal.topRows<3>().diagonal().array() -= response.pressure;
  }



  inline Eigen::Matrix<double, 4, 3>
  SlipEquations::by_towed() const
  {
    Eigen::Matrix<double, 4, 3> result;
    result << limit * axes, slope * tau - response.pressure_by_slip * normal.n,
      0., 0., 1.;
    return result;
  }



  // With respect to w, at fixed xi_hat. The tangents turn the normal, and what
  // of the excess lies along them changes.
  inline SlipEquations::Derivative<W::size>
  SlipEquations::along_w() const
  {
    Derivative<W::size> result;
    auto               &d = result.traction_and_distance;
    d << change.gap, change.normal * normal.derivative(), change.trial,
      change.old_gap, change.turn;
    result.h = -1. / eps_t * tangents.transpose() * d.topRows<3>();
    result.h.middleCols<3>(W::gap) += tangents.transpose();
    result.h.block<1, 3>(0, W::a1) += excess.transpose();
    result.h.block<1, 3>(1, W::a2) += excess.transpose();
    return result;
  }



  // Parts of a vector along the second derivatives a_alpha,beta.
  inline Eigen::Matrix2d
  SlipEquations::bend(const Vector3d &v) const
  {
    const double    mixed = v.dot(geometry.a12);
    Eigen::Matrix2d result;
    result << v.dot(geometry.a11), mixed, mixed, v.dot(geometry.a22);
    return result;
  }



  inline Eigen::Matrix<double, 3, 2>
  SlipEquations::normal_along_surface() const
  {
    return -normal.duals * bend(normal.n);
  }



  // With respect to xi_hat: y moves along the tangents, and the tangents change
  // with the second derivatives of the surface, a_alpha,beta. x and y_n stay.
  inline SlipEquations::Derivative<2>
  SlipEquations::along_surface() const
  {
    Derivative<2> result;
    auto         &d = result.traction_and_distance;
    d        = change.normal * normal_along_surface() - change.gap * tangents;
    result.h = bend(excess) -
               tangents.transpose() * (tangents + 1. / eps_t * d.topRows<3>());
    return result;
  }



  // L changes with it at the end, and so does the string that the point has
  // been towed by.
  inline SlipEquations::Derivative<1>
  SlipEquations::along_damage() const
  {
    Derivative<1> result;
    auto         &d = result.traction_and_distance;
    d               = with(response.limit_by_damage * tau, 0.);
    if (towed)
      d += held_by_damage / eps_t * (by_towed() * towed->derivative.col(4));
    result.h = -1. / eps_t * tangents.transpose() * d.topRows<3>();
    return result;
  }



  // y moves along the tangents, to which n is normal, so that g_n changes with
  // the gap and as the normal turns.
  inline Eigen::Matrix<double, 1, W::size>
  SlipEquations::gap_along_w() const
  {
    Eigen::Matrix<double, 1, W::size> result =
      Eigen::Matrix<double, 1, W::size>::Zero();
    result.segment<3>(W::gap) = normal.n.transpose();
    result.segment<6>(W::a1)  = gap.transpose() * normal.derivative();
    return result;
  }



  inline Eigen::Matrix<double, 1, 2>
  SlipEquations::gap_along_surface() const
  {
    return gap.transpose() * normal_along_surface();
  }



  // Finding the interacting point.
  //
  // Newton's method for the two parameters, with a line search on |h|. As long
  // as a step does not slide over kinks of the law or of the surface it takes
  // one or two iterations. The parameters stay in the surface: an iteration
  // that keeps pushing against its border has left the master, and the point
  // opens. What is not found is said, never guessed: the caller tries another
  // start, and then the step fails and is made smaller.
  //
  // The last step needs no evaluation, see report(), where |h| is small and
  // falls so fast that what is left after that step is rounding.
  SlipOutcome
  SlipProblem::solve(const Vector2d &start)
  {
    Vector2d xi     = start;
    double   before = 0.; // error of the last iteration
    held            = {{false, false}};
    last_step.setZero();
    evaluate(xi);
    unsigned int pushes = 0;
    for (unsigned int iteration = 0; iteration < 30; ++iteration)
      {
        const double   error = distance_error(), rounding = round_off();
        const Vector2d step = -along_surface().h.inverse() * equations->h;
        if (!step.allFinite())
          return SlipOutcome::not_found;
        if (step.cwiseAbs().maxCoeff() < 1e-15 || error <= rounding)
          break;
        const Vector2d bounded = surface.bounded_step(xi, step);
        if (bounded != step && ++pushes > 5)
          return SlipOutcome::left_patch;
        if (bounded == step && error <= 1e4 * rounding_of_places() &&
            std::pow(error, 3) <= rounding_of_places() * std::pow(before, 2))
          {
            last_step = bounded;
            break;
          }
        // At the level of rounding no descent is to be had, and one more step
        // is all that there is to gain. Otherwise the test below says whether
        // this is it.
        if (error <= 16. * rounding)
          {
            xi = surface.moved(xi, bounded);
            evaluate(xi);
            break;
          }
        if (!search_along(bounded, error, xi))
          break;
        before = error;
      }
    if (last_step.isZero(0.) && distance_error() > 100. * round_off())
      return surface.has_ridges() ? solve_with_ridges(xi) :
                                    SlipOutcome::not_found;
    xi_hat = surface.moved(xi, last_step);
    return SlipOutcome::solved;
  }



  // The step of Newton's method within an element. Parameters at a side beyond
  // which it leads stay, and the other one has a step of its own. In the
  // parts of a thin triangle what vanishes at the solution would lead steps
  // round in circles.
  SlipProblem::ElementStep
  SlipProblem::step_in_element(const NurbsSurface::Place &place)
  {
    const auto            box   = surface.element_bounds(place.element);
    const SlipEquations  &e     = *equations;
    const Eigen::Matrix2d slope = along_surface().h - e.tangential_bend();
    ElementStep           result{-slope.inverse() * e.h};
    for (unsigned int d = 0; d < 2; ++d)
      result.beyond[d] = (place.xi[d] <= box[0][d] && result.step[d] < 0.) ||
                         (place.xi[d] >= box[1][d] && result.step[d] > 0.);
    for (unsigned int d = 0; d < 2; ++d)
      if (result.beyond[d])
        {
          const unsigned int o = 1 - d;
          result.step[d]       = 0.;
          result.step[o]       = result.beyond[o] ? 0. : -e.h[o] / slope(o, o);
        }
    return result;
  }



  // Where faces meet at an angle tangents jump, and the equations may have no
  // solution: each side leads to the other one. Then the ridge holds xi_hat,
  // and what is left to solve is along it, and how far the normal has turned.
  SlipOutcome
  SlipProblem::solve_with_ridges(const Vector2d &start)
  {
    constexpr double    negligible = 1e-13; // of a parameter
    NurbsSurface::Place now{surface.element_of(start), start};
    evaluate_in(now);
    for (unsigned int iteration = 0; iteration < 60; ++iteration)
      {
        const auto        box  = surface.element_bounds(now.element);
        const ElementStep here = step_in_element(now);
        if (!here.step.allFinite())
          return SlipOutcome::not_found;
        const Vector2d target =
          (now.xi + here.step).cwiseMax(box[0]).cwiseMin(box[1]);
        const double step = (target - now.xi).cwiseAbs().maxCoeff();
        if (step > negligible && distance_error(here.beyond) > round_off())
          {
            now.xi = target;
            evaluate_in(now);
            continue;
          }
        // solved within the element, or at a side that the equations lead over
        bool moved = false;
        if (here.beyond[0] || here.beyond[1])
          for (const NurbsSurface::Place &beside :
               surface.places_beside(now.element, now.xi))
            {
              evaluate_in(beside);
              const ElementStep there = step_in_element(beside);
              if (there.step.allFinite() && !there.beyond[0] &&
                  !there.beyond[1] &&
                  there.step.cwiseAbs().maxCoeff() > negligible)
                {
                  now   = beside;
                  moved = true;
                  break;
                }
            }
        if (moved)
          continue;
        evaluate_in(now);
        const auto end = surface.end_of_surface(now.element, now.xi);
        if ((here.beyond[0] && end[0] != 0) || (here.beyond[1] && end[1] != 0))
          return SlipOutcome::left_patch;
        // at a corner the equations are missed by the gap along the normal
        // times the angle, a small part of the elastic gap
        held   = here.beyond;
        xi_hat = now.xi;
        if (!turn_on_ridge(now))
          evaluate_in(now);
        return SlipOutcome::solved;
      }
    return SlipOutcome::not_found;
  }



  // Of the one element beside, across the side and on from this one; zero at a
  // corner, where there are several.
  Vector3d
  SlipProblem::tangent_beside(const NurbsSurface::Place &place,
                              const bool                 is_last)
  {
    const auto beside = surface.places_beside(place.element, place.xi);
    if (beside.size() != 1)
      return Vector3d::Zero();
    const auto &[element, xi] = beside[0];
    const auto         box    = surface.element_bounds(element);
    const unsigned int e      = xi[0] > box[0][0] && xi[0] < box[1][0] ? 1 : 0;
    if (xi[1 - e] <= box[0][1 - e] || xi[1 - e] >= box[1][1 - e])
      return Vector3d::Zero(); // where the ridge ends
    surface.evaluate_in_element(element, xi, basis);
    contract(basis, *point.master.positions, geometry);
    // where both parameters grow, or fall, towards the side: the other way
    return ((xi[e] >= box[1][e]) == is_last ? -1. : 1.) *
           (e == 0 ? geometry.a1 : geometry.a2);
  }



  // On a ridge the normal may be any between those of both sides: that of a
  // fillet, so narrow that y does not move across it. Its tangent across the
  // side, c_A + lambda (c_B - c_A), and xi_hat along it are what the equations
  // are solved for. Without that the traction would jump from side to side, and
  // between them bodies would find no equilibrium.
  bool
  SlipProblem::turn_on_ridge(NurbsSurface::Place place)
  {
    constexpr double narrow = 1e-12, negligible = 1e-10; // of lambda
    // across the ridge and along it
    const unsigned int d = held[0] ? 0 : 1, o = 1 - d;
    const auto         box     = surface.element_bounds(place.element);
    const bool         is_last = place.xi[d] >= box[1][d];
    double             lambda  = 0.5; // of the way to the normal beside
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        // the surface here, with second derivatives as lambda turns it; these
        // lead Newton's method for lambda and the place along the ridge
        Vector3d c_B = tangent_beside(place, is_last);
        if (c_B.isZero(0.))
          return false; // a corner
        surface.evaluate_in_element(place.element, place.xi, basis);
        contract(basis, *point.master.positions, geometry);
        Vector3d &a_d = d == 0 ? geometry.a1 : geometry.a2;
        // as long, as parameters of faces are of different lengths
        c_B *= a_d.norm() / c_B.norm();
        (d == 0 ? geometry.a11 : geometry.a22) = narrow * (c_B - a_d);
        // how that across changes along the ridge is that of this side: it is
        // wanted for the convergence only
        geometry.a12 *= narrow;
        a_d = narrow * ((1. - lambda) * a_d + lambda * c_B);
        // forces at control points are those of y, whatever lambda is
        for (double &N : d == 0 ? basis.N_1 : basis.N_2)
          N *= narrow;
        equations.emplace(point, geometry);
        by_xi.reset();
        const Vector2d step = -along_surface().h.inverse() * equations->h;
        if (std::abs(step[d]) < negligible && std::abs(step[o]) < 1e-13)
          {
            xi_hat = place.xi;
            held   = {{false, false}};
            fillet = narrow;
            across = d;
            return true;
          }
        lambda      = std::clamp(lambda + step[d], 0., 1.);
        place.xi[o] = std::clamp(place.xi[o] + step[o], box[0][o], box[1][o]);
      }
    return false;
  }



  // Halves the step until |h| becomes smaller: the law has kinks where the bond
  // begins and ends to break, behind which the linearisation may overshoot.
  // False, and nothing has moved, if no part of the step makes |h| smaller.
  bool
  SlipProblem::search_along(const Vector2d &step,
                            const double    error,
                            Vector2d       &xi)
  {
    const Vector2d old = xi;
    for (double fraction = 1.; fraction > 0.01; fraction *= 0.5)
      {
        xi = surface.moved(old, fraction * step);
        evaluate(xi);
        if (distance_error() < error)
          return true;
      }
    xi = old;
    evaluate(xi);
    return false;
  }



  // Of dh/dxi_hat; what a ridge holds does not move.
  Eigen::Matrix2d
  SlipProblem::inverse_along_surface()
  {
    const Eigen::Matrix2d &by     = along_surface().h;
    Eigen::Matrix2d        result = by.inverse();
    for (unsigned int d = 0; d < 2; ++d)
      if (held[d])
        {
          result.setZero();
          if (!held[1 - d])
            result(1 - d, 1 - d) = 1. / by(1 - d, 1 - d);
        }
    return result;
  }



  // The point as the rest of the program sees it. xi_hat is no unknown of the
  // whole system: with h(xi_hat, w) = 0 the implicit function theorem gives its
  // motion,
  //
  //     dxi_hat = -(dh/dxi_hat)^-1 dh/dw dw,
  //
  // and the total derivative of the traction,
  //
  //     dt/dw = (dt/dw at fixed xi_hat) + dt/dxi_hat dxi_hat/dw,
  //
  // with which Newton's method converges quadratically also where points slide,
  // soften and turn. The stored energy is that of the normal and of the
  // tangential gap; what friction dissipates is summed up elsewhere, from
  // traction and slip.
  //
  // Newton's last step moves xi_hat by 1e-11 mm at most. What it changes
  // follows from the derivatives, up to its square.
  void
  SlipProblem::report(ContactPointResult &result)
  {
    const SlipEquations &e        = *equations;
    InterfaceResponse    response = e.response;
    const Vector3d       n_turns  = e.normal_along_surface() * last_step;
    const Vector4d change = along_surface().traction_and_distance * last_step;
    const double   gap    = e.gap_along_surface() * last_step,
                 more     = response.pressure_by_gap * gap +
                        response.pressure_by_slip * change[3]; // pressure
    Vector3d tangential = e.tangential_traction;
    if (!tangential.isZero(0.)) // else rounding would have a direction
      tangential +=
        change.head<3>() + more * e.normal.n + response.pressure * n_turns;
    response.pressure += more;
    if (!response.shears)
      response.rubbed = e.distance + change[3];
    result.state.xi = xi_hat;
    if (last_step.isZero(0.))
      result.basis = basis;
    else
      surface.evaluate(xi_hat, result.basis);
    result.state.gap =
      e.normal.parts(tangential / point.law.tangential_penalty);
    // in parts of the tangents of the surface, of which that across is wider
    result.state.gap[across] *= fillet;
    point.carry(response,
                e.normal.n + n_turns,
                tangential,
                e.g_n + gap,
                e.distance + change[3],
                result);
    result.viscous_traction =
      e.resistance * response.rubbed * tangential.normalized();
    result.slip_increment =
      e.slip + geometry.a1 * last_step[0] + geometry.a2 * last_step[1];
    const auto            by_w    = e.along_w();
    const Eigen::Matrix2d inverse = inverse_along_surface();
    result.dxi                    = -inverse * by_w.h;
    const Eigen::Matrix<double, 4, W::size> total =
      by_w.traction_and_distance + by_xi->traction_and_distance * result.dxi;
    result.dt = total.topRows<3>();
    if (point.joint().cohesion)
      {
        const auto by_damage = e.along_damage();
        result.by_damage.xi  = -inverse * by_damage.h;
        const Vector4d change =
          by_damage.traction_and_distance +
          by_xi->traction_and_distance * result.by_damage.xi;
        result.by_damage.traction = change.head<3>();
      }
    // where it has not moved the length has no derivative
    result.dpath.setZero();
    if (point.joint().slid(result.state) !=
        point.joint().slid(point.start.history))
      result.dpath = total.row(3);
    if (point.joint().opened(result.state) >
        point.joint().opened(point.start.history))
      result.dpath += e.gap_along_w() + e.gap_along_surface() * result.dxi;
  }



  // Second derivatives of the surface are needed for along_surface() only, but
  // there in every iteration.
  inline void
  SlipProblem::evaluate(const Vector2d &xi)
  {
    evaluate_in({surface.element_of(xi), xi});
  }



  inline void
  SlipProblem::evaluate_in(const NurbsSurface::Place &place)
  {
    surface.evaluate_in_element(place.element, place.xi, basis);
    contract(basis, *point.master.positions, geometry);
    equations.emplace(point, geometry);
    by_xi.reset();
  }



  // |h|/|a| is a distance: it cannot be smaller than the rounding of positions,
  // which are of the size of the surface, and of the sliding distance found
  // from them, which moves the traction.
  inline double
  SlipProblem::rounding_of_places() const
  {
    return 1e-16 * (point.x.norm() + geometry.a1.norm() + geometry.a2.norm());
  }



  inline double
  SlipProblem::round_off() const
  {
    return rounding_of_places() *
           (1. + std::abs(equations->slope) / point.law.tangential_penalty);
  }



  // h has the unit of a_alpha times a length. Over |a_alpha| it is the distance
  // in the surface by which the gap misses what is asked of it [mm], along the
  // parameters that are not held.
  inline double
  SlipProblem::distance_error(const std::array<bool, 2> &held) const
  {
    return Vector2d(held[0] ? 0. : equations->h[0] / geometry.a1.norm(),
                    held[1] ? 0. : equations->h[1] / geometry.a2.norm())
      .norm();
  }
} // namespace Debond
