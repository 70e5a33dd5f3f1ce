#ifndef debond_models_simulation_summary_h
#define debond_models_simulation_summary_h

#include <debond/models/simulation.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace Debond
{
  /** "N degrees of freedom, M of them unknowns, ..." */
  std::string
  unknowns_of(const CoupledSystem &system);

  /** What the measures of a simulation's torque curve refer to. */
  CurveSettings
  curve_settings(const Simulation &simulation, const ReferenceCurve &reference);

  /** What a simulation says of itself; how it ended, and where the time went,
   * is for who ran it. */
  RunSummary
  summary_of(const Simulation &simulation, const CurveSettings &settings);

  /** Adds what a simulation says of bonding and jumps to its summary.json. */
  void
  add_facts(const Simulation &simulation, nlohmann::ordered_json &json);
} // namespace Debond
#endif
