#include <debond/interface/interface_configuration.h>
#include <debond/support/number_text.h>
#include <debond/support/runtime.h>
#include <debond/system/coupled_system.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

// The coupled system, which sections 6 and 7 of doc/developers/walk.md are
// about: two bodies, the chuck and the interface between them. In the paper it
// is Appendix A.3; what the paper leaves open is how to solve it, see
// doc/explanation/solution.md.
//
// Friction sees the bodies through the positions of the control points of the
// two contact faces, and nothing else. Only these and the components of the
// chuck that are not prescribed are unknowns: some 300 on the coarse mesh, 2400
// on the fine one. The interior of a body is condensed, as step-44 condenses
// pressure and dilatation; but there it is done cell by cell and in every
// iteration, here it is the whole inside of a body, and once, since the
// stiffness in the body's own frame hardly changes. A bone too large for that
// is not condensed: its nodes are found together with these unknowns
// (solve_whole()).
//
// A step calls predict(), then evaluate(), solve() and correct() in turn until
// the residual is small, then commit() or rollback(). All that happens before
// commit() is a trial.
namespace Debond
{
  namespace
  {
    BodyParameters
    with_solver(const ModelParameters &parameters)
    {
      parameters.check_ranks();
      BodyParameters bone = parameters.bone;
      bone.bulk_solver    = parameters.bulk_solver();
      return bone;
    }



    /** Bodies that another run hands over, if it has solved them as this one
     *  has to; else new ones. */
    std::shared_ptr<BodyPair>
    those_or_new(std::shared_ptr<BodyPair> bodies,
                 const ModelParameters    &parameters)
    {
      if (bodies && bodies->bone->mesh().parameters().bulk_solver ==
                      with_solver(parameters).bulk_solver)
        return bodies;
      return std::make_shared<BodyPair>(parameters);
    }
  } // namespace



  // Apart from the rest since variants of a study share them: meshes and
  // factors depend on the bodies alone, not on friction or loads, so that a
  // study makes them once.
  BodyPair::BodyPair(const ModelParameters &parameters)
    : bone(make_body(with_solver(parameters), Side::bone))
    , implant(make_body(parameters.implant, Side::implant))
  {}



  // Two scales come with the scene. A residual is to be small compared with the
  // contact forces, which may be none: force_floor is the force [N] of a
  // penetration of 1e-6 R over the whole face, eps_n A 1e-6 R. Where the
  // tolerance is less than the rounding of places it is that much more: the
  // force of a penetration of one unit in their last digit is no residual.
  CoupledSystem::CoupledSystem(const ModelParameters    &parameters,
                               std::shared_ptr<BodyPair> bodies,
                               dealii::TimerOutput      *timer)
    : both_bodies(those_or_new(std::move(bodies), parameters))
    , bone(*both_bodies->bone)
    , implant(*both_bodies->implant)
    , body{{&bone, &implant}}
    , chuck(parameters.chuck,
            parameters.chuck.place(parameters.implant.geometry().chuck_height),
            parameters.implant.characteristic_radius())
    , interface(parameters.interface, bone.mesh(), implant.mesh())
    , press_fit(parameters.interface, parameters.implant, implant.surface())
    , R(parameters.implant.characteristic_radius())
    , timer(timer)
    , force_floor(parameters.interface.normal_penalty *
                  interface.implant_area() *
                  std::max(1e-6 * R,
                           std::numeric_limits<double>::epsilon() *
                             (R + chuck.reference_centre().norm()) /
                             parameters.load_steps.residual_tolerance))
    , matrix(body, interface, configuration, path)
  {
    configuration.chuck = &chuck;
    path.follow         = parameters.load_steps.follow_path;
    // Rows q_k = value_k(t) of prescribed components, which are equations of
    // their own along a path only, are lengths and angles among forces and
    // moments. Multiplied by the stiffness of the whole face, eps_n A [N/mm],
    // or eps_n A R^2 [N mm] if they are angles, they are of the size of the
    // rows of forces and moments beside them. It also stands for the chuck in
    // the preconditioner, where that has no other stiffness (CoupledTangent).
    for (unsigned int k = 0; k < 6; ++k)
      {
        path.stiffness[k] = parameters.interface.normal_penalty *
                            interface.implant_area() * std::pow(scale_of(k), 2);
        path.row_scale[k] =
          path.stiffness[k] /
          std::max(path.stiffness[k], -chuck.machine_stiffness(k));
      }
  }



