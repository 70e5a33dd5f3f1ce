#include <debond/interface/contact_interface.h>
#include <debond/interface/rigid_motion.h>
#include <debond/interface/slip_problem.h>

#include <boost/math/quadrature/gauss.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

// Works of the points in a step, for the balances of energy.
namespace Debond
{
  namespace
  {
    /** Per area, what friction takes of a point that is lifted until it opens
     *  [N/mm]. Its spring of the @p stiffness is stretched by @p gap, what
     *  holds the spring moves by @p motion, and the limit of the gap, @p
     *  limit_at a sliding distance, falls evenly to zero: the point sticks
     *  until both meet. Then the gap follows the limit, and turns towards the
     *  motion: the tangent of half the angle between them falls with the power
     *  |motion| / limit of what is left; viscosity makes it longer by @p lag.
     *  All of the motion's work and of what was stored is lost. */
    double
    friction_until_open(const Eigen::Vector3d               &gap,
                        const Eigen::Vector3d               &motion,
                        const std::function<double(double)> &limit_at,
                        const double                         lag,
                        const double                         stiffness)
    {
      const double limit =
        std::max(limit_at(0.), 1e-6 * (gap.norm() + motion.norm()));
      if (!(limit > 0.))
        return 0.;
      // Lengths here are stretches of the spring eps_t [mm], and squares of
      // them times eps_t/2 are energies per area. First the share s of the
      // motion after which the point can no longer stick: the positive root of
      // a quadratic equation, in the form that loses no digits where the gap is
      // at its limit already.
      // |gap + s motion| = (1 - s) limit, from within: s from 0 to 1
      const double a    = motion.squaredNorm() - limit * limit,
                   b    = gap.dot(motion) + limit * limit,
                   c    = std::min(0., gap.squaredNorm() - limit * limit),
                   root = std::sqrt(std::max(0., b * b - a * c)),
                   s    = std::clamp(b > 0. ? -c / (b + root) :
                                  a > 0. ? (root - b) / a :
                                           1.,
                                  0.,
                                  1.);
      const Eigen::Vector3d then = gap + s * motion;
      const double          way = motion.norm(), length = then.norm();
      double                work = 0.5 * length * length;
      if (way > 0. && length > 0.)
        {
          // From there on the limit falls evenly with what is left of the way,
          // `left' from 1 to 0. z is the squared tangent of half the angle
          // between gap and motion, which falls as left^power; the traction
          // along the motion is (1 - z)/(1 + z) of the limit.
          using Gauss         = boost::math::quadrature::gauss<double, 6>;
          const double cosine = motion.dot(then) / (way * length),
                       square = // of the tangent
                       (1. - cosine) / std::max(1. + cosine, 1e-12),
                       power = 2. * way / limit;
          const auto loss    = [&](const double left) {
            const double z    = square * std::pow(left, power),
                         slip = (1. - left) * ((1. - s) * way + length) -
                                limit * std::log((1. + square) / (1. + z));
            return (left * (1. - s) * limit_at(std::max(0., slip)) + lag) *
                   (1. - z) / (1. + z);
          };
          // the gap turns while little of the way is done, if that is long
          const double part = power / (power + 6.);
          work += (1. - s) * way *
                  (Gauss::integrate(loss, 0., part) +
                   Gauss::integrate(loss, part, 1.));
        }
      // as if it stuck all the way, at most
      return stiffness * std::min(work,
                                  0.5 * std::max(gap.squaredNorm(),
                                                 (gap + motion).squaredNorm()));
    }



