#pragma once

#include <debond/interface/contact_interface.h>
#include <debond/output/bone_strength.h>
#include <debond/scene/scene.h>
#include <debond/system/chuck_path.h>
#include <debond/system/energy_balance.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <string>
#include <utility>

namespace Debond
{
  class CoupledSystem;

  /** What a user has to know about the states that a run has accepted. That
   *  they solve the equations, and are the only solution, was asked before. */
  class StateChecks
  {
  public:
    /** Keeps a reference. @p warn is told of checks that are not passed. */
    StateChecks(const ModelParameters               &parameters,
                std::function<void(const Warning &)> warn);

    /** Notes what the chuck is to do in a step with friction from time @p from
     *  to time @p to, that is about to be accepted as a part of the planned
     *  @p step. Throws InputError if a value in between is not finite. */
    void
    add_motion(unsigned int         step,
               const CoupledSystem &system,
               double               from,
               double               to);

    /** A phase of the load begins with the last state. */
    void
    begin_phase()
    {
      energy_balance.begin_phase();
    }

    /** Notes a state that has just been accepted in a planned step. @p summary
     *  and @p reaction_defect are those of the state before commit(). A check
     *  that it does not pass is a warning, and counts in the next row. */
    void
    add(unsigned int            step,
        const CoupledSystem    &system,
        const InterfaceSummary &summary,
        double                  reaction_defect);

    /** Warns, at the end of the run, in its last state, of linear bodies with
     *  large strains. Asks also where tractions are small @p in_any_case. */
    void
    judge_strains(const CoupledSystem &system, bool in_any_case);
    /** Relative change of displacements that large strains would make. */
    double
    change_at_large_strains() const
    {
      return std::max(change_at_strains[0], change_at_strains[1]);
    }

    const EnergyBalance &
    energy() const
    {
      return energy_balance;
    }
    const ReleasedEnergy &
    released() const
    {
      return released_energy;
    }
    const BeyondStrength &
    beyond_strength() const
    {
      return beyond;
    }
    /** How many checks were not passed by a state since the last call. */
    unsigned int
    take_violations()
    {
      return std::exchange(violated, {}).size();
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &energy_balance &released_energy &path;
      for (ControlNet &displacement : judged_displacement)
        archive &displacement;
      archive &change_at_strains;
      if (Archive::is_loading::value) // between rows there are none
        violated.clear();
    }

  private:
    void
    note(unsigned int step, const std::string &check, const std::string &text);
    void
    ask_for_strains(const CoupledSystem &system, double max_traction);

    const ModelParameters                     &parameters;
    const std::function<void(const Warning &)> warn;
    EnergyBalance                              energy_balance;
    ReleasedEnergy                             released_energy;
    ChuckPath                                  path;
    /** Of the faces, by side, where ask_for_strains() last asked [mm]. */
    std::array<ControlNet, 2> judged_displacement;
    /** The largest Body::change_at_large_strains(), by side. */
    std::array<double, 2> change_at_strains{{0., 0.}};
    std::set<std::string> violated; ///< since the last row
    BeyondStrength        beyond;   ///< of the last state
  };
} // namespace Debond
