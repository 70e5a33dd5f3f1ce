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



  void
  CoupledSystem::update_configuration()
  {
    configuration.side[Side::bone].positions =
      bone.surface().control_points() + bone.contact_displacement();
    const auto  v         = implant.contact_displacement();
    const auto &reference = implant.surface().control_points();
    auto       &positions = configuration.side[Side::implant].positions;
    positions.resize(3, reference.cols());
    for (unsigned int A = 0; A < reference.cols(); ++A)
      positions.col(A) = chuck.map(reference.col(A), v.col(A));
    configuration.side[Side::implant].frame = chuck.rotation();
  }



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
    residual.setZero(unknowns);
    solver.forget();
  }



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



  bool
  CoupledSystem::extend_contact_unknowns()
  {
    if (!bone.bulk())
      return false;
    std::vector<bool>       wanted = bone.contact_control_points();
    const std::vector<bool> touched =
      touched_bone_control_points(bone.surface(),
                                  interface.get_points(),
                                  interface.slave_side());
    bool grown = false;
    for (unsigned int A = 0; A < wanted.size(); ++A)
      if (touched[A] && !wanted[A])
        grown = wanted[A] = true;
    if (!grown)
      return false;
    // everything under the implant now, so that this happens seldom
    const std::vector<bool> under =
      bone_control_points_under_implant(bone.surface(),
                                        implant.surface(),
                                        configuration);
    for (unsigned int A = 0; A < wanted.size(); ++A)
      wanted[A] = wanted[A] || under[A];
    const TimedSection t(timer, "condensation");
    bone.set_contact_control_points(wanted);
    number_unknowns();
    return true;
  }



  // Open points may face what lies beside the contact unknowns.
  bool
  CoupledSystem::complete_surfaces()
  {
    if (!bone.surface_was_left_behind() && !implant.surface_was_left_behind())
      return false;
    if (!interface.has_open_points())
      return false;
    const TimedSection t(timer, "bulk");
    bone.complete_surface();
    implant.complete_surface();
    return true;
  }



  void
  CoupledSystem::predict(const double time,
                         const double parameter,
                         const bool   extrapolate)
  {
    bone.predict(parameter, extrapolate);
    implant.predict(parameter, extrapolate);
    chuck.predict(parameter, extrapolate);
    chuck.prescribe(time);
    trial_time = time;
    path.slip  = 0.;
  }



  void
  CoupledSystem::leave_surface_behind()
  {
    const auto     &reference = implant.surface().control_points();
    const auto      v         = implant.contact_displacement();
    const auto      numbers   = implant.unknown_of();
    Eigen::VectorXd dv        = Eigen::VectorXd::Zero(implant.n_unknowns());
    for (unsigned int A = 0; A < reference.cols(); ++A)
      {
        const Eigen::Vector3d back =
          chuck.rotation().transpose() *
          (interface.accepted_surface(Side::implant).col(A) -
           chuck.map(reference.col(A), v.col(A)));
        for (unsigned int c = 0; c < 3; ++c)
          if (numbers[3 * A + c] >= 0)
            dv[numbers[3 * A + c]] = back[c];
      }
    implant.correct(implant.correction(dv, {}));
  }



  void
  CoupledSystem::commit(const double parameter)
  {
    {
      const TimedSection t(timer, "bulk");
      // closed points face contact unknowns only
      const bool surface_is_seen = interface.has_open_points();
      bone.commit(parameter, surface_is_seen);
      implant.commit(parameter, surface_is_seen);
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
    bone.rollback();
    implant.rollback();
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
    double             norm_squared = 0., interior_squared = 0.;
    unsigned int       first = 0;
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
        residual.segment(first, body[side]->n_unknowns()) = part.condensed;
        norm_squared += part.norm_squared;
        interior_squared += part.interior_squared;
        first += body[side]->n_unknowns();
      }

    // A residual is small compared with the contact force, or, where bodies
    // barely touch, with that of a penetration of 1e-6 R.
    const double force = interface.force(interface.slave_side()).norm();
    result.reference   = std::max(force_floor, force);
    norm_squared += evaluate_chuck(result.reference);
    result.norm  = std::sqrt(norm_squared);
    result.valid = std::isfinite(result.norm) && std::isfinite(force);
    if (!result.valid)
      result.why = "the residual is not finite";
    result.interior_share =
      norm_squared > 0. ? interior_squared / norm_squared : 0.;
    return result;
  }



  // The rows of the chuck and of the time. Moments count as forces at the
  // distance R. Returns the square of their norm, and raises the reference to
  // the largest load.
  double
  CoupledSystem::evaluate_chuck(double &reference)
  {
    double               norm_squared = 0.;
    const Chuck::Vector6 forces       = chuck_forces();
    for (const auto &[component, number] : configuration.chuck_unknowns)
      if (chuck.is_prescribed(component))
        residual[number] = 0.; // along a path q_k is set with the time
      else
        {
          const double load = chuck.machine_load(component);
          residual[number]  = forces[component] - load;
          norm_squared += std::pow(residual[number] / scale_of(component), 2);
          reference = std::max(reference, std::abs(load) / scale_of(component));
        }
    if (path.follow)
      {
        residual[path.number] =
          path.evaluate(interface, configuration, trial_time, reference);
        norm_squared += std::pow(residual[path.number], 2);
      }
    return norm_squared;
  }



  bool
  CoupledSystem::is_unsupported() const
  {
    bool free_chuck = false;
    for (const unsigned int k : chuck.unknowns())
      free_chuck = free_chuck || chuck.machine_stiffness(k) == 0.;
    return free_chuck && interface.summarise().n_closed == 0;
  }



  // One Newton correction: (S + Q^T (df/dx) Q) dv = -r. Each body then says how
  // its interior follows.
  CoupledSystem::Correction
  CoupledSystem::solve(const double relative_tolerance)
  {
    Correction result;
    {
      const TimedSection t(timer, "dense solve");
      result.unknowns = -solver.solve(matrix, residual, relative_tolerance);
    }
    if (!result.unknowns.allFinite())
      result.why = "the system of equations is singular";
    else
      for (const auto &[component, number] : configuration.chuck_unknowns)
        if (!chuck.is_prescribed(component) &&
            chuck.machine_stiffness(component) == 0. &&
            std::abs(result.unknowns[number]) >
              (is_rotation(component) ? 1. : 10. * R))
          result.why = std::string("the loaded chuck component ") +
                       ChuckParameters::names[component] +
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



  // Prescribed components of the chuck follow the time.
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



  bool
  CoupledSystem::refactor_bulk()
  {
    const TimedSection t(timer, "condensation");
    solver.forget();
    return bone.refactor() && implant.refactor();
  }



  std::string
  CoupledSystem::describe_worst_point() const
  {
    int          worst = 0;
    const double value =
      residual.size() > 0 ? residual.cwiseAbs().maxCoeff(&worst) : 0.;
    std::ostringstream text;
    for (const Side side : both_sides)
      {
        const auto &numbers = configuration.side[side].unknown_of;
        const auto  found   = std::find(numbers.begin(), numbers.end(), worst);
        if (residual.size() > 0 && found != numbers.end())
          {
            const unsigned int index = found - numbers.begin();
            const auto x = configuration.side[side].positions.col(index / 3);
            text << "residual " << value << " N in "
                 << "xyz"[index % 3] << " at the " << name_of(side)
                 << "'s control point at (" << x[0] << ", " << x[1] << ", "
                 << x[2] << ") mm";
          }
      }
    for (const auto &[component, number] : configuration.chuck_unknowns)
      if (number == static_cast<unsigned int>(worst))
        text << "residual " << value
             << (is_rotation(component) ? " N mm" : " N") << " in the chuck's "
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



  // A rotation about the axis b_k moves x by b_k x (x - C - u), and
  // f . (b_k x r) = b_k . (r x f).
  Chuck::Vector6
  CoupledSystem::chuck_forces() const
  {
    const Chuck::Vector6 total  = chuck_resultant();
    Chuck::Vector6       result = total;
    for (unsigned int k = 3; k < 6; ++k)
      result[k] = chuck.axis(k).dot(total.tail<3>());
    return result;
  }



  // In the implant's frame. A linear body balances moments with reference lever
  // arms only.
  double
  CoupledSystem::reaction_defect() const
  {
    if (!implant.bulk())
      return 0.;
    const Eigen::Vector3d C = chuck.reference_centre();
    ControlNet arm          = implant.surface().control_points().colwise() - C;
    if (implant.has_current_lever_arms())
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