    /** The same of a point that is pressed, and that the chuck lifts up to the
     *  gap @p g_n [mm] by its @p motion. Its spring is stretched by @p gap, and
     *  the bodies move @p by_bodies when they are unloaded [mm]. */
    double
    friction_of_lifting(const ContactPointLaw   &law,
                        const PointStart        &start,
                        const InterfaceResponse &at_start,
                        const OpeningMotion     &motion,
                        const Eigen::Vector3d   &gap,
                        const Eigen::Vector3d   &by_bodies,
                        const double             g_n)
    {
      const Eigen::Vector3d &n     = motion.normal;
      const double           eps_t = law.tangential_penalty,
                   penetration     = at_start.pressure / law.joint->stiffness;
      // How compliant the bodies are, over the springs: along the pressure,
      // and along the traction where there is one worth asking.
      const double rises      = std::max(0., -n.dot(by_bodies)),
                   limit      = at_start.limit / eps_t,
                   little     = 1e-4 * limit * limit,
                   compliance = std::max(0.,
                                         (by_bodies.dot(gap) +
                                          little * rises / penetration) /
                                           (gap.squaredNorm() + little));
      // it is closed until the chuck has used up the penetration of both
      const double closed =
        (penetration + rises) / (penetration + rises + std::max(0., g_n));
      // Spring and bodies in series: the compliance 1 + c in units of
      // 1/eps_t, stretched by (1 + c) gap. What holds it moves by the chuck
      // as long as the point is closed, and by what the bodies do beside
      // giving way to this traction.
      const Eigen::Vector3d stretched = (1. + compliance) * gap,
                            holder    = closed * motion.by_chuck + by_bodies,
                            moved =
                              holder - n.dot(holder) * n - compliance * gap;
      // it slides evenly, as friction that depends on the speed asks
      const double way      = (stretched + moved).norm();
      const auto   limit_at = [&](const double slip) {
        const double     part = way > 0. ? std::max(1e-3, slip / way) : 1.;
        const PointStart from =
          law.joint->begin(start.history,
                           start.phi_0,
                           part * closed * start.duration);
        return (1. + compliance) / eps_t *
               law.joint->respond(from, start.history.normal_gap, part * way)
                 .limit;
      };
      const double viscous = start.duration > 0. ?
                               law.viscosity / (closed * start.duration) *
                                 (1. + compliance) / eps_t :
                               0.;
      const double lag     = viscous / (1. + viscous) * way;
      return friction_until_open(
        stretched, moved, limit_at, lag, eps_t / (1. + compliance));
    }
  } // namespace



  // While a point slides it dissipates t_t . dy, taken as a trapezoid between
  // the accepted and the trial traction, of which the accepted one was kept in
  // the frame of the master. With the trapezoid of the chuck's work that makes
  // the balance of energies an identity, but for turns and for points that open
  // or close. Beside that stands the work that the law itself allows for this
  // slip, with the exact integral of mu over the distance: a step in which the
  // state jumps cannot dissipate more.
  void
  InterfaceWork::add(const SlavePoint       &point,
                     const InterfaceLaw     &law,
                     const ContactPointMode &mode,
                     const Eigen::Matrix3d  &frame)
  {
    const ContactPointResult &trial        = point.trial;
    const Eigen::Vector3d     slip         = point.JxW * trial.slip_increment;
    const Eigen::Vector3d     old_traction = frame * point.accepted_traction;
    // Both are in space. xi_hat follows the slave point, and t_t, of the sign
    // of the gap x - y(xi_hat), points from it to the point: the product is
    // positive where sliding costs energy [N mm]. With the tractions at the end
    // alone it is negative only where points slide along their traction, which
    // no law of friction does.
    dissipation += 0.5 * (old_traction + trial.tangential_traction).dot(slip);
    // The viscous traction is anything between its two ends. It stands in both
    // balances, of which the second takes the law for the rest.
    const double in_bone = trial.state.sheared - point.accepted.sheared,
                 slid    = trial.state.slip - point.accepted.slip -
                        (law.bone.shear_wears_bond ? in_bone : 0.),
                 of_faces = in_bone > 0. ? slid / (slid + in_bone) : 1.;
    const double viscous_slip =
      0.5 * of_faces *
      (frame * point.accepted_viscous_traction + trial.viscous_traction)
        .dot(slip);
    // the same across the interface, whichever way the gap goes
    const bool   was_open = point.accepted.normal_gap == PointHistory::far;
    const double opened =
      was_open ?
        0. :
        std::max(0., trial.normal_gap + trial.state.crushed) -
          std::max(0., point.accepted.normal_gap + point.accepted.crushed);
    const double viscous_opening =
      -0.5 * point.JxW *
      (point.accepted_viscous_pressure + trial.viscous_pressure) * opened;
    for (double *work : {&viscous, &friction, &friction_bound})
      *work += viscous_slip + viscous_opening;
    // By the law: the exact integral over the slip at the pressures of both
    // ends, which a step that follows equilibrium comes to, too, as steps
    // shrink.
    const PointStart start  = point.begin(law, mode);
    PointWork        by_law = law.work(start, trial.normal_gap, slid);
    // Over an edge, to a piece that it is below: what is stored there at once
    // is a part of what was lost as it left. In the step between it is open,
    // and nothing is stored.
    if (point.enters_at < 0.)
      for (double *work : {&dissipation, &friction})
        *work -= point.JxW * law.respond(start, point.enters_at, 0.).energy;
    // A bond that wears as the bone slides may fall from above tau_b to below
    // it within the step: what its law would have taken beyond the bone has not
    // let through.
    if (law.bone.shears())
      by_law.friction =
        std::min(by_law.friction, law.bone.shear_strength * slid);
    add_bone(point, law, start, mode, in_bone);
    // given back where points slide along their traction, or climb on each
    // other by more than friction pays for
    step_dissipation +=
      trial.tangential_traction.dot(slip) - point.JxW * by_law.lift;
    // where a pattern has moved on, the string bears more than what holds now
    if (law.friction->has_bond() && !slip.isZero(0.))
      {
        const double bears =
          (old_traction - frame * point.accepted_viscous_traction).norm();
        const double holds =
          law.respond(start, point.accepted.normal_gap, 0.).limit;
        friction += 0.5 * std::max(0., bears - holds) * slip.norm();
      }
    // Across the interface [N mm]: what viscosity and damage take. A lift has
    // been counted as slip, but is stored in the normal spring.
    const double of_gap =
      viscous_opening + point.JxW * (by_law.damage - by_law.lift);
    adhesive += point.JxW * by_law.adhesive;
    damage += point.JxW * by_law.damage;
    adhesive_normal += point.JxW * by_law.damage;
    dissipation += of_gap;
    friction += point.JxW * (by_law.damage - by_law.lift + by_law.friction);
    friction_bound += point.JxW * by_law.friction_bound;
  }



