#include <debond/models/closed_form_problem.h>
#include <debond/models/foundation.h>
#include <debond/output/console.h>
#include <debond/support/input_error.h>
#include <debond/support/runtime.h>
#include <debond/system/energy_balance.h>
#include <debond/system/load_stepping.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>

namespace Debond
{
  namespace
  {
    std::string
    name_of(const ModelKind model)
    {
      switch (model)
        {
          case ModelKind::foundation:
            return "foundation";
          case ModelKind::analytical:
            return "analytical";
          case ModelKind::mathieu:
            return "mathieu";
          case ModelKind::finite_elements:
          case ModelKind::automatic:
            break;
        }
      return "finite elements";
    }



    [[noreturn]] void
    refuse(const Scene &scene, const std::string &entry, const std::string &why)
    {
      throw InputError(entry + ": " + why +
                       " (Model = " + name_of(scene.model) +
                       "; Model = finite elements can do more)");
    }



    void
    check_scene_is_simple(const Scene &scene)
    {
      if (scene.implant.shape != BodyShape::coin)
        refuse(scene,
               "Implant / Shape",
               "closed forms are for the flat disk of a coin");
      const BondingPatternKind pattern = scene.interface.bonding.pattern;
      const bool knows_disk            = scene.model == ModelKind::foundation;
      if (pattern != BondingPatternKind::homogeneous &&
          !(pattern == BondingPatternKind::disk && knows_disk))
        refuse(scene,
               "Interface / Bonding / Pattern",
               std::string("this closed form knows homogeneous bonding ") +
                 (knows_disk ? "and the disk only" : "only"));
      if (scene.model == ModelKind::mathieu &&
          scene.interface.bonding.initial_bonding != 1)
        refuse(scene,
               "Interface / Bonding / Initial bonding",
               "this closed form knows a fully bonded surface only");
      if (scene.interface.viscosity != 0)
        refuse(scene,
               "Interface / Viscosity",
               "closed forms do not depend on the rate");
      if (scene.interface.explicit_friction)
        refuse(scene,
               "Interface / Friction update",
               "closed forms have no steps to lag behind by");
      for (const unsigned int k : {0, 1, 3, 4, 5})
        if (scene.chuck.component[k].loaded)
          refuse(scene,
                 std::string("Chuck / ") + ChuckParameters::names[k] +
                   " / Control",
                 "closed forms take this motion as prescribed");
      for (unsigned int k = 0; k < 6; ++k)
        if (scene.chuck.component[k].stiffness != 0 &&
            !(k == ChuckComponent::rotation_z &&
              scene.model == ModelKind::foundation))
          refuse(scene,
                 std::string("Chuck / ") + ChuckParameters::names[k] +
                   " / Stiffness",
                 "closed forms have no compliant machine, but that the "
                 "foundation's Rotation z may be driven by one");
    }
  } // namespace



  ClosedFormProblem::ClosedFormProblem(const Scene &scene)
    : scene(scene)
  {
    check_scene_is_simple(scene);
    find_loads();
    find_stiffness();
    make_model();
    if (scene.load_steps.adaptive)
      refine_loads();
  }

  ClosedFormProblem::~ClosedFormProblem() = default;



  ClosedFormProblem::Load
  ClosedFormProblem::load_at(const double time) const
  {
    const Chuck          chuck(scene.chuck,
                      Eigen::Vector3d::Zero(),
                      scene.implant.radius);
    const Chuck::Vector6 q = chuck.values(time);
    for (const unsigned int k : {0, 1, 3, 4})
      if (q[k] != 0.)
        refuse(scene,
               std::string("Chuck / ") + ChuckParameters::names[k] + " / Value",
               "closed forms know Translation z and Rotation z only");
    return {time,
            -q[ChuckComponent::translation_z],
            q[ChuckComponent::rotation_z]};
  }



  void
  ClosedFormProblem::find_loads()
  {
    const LoadStepping stepping(scene.load_steps);
    for (unsigned int step = 0; step <= stepping.n_steps(); ++step)
      loads.push_back(load_at(stepping.time(step)));

    check_loads();
  }



