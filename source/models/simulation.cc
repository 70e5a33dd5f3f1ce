#include <debond/models/simulation.h>
#include <debond/support/number_text.h>
#include <debond/support/runtime.h>
#include <debond/system/memory_estimate.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  // <h3>What is there before the first step</h3>
  //
  // The meshes of both bodies, the condensed stiffness of each on its contact
  // surface, the quadrature points of the interface. All of that is the
  // CoupledSystem; what follows here leads it from state to state.
  namespace
  {
    // A scene that needs more memory than there is would be killed by the
    // system after minutes, without a word. So the need is estimated first. It
    // is done before the first mesh is made, from sizes alone
    // (doc/explanation/solution.md, Threads, memory and checks). What follows
    // is the `setup_system' of a step of deal.II, timed as one section.
    CoupledSystem
    build(const Scene              &scene,
          std::shared_ptr<BodyPair> bodies,
          dealii::TimerOutput      *timer)
    {
      scene.require_same_on_all_ranks();
      require_memory(scene, scene.output.fields_every > 0, bodies != nullptr);
      const TimedSection t(timer, "set-up");
      return CoupledSystem(scene, std::move(bodies), timer);
    }



    // Of the pattern of the bond.
    void
    warn_of_bonding(const Scene            &scene,
                    const ContactInterface &interface,
                    std::vector<Warning>   &warnings)
    {
      const auto &report  = interface.bonding().report();
      const auto  bonding = scene.interface.bonding_of_law();
      const auto  box     = scene.implant.geometry().box_of_face();
      if (report.mean == 0. &&
          bonding.initial_bonding * bonding.bonded_fraction > 0.)
        warnings.push_back({"nothing bonded",
                            Text()
                              << bonding_section
                              << "Pattern bonds nothing, a fraction 0 of "
                              << report.area << " mm^2: on this face x is "
                              << box[0][0] << " to " << box[1][0] << " and y "
                              << box[0][1] << " to " << box[1][1] << " mm"});
      // What it was read from, a picture for instance, may need a remark, too.
      if (!report.remark.empty())
        warnings.push_back({"picture", report.remark});
      // The pattern of the initial bonding phi_0 belongs to the implant. If the
      // quadrature points are the bone's, they see it where they happen to lie.
      const FacesAtStart &faces = interface.faces_at_start();
      const double        seen  = faces.bonding_area / faces.facing_area;
      if (interface.slave_side() == Side::bone &&
          std::abs(seen - report.mean) > 0.01 * report.mean)
        warnings.push_back(
          {"bonding",
           "the quadrature points of the bone, which is the slave, see a mean "
           "phi_0 of " +
             to_text(seen, 4) + " instead of " + to_text(report.mean, 4) +
             ": Expert / Interface / Slave = implant meets it exactly, more "
             "elements of the bone more closely"});
    }



    // What can be said before anything is solved, of the scene
    // (Scene::warnings()) and of what it makes.
    std::vector<Warning>
    warnings_of(const Scene &scene, const ContactInterface &interface)
    {
      std::vector<Warning> warnings = scene.warnings();
      const FacesAtStart  &faces    = interface.faces_at_start();
      warn_of_bonding(scene, interface, warnings);
      if (faces.overlap > 1e-6 * scene.implant.characteristic_radius())
        warnings.push_back(
          {"overlap",
           "the bodies overlap by up to " + to_text(faces.overlap, 3) +
             " mm where they are made, which presses them apart: move one of "
             "them; Interface / Interference is for press fits"});
      if (faces.uneven > 1e-3 * scene.implant.characteristic_radius())
        warnings.push_back(
          {"facets",
           "facets of bone and implant do not match, and leave gaps that differ "
           "by up to " +
             to_text(faces.uneven, 2) +
             " mm: pressures are off by that over the penetration. Use cells "
             "that match"});
      // with the bone as slave points meet the rim as closely as they lie
      const double beside = interface.implant_area() - faces.facing_area,
                   little = interface.slave_side() == Side::bone ? 0.1 : 0.01;
      if (beside > little * interface.implant_area())
        warnings.push_back(
          {"faces nothing",
           to_text(beside, 4) + " of " + to_text(interface.implant_area(), 4) +
             " mm^2 of the implant's contact face have no bone in front of "
             "them at the start" +
             (interface.slave_side() == Side::bone ?
                "" :
                ", and count in mean pressure and bonded area") +
             ": is it beside the bone, is the bone too short, or is a face left "
             "out of contact?"});
      const double left_out = interface.area_left_out();
      if (left_out > 1e-3 * interface.implant_area())
        warnings.push_back(
          {"not in contact",
           to_text(left_out, 4) +
             " mm^2 of the implant's faces lie on the bone, but are not in "
             "contact, and carry nothing: name them contact, too, in Implant / "
             "Mesh file and in the bone's, or leave a gap"});
      return warnings;
    }



    Chuck::Vector6
    in_degrees(Chuck::Vector6 position)
    {
      position.tail<3>() *= 180. / M_PI;
      return position;
    }
  } // namespace



  // The parts refer to each other and to the copy of the scene, which therefore
  // comes first. At the first time the chuck places the implant, undeformed,
  // and each quadrature point of the slave finds the master surface that it
  // faces.
  Simulation::Simulation(const Scene              &scene,
                         std::shared_ptr<BodyPair> bodies,
                         dealii::TimerOutput      *timer)
    : scene(scene)
    , team(Ranks::team())
    , timer(timer)
    // bodies that a study has condensed already are taken over, not built again
    , coupled_system(build(this->scene, std::move(bodies), timer))
    , solver(this->scene, coupled_system)
    , steps(choose_steps())
    , step_control(
        std::visit([](auto &chosen) -> StepControl & { return chosen; }, steps))
    , state_checks(this->scene,
                   [this](const Warning &warning) { warn(warning); })
  {
    // The step solver takes the first time from the scene. Nothing is solved
    // yet; a simulation can be loaded from a checkpoint from here on.
    coupled_system.start(solver.time());
    all_warnings = warnings_of(scene, coupled_system.interface);
  }



  // Three strategies lead through the load history; they share the interface
  // StepControl. Planned steps are those of the scene. Adaptive ones keep the
  // curves, drawn as cubics from row to row, within a tolerance. Where the load
  // falls and the machine springs back, neither time nor angle grows
  // along the path of equilibrium: path following takes the mean sliding
  // distance instead, which does.
  Simulation::Steps
  Simulation::choose_steps() const
  {
    const LoadSteppingParameters &load_steps = scene.load_steps;
    const double                  R = scene.implant.characteristic_radius();
    // The radius R [mm] makes forces of moments, and lengths of angles, so that
    // one tolerance can judge the curves of all six components of the chuck.
    if (load_steps.adaptive)
      return AdaptiveStepping(load_steps,
                              R,
                              scene.chuck,
                              [&](const double time) {
                                return coupled_system.chuck.values(time);
                              });
    if (!load_steps.follow_path)
      return PlannedSteps(load_steps);
    // A twentieth of the distance over which mu changes resolves the law; an
    // implant that has slid by its radius has nothing left to tell.
    return PathFollowing(
      load_steps,
      load_steps.largest_slip_step > 0. ?
        load_steps.largest_slip_step :
        coupled_system.interface.get_law().characteristic_distance / 20.,
      load_steps.path_ends_at_slip > 0. ? load_steps.path_ends_at_slip : R);
  }



  // <h3>From row to row</h3>
  //
  // A run is nothing but one row of the torque curve after the other. Whoever
  // looks on is told of each of them and may end the run by an exception.
  void
  Simulation::run()
  {
    const Ranks::Together together(team);
    // a simulation that was loaded from a checkpoint has rows, and goes on
    while (all_rows.empty() || !is_finished())
      advance();
    judge_whole_run();
  }



  // A row comes as a whole or not at all. What it may change is saved first:
  // what a checkpoint holds, and the trial state that the last row ended with,
  // which fields and points show. That costs a copy of some numbers. Factors
  // are not copied: those of the coupled system are shared, and a bulk that was
  // condensed anew is condensed once more, from the state that is saved, as a
  // run that is resumed does.
  //
  // A row is complete, and the system in its state, when the signal is given:
  // fields, profiles and checkpoints can be taken from it. Who looks on may end
  // the run on one rank only, which the others would wait for.
  void
  Simulation::advance()
  {
    const Ranks::Together together(team);
    if (is_lost)
      throw RunError("the state of the last row is lost, as it could not be "
                     "restored after an error: begin anew");
    const std::size_t n_rows     = all_rows.size(),
                      n_warnings = all_warnings.size();
    last_row.save(*this);
    try
      {
        if (all_rows.empty())
          solve_first_row();
        else
          solve_row();
      }
    // Several ranks have to restore their parts of a body together.
    catch (...)
      {
        is_lost = true;
        if (Ranks::all_meet(std::current_exception()))
          try
            {
              last_row.restore(*this);
              all_rows.resize(n_rows);
              all_warnings.resize(n_warnings);
              is_lost = false;
            }
          catch (const std::exception &)
            {} // the first error tells more
        throw;
      }
    Ranks::in_agreement([this] { signals.row(all_rows.back()); });
  }



  // Some mistakes only show when all is done: an implant that never touched the
  // bone, for instance because it was pulled instead of pressed, and a path
  // that ended before the load that was asked for.
  void
  Simulation::judge_whole_run()
  {
    if (std::all_of(all_rows.begin(), all_rows.end(), [](const TorqueRow &row) {
          return row.share_open == 1.;
        }))
      warn({"no contact", "the bodies are never in contact"});
    state_checks.judge_strains(coupled_system, scene.accuracy > 0.);
    const LoadSteppingParameters &load_steps = scene.load_steps;
    if (solver.time() != load_steps.times.back() &&
        load_steps.path_ends_at_slip == 0.)
      warn({"path",
            "the last time is not reached: " + step_control.reason_to_end()});
  }



  CurveSettings
  Simulation::curve_settings() const
  {
    const BodyParameters   &shape     = scene.implant;
    const ContactInterface &interface = coupled_system.interface;
    CurveSettings           settings;
    settings.mean_phi_0 = interface.bonding().report().mean;
    settings.is_bonded  = settings.mean_phi_0 > 0.;
    settings.phi_only_falls =
      interface.slave_side() == Side::implant ||
      scene.interface.bonding.pattern == BondingPatternKind::homogeneous;
    const double area         = shape.geometry().area;
    settings.contact_area_mm2 = area > 0. ? area : interface.implant_area();
    settings.phase_times      = scene.load_steps.times;
    return settings;
  }



  // Row 0 is the state at the first time. It is solved like a step, but has no
  // state before it: no extrapolation, no friction in the past, and nothing to
  // make smaller if it fails.
  void
  Simulation::solve_first_row()
  {
    // Bodies that only touch, under a load, have no stiffness against it yet:
    // the solver lets points stick in its first iteration. The iterations of
    // row 0 count like those of any step.
    const StepResult result = solver.solve_first();
    so_far.newton_iterations += result.iterations;
    if (result.hopeless)
      give_up({}, result);
    if (!result.is_acceptable())
      throw RunError("The state at the first time, " + to_text(solver.time()) +
                     ", could not be found: " + result.why);
    accept(result);
    add_row(result.interface, result.iterations);
  }



  // All other rows end with an accepted step. Two objects share the work: the
  // control of steps says which step to try next, and the solver looks for a
  // state of equilibrium at its end,
  //
  //   S v_c + Q^T f(v_c, q) = 0,   sum_A f_A . dx_A/dq_k - load_k = 0,
  //
  // by Newton's method from one or several starts (StepSolver::solve). Both may
  // say no, and an answer that is no is never kept.
  void
  Simulation::solve_row()
  {
    // A phase is what lies between two of Load steps / Times. The load may have
    // a kink there: no step crosses it, and none is extrapolated from before.
    // Extrapolated over it Newton's method would start far away, and a motion
    // that turns back would not be seen.
    if (step_control.is_between_phases())
      {
        step_control.begin_phase(state());
        state_checks.begin_phase();
      }
    unsigned int iterations = 0;
    while (true)
      {
        // A time to go to, or, along a path of equilibrium, a growth of the
        // mean sliding distance, for which the solver finds the time. The
        // solver has several attempts at it, from different starts, before it
        // gives up.
        const Step       step   = step_control.next();
        const StepResult result = solver.solve(step);
        // what failed has cost iterations, too
        iterations += result.iterations;
        so_far.newton_iterations += result.iterations;
        // No state within reach, or one where the law has more than one
        // solution: the step is made smaller, down to the smallest that the
        // scene allows. The solver has taken the trial back already.
        if (!result.is_acceptable())
          {
            if (result.hopeless ||
                !step_control.reject(step, result.interface.n_beyond > 0))
              give_up(step, result);
          }
        // There is a state. The control may still refuse it, because the curve
        // would be drawn too coarsely, or because it was a trial in the middle
        // of a step from which the error is estimated.
        else if (!step_control.take(step, end_of_step(step), result.iterations))
          coupled_system.rollback();
        else
          {
            // A planned step that had to be divided takes several accepted
            // steps, of which only the last one makes a row.
            accept(result);
            if (step_control.row_is_complete())
              return add_row(result.interface, iterations);
          }
      }
  }



  // What the control of steps judges by: forces and place of the chuck, whose
  // curves are drawn, and where the scene wants the chuck to be.
  //
  // Forces are N, moments N mm. The mean sliding distance [mm] is known along a
  // path only, where it is what a step prescribes.
  StepState
  Simulation::state() const
  {
    StepState result;
    result.time        = coupled_system.time();
    result.forces      = coupled_system.chuck_forces();
    result.drive       = coupled_system.chuck.values(result.time);
    result.path_length = coupled_system.path_length();
    if (scene.load_steps.follow_path)
      {
        result.path_left   = coupled_system.interface.path_left();
        result.is_detached = coupled_system.is_held_by_contact() &&
                             coupled_system.interface.is_detached();
      }
    result.position = coupled_system.chuck.position();
    return result;
  }



  // Adaptive steps draw the curve with the rates at the ends of the steps,
  // which cost one more solution each. Where the tangent is singular, at a
  // limit point, there are none; the step is then made smaller, and drawn
  // straight in the end.
  //
  // Two halves of a method of second order are right to a quarter of what one
  // step is. Friction that depends on the speed is of first order: to a half.
  StepState
  Simulation::end_of_step(const Step &step)
  {
    StepState end = state();
    if (scene.load_steps.draws_curve())
      {
        rates              = coupled_system.rates();
        end.let_go         = coupled_system.let_go();
        end.force_rates    = rates.forces;
        end.position_rates = rates.position;
        const double times =
          coupled_system.interface.depends_on_rate() ? 2. : 4. / 3.;
        end.error = [this, &step, times] {
          return Chuck::Vector6(times *
                                coupled_system.difference_of_halves(
                                  step.time - solver.time(),
                                  step.extrapolate ? &accepted_rates : nullptr,
                                  rates));
        };
      }
    return end;
  }



  // <h3>Where there is no state to accept</h3>
  //
  // A sliding point solves r theta = g_s + mu(g_s) p / eps_t, the rigid case of
  // Eqs. (29) and (30). Where |d mu/d g_s| p > eps_t its right-hand side falls
  // with g_s, and the traction has to jump: there are several solutions, and
  // which one Newton's method finds means nothing. Smaller steps do not change
  // that, so it is hopeless.
  //
  // Otherwise the smallest step has failed. The message says where, and, if a
  // load is prescribed that the interface may not be able to carry, how to
  // follow the fall beyond the largest one.
  void
  Simulation::give_up(const Step &step, const StepResult &result) const
  {
    const Chuck &chuck = coupled_system.chuck;
    Text         message;
    message << "Step " << all_rows.size();
    if (result.hopeless)
      throw RunError(message << ", after time " << solver.time() << ": "
                             << result.why);
    // along a path, and with adaptive steps, the number of rows is not known
    if (scene.load_steps.rows_are_planned())
      message << " of " << scene.load_steps.n_steps();
    message << " failed at time "
            << (scene.load_steps.rows_are_planned() ? step.whole_time :
                                                      coupled_system.time())
            << ", angle "
            << chuck.position()[ChuckComponent::rotation_z] * 180. / M_PI
            << " deg, with the smallest allowed part of a step: " << result.why;
    if (scene.load_steps.follow_path)
      message << ". A path may end at a limit point, see "
                 "doc/explanation/stability.md (Following the path)";
    else if (!chuck.unknowns().empty() && result.interface.n_closed > 0)
      message << ". A prescribed load may be more than the interface can "
                 "carry; prescribing the displacement or angle instead, or "
                 "Load steps / Path following = slip, follows the fall";
    if (scene.interface.friction->depends_on_rate &&
        !scene.interface.is_viscous())
      message
        << ". Where friction falls with the speed faster than the springs "
           "pull there is no quasi-static solution; Interface / Viscosity "
           "limits the speed";
    const Side slave = coupled_system.interface.slave_side();
    if (result.interface.n_crossed > 0)
      message
        << ". " << result.interface.n_crossed << " points of the "
        << name_of(slave) << " have crossed the edge of the "
        << name_of(other(slave))
        << ". One that does gains or loses its force at once, and between with "
           "and without it there may be no equilibrium. "
        << (slave == Side::implant ?
              "If no edge is meant, enlarge Bone / Size" :
              "With Expert / Interface / Slave = implant they stay on the implant");
    throw RunError(message);
  }



  // <h3>The state becomes history</h3>
  //
  // This is the only place where it does. Until here all was a trial: the
  // positions of both bodies and of the chuck, and for each quadrature point
  // its interacting point xi_hat and its sliding distance g_s, Eq. (32).
  // commit() makes the accepted state of them, the g_s^n of the next step;
  // friction depends on the path, so that there is no return from it.
  void
  Simulation::accept(const StepResult &result)
  {
    const unsigned int row  = all_rows.size();
    const double       from = solver.time(), to = coupled_system.time();
    // What the contact forces sum up to must be what the top of the implant is
    // held with. That is asked of the trial state, whose residual both know. It
    // is their difference over the larger, and would show a force that is lost
    // between the interface and the chuck, such as that of a step which did not
    // converge.
    reaction_defect = coupled_system.reaction_defect();
    if (row > 0)
      {
        // the first state is no step, and has no duration
        ++so_far.steps;
        so_far.smallest_step =
          std::fmin(so_far.smallest_step, std::abs(to - from));
        // Steps know their ends only. A chuck that turns back within a step, or
        // goes along a curve, slides less than the scene says.
        if (scene.has_friction() && scene.has_friction_after(from))
          state_checks.add_motion(row, coupled_system, from, to);
      }
    mark_motion();
    solver.commit();
    accepted_rates = rates;
    // Energies, jumps, penetration: a check that is not passed does not end the
    // run, but it is said, and counted in the row.
    state_checks.add(row, coupled_system, result.interface, reaction_defect);
  }



  // A warning is given once. The thousandth step tells no more than the first.
  void
  Simulation::warn(const Warning &warning)
  {
    if (std::any_of(all_warnings.begin(),
                    all_warnings.end(),
                    [&](const Warning &other) {
                      return other.check == warning.check;
                    }))
      return;
    all_warnings.push_back(warning);
    signals.warning(warning);
  }



  // <h3>A row of the torque curve</h3>
  //
  // All forces are what the chuck exerts on the implant. The torque T is the
  // generalised force conjugate to the rotation about the implant's own axis,
  // sum_A f_A . dx_A/d gamma: Eq. (37) as a sum over the contact forces.
  void
  Simulation::add_row(const InterfaceSummary &summary,
                      const unsigned int      iterations)
  {
    const Chuck            &chuck     = coupled_system.chuck;
    const ContactInterface &interface = coupled_system.interface;
    const Chuck::Vector6    q         = in_degrees(chuck.position());
    const Chuck::Vector6    reaction  = coupled_system.chuck_resultant();

    // Angles are in radians inside, and in degrees in files.
    TorqueRow row;
    row.step       = all_rows.size();
    row.time       = solver.time();
    row.angle_deg  = q[ChuckComponent::rotation_z];
    row.torque_Nmm = coupled_system.chuck_forces()[ChuckComponent::rotation_z];
    // no negative zero
    row.force_N = 0. - reaction[ChuckComponent::translation_z];
    // The mean pressure refers to the area of the undeformed contact face. In a
    // socket it is no matter of the axial force.
    row.pressure_MPa = scene.implant.is_in_socket() ?
                         summary.pressure :
                         row.force_N / interface.implant_area();
    // Sums over the quadrature points, by area: the mean bonding state of Eq.
    // (13), and how much sticks, slides and is open.
    row.phi_mean          = summary.phi_mean;
    row.share_stick       = summary.share_stick;
    row.share_slip        = summary.share_slip;
    row.share_open        = summary.share_open;
    row.newton_iterations = iterations;
    // The balance W = E_bulk + E_interface + D. The work W of the chuck and the
    // dissipation D are trapezoids over the steps; energy_defect_bound is what
    // these may be off by.
    row.energy_defect        = state_checks.energy().defect();
    row.work_Nmm             = state_checks.energy().work();
    row.energy_bulk_Nmm      = coupled_system.bulk_energy();
    row.energy_interface_Nmm = summary.energy;
    // The part of D above mu_b p is what the bond has cost; the W_adh of Eq.
    // (20) is read off the curve instead.
    row.dissipation_Nmm     = interface.work().dissipation;
    row.adhesive_work_Nmm   = interface.work().adhesive;
    row.energy_defect_bound = state_checks.energy().defect_bound();
    row.reaction_defect     = reaction_defect;
    row.viscous_work_Nmm    = interface.work().viscous;
    row.share_pulled        = summary.share_pulled;
    row.damage_Nmm          = interface.work().damage;
    row.adhesive_normal_Nmm = interface.work().adhesive_normal;
    row.crushed_Nmm         = interface.work().crushed;
    row.sheared_Nmm         = interface.work().sheared;
    row.share_shears        = summary.share_shears;
    row.beyond_strength_mm3 = state_checks.beyond_strength().volume_mm3;
    row.warnings            = state_checks.take_violations();
    // With a compliant machine the scene prescribes the place of the machine,
    // ahead of the chuck's by T / k or F / k.
    const Chuck::Vector6 machine = in_degrees(chuck.machine_position());
    row.machine_angle_deg        = machine[ChuckComponent::rotation_z];
    row.machine_uz_mm            = machine[ChuckComponent::translation_z];
    row.released_energy_Nmm      = state_checks.released().total;
    // Force and moment about the chuck's centre C + u, and where it is.
    row.chuck_reaction = reaction;
    row.chuck_position = q;
    if (row.step > 0 && scene.load_steps.draws_curve())
      set_rates(row);
    all_rows.push_back(row);
    add_motion(row.time);
  }



  // The rates at the beginning of a step are those at the end of the one
  // before, unless a phase begins: then those of a parabola.
  void
  Simulation::set_rates(TorqueRow &row) const
  {
    const TorqueRow &before = all_rows.back();
    row.rates_at_end << rates.forces[ChuckComponent::rotation_z],
      rates.reaction, in_degrees(rates.position);
    if (step_control.step_shape() == StepControl::StepShape::parabola)
      row.rates_at_begin =
        2. * (row.curve() - before.curve()) / (row.time - before.time) -
        row.rates_at_end;
    else if (step_control.step_shape() == StepControl::StepShape::cubic)
      row.rates_at_begin = before.rates_at_end;
  }
} // namespace Debond
