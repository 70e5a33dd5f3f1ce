#include <debond/models/simulation_summary.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace Debond
{
  std::string
  unknowns_of(const CoupledSystem &system)
  {
    const BodyMesh    &bone    = system.bone.mesh();
    const BodyMesh    &implant = system.implant.mesh();
    std::ostringstream text;
    text << bone.n_dofs_as_published() + implant.n_dofs_as_published()
         << " degrees of freedom, " << bone.n_unknowns() + implant.n_unknowns()
         << " of them unknowns, " << system.n_unknowns()
         << " after condensation on the contact surfaces";
    return text.str();
  }



  CurveSettings
  curve_settings(const Simulation &simulation, const ReferenceCurve &reference)
  {
    const Scene            &scene     = simulation.scene;
    const BodyParameters   &implant   = scene.implant;
    const ContactInterface &interface = simulation.system().interface;
    CurveSettings           settings;
    settings.contact_area_mm2 =
      implant.shape == BodyShape::coin ?
        M_PI * implant.radius * implant.radius :
      implant.shape == BodyShape::cap ?
        2. * M_PI * implant.cap_radius * implant.rise() :
        interface.implant_area();
    settings.mean_phi_0             = scene.output.observed_bonding > 0 ?
                                        scene.output.observed_bonding :
                                        interface.bonding().report().mean;
    settings.full_sliding_angle_deg = scene.output.full_sliding_angle;
    settings.phase_times            = scene.load_steps.times;
    settings.reference              = reference;
    return settings;
  }



  RunSummary
  summary_of(const Simulation &simulation, const CurveSettings &settings)
  {
    const CoupledSystem &system = simulation.system();
    const BodyMesh &bone = system.bone.mesh(), &implant = system.implant.mesh();
    RunSummary      summary;
    summary.measures      = measure_torque_curve(simulation.rows(), settings);
    summary.steps         = simulation.effort().steps;
    summary.smallest_step = simulation.effort().shortest_step;
    summary.newton_iterations = simulation.effort().newton_iterations;
    summary.dofs = bone.n_dofs_as_published() + implant.n_dofs_as_published();
    summary.unknowns           = bone.n_unknowns() + implant.n_unknowns();
    summary.condensed_unknowns = system.n_unknowns();
    return summary;
  }



  void
  add_facts(const Simulation &simulation, nlohmann::ordered_json &json)
  {
    const auto &bonding     = simulation.system().interface.bonding().report();
    const auto &released    = simulation.checks().released();
    json["phi_0_mean"]      = bonding.mean;
    json["bonded_area_mm2"] = bonding.bonded_area;
    json["bonded_patches"]  = bonding.patches;
    json["largest_bonded_patch_mm2"] = bonding.largest_patch;
    json["jumps"]                    = released.n_jumps();
    json["released_energy_Nm"]       = 1e-3 * released.total();
  }
} // namespace Debond