  void
  ClosedFormProblem::check_loads() const
  {
    if (loads.front().angle != 0.)
      refuse(scene,
             "Chuck / Rotation z / Value",
             "closed forms begin with an angle of zero");
    const double direction = loads.back().angle < 0. ? -1. : 1.;
    double       last_push = 0.;
    for (const Load &load : loads)
      last_push = std::max(last_push, std::abs(load.push));
    for (std::size_t i = 1; i < loads.size(); ++i)
      {
        const double turned = direction * (loads[i].angle - loads[i - 1].angle);
        if (turned < 0.)
          refuse(scene,
                 "Chuck / Rotation z / Value",
                 "closed forms know no rotation that reverses");
        if (loads[i].angle != 0. &&
            std::abs(loads[i].push - loads[i - 1].push) > 1e-9 * last_push)
          refuse(scene,
                 "Chuck / Translation z / Value",
                 "closed forms know no push-in that changes while it turns");
        if (loads[i].angle != 0. &&
            loads[i - 1].time < scene.interface.friction.starts_at -
                                  1e-9 * (loads.back().time - loads[0].time))
          refuse(scene,
                 "Interface / Friction starts at",
                 "closed forms know no rotation without friction before one "
                 "with friction");
      }
  }



  // With adaptive steps: halves steps until the curve drawn as straight lines
  // keeps the tolerance at the quarters of each of them.
  void
  ClosedFormProblem::refine_loads()
  {
    double T_max = 0.;
    for (const Load &load : loads)
      T_max = std::max(T_max, std::abs(model->torque(angle_of_disk(load))));
    const double smallest = scene.load_steps.smallest_step_fraction *
                            (loads.back().time - loads.front().time) /
                            loads.size();
    std::vector<Load> refined{loads.front()};
    std::vector<Load> to_come(loads.rbegin(), loads.rend() - 1); // next: last
    while (!to_come.empty())
      {
        const Load  &begin = refined.back(), &end = to_come.back();
        const double T_begin = model->torque(angle_of_disk(begin));
        const double T_end   = model->torque(angle_of_disk(end));
        double       error   = 0.;
        for (const double part : {0.25, 0.5, 0.75})
          {
            const Load load =
              load_at(begin.time + part * (end.time - begin.time));
            const double turned =
              end.angle == begin.angle ?
                0. :
                (load.angle - begin.angle) / (end.angle - begin.angle);
            error = std::max(error,
                             std::abs(model->torque(angle_of_disk(load)) -
                                      T_begin - turned * (T_end - T_begin)));
          }
        if (error > 0.5 * scene.load_steps.tolerance * T_max &&
            end.time - begin.time > 2. * smallest)
          to_come.push_back(load_at(0.5 * (begin.time + end.time)));
        else
          {
            refined.push_back(end);
            to_come.pop_back();
          }
      }
    loads = refined;
    check_loads();
  }



  void
  ClosedFormProblem::find_stiffness()
  {
    const ClosedFormParameters &given = scene.closed_form;
    normal_stiffness                  = given.normal_stiffness;
    lambda                            = given.torsional_stiffness;

    const bool pressure_is_given =
      given.pressure > 0. ||
      scene.chuck.component[ChuckComponent::translation_z].loaded;
    const bool turns_on_foundation = scene.model == ModelKind::foundation;
    if ((normal_stiffness == 0. && !pressure_is_given) ||
        (lambda == 0. && turns_on_foundation))
      {
        bulk = foundation_stiffness(scene);
        if (normal_stiffness == 0.)
          normal_stiffness = bulk.normal;
        if (lambda == 0.)
          lambda = bulk.torsional;
      }
  }



  double
  ClosedFormProblem::pressure(const Load &load) const
  {
    const double final_push = loads.back().push;
    if (scene.closed_form.pressure > 0.)
      return final_push > 0. ? scene.closed_form.pressure *
                                 std::max(0., load.push) / final_push :
                               scene.closed_form.pressure;
    const double R = scene.implant.radius;
    return std::max(
      0.,
      scene.chuck.component[ChuckComponent::translation_z].loaded ?
        load.push / (M_PI * R * R) :
        load.push * normal_stiffness);
  }