  // Where the control points of the two surfaces are in space [mm]: x = X + v
  // on the bone, whose frame stands still, and x = C + u + Q (X - C + v) on the
  // implant, where a press fit has its part in v. The contact law sees the
  // bodies through these positions only.
  //
  // v is the displacement in the body's own frame, of the order of the elastic
  // deformation even after a full turn of the implant. Stored as positions in
  // space the bodies would lose digits to the rotation, and their stiffness
  // would turn with them.
  void
  CoupledSystem::update_configuration()
  {
    configuration.side[Side::bone].positions =
      bone.surface().control_points() + bone.contact_displacement();
    ControlNet v = implant.contact_displacement();
    if (!press_fit.is_none())
      v += press_fit.offset();
    configuration.side[Side::implant].positions =
      chuck.map_points(implant.surface().control_points(), v);
    configuration.side[Side::implant].frame = chuck.rotation();
    if (interface.faces_at_start().largest_gap > 0.)
      configuration.side[interface.slave_side()].add_frame(
        interface.slave_side() == Side::implant ? chuck.centre() :
                                                  Eigen::Vector3d::Zero());
  }



  // The unknowns in their order: those of the bone, of the implant, of the
  // chuck, and along a path the time. Each body numbers its own from 0; those
  // of the implant follow those of the bone. -1 stands for a component that is
  // fixed or condensed. A rigid body has no unknowns.
  //
  // Along a path all six components of the chuck are unknowns, since they
  // depend on the time, which is one. Else only those that are loaded or held
  // by a spring are. The preconditioner belongs to the old numbering and is
  // dropped.
  void
  CoupledSystem::number_unknowns()
  {
    unsigned int first = 0;
    for (const Side side : both_sides)
      {
        configuration.side[side].unknown_of = body[side]->unknown_of();
        for (int &number : configuration.side[side].unknown_of)
          if (number >= 0)
            number += first;
        configuration.side[side].unknown_of.resize(
          configuration.side[side].positions.size(), -1);
        first += body[side]->n_unknowns();
      }
    configuration.chuck_unknowns.clear();
    for (unsigned int component = 0; component < 6; ++component)
      if (path.follow || !chuck.is_prescribed(component))
        configuration.chuck_unknowns.emplace_back(component, first++);
    path.number = first;
    unknowns    = first + (path.follow ? 1 : 0);
    solver.forget();
  }



  // The state that row 0 is solved from: undeformed bodies in the place where
  // the scene has the chuck at the first time. Each slave point is faced with
  // its closest point on the master, which is its first interacting point
  // xi_hat (Appendix A.2 of the paper).
  //
  // Each body is condensed once, on the control points that contact can reach:
  // all of the implant's face, and what lies under it on the bone. All of the
  // bone's face would be safe, too, but S is dense: the factor that every
  // iteration passes through grows with the square of the number of its
  // unknowns.
  void
  CoupledSystem::start(const double time)
  {
    chuck.place(time);
    update_configuration();
    {
      const TimedSection t(timer, "contact");
      interface.initialise(configuration);
      if (implant.mesh().parameters().shape == BodyShape::file &&
          !press_fit.is_none())
        {
          press_fit.set(time);
          update_configuration();
          interface.begin_thicker(configuration);
          press_fit.rollback();
          update_configuration();
        }
    }
    const TimedSection t(timer, "condensation");
    bone.set_contact_control_points(bone_control_points_under_implant(
      bone.surface(), implant.surface(), configuration));
    implant.set_contact_control_points(
      std::vector<bool>(implant.surface().n_control_points(), true));
    number_unknowns();
  }