  // Of bone that is crushed the trapezoid takes the mean pressure of both ends:
  // with the trapezoid of the gap, (p_n + p)(g_n - g)/2, and what the spring
  // stores before and after, p^2 / (2 eps_n), nothing else is left of the work.
  // The law takes what crushing costs, which is less where it began within the
  // step; the difference is a bound. In shear bone bears the same all the
  // while, so that both agree. Before the first time nothing has been put in
  // that a trapezoid would have to match, and the law is right.
  void
  InterfaceWork::add_bone(const SlavePoint       &point,
                          const InterfaceLaw     &law,
                          const PointStart       &start,
                          const ContactPointMode &mode,
                          const double            slid)
  {
    const ContactPointResult &trial = point.trial;
    const double deeper = trial.state.crushed - point.accepted.crushed;
    if (deeper > 0.)
      {
        const double by_law = point.JxW * law.bone.work(point.accepted.crushed,
                                                        trial.state.crushed),
                     by_trapezoid =
                       mode.duration == 0. ?
                         by_law :
                         0.5 * point.JxW * deeper *
                           (law.pressed(start, point.accepted.normal_gap, 0.) +
                            trial.pressure - trial.viscous_pressure);
        crushed += by_law;
        dissipation += by_trapezoid;
        friction += by_law;
        friction_bound += std::abs(by_law - by_trapezoid);
      }
    const double shear = point.JxW * law.bone.shear_strength * slid;
    friction += shear;
    sheared += shear;
  }



  // What the trapezoid of the traction over the gap is more than what is stored
  // after it than before: A_n and A being the stiffness at both ends, delta_n
  // and delta the gaps, (A_n - A) delta_n . delta / 2. That holds for any two
  // states; what the law dissipates on the way between tells whether they are
  // joined by equilibrium.
  void
  InterfaceWork::add(const CohesiveShare    &share,
                     const SlavePoint       &point,
                     const InterfaceLaw     &law,
                     const ContactPointMode &mode,
                     const Eigen::Matrix3d  &frame)
  {
    if (!share.holds)
      return;
    // The gap that bore in the accepted state has turned with the master.
    const Eigen::Vector3d gap    = frame * share.gap;
    const double          factor = 0.5 * point.JxW * share.stiffness_by_damage *
                          (point.accepted.damage - share.damage);
    for (double *work : {&damage, &adhesive, &dissipation})
      *work += factor * share.bears.dot(gap);
    if (share.damage > point.accepted.damage)
      friction +=
        point.JxW * share.damage_work(law, point.begin(law, mode), gap);
    adhesive_normal +=
      factor * share.normal.dot(share.bears) * share.normal.dot(gap);
  }



