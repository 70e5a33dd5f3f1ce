#include <debond/models/closed_form_solution.h>
#include <debond/models/foundation.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/system/energy_balance.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace Debond
{
  namespace
  {
    constexpr double  degree      = M_PI / 180.;
    const char *const more_can_do = " (Model = finite elements can do more)";
    constexpr auto    push        = ChuckComponent::translation_z;
    constexpr auto    twist       = ChuckComponent::rotation_z;



    void
    refuse_if(const bool         is_so,
              const std::string &entry,
              const std::string &why)
    {
      if (is_so)
        throw EntryError(entry, why + more_can_do);
    }

    void
    check_scene_is_simple(const Scene &scene)
    {
      const BondingParameters &bonding = scene.interface.bonding;
      const bool is_foundation         = scene.model == ModelKind::foundation;
      refuse_if(!scene.implant.geometry().has_closed_forms,
                "Implant / Shape",
                "closed forms are for the flat disk of a coin");
      const auto pattern = scene.interface.bonding_of_law().pattern;
      refuse_if(pattern != BondingPatternKind::homogeneous &&
                  !(pattern == BondingPatternKind::disk && is_foundation),
                "Interface / Bonding / Pattern",
                std::string("this closed form knows homogeneous bonding ") +
                  (is_foundation ? "and the disk only" : "only"));
      refuse_if(scene.model == ModelKind::crack && bonding.initial_bonding != 1,
                "Interface / Bonding / Bonding degree",
                "this closed form knows a fully bonded surface only");
      const InterfaceParameters &interface = scene.interface;
      const BoneLayer           &bone      = interface.bone_layer;
      for (const auto &[is_set, entry] :
           {std::pair(interface.law_choice.law != "friction", "Law"),
            {interface.pressure_dependence.exponent != 1., "Friction exponent"},
            {!interface.pressure_dependence.is_none(),
             "Friction over pressure"},
            {bone.crushes(), "Crushing strength"},
            {bone.shears(), "Bone shear strength"}})
        refuse_if(is_set,
                  std::string("Interface / ") + entry,
                  "closed forms know friction in proportion to the pressure, "
                  "without strength in tension, on bone that bears all, only");
      refuse_if(scene.interface.viscosity != 0,
                "Interface / Viscosity",
                "closed forms do not depend on the rate");
      refuse_if(scene.interface.explicit_friction,
                "Expert / Friction update",
                "closed forms have no steps to lag behind by");
      refuse_if(scene.chuck.point != "auto",
                "Chuck / Point",
                "closed forms turn the coin about its axis: expected auto");
      for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
        {
          const ChuckComponentParameters &component = scene.chuck.component[k];
          refuse_if(component.loaded && k != push,
                    scene.chuck.entry_name(k, "Control"),
                    "closed forms take this motion as prescribed");
          refuse_if(component.stiffness != 0 && !(k == twist && is_foundation),
                    scene.chuck.entry_name(k, "Stiffness"),
                    "closed forms have no compliant machine, but that the "
                    "foundation's Rotation z may be driven by one");
        }
    }



    struct Load
    {
      double time  = 0;
      double push  = 0; ///< depth [mm] or force [N], positive downwards
      double angle = 0; ///< [rad]
    };

    /** What the scene prescribes, at the ends of the rows. */
    struct LoadHistory
    {
      const Scene      &scene;
      const Chuck       chuck;
      std::vector<Load> loads;

      explicit LoadHistory(const Scene &scene)
        : scene(scene)
        , chuck(scene.chuck, Eigen::Vector3d::Zero(), scene.implant.radius)
      {
        // expressions may do anything between the rows
        for (const auto &times : {scene.load_steps.sample_times(),
                                  scene.load_steps.planned_times()})
          {
            loads.clear();
            for (const double time : times)
              loads.push_back(at(time));
            check();
          }
      }

      Load
      at(const double time) const
      {
        const Chuck::Vector6 q = chuck.values(time);
        for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
          refuse_if(
            k != push && k != twist && q[k] != 0.,
            scene.chuck.entry_name(k, "Value"),
            "closed forms know Press (or Translation z) and Rotation z only");
        return {time, -q[push], q[twist]};
      }

      void
      check() const
      {
        const Load &last = loads.back();
        refuse_if(loads.front().angle != 0.,
                  scene.chuck.entry_name(twist, "Value"),
                  "closed forms begin with an angle of zero");
        double largest_push = 0.;
        for (const Load &load : loads)
          largest_push = std::max(largest_push, std::abs(load.push));
        for (std::size_t i = 1; i < loads.size(); ++i)
          {
            const Load &begin = loads[i - 1], &end = loads[i];
            refuse_if((end.angle - begin.angle) * (last.angle < 0. ? -1. : 1.) <
                        0.,
                      scene.chuck.entry_name(twist, "Value"),
                      "closed forms know no rotation that reverses");
            if (end.angle == 0.)
              continue;
            refuse_if(std::abs(end.push - begin.push) > 1e-9 * largest_push,
                      scene.chuck.entry_name(push, "Value"),
                      "closed forms know no push-in that changes while it "
                      "turns");
            refuse_if(!scene.has_friction_after(begin.time),
                      "Interface / Friction starts at",
                      "closed forms know no rotation without friction before "
                      "one with friction");
          }
      }

      // With adaptive steps: halves steps until the curve drawn as straight
      // lines keeps the tolerance at the quarters of each of them.
      void
      refine(const std::function<double(const Load &)> &torque)
      {
        double T_max = 0.;
        for (const Load &load : loads)
          T_max = std::max(T_max, std::abs(torque(load)));
        const double smallest = scene.load_steps.smallest_step_fraction *
                                (loads.back().time - loads.front().time) /
                                loads.size();
        // the last one comes next
        std::vector<Load> to_come(loads.rbegin(), loads.rend() - 1);
        loads.resize(1);
        while (!to_come.empty())
          {
            const Load  &begin = loads.back(), &end = to_come.back();
            const double duration = end.time - begin.time;
            const double turned   = end.angle - begin.angle;
            const double T_begin = torque(begin), T_end = torque(end);
            double       error = 0.;
            for (const double part : {0.25, 0.5, 0.75})
              {
                const Load   load = at(begin.time + part * duration);
                const double share =
                  turned == 0. ? 0. : (load.angle - begin.angle) / turned;
                error = std::max(error,
                                 std::abs(torque(load) - T_begin -
                                          share * (T_end - T_begin)));
              }
            if (error > 0.5 * scene.load_steps.tolerance * T_max &&
                duration > 2. * smallest)
              to_come.push_back(at(0.5 * (begin.time + end.time)));
            else
              {
                loads.push_back(end);
                to_come.pop_back();
              }
          }
      }
    };



    /** Sets the stiffness of the foundation: that of the scene or, where the
     *  model needs what the scene does not say, that of its bodies. */
    void
    find_stiffness(ClosedFormSolution &solution)
    {
      const Scene                &scene = solution.scene;
      const ClosedFormParameters &given = scene.closed_form;
      double &normal = solution.normal_stiffness = given.normal_stiffness;
      double &torsional = solution.torsional_stiffness =
        given.torsional_stiffness;
      if (!scene.asks_bodies())
        return;
      const FoundationStiffness bodies = foundation_stiffness(scene);
      if (normal == 0.)
        normal = bodies.normal;
      if (torsional == 0.)
        torsional = bodies.torsional;
    }



    /** p [MPa] under a @p load, of which the @p last one is that of the
     *  rotation. */
    double
    pressure_under(const Scene &scene,
                   const double normal_stiffness,
                   const Load  &load,
                   const Load  &last)
    {
      const double prescribed = scene.closed_form.pressure;
      if (prescribed > 0. && last.push <= 0.)
        return prescribed;
      return std::max(0.,
                      prescribed > 0. ?
                        prescribed * load.push / last.push :
                      scene.chuck.component[push].loaded ?
                        load.push / (M_PI * std::pow(scene.implant.radius, 2)) :
                        load.push * normal_stiffness);
    }



    /** The disk under a pressure [MPa], on a foundation with this torsional
     *  stiffness [MPa/mm]. */
    TorsionModel::Disk
    make_disk(const Scene &scene, const double pressure, const double stiffness)
    {
      const BondingParameters bonding = scene.interface.bonding_of_law();
      TorsionModel::Disk      disk;
      disk.radius    = scene.implant.radius;
      disk.pressure  = pressure;
      disk.stiffness = stiffness;
      disk.phi_0     = bonding.initial_bonding;
      disk.friction  = scene.interface.friction;
      if (bonding.pattern == BondingPatternKind::disk)
        disk.bonded_radius = disk.radius * std::sqrt(bonding.bonded_fraction);
      refuse_if(!(disk.pressure > 0.),
                scene.chuck.entry_name(push, "Value"),
                "closed forms need pressure while they turn");
      return disk;
    }



    void
    refuse_jumps(const TorsionModel::Disk &disk)
    {
      refuse_if(!RigidBodiesTorsion::has_unique_solution(disk),
                "Interface / Friction law",
                "the law softens faster than the foundation is stiff, so "
                "that the traction would jump. What helps: a larger " +
                  disk.friction->entries_against_fall);
    }



    std::unique_ptr<TorsionModel>
    make_model(const ClosedFormSolution &solution, const double final_pressure)
    {
      const Scene                &scene = solution.scene;
      const ClosedFormParameters &given = scene.closed_form;
      const TorsionModel::Disk    disk =
        make_disk(scene, final_pressure, solution.torsional_stiffness);
      if (scene.model == ModelKind::foundation)
        {
          refuse_jumps(disk);
          return std::make_unique<RigidBodiesTorsion>(disk);
        }
      if (scene.model == ModelKind::crack)
        return crack_torsion(disk,
                             given.shear_modulus,
                             1e-3 * given.adhesion_energy, // N/mm
                             disk.limit(0.).value);
      if (given.full_sliding < given.linear_limit)
        throw EntryError("Closed form / Linear limit angle",
                         "it is more than Slip counts from angle, " +
                           to_text(given.full_sliding) + " deg");
      return prescribed_angles_torsion(disk,
                                       given.linear_limit * degree,
                                       given.full_sliding * degree);
    }



    /** @p p: the pressure [MPa], @p angle: of the disk [rad], where the load's
     *  is that of the machine. */
    TorqueRow
    make_row(const ClosedFormSolution &solution,
             const Load               &load,
             const double              p,
             const double              angle)
    {
      const auto   state = solution.model->state(angle);
      const double R     = solution.scene.implant.radius;
      TorqueRow    row;
      row.step              = solution.rows.size();
      row.time              = load.time;
      row.angle_deg         = angle / degree;
      row.machine_angle_deg = load.angle / degree;
      row.torque_Nmm        = state.torque;
      row.force_N           = p * M_PI * R * R;
      row.pressure_MPa      = p;
      row.phi_mean          = state.phi_mean;
      row.share_stick =
        p > 0. ? std::pow(solution.model->stick_radius(angle) / R, 2) : 0.;
      row.share_open           = p > 0. ? 0. : 1.;
      row.share_slip           = 1. - row.share_stick - row.share_open;
      row.energy_interface_Nmm = state.stored_energy;
      row.dissipation_Nmm      = state.dissipation;
      row.adhesive_work_Nmm    = state.adhesive_work;
      row.reaction_defect      = TorsionModel::undefined;
      row.chuck_reaction << 0, 0, -row.force_N, 0, 0, state.torque;
      row.chuck_position[push]  = solution.scene.chuck.component[push].loaded ?
                                    TorsionModel::undefined :
                                    -load.push;
      row.chuck_position[twist] = row.angle_deg;
      row.machine_uz_mm         = row.chuck_position[push];
      for (const auto &jump : solution.jumps)
        if (jump.machine_angle < std::abs(load.angle))
          row.released_energy_Nmm += jump.released_energy;
      return row;
    }
  } // namespace



  std::string
  why_no_closed_form(const Scene &scene)
  {
    if (scene.bone.modulus)
      return "Young's modulus of the bone varies";
    if (scene.interface.friction->depends_on_rate)
      return "friction depends on the sliding speed";
    try
      {
        check_scene_is_simple(scene);
        const LoadHistory history(scene);
        const Load        last = history.loads.back();
        const bool is_pressed  = pressure_under(scene, 1., last, last) > 0.;
        return last.angle == 0. ? "nothing turns" :
               !is_pressed      ? "nothing presses the coin while it turns" :
                                  "";
      }
    catch (const EntryError &error)
      {
        return error.why.substr(0, error.why.find(more_can_do));
      }
  }



  TorsionModel::Disk
  foundation_disk(const Scene &scene,
                  const double normal_stiffness,
                  const double torsional_stiffness)
  {
    const Chuck::Vector6 q =
      Chuck(scene.chuck, Eigen::Vector3d::Zero(), scene.implant.radius)
        .values(scene.load_steps.times.back());
    const Load last{scene.load_steps.times.back(), -q[push], q[twist]};
    const TorsionModel::Disk disk =
      make_disk(scene,
                pressure_under(scene, normal_stiffness, last, last),
                torsional_stiffness);
    refuse_jumps(disk);
    return disk;
  }



  ClosedFormSolution::ClosedFormSolution(const Scene &given)
    : scene(given)
  {
    check_scene_is_simple(scene);
    LoadHistory history(scene);
    find_stiffness(*this);
    const Load   last          = history.loads.back();
    const double largest_angle = std::abs(last.angle);
    const auto   pressure_at   = [&](const Load &load) {
      return pressure_under(scene, normal_stiffness, load, last);
    };
    model = make_model(*this, pressure_at(last));

    // A compliant machine turns further than the disk, and may jump.
    std::optional<CompliantMachineTorsion> machine;
    if (const double k = scene.chuck.component[twist].stiffness; k > 0.)
      machine.emplace(*model, k, largest_angle);
    if (machine)
      for (const auto &jump : machine->jumps)
        if (jump.machine_angle < largest_angle)
          jumps.push_back(jump);
    const auto angle_of_disk = [&](const Load &load) {
      return machine && load.angle != 0. ?
               std::copysign(machine->angle(std::abs(load.angle)), load.angle) :
               load.angle;
    };
    if (scene.load_steps.adaptive)
      history.refine(
        [&](const Load &load) { return model->torque(angle_of_disk(load)); });

    // The work is that of the torque alone: the model is about the rotation,
    // and the push-in is not in it.
    EnergyBalance energy;
    for (const Load &load : history.loads)
      {
        const double angle = angle_of_disk(load);
        TorqueRow    row   = make_row(*this, load, pressure_at(load), angle);
        energy.add({row.torque_Nmm * Chuck::Vector6::Unit(twist),
                    angle * Chuck::Vector6::Unit(twist),
                    row.energy_interface_Nmm,
                    row.dissipation_Nmm});
        row.work_Nmm            = energy.work();
        row.energy_defect       = energy.defect();
        row.energy_defect_bound = energy.defect_bound();
        rows.push_back(row);
      }
  }
} // namespace Debond