  // An implant that is pushed sideways comes to control points of the bone that
  // were condensed. There the force of a point that closes would be lost on a
  // linear body, whose interior carries no load. These control points become
  // unknowns, and S is formed anew with them. Returns whether the system has
  // grown: then residual and tangent have another size.
  bool
  CoupledSystem::extend_contact_unknowns()
  {
    // Unknowns are added and never given back, so that an implant that goes to
    // and fro over an edge of elements does not condense the bone at every
    // turn.
    if (!bone.bulk())
      return false;
    std::vector<bool> wanted = bone.contact_control_points();
    const auto        add    = [&wanted](const std::vector<bool> &more) {
      for (unsigned int i = 0; i < more.size(); ++i)
        wanted[i] = wanted[i] || more[i];
    };
    add(touched_bone_control_points(bone.surface(),
                                    interface.get_points(),
                                    interface.slave_side()));
    if (wanted == bone.contact_control_points())
      return false;
    // everything under the implant now, so that this happens seldom
    add(bone_control_points_under_implant(bone.surface(),
                                          implant.surface(),
                                          configuration));
    const TimedSection t(timer, "condensation");
    bone.set_contact_control_points(wanted);
    number_unknowns();
    return true;
  }



  // A linear body does not move the control points beside its contact unknowns
  // along; they get their equilibrium shape when somebody looks. Closed points
  // lie on contact unknowns only. Open points may face what lies beside them
  // and then need to know where it is: their gap, Eq. (26), decides whether
  // they close. It costs a solve with the interior for the trial state and for
  // both accepted ones, so it is put off until a point is open.
  bool
  CoupledSystem::complete_surfaces()
  {
    if ((!bone.surface_was_left_behind() &&
         !implant.surface_was_left_behind()) ||
        !interface.has_open_points())
      return false;
    const TimedSection t(timer, "bulk");
    for (Body *each : body)
      each->complete_surface();
    return true;
  }



  // A step begins with a trial state: the accepted one, or the straight line
  // through the last two, of which it is the continuation over the time or,
  // along a path, over the number of the step. In 100 steps of the main scene
  // with linear bodies it takes 105 iterations, and starting from the last
  // state with sticking points 301.
  //
  // What is prescribed is put where the scene wants it at once; the residual
  // then holds what that does to the interface. In the implant's frame the
  // supports do not move, so that no inhomogeneous boundary values enter the
  // linear systems.
  void
  CoupledSystem::predict(const double time,
                         const double parameter,
                         const bool   extrapolate)
  {
    for (Body *each : body)
      each->predict(parameter, extrapolate);
    chuck.predict(parameter, extrapolate);
    chuck.prescribe(time);
    press_fit.set(time);
    trial_time = time;
    path.slip  = 0.;
  }



  // The trial state becomes the accepted one, in all parts at once. The points
  // are last: open ones are projected anew in the configuration that has just
  // been accepted, so that what a point moved along the master while it was
  // open does not count as slip when it closes in a later step.
  void
  CoupledSystem::commit(const double parameter)
  {
    {
      const TimedSection t(timer, "bulk");
      // closed points face contact unknowns only
      const bool surface_is_seen = interface.has_open_points();
      for (Body *each : body)
        each->commit(parameter, surface_is_seen);
    }
    chuck.commit(parameter);
    update_configuration();
    const TimedSection t(timer, "contact");
    // The mean sliding distance [mm] that the next step along a path goes on
    // from, taken while the trial states of the points are still there.
    path.old_slip = path_length();
    interface.commit(configuration);
    press_fit.commit(chuck.rotation().transpose() *
                     force_on_points(Side::implant));
  }



