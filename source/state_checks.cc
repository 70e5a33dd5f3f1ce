#include <debond/console.h>
#include <debond/coupled_system.h>
#include <debond/state_checks.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Debond
{
  StateChecks::StateChecks(const Scene &scene, Console &console)
    : scene(scene)
    , console(console)
  {}



  void
  StateChecks::add(const unsigned int               step,
                   const CoupledSystem             &system,
                   const ContactInterface::Summary &summary,
                   const double                     reaction_defect)
  {
    last_reaction_defect = reaction_defect;
    energy_balance.add(system.chuck_forces(),
                       system.chuck.position(),
                       system.bone.energy() + system.implant.energy(),
                       summary.energy,
                       system.interface.dissipation());
    const std::string where = "step " + std::to_string(step) + ": ";
    // the explicit law does not spend what friction_work() says
    if (!scene.interface.explicit_friction)
      check_for_jump(where, system, summary);
    check_interface(where, system, summary);
    check_reaction(where);
    check_energy_balance(where, system.interface.step_dissipation());
  }



  unsigned int
  StateChecks::take_violations()
  {
    const unsigned int n = violated.size();
    violated.clear();
    return n;
  }



  void
  StateChecks::note_violation(const std::string &check, const std::string &text)
  {
    console.warn(check, text);
    violated.insert(check);
  }



  // Whether the state just accepted is on another branch of equilibrium.
  void
  StateChecks::check_for_jump(const std::string               &where,
                              const CoupledSystem             &system,
                              const ContactInterface::Summary &summary)
  {
    const ContactInterface &interface = system.interface;
    ReleasedEnergy::State   now;
    now.forces   = system.chuck_forces();
    now.position = system.chuck.machine_position();
    now.stored   = system.chuck.machine_energy() + system.bone.energy() +
                 system.implant.energy() + summary.energy;
    now.spent             = interface.friction_work();
    now.bound             = interface.friction_work_bound();
    const double released = released_energy.add(now);
    if (released > 0.)
      {
        std::ostringstream text;
        text << where << "in one step the torque went from " << last_torque
             << " to " << now.forces[5] << " N mm, and " << released
             << " N mm of stored energy were released without equilibrium: the "
                "load cannot be followed there, the state jumped to another "
                "branch. Load steps / Path following = slip follows the path "
                "between";
        note_violation("jump", text.str());
      }
    last_torque = now.forces[5];
  }



  namespace
  {
    // Beyond that a point may find no partner, or the wrong one [mm].
    double
    deepest_penetration(const Scene &scene, const CoupledSystem &system)
    {
      double smallest =
        0.1 * std::min(scene.bone.thickness(), scene.implant.thickness());
      const auto   n    = system.implant.surface().n_elements();
      const double area = system.interface.implant_area();
      return std::min(smallest, std::sqrt(area / n));
    }
  } // namespace



  void
  StateChecks::check_interface(const std::string               &where,
                               const CoupledSystem             &system,
                               const ContactInterface::Summary &summary)
  {
    if (summary.bonded_opened > 0)
      note_violation(
        "opening",
        where + "bonded points open (" + std::to_string(summary.bonded_opened) +
          "): the law has no strength in tension, so that pulling costs nothing" +
          (scene.interface.opening_breaks_bond ?
             "" :
             ", and points that close again are "
             "bonded as before"));
    const double too_deep = deepest_penetration(scene, system);
    if (summary.max_penetration > too_deep)
      {
        std::ostringstream text;
        text << where << "the bodies penetrate each other by "
             << summary.max_penetration << " mm, more than " << too_deep
             << " mm, a tenth of the thinner one or a whole surface element: "
                "lengths are mm, is the push-in right?";
        note_violation("penetration", text.str());
      }
    if (system.interface.n_unprojected() > 0)
      note_violation("projection",
                     where + "for " +
                       std::to_string(system.interface.n_unprojected()) +
                       " open points no closest point of the other surface was "
                       "found: they stay open");
  }



  void
  StateChecks::check_reaction(const std::string &where)
  {
    if (last_reaction_defect > 1e-6)
      {
        std::ostringstream text;
        text
          << where
          << "contact forces and the reaction of the implant's top differ by "
          << last_reaction_defect << " of the larger";
        note_violation("reaction", text.str());
      }
  }



  void
  StateChecks::check_energy_balance(const std::string &where,
                                    const double       step_dissipation)
  {
    if (energy_balance.dissipates_too_much())
      note_violation("dissipation",
                     where +
                       "more energy is dissipated than was put in: the steps "
                       "are too large for the energy balance to be trusted");
    if (energy_balance.is_given_back(step_dissipation))
      note_violation("dissipation falls",
                     where + "sliding gives energy back: points slide along "
                             "their traction instead of against it");
    if (energy_balance.is_out_of_balance())
      {
        std::ostringstream text;
        text << where << "of the chuck's work, " << energy_balance.defect()
             << " of its largest value is neither stored nor dissipated; the "
                "size of the steps accounts for "
             << energy_balance.defect_bound();
        note_violation("energy balance", text.str());
      }
  }



  std::string
  describe_softening(const ContactInterface::Summary &summary)
  {
    const double       slope = summary.softening_slope;
    std::ostringstream text;
    text << "the friction law softens faster than the interface is stiff, so "
            "that its local solution is not unique and the bond would break "
            "in a jump: at a pressure of p = "
         << summary.softening_pressure
         << " MPa the stiffness eps_t (with Viscosity: and eta over the "
            "step's duration) makes p / eps_t = "
         << summary.steepest_softening / slope
         << " mm, and less than 1 / |d mu/d g_s| = " << 1. / slope
         << " mm has one solution. What helps: Interface / Viscosity, a "
            "larger Interface / Tangential penalty stiffness, a larger "
            "Sliding threshold or Transition factor";
    return text.str();
  }
} // namespace Debond