  void
  ClosedFormProblem::make_model()
  {
    const double R = scene.implant.radius, p = pressure(loads.back());
    const auto  &bonding  = scene.interface.bonding;
    const auto  &friction = scene.interface.friction;
    const auto  &given    = scene.closed_form;
    if (!(p > 0.))
      refuse(scene,
             "Chuck / Translation z / Value",
             "closed forms need pressure while they turn");

    if (scene.model == ModelKind::foundation)
      {
        RigidBodiesTorsion::Parameters parameters;
        parameters.radius             = R;
        parameters.push_in            = 1.;
        parameters.normal_penalty     = p;
        parameters.tangential_penalty = lambda;
        parameters.phi_0              = bonding.initial_bonding;
        parameters.friction           = friction;
        if (bonding.pattern == BondingPatternKind::disk)
          parameters.bonded_radius = R * std::sqrt(bonding.bonded_fraction);
        if (!RigidBodiesTorsion::has_unique_solution(parameters))
          refuse(scene,
                 "Interface / Sliding threshold",
                 "the friction law softens faster than the foundation is "
                 "stiff, so that the traction would jump");
        auto foundation = std::make_unique<RigidBodiesTorsion>(parameters);
        if (scene.chuck.component[ChuckComponent::rotation_z].stiffness > 0.)
          machine = std::make_unique<CompliantMachineTorsion>(
            *foundation,
            scene.chuck.component[ChuckComponent::rotation_z].stiffness,
            std::abs(loads.back().angle));
        model = std::move(foundation);
      }
    else if (scene.model == ModelKind::analytical)
      {
        AnalyticalTorsion::Parameters parameters;
        parameters.radius       = R;
        parameters.pressure     = p;
        parameters.linear_limit = given.linear_limit * M_PI / 180.;
        parameters.full_sliding = given.full_sliding * M_PI / 180.;
        parameters.phi_0        = bonding.initial_bonding;
        parameters.friction     = friction;
        if (given.full_sliding < given.linear_limit)
          {
            std::ostringstream why;
            why << "Closed form / Linear limit angle: " << given.linear_limit
                << " deg is more than Full sliding angle, "
                << given.full_sliding << " deg";
            throw InputError(why.str());
          }
        model = std::make_unique<AnalyticalTorsion>(parameters);
      }
    else
      {
        MathieuTorsion::Parameters parameters;
        parameters.radius          = R;
        parameters.pressure        = p;
        parameters.shear_modulus   = given.shear_modulus;
        parameters.adhesion_energy = 1e-3 * given.adhesion_energy; // N/mm
        parameters.friction_stress =
          friction.kind == FrictionLawKind::frictionless ?
            0. :
            friction.mu_broken * p;
        model = std::make_unique<MathieuTorsion>(parameters);
      }
  }



  // The load's angle is that of the machine.
  double
  ClosedFormProblem::angle_of_disk(const Load &load) const
  {
    if (!machine || load.angle == 0.)
      return load.angle;
    return std::copysign(machine->angle(std::abs(load.angle)), load.angle);
  }



  double
  ClosedFormProblem::released_energy(const Load &load) const
  {
    double sum = 0.;
    if (machine)
      for (const auto &jump : machine->jumps())
        if (jump.machine_angle < std::abs(load.angle))
          sum += jump.released_energy;
    return sum;
  }



  TorqueRow
  ClosedFormProblem::row(const unsigned int step)
  {
    const Load  &load = loads[step];
    const double R = scene.implant.radius, area = M_PI * R * R;
    const double p     = pressure(load);
    const double angle = angle_of_disk(load);
    const auto   state = model->state(angle);
    const double c     = model->stick_radius(angle);

    TorqueRow row;
    row.step                 = step;
    row.time                 = load.time;
    row.angle_deg            = angle * 180. / M_PI;
    row.machine_angle_deg    = load.angle * 180. / M_PI;
    row.released_energy_Nmm  = released_energy(load);
    row.torque_Nmm           = state.torque;
    row.force_N              = p * area;
    row.pressure_MPa         = p;
    row.phi_mean             = state.phi_mean;
    row.share_stick          = p > 0. ? c * c / (R * R) : 0.;
    row.share_open           = p > 0. ? 0. : 1.;
    row.share_slip           = 1. - row.share_stick - row.share_open;
    row.energy_interface_Nmm = state.stored_energy;
    row.dissipation_Nmm      = state.dissipation;
    row.adhesive_work_Nmm    = state.adhesive_work;
    row.chuck_reaction       = {{0, 0, -row.force_N, 0, 0, state.torque}};
    row.chuck_position[ChuckComponent::translation_z] =
      scene.chuck.component[ChuckComponent::translation_z].loaded ?
        CurveMeasures::undefined :
        -load.push;
    row.chuck_position[ChuckComponent::rotation_z] = row.angle_deg;
    return row;
  }



  namespace
  {
    /** Work of the torque and how well it is accounted for; the push-in is not
     *  in it, because the model is about the rotation alone. */
    void
    balance_energy(TorqueRow &row, const double angle, EnergyBalance &energy)
    {
      Chuck::Vector6 force = Chuck::Vector6::Zero(), position = force;
      force[ChuckComponent::rotation_z]    = row.torque_Nmm;
      position[ChuckComponent::rotation_z] = angle;
      energy.add(
        force, position, 0., row.energy_interface_Nmm, row.dissipation_Nmm);
      row.work_Nmm            = energy.work();
      row.energy_defect       = energy.defect();
      row.energy_defect_bound = energy.defect_bound();
      row.reaction_defect     = CurveMeasures::undefined;
    }
  } // namespace