  // A step that failed leaves no trace. The points need nothing: evaluate()
  // reads their accepted history and writes their trial states only, and Eq.
  // (32) sums from the accepted g_s. With an update in place g_s would grow
  // with every attempt, and the bond would break of failed iterations.
  void
  CoupledSystem::rollback()
  {
    for (Body *each : body)
      each->rollback();
    chuck.rollback();
    press_fit.rollback();
  }



  // The residual at the trial state, section 6 of doc/developers/walk.md. For
  // each body, in its frame,
  //
  //   r_c = S v_c + Q^T f                           if it is linear,
  //   r_c = R_c + Q^T f - K_ci K_ii^-1 R_i          if it is Neo-Hookean,
  //
  // with the contact forces f of Eqs. (28) and (36) on its control points [N],
  // and for each component of the chuck that is not prescribed
  //
  //   r_k = sum_A f_A . dx_A/dq_k - load_k.
  //
  // The second line is exact with any K: at the solution R_i and r_c vanish,
  // whatever the state was in which K was formed. S decides how fast Newton's
  // method gets there, and not where.
  //
  // A residual that cannot be formed is no error of the program but a reason to
  // try a smaller step: `why` says what stood against it.
  CoupledSystem::Residual
  CoupledSystem::evaluate(const ContactPointMode &mode)
  {
    Residual result;
    // Contact first: f depends on where the surfaces are. It may reach control
    // points that were no unknowns yet; then the system grows, and f is
    // evaluated again.
    do
      {
        update_configuration();
        const TimedSection t(timer, "contact");
        // Every slave point by itself. A point whose equations (29),
        // (30) could not be solved ends the attempt.
        if (!interface.evaluate(configuration, mode))
          {
            result.why = interface.describe_failure();
            return result;
          }
      }
    while (extend_contact_unknowns() || complete_surfaces());

    const TimedSection t(timer, "bulk");
    result.unknowns.setZero(unknowns);
    double       norm_squared = 0., interior_squared = 0.;
    unsigned int first = 0;
    for (const Side side : both_sides)
      {
        Body::Residual &part = bulk_residual[side];
        // Q^T turns the forces from space into the body's frame. For the bone Q
        // = 1.
        part = body[side]->residual(configuration.side[side].frame.transpose() *
                                    force_on_points(side));
        if (!part.valid)
          {
            result.why = std::string("a cell of the ") + name_of(side) +
                         " is turned inside out";
            return result;
          }
        result.unknowns.segment(first, body[side]->n_unknowns()) =
          part.condensed;
        // The tolerance is for the whole residual, interior included. The
        // condensed one alone may vanish while errors of surface and interior
        // cancel in it.
        norm_squared += part.norm_squared;
        interior_squared += part.interior_squared;
        first += body[side]->n_unknowns();
      }

    // A residual is small compared with the contact force, or, where bodies
    // barely touch, with that of a penetration of 1e-6 R. An absolute tolerance
    // in N would have to be chosen anew for every scene. The forces on both
    // faces have the same sum but for the sign; those of the slave are taken.
    const double force = interface.force(interface.slave_side()).norm();
    result.reference   = std::max(force_floor, force);
    norm_squared += evaluate_chuck(result);
    result.norm = std::sqrt(norm_squared);
    // else a NaN would surface in the linear solver only, as a singular matrix
    if (!std::isfinite(result.norm) || !std::isfinite(force))
      result.why = "the residual is not finite";
    // What Newton's method decides by whether the tangent of a Neo-Hookean bulk
    // has to be formed anew.
    result.interior_share =
      norm_squared > 0. ? interior_squared / norm_squared : 0.;
    return result;
  }



  // What pulls at a loaded component is the contact alone: no spring holds it,
  // and the implant's stiffness does not resist a motion of its own frame.
  // Without contact, or without friction against a moment about z, nothing
  // stops it, and there is no solution.
  bool
  CoupledSystem::is_held_by_contact() const
  {
    const auto &unknown = chuck.unknowns();
    return std::any_of(unknown.begin(), unknown.end(), [this](const auto k) {
      return chuck.is_loaded(k);
    });
  }



