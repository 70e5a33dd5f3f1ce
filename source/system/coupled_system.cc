#include <debond/interface/contact_zone.h>
#include <debond/support/timed_section.h>
#include <debond/system/coupled_system.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Debond
{
  BodyPair::BodyPair(const ModelParameters &parameters)
    : bone(make_body(parameters.bone, Side::bone))
    , implant(make_body(parameters.implant, Side::implant))
  {}



  CoupledSystem::CoupledSystem(const ModelParameters    &parameters,
                               std::shared_ptr<BodyPair> bodies,
                               dealii::TimerOutput      *timer)
    : both_bodies(bodies ? std::move(bodies) :
                           std::make_shared<BodyPair>(parameters))
    , bone(*both_bodies->bone)
    , implant(*both_bodies->implant)
    , body{{&bone, &implant}}
    , chuck(parameters.chuck,
            Eigen::Vector3d(0, 0, parameters.implant.thickness()),
            parameters.implant.characteristic_radius())
    , interface(parameters.interface, bone.mesh(), implant.mesh())
    , R(parameters.implant.characteristic_radius())
    , timer(timer)
    , force_floor(parameters.interface.law().normal->initial_stiffness() *
                  interface.implant_area() * 1e-6 * R)
    , matrix(body, interface, configuration, path)
  {
    configuration.chuck = &chuck;
    path.follow         = parameters.load_steps.follow_path;
    for (unsigned int k = 0; k < 6; ++k)
      path.stiffness[k] =
        parameters.interface.law().normal->initial_stiffness() *
        interface.implant_area() * std::pow(scale_of(k), 2);
  }



  // Where the control points of the two surfaces are in space: x = X + v on the
  // bone, whose frame stands still, and x = C + u + Q (X - C + v) on the
  // implant. The contact law sees the bodies through these positions only.
  void
  CoupledSystem::update_configuration()
  {
    configuration.side[Side::bone].positions =
      bone.surface().control_points() + bone.contact_displacement();
    configuration.side[Side::implant].positions =
      chuck.map_points(implant.surface().control_points(),
                       implant.contact_displacement());
    configuration.side[Side::implant].frame = chuck.rotation();
  }



  // The unknowns in their order: those of the bone, of the implant, of the
  // chuck, and along a path the time. A preconditioner of another system is of
  // no use any more.
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



  // Each body is condensed once, on the control points that contact can reach:
  // all of the implant's face, and what lies under it on the bone.
  void
  CoupledSystem::start(const double time)
  {
    chuck.place(time);
    update_configuration();
    {
      const TimedSection t(timer, "contact");
      interface.initialise(configuration);
    }
    const TimedSection t(timer, "condensation");
    bone.set_contact_control_points(bone_control_points_under_implant(
      bone.surface(), implant.surface(), configuration));
    implant.set_contact_control_points(
      std::vector<bool>(implant.surface().n_control_points(), true));
    number_unknowns();
  }



  // Where contact has spread to control points of the bone that were condensed
  // these become unknowns, and S is formed anew with them.
  bool
  CoupledSystem::extend_contact_unknowns()
  {
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



  // Open points may face what lies beside the contact unknowns.
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
  // through the last two. What is prescribed is where the scene wants it.
  void
  CoupledSystem::predict(const double time,
                         const double parameter,
                         const bool   extrapolate)
  {
    for (Body *each : body)
      each->predict(parameter, extrapolate);
    chuck.predict(parameter, extrapolate);
    chuck.prescribe(time);
    trial_time = time;
    path.slip  = 0.;
  }



  // The opposite of letting the implant's face go along with the chuck: its
  // displacement in the moving frame undoes the chuck's motion,
  // v = Q^T (x - C - u) - (X - C).
  void
  CoupledSystem::leave_surface_behind()
  {
    const ControlNet back =
      chuck.rotation().transpose() *
      (interface.accepted_surface(Side::implant) -
       chuck.map_points(implant.surface().control_points(),
                        implant.contact_displacement()));
    const auto     &numbers = implant.unknown_of();
    Eigen::VectorXd dv      = Eigen::VectorXd::Zero(implant.n_unknowns());
    for (unsigned int i = 0; i < numbers.size(); ++i)
      if (numbers[i] >= 0)
        dv[numbers[i]] = back.data()[i];
    implant.correct(implant.correction(dv, {}));
  }



  // The trial state becomes the accepted one, in all parts at once. The points
  // are last: open ones are projected anew in the configuration that has just
  // been accepted.
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
    path.old_slip = mean_slip();
    interface.commit(configuration);
  }



  void
  CoupledSystem::rollback()
  {
    for (Body *each : body)
      each->rollback();
    chuck.rollback();
  }



  // The residual at the trial state. For each body, in its frame,
  //
  //   r_c = S v_c + Q^T f                           if it is linear,
  //   r_c = R_c + Q^T f - K_ci K_ii^-1 R_i          if it is Neo-Hookean,
  //
  // with the contact forces f of Eqs. (28) and (36) on its control points, and
  // for each component of the chuck that is not prescribed
  //
  //   r_k = sum_A f_A . dx_A/dq_k - load_k.
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
        // Q^T turns the forces into the body's frame
        part = body[side]->residual(configuration.side[side].frame.transpose() *
                                    interface.force(side));
        if (!part.valid)
          {
            result.why = std::string("a cell of the ") + name_of(side) +
                         " is turned inside out";
            return result;
          }
        result.unknowns.segment(first, body[side]->n_unknowns()) =
          part.condensed;
        norm_squared += part.norm_squared;
        interior_squared += part.interior_squared;
        first += body[side]->n_unknowns();
      }

    // A residual is small compared with the contact force, or, where bodies
    // barely touch, with that of a penetration of 1e-6 R.
    const double force = interface.force(interface.slave_side()).norm();
    result.reference   = std::max(force_floor, force);
    norm_squared += evaluate_chuck(result);
    result.norm = std::sqrt(norm_squared);
    if (!std::isfinite(result.norm) || !std::isfinite(force))
      result.why = "the residual is not finite";
    result.interior_share =
      norm_squared > 0. ? interior_squared / norm_squared : 0.;
    return result;
  }



  // The rows of the chuck: a loaded component is in equilibrium with its load,
  // one with a compliant machine with the force of the spring (machine_load).
  // Then, along a path, the row of the time, see PathEquation. Moments count as
  // forces at the distance R. Returns the square of their norm, and raises the
  // reference to the largest load.
  double
  CoupledSystem::evaluate_chuck(Residual &residual)
  {
    double               norm_squared = 0.;
    const Chuck::Vector6 forces       = chuck_forces();
    for (const auto &[component, number] : configuration.chuck_unknowns)
      if (!chuck.is_prescribed(component)) // along a path it follows the time
        {
          const double load         = chuck.machine_load(component);
          const double force        = forces[component] - load;
          residual.unknowns[number] = force;
          norm_squared += std::pow(force / scale_of(component), 2);
          residual.reference =
            std::max(residual.reference, std::abs(load) / scale_of(component));
        }
    if (path.follow)
      {
        const double excess            = path.evaluate(interface,
                                            configuration,
                                            trial_time,
                                            residual.reference);
        residual.unknowns[path.number] = excess;
        norm_squared += excess * excess;
      }
    return norm_squared;
  }



  // One Newton correction (theory.md, section 4),
  //
  //   (S + Q^T (df/dx) Q) dv_c = -r,
  //
  // bordered by the rows and columns of the chuck's unknown components. The
  // interior of a body is no part of it: the body says how it follows.
  CoupledSystem::Correction
  CoupledSystem::solve(const Residual &residual,
                       const double    relative_tolerance)
  {
    Correction result;
    // What pulls at a loaded component is the contact alone: without contact,
    // or without friction, nothing stops it, and there is no solution.
    const auto is_loaded = [this](const auto &unknown) {
      return !chuck.is_prescribed(unknown.first) &&
             chuck.machine_stiffness(unknown.first) == 0.;
    };
    const auto &components = configuration.chuck_unknowns;
    if (std::any_of(components.begin(), components.end(), is_loaded) &&
        interface.summarise().n_closed == 0)
      {
        result.why = "a loaded chuck has nothing to act against: the bodies "
                     "are not in contact";
        return result;
      }
    {
      const TimedSection t(timer, "dense solve");
      result.unknowns =
        -solver.solve(matrix, residual.unknowns, relative_tolerance);
    }
    if (!result.unknowns.allFinite())
      result.why = "the system of equations is singular";
    else
      for (const auto &unknown : components)
        if (is_loaded(unknown) && std::abs(result.unknowns[unknown.second]) >
                                    (is_rotation(unknown.first) ? 1. : 10. * R))
          result.why = std::string("the loaded chuck component ") +
                       ChuckParameters::names[unknown.first] +
                       " meets no resistance";
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
        result.bodies[side] =
          body[side]->correction(result.unknowns.segment(first, n),
                                 bulk_residual[side]);
        first += n;
      }
    return result;
  }



  // v <- v + dv for both bodies, q <- q + dq for the chuck. Along a path the
  // time is corrected as well, and prescribed components follow it.
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
  // left since. Usually that does: it is strains of 1e-3 away. If not, the
  // present state takes its place.
  bool
  CoupledSystem::refactor_bulk()
  {
    const TimedSection t(timer, "condensation");
    solver.forget();
    return bone.refactor() && implant.refactor();
  }



  std::string
  CoupledSystem::describe_worst_point(const Residual &residual) const
  {
    int                worst = -1;
    std::ostringstream text;
    text << "residual "
         << (unknowns > 0 ? residual.unknowns.cwiseAbs().maxCoeff(&worst) : 0.);
    for (const Side side : both_sides)
      {
        const auto &numbers = configuration.side[side].unknown_of;
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
    return text.str();
  }



  namespace
  {
    /** Sum of forces [N] and of their moments at the given lever arms [N mm].
     */
    Chuck::Vector6
    resultant(const ControlNet &force, const ControlNet &arm)
    {
      Chuck::Vector6 result = Chuck::Vector6::Zero();
      for (unsigned int A = 0; A < force.cols(); ++A)
        {
          const Eigen::Vector3d f = force.col(A), r = arm.col(A);
          result.head<3>() += f;
          result.tail<3>() += r.cross(f);
        }
      return result;
    }
  } // namespace



  Chuck::Vector6
  CoupledSystem::chuck_resultant() const
  {
    return resultant(interface.force(Side::implant),
                     configuration.side[Side::implant].positions.colwise() -
                       chuck.centre());
  }



  // What does work on the components q_k: r_k without the load. A rotation
  // about the axis b_k moves x by b_k x (x - C - u), and f . (b_k x r) = b_k .
  // (r x f).
  Chuck::Vector6
  CoupledSystem::chuck_forces() const
  {
    const Chuck::Vector6 total  = chuck_resultant();
    Chuck::Vector6       result = total;
    for (unsigned int k = 3; k < 6; ++k)
      result[k] = chuck.axis(k).dot(total.tail<3>());
    return result;
  }



  // A check of the whole chain of contact forces, condensation and supports:
  // what the contact exerts on the implant must come out at its top. It is
  // computed there from K v, or from the internal forces, and not from the
  // contact forces. In the implant's frame. A linear body balances moments with
  // reference lever arms only.
  double
  CoupledSystem::reaction_defect() const
  {
    if (!implant.bulk())
      return 0.;
    const Eigen::Vector3d C = chuck.reference_centre();
    ControlNet arm          = implant.surface().control_points().colwise() - C;
    if (!implant.has_small_strains())
      arm += implant.contact_displacement();
    Chuck::Vector6 contact =
      resultant(chuck.rotation().transpose() * interface.force(Side::implant),
                arm);
    Chuck::Vector6 support    = support_reaction(Side::implant, C);
    Chuck::Vector6 difference = contact - support;
    for (Chuck::Vector6 *forces : {&contact, &support, &difference})
      forces->tail<3>() /= R;
    return difference.norm() /
           std::max({contact.norm(), support.norm(), force_floor});
  }
} // namespace Debond