  void
  ClosedFormProblem::run()
  {
    const ResultDirectory directory(scene.output, scene.completed_parameters);
    Console               console(scene.output.console, std::cout);
    TorqueCurveWriter     writer(directory);
    ProfileOutput         profiles(scene, directory);
    EnergyBalance         energy;
    const double          seconds_before_steps = clock.wall_time();
    if (!scene.title.empty())
      console.headline(scene.title);
    for (unsigned int step = 0; step < loads.size(); ++step)
      {
        TorqueRow next = row(step);
        balance_energy(next, angle_of_disk(loads[step]), energy);
        torque_rows.push_back(next);
        writer.write(next);
        console.row(next, loads.size() - 1);
        profiles.write(next.angle_deg, *model);
      }
    writer.finish();
    console.warn("profile", profiles.finish());
    warn_of_jumps(console);
    write_summary(directory, profiles, console, seconds_before_steps);
  }



  void
  ClosedFormProblem::warn_of_jumps(Console &console) const
  {
    if (machine)
      for (const auto &jump : machine->jumps())
        if (jump.machine_angle < std::abs(loads.back().angle))
          {
            std::ostringstream text;
            text << "the bond snaps back: at the machine's angle of "
                 << jump.machine_angle * 180. / M_PI
                 << " deg the torque jumps from " << jump.torque_before
                 << " to " << jump.torque_after << " N mm, and "
                 << jump.released_energy
                 << " N mm of stored energy are released without equilibrium";
            console.warn("jump", text.str());
          }
  }



  void
  ClosedFormProblem::write_summary(const ResultDirectory &directory,
                                   const ProfileOutput   &profiles,
                                   Console               &console,
                                   const double seconds_before_steps) const
  {
    const double  wall_seconds = clock.wall_time();
    const double  R            = scene.implant.radius;
    CurveSettings settings;
    settings.contact_area_mm2       = M_PI * R * R;
    settings.mean_phi_0             = scene.output.observed_bonding > 0 ?
                                        scene.output.observed_bonding :
                                        scene.interface.bonding.initial_bonding *
                              scene.interface.bonding.bonded_fraction;
    settings.full_sliding_angle_deg = scene.output.full_sliding_angle;
    if (scene.model == ModelKind::analytical &&
        scene.output.full_sliding_angle == 0.)
      settings.full_sliding_angle_deg = scene.closed_form.full_sliding;
    settings.phase_times = scene.load_steps.times;
    settings.reference   = read_reference_curve(scene.output.reference_curve);

    RunSummary summary;
    summary.measures = measure_torque_curve(torque_rows, settings);
    console.warn("reference",
                 warning_about_reference(summary.measures, settings));
    summary.steps            = torque_rows.size() - 1;
    summary.converged        = true;
    summary.reason           = "all planned steps are done";
    summary.warnings         = console.warnings();
    summary.wall_seconds     = wall_seconds;
    summary.seconds          = {{"before steps", seconds_before_steps},
                                {"stepping", wall_seconds - seconds_before_steps}};
    summary.profile_measures = profiles.measures();
    summary.peak_memory_MB   = peak_memory_MB();
    JsonObject json;
    add_summary(summary, json);
    json.add("normal_stiffness_MPa_per_mm",
             normal_stiffness > 0. ? normal_stiffness :
                                     CurveMeasures::undefined);
    json.add("torsional_stiffness_MPa_per_mm",
             lambda > 0. ? lambda : CurveMeasures::undefined);
    if (machine)
      {
        json.add("jumps", unsigned(machine->jumps().size()));
        json.add("released_energy_Nm", 1e-3 * released_energy(loads.back()));
      }
    write_file(directory.file("summary.json"), json.text());

    std::ostringstream text;
    text << "Largest torque " << summary.measures.T_max_Nmm << " N mm at "
         << summary.measures.theta_max_deg << " deg, at the end "
         << summary.measures.T_inf_Nmm << " N mm. Results are in "
         << directory.path();
    console.headline(text.str());
  }



  void
  ClosedFormProblem::check(std::ostream &out)
  {
    out << "Model " << name_of(scene.model) << ", pressure "
        << model->pressure() << " MPa";
    if (normal_stiffness > 0.)
      out << ", normal stiffness " << normal_stiffness << " MPa/mm";
    if (lambda > 0.)
      out << ", torsional stiffness " << lambda << " MPa/mm";
    out << '\n'
        << loads.size() - 1 << " planned steps from time " << loads.front().time
        << " to " << loads.back().time << '\n'
        << "at the end " << model->torque(angle_of_disk(loads.back()))
        << " N mm\n";
  }
} // namespace Debond