  // Faces that do not touch offer no resistance to the load that presses them
  // together. The chuck is brought as deep as the load would press the whole
  // face into the interface, F / (eps_n A). From there Newton's method finds
  // the depth, which of a curved face is larger. A load that is nothing yet
  // brings them to touch.
  CoupledSystem::Correction
  CoupledSystem::approach() const
  {
    Correction     result;
    constexpr auto push = ChuckComponent::translation_z;
    const double   gap  = interface.smallest_gap();
    if (!chuck.is_loaded(push) || path.follow || gap > 10. * R ||
        chuck.machine_load(push) > 0. ||
        implant.mesh().parameters().geometry().is_in_bore())
      {
        result.why = "a loaded chuck has nothing to act against: in this trial "
                     "no point is in contact";
        return result;
      }
    result.unknowns.setZero(unknowns);
    for (const auto &[component, row] : configuration.chuck_unknowns)
      if (component == push)
        result.unknowns[row] =
          -std::max(-chuck.machine_load(push), force_floor) /
            path.stiffness[push] -
          gap;
    if (const auto whole = bone.whole())
      result.bodies[Side::bone] =
        whole->at_nodes(Eigen::VectorXd::Zero(whole->n_owned()));
    return result;
  }



  // One Newton correction, section 7 of doc/developers/walk.md,
  //
  //   (S + Q^T (df/dx) Q) dv_c = -r,
  //
  // bordered by the rows and columns of the chuck's unknown components. df/dx
  // is the exact derivative of Eqs. (29) to (32), unsymmetric while points
  // slide. It is never formed unless the solver asks for it: with condensed
  // bodies as preconditioner products are enough.
  //
  // The interior of a body is no part of it: the body says how it follows. A
  // correction is kept as a value, bodies included, so that half of it can be
  // taken back.
  CoupledSystem::Correction
  CoupledSystem::solve(const Residual &residual,
                       const double    relative_tolerance)
  {
    Correction result;
    if (is_held_by_contact() && interface.summarise().n_closed == 0)
      {
        result = approach();
        if (!result.why.empty())
          return result;
      }
    else if (bone.whole())
      {
        const WholeSolution solution =
          solve_whole(residual.unknowns,
                      bulk_residual[Side::bone].interior,
                      relative_tolerance);
        result.unknowns = -solution.unknowns;
        if (!solution.converged)
          result.why = "multigrid has not solved the linear system in " +
                       std::to_string(solution.cycles) + " cycles";
        result.bodies[Side::bone] = -bone.whole()->at_nodes(solution.bone);
      }
    else
      {
        const TimedSection t(timer, "dense solve");
        result.unknowns =
          -solver.solve(matrix, residual.unknowns, relative_tolerance);
      }
    // A singular matrix shows as numbers that are not finite, or, as rounding
    // seldom leaves an exact zero, as a chuck that flies away: by more than a
    // radian or 10 R in one iteration. Neither may enter the trial state.
    if (!result.unknowns.allFinite())
      result.why = "the system of equations is singular";
    else
      for (const auto &[k, row] : configuration.chuck_unknowns)
        if (chuck.is_loaded(k) &&
            std::abs(result.unknowns[row]) > (is_rotation(k) ? 1. : 10. * R))
          result.why = std::string("the loaded chuck component ") +
                       ChuckParameters::names[k] + " meets no resistance";
    if (!result.why.empty())
      {
        solver.forget();
        return result;
      }
    const TimedSection t(timer, "bulk");
    unsigned int       first = 0;
    for (const Side side : both_sides)
      {
        const unsigned int n = body[side]->n_unknowns();
        if (result.bodies[side].size() == 0) // else it is known already
          result.bodies[side] =
            body[side]->correction(result.unknowns.segment(first, n),
                                   bulk_residual[side]);
        first += n;
      }
    return result;
  }