  // How a point has let go: where it was, its slave was at @p before.
  OpeningMotion
  ContactInterface::opening_motion(const SlavePoint             &point,
                                   const InterfaceConfiguration &configuration,
                                   const RigidMotion            &chuck,
                                   const ControlNet             &before) const
  {
    // The interacting point of the accepted state on the master as it lies now:
    // an open point has no other, and the gap to it says how far the faces are
    // apart.
    const MasterSurface surface = master(configuration);
    SurfaceGeometry     geometry;
    contract(point.trial.old_basis, *surface.positions, geometry);
    const Eigen::Vector3d n = MasterNormal(geometry, surface.outward_sign).n;
    return {n,
            interpolate(point.basis, configuration.side[slave].positions) -
              geometry.y,
            chuck.over_master(interpolate(point.basis, before), slave)};
  }



  // A point that opens loses all that its tangential spring has stored, and
  // what friction takes of its motion before. Its normal spring gives back to
  // the chuck what it has stored, unless the point leaves over the edge while
  // it is still pressed: then that is lost, too. g_s stays.
  void
  InterfaceWork::add_opening(const SlavePoint       &point,
                             const ContactPointLaw  &law,
                             const ContactPointMode &mode,
                             const Eigen::Matrix3d  &frame,
                             const OpeningMotion    &motion)
  {
    const ContactPointResult &trial = point.trial;
    const InterfaceLaw       &joint = *law.joint;
    PointStart                start = point.begin(joint, mode);
    if (joint.cohesion) // what is held beside is known
      start.damage = start.history.damage = trial.state.damage;
    // of the beginning, and where nothing has slid
    const InterfaceResponse at_start =
      joint.respond(start, point.accepted.normal_gap, 0.);
    // Pressure at the beginning [MPa]; gap at the end [mm], over that up to
    // which faces that have climbed carry something.
    const double p = std::max(0., at_start.pressure),
                 g_n =
                   trial.normal_gap - (joint.pulls() ? -start.history.crushed :
                                                       joint.reach(start, 0.));
    const Eigen::Vector3d old_traction = frame * point.accepted_traction,
                          gap          = old_traction / law.tangential_penalty,
                          // unloaded, the bodies move as well: while the point
                          // is closed
      by_bodies = motion.gap - motion.by_chuck -
                  (gap - p / joint.stiffness * motion.normal);
    const bool over_edge = g_n < -mode.touch_tolerance && p > 0.;
    double     lost = 0., of_springs = 0.; // per area [N/mm]
    if (at_start.pressure < 0.)            // a bond that is torn over the edge
      of_springs = at_start.energy;
    if (over_edge)
      {
        // rubbed on the way there, at a pressure that is known at the beginning
        // only
        lost = joint.work(start, point.accepted.normal_gap, trial.path_to_edge)
                 .friction;
        // the pressure at the edge is anything between that of the beginning
        // and 0
        friction_bound += 0.5 * point.JxW * lost;
        lost += std::max(0., 0.5 * old_traction.dot(gap + by_bodies));
        of_springs = -0.5 * p * g_n;
      }
    else if (!mode.frictionless && p > 0.)
      {
        lost = friction_of_lifting(
          law, start, at_start, motion, gap, by_bodies, g_n);
      }
    // as the trapezoid of the chuck's work has it, with a traction that falls
    // evenly to zero over the whole step
    const double bound =
      point.JxW * std::abs(lost - 0.5 * old_traction.dot(motion.gap));
    dissipation += point.JxW * (lost + of_springs);
    friction += point.JxW * (lost + of_springs);
    dissipation_bound += bound;
    friction_bound += bound;
  }
} // namespace Debond
