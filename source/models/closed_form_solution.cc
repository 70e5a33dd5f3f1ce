#include <debond/models/closed_form_solution.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/system/energy_balance.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  std::string
  name_of_closed_form(const ModelKind model)
  {
    return model == ModelKind::foundation ? "foundation" :
           model == ModelKind::analytical ? "analytical" :
                                            "mathieu";
  }



  namespace
  {
    constexpr double degree = M_PI / 180.;
    constexpr auto   push   = ChuckComponent::translation_z;
    constexpr auto   twist  = ChuckComponent::rotation_z;



    [[noreturn]] void
    refuse(const Scene &scene, const std::string &entry, const std::string &why)
    {
      throw EntryError(entry,
                       why + " (Model = " + name_of_closed_form(scene.model) +
                         "; Model = finite elements can do more)");
    }



    void
    check_scene_is_simple(const Scene &scene)
    {
      const BondingParameters &bonding   = scene.interface.bonding;
      const auto               refuse_if = [&](const bool         is_so,
                                 const std::string &entry,
                                 const std::string &why) {
        if (is_so)
          refuse(scene, entry, why);
      };
      const bool is_foundation = scene.model == ModelKind::foundation;
      refuse_if(scene.implant.shape != BodyShape::coin,
                "Implant / Shape",
                "closed forms are for the flat disk of a coin");
      refuse_if(bonding.pattern != BondingPatternKind::homogeneous &&
                  !(bonding.pattern == BondingPatternKind::disk &&
                    is_foundation),
                "Interface / Bonding / Pattern",
                std::string("this closed form knows homogeneous bonding ") +
                  (is_foundation ? "and the disk only" : "only"));
      refuse_if(scene.model == ModelKind::mathieu &&
                  bonding.initial_bonding != 1,
                "Interface / Bonding / Initial bonding",
                "this closed form knows a fully bonded surface only");
      refuse_if(scene.interface.viscosity != 0,
                "Interface / Viscosity",
                "closed forms do not depend on the rate");
      refuse_if(scene.interface.explicit_friction,
                "Interface / Friction update",
                "closed forms have no steps to lag behind by");
      for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
        {
          const ChuckComponentParameters &component = scene.chuck.component[k];
          refuse_if(component.loaded && k != push,
                    ChuckParameters::entry_name(k, "Control"),
                    "closed forms take this motion as prescribed");
          refuse_if(component.stiffness != 0 && !(k == twist && is_foundation),
                    ChuckParameters::entry_name(k, "Stiffness"),
                    "closed forms have no compliant machine, but that the "
                    "foundation's Rotation z may be driven by one");
        }
    }
  } // namespace



  ClosedFormSolution::ClosedFormSolution(const Scene &scene)
    : scene(scene)
  {
    check_scene_is_simple(scene);
    for (const double time : scene.load_steps.planned_times())
      loads.push_back(load_at(time));
    check_loads();
    find_stiffness();
    make_model();
    if (scene.load_steps.adaptive)
      refine_loads();
    add_rows();
  }



  ClosedFormSolution::Load
  ClosedFormSolution::load_at(const double time) const
  {
    const Chuck          chuck(scene.chuck,
                      Eigen::Vector3d::Zero(),
                      scene.implant.radius);
    const Chuck::Vector6 q = chuck.values(time);
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      if (k != push && k != twist && q[k] != 0.)
        refuse(scene,
               ChuckParameters::entry_name(k, "Value"),
               "closed forms know Translation z and Rotation z only");
    return {time, -q[push], q[twist]};
  }



  void
  ClosedFormSolution::check_loads() const
  {
    const std::string pushed = ChuckParameters::entry_name(push, "Value"),
                      turned = ChuckParameters::entry_name(twist, "Value");
    if (loads.front().angle != 0.)
      refuse(scene, turned, "closed forms begin with an angle of zero");
    double largest_push = 0.;
    for (const Load &load : loads)
      largest_push = std::max(largest_push, std::abs(load.push));
    const double last_without_friction =
      scene.interface.friction_starts_at -
      1e-9 * (loads.back().time - loads.front().time);
    for (std::size_t i = 1; i < loads.size(); ++i)
      {
        const Load &begin = loads[i - 1], &end = loads[i];
        if ((end.angle - begin.angle) * (loads.back().angle < 0. ? -1. : 1.) <
            0.)
          refuse(scene, turned, "closed forms know no rotation that reverses");
        if (end.angle == 0.)
          continue;
        if (std::abs(end.push - begin.push) > 1e-9 * largest_push)
          refuse(scene,
                 pushed,
                 "closed forms know no push-in that changes while it turns");
        if (begin.time < last_without_friction)
          refuse(scene,
                 "Interface / Friction starts at",
                 "closed forms know no rotation without friction before one "
                 "with friction");
      }
  }



  // With adaptive steps: halves steps until the curve drawn as straight lines
  // keeps the tolerance at the quarters of each of them.
  void
  ClosedFormSolution::refine_loads()
  {
    const auto torque = [&](const Load &load) {
      return torsion->torque(angle_of_disk(load));
    };
    double T_max = 0.;
    for (const Load &load : loads)
      T_max = std::max(T_max, std::abs(torque(load)));
    const double smallest = scene.load_steps.smallest_step_fraction *
                            (loads.back().time - loads.front().time) /
                            loads.size();
    std::vector<Load> refined{loads.front()};
    std::vector<Load> to_come(loads.rbegin(), loads.rend() - 1); // next: last
    while (!to_come.empty())
      {
        const Load  &begin = refined.back(), &end = to_come.back();
        const double duration = end.time - begin.time;
        const double turned   = end.angle - begin.angle;
        const double T_begin = torque(begin), T_end = torque(end);
        double       error = 0.;
        for (const double part : {0.25, 0.5, 0.75})
          {
            const Load   load = load_at(begin.time + part * duration);
            const double share =
              turned == 0. ? 0. : (load.angle - begin.angle) / turned;
            error = std::max(error,
                             std::abs(torque(load) - T_begin -
                                      share * (T_end - T_begin)));
          }
        if (error > 0.5 * scene.load_steps.tolerance * T_max &&
            duration > 2. * smallest)
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
  ClosedFormSolution::find_stiffness()
  {
    const ClosedFormParameters &given = scene.closed_form;
    normal_stiffness                  = given.normal_stiffness;
    torsional_stiffness               = given.torsional_stiffness;
    const bool needs_normal = normal_stiffness == 0. && given.pressure == 0. &&
                              !scene.chuck.component[push].loaded;
    const bool needs_torsional =
      torsional_stiffness == 0. && scene.model == ModelKind::foundation;
    if (!needs_normal && !needs_torsional)
      return;
    linear_solution = foundation_stiffness(scene);
    if (normal_stiffness == 0.)
      normal_stiffness = linear_solution.normal;
    if (torsional_stiffness == 0.)
      torsional_stiffness = linear_solution.torsional;
  }



  double
  ClosedFormSolution::pressure(const Load &load) const
  {
    const double given = scene.closed_form.pressure, R = scene.implant.radius;
    const double final_push = loads.back().push;
    if (given > 0.)
      return final_push > 0. ? given * std::max(0., load.push) / final_push :
                               given;
    return std::max(0.,
                    scene.chuck.component[push].loaded ?
                      load.push / (M_PI * R * R) :
                      load.push * normal_stiffness);
  }



  void
  ClosedFormSolution::make_model()
  {
    const ClosedFormParameters &given = scene.closed_form;
    TorsionModel::Disk          disk;
    disk.radius   = scene.implant.radius;
    disk.pressure = pressure(loads.back());
    disk.phi_0    = scene.interface.bonding.initial_bonding;
    disk.friction = scene.interface.friction;
    if (!(disk.pressure > 0.))
      refuse(scene,
             ChuckParameters::entry_name(push, "Value"),
             "closed forms need pressure while they turn");

    if (scene.model == ModelKind::foundation)
      torsion = make_foundation(disk);
    else if (scene.model == ModelKind::analytical)
      {
        if (given.full_sliding < given.linear_limit)
          throw EntryError("Closed form / Linear limit angle",
                           "it is more than Full sliding angle, " +
                             to_text(given.full_sliding) + " deg");
        torsion =
          std::make_unique<AnalyticalTorsion>(disk,
                                              given.linear_limit * degree,
                                              given.full_sliding * degree);
      }
    else
      torsion =
        std::make_unique<MathieuTorsion>(disk,
                                         given.shear_modulus,
                                         1e-3 * given.adhesion_energy, // N/mm
                                         disk.pressure *
                                           disk.friction->mu_without_bond());
  }



  std::unique_ptr<TorsionModel>
  ClosedFormSolution::make_foundation(const TorsionModel::Disk &disk)
  {
    const BondingParameters       &bonding = scene.interface.bonding;
    RigidBodiesTorsion::Parameters parameters{disk, torsional_stiffness};
    if (bonding.pattern == BondingPatternKind::disk)
      parameters.bonded_radius =
        disk.radius * std::sqrt(bonding.bonded_fraction);
    if (!RigidBodiesTorsion::has_unique_solution(parameters))
      refuse(scene,
             "Interface / Sliding threshold",
             "the friction law softens faster than the foundation is "
             "stiff, so that the traction would jump");
    auto         foundation = std::make_unique<RigidBodiesTorsion>(parameters);
    const double stiffness  = scene.chuck.component[twist].stiffness;
    if (stiffness > 0.)
      machine =
        std::make_unique<CompliantMachineTorsion>(*foundation,
                                                  stiffness,
                                                  std::abs(loads.back().angle));
    return foundation;
  }



  double
  ClosedFormSolution::angle_of_disk(const Load &load) const
  {
    if (!machine || load.angle == 0.)
      return load.angle;
    return std::copysign(machine->angle(std::abs(load.angle)), load.angle);
  }



  std::vector<CompliantMachineTorsion::Jump>
  ClosedFormSolution::jumps() const
  {
    std::vector<CompliantMachineTorsion::Jump> done;
    if (machine)
      for (const auto &jump : machine->jumps())
        if (jump.machine_angle < std::abs(loads.back().angle))
          done.push_back(jump);
    return done;
  }



  TorqueRow
  ClosedFormSolution::row(const unsigned int step) const
  {
    const Load  &load = loads[step];
    const double p = pressure(load), angle = angle_of_disk(load);
    const auto   state       = torsion->state(angle);
    const double R           = scene.implant.radius;
    const double stick_share = std::pow(torsion->stick_radius(angle) / R, 2);

    TorqueRow row;
    row.step                 = step;
    row.time                 = load.time;
    row.angle_deg            = angle / degree;
    row.machine_angle_deg    = load.angle / degree;
    row.torque_Nmm           = state.torque;
    row.force_N              = p * M_PI * R * R;
    row.pressure_MPa         = p;
    row.phi_mean             = state.phi_mean;
    row.share_stick          = p > 0. ? stick_share : 0.;
    row.share_open           = p > 0. ? 0. : 1.;
    row.share_slip           = 1. - row.share_stick - row.share_open;
    row.energy_interface_Nmm = state.stored_energy;
    row.dissipation_Nmm      = state.dissipation;
    row.adhesive_work_Nmm    = state.adhesive_work;
    row.reaction_defect      = TorsionModel::undefined;
    row.chuck_reaction       = {{0, 0, -row.force_N, 0, 0, state.torque}};
    row.chuck_position[push] =
      scene.chuck.component[push].loaded ? TorsionModel::undefined : -load.push;
    row.chuck_position[twist] = row.angle_deg;
    for (const auto &jump : jumps())
      if (jump.machine_angle < std::abs(load.angle))
        row.released_energy_Nmm += jump.released_energy;
    return row;
  }



  // The work is that of the torque alone: the model is about the rotation, and
  // the push-in is not in it.
  void
  ClosedFormSolution::add_rows()
  {
    EnergyBalance energy;
    for (unsigned int step = 0; step < loads.size(); ++step)
      {
        TorqueRow   next = row(step);
        EnergyState state;
        state.forces[twist]   = next.torque_Nmm;
        state.position[twist] = angle_of_disk(loads[step]);
        state.stored          = next.energy_interface_Nmm;
        state.dissipated      = next.dissipation_Nmm;
        energy.add(state);
        next.work_Nmm            = energy.work();
        next.energy_defect       = energy.defect();
        next.energy_defect_bound = energy.defect_bound();
        all_rows.push_back(next);
      }
  }
} // namespace Debond