  WholeSolution
  CoupledSystem::solve_whole(const Eigen::VectorXd &b,
                             const Eigen::VectorXd &b_of_bone,
                             const double           relative_tolerance) const
  {
    WholeSolution solution = Debond::solve_whole(
      matrix, *bone.whole(), b, b_of_bone, relative_tolerance, timer);
    ++effort_of_multigrid.systems;
    effort_of_multigrid.cycles += solution.cycles;
    effort_of_multigrid.most_cycles =
      std::max(effort_of_multigrid.most_cycles, solution.cycles);
    return solution;
  }



  // With forces at the unknowns only.
  Eigen::VectorXd
  CoupledSystem::solve_with_whole_bone(const Eigen::VectorXd &right,
                                       const double relative_tolerance) const
  {
    Eigen::VectorXd of_bone = Eigen::VectorXd::Zero(bone.whole()->n_owned());
    bone.whole()->add_unknowns(right.data(), of_bone.data());
    const WholeSolution solution =
      solve_whole(right, of_bone, relative_tolerance);
    return solution.converged ?
             solution.unknowns :
             Eigen::VectorXd::Constant(right.size(), std::nan(""));
  }



  // v <- v + dv for both bodies, q <- q + dq for the chuck. In the frame of the
  // chuck the implant's v is a plain vector, so adding is all it takes, even in
  // a large rotation. Along a path the time is corrected as well; prescribed
  // components follow it by the scene's own functions, not by their
  // linearisation.
  //
  // A negative fraction takes that much back, in the line search of Newton's
  // method.
  void
  CoupledSystem::correct(const Correction &correction, const double fraction)
  {
    for (const Side side : both_sides)
      body[side]->correct(fraction * correction.bodies[side]);
    for (const auto &[component, number] : configuration.chuck_unknowns)
      if (!chuck.is_prescribed(component))
        chuck.correct(component, fraction * correction.unknowns[number]);
    if (path.follow)
      {
        trial_time += fraction * correction.unknowns[path.number];
        chuck.prescribe(trial_time);
      }
  }



  // A Neo-Hookean bulk is condensed with the tangent of a state that it has
  // left since. Usually that does: it is strains of 1e-3 away, and so the error
  // falls to a thousandth in each iteration. That saves a factorisation in each
  // of them. If the error falls poorly, the present state takes its place. A
  // linear bulk has nothing to renew. False if a stiffness is not positive
  // definite, which ends the attempt.
  bool
  CoupledSystem::refactor_bulk()
  {
    const TimedSection t(timer, "condensation");
    solver.forget();
    return bone.refactor() && implant.refactor();
  }



  // For the message of a step that did not converge: where the residual is
  // largest, a control point of a face or a component of the chuck, tells more
  // than its norm.
  std::string
  CoupledSystem::describe_worst_point(const Residual &residual) const
  {
    int  worst = -1;
    Text text;
    text << "residual "
         << (unknowns > 0 ? residual.unknowns.cwiseAbs().maxCoeff(&worst) : 0.);
    for (const Side side : both_sides)
      {
        const auto &numbers = configuration.side[side].unknown_of;
        // unknown_of counts three components to a control point
        for (unsigned int i = 0; i < numbers.size(); ++i)
          if (worst >= 0 && numbers[i] == worst)
            {
              const auto x = configuration.side[side].positions.col(i / 3);
              text << " N in "
                   << "xyz"[i % 3] << " at the " << name_of(side)
                   << "'s control point at (" << x[0] << ", " << x[1] << ", "
                   << x[2] << ") mm";
            }
      }
    for (const auto &[component, number] : configuration.chuck_unknowns)
      if (static_cast<int>(number) == worst)
        text << (is_rotation(component) ? " N mm" : " N") << " in the chuck's "
             << ChuckParameters::names[component];
    return text;
  }
} // namespace Debond
