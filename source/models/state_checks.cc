#include <debond/models/state_checks.h>
#include <debond/system/step_solver.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Debond
{
  StateChecks::StateChecks(const ModelParameters &parameters)
    : parameters(parameters)
    , path(parameters.chuck)
  {}



  void
  StateChecks::add(const unsigned int      step,
                   const CoupledSystem    &system,
                   const InterfaceSummary &summary,
                   const double            reaction_defect)
  {
    const bool        is_first = !energy_balance.has_state();
    const EnergyState before   = energy_balance.state();
    last_reaction_defect       = reaction_defect;
    energy_balance.add({system.chuck_forces(),
                        system.chuck.position(),
                        system.bulk_energy() + summary.energy,
                        system.interface.work().dissipation});
    const std::string where = "step " + std::to_string(step) + ": ";
    // the explicit law does not dissipate what InterfaceWork::friction says
    if (!parameters.interface.explicit_friction)
      check_for_jump(where, before.forces, system, summary);
    check_interface(where, system, summary);
    if (!is_first)
      check_turn(where,
                 (system.chuck.position() - before.position).tail<3>().norm());
    check_reaction(where);
    check_energy_balance(where, system.interface.work().step_dissipation);
  }



  // What slides does so by less than it should.
  void
  StateChecks::add_path(const unsigned int step,
                        const Chuck       &chuck,
                        const double       from,
                        const double       to)
  {
    path.add(chuck, from, to);
    if (path.missed_share() > ChuckPath::largest_missed_share)
      note_violation("way",
                     "step " + std::to_string(step) +
                       ": steps go straight from state to state, and have "
                       "missed " +
                       path.describe() +
                       " so far: what turns back or goes along a curve needs "
                       "shorter steps, or Load steps / Times where it turns");
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
    found.push_back({check, text});
    violated.insert(check);
  }



  namespace
  {
    /** What happened to the force that changed most, moments being forces at
     *  the distance @p R. */
    std::string
    describe_change(const Chuck::Vector6 &from,
                    const Chuck::Vector6 &to,
                    const double          R)
    {
      const char    *names[] = {"Fx", "Fy", "Fz", "Mx", "My", "the torque"};
      Chuck::Vector6 change  = (to - from).cwiseAbs();
      change.tail<3>() /= R;
      Eigen::Index k;
      change.maxCoeff(&k);
      std::ostringstream text;
      text << names[k] << " went from " << from[k] << " to " << to[k]
           << (is_rotation(k) ? " N mm" : " N");
      return text.str();
    }



    /** Whether anything but the interface stores energy; what that does is
     *  judged point by point (InterfaceSummary::steepest_softening).
     */
    bool
    can_jump(const ModelParameters &parameters, const CoupledSystem &system)
    {
      return parameters.bone.material != Material::rigid ||
             parameters.implant.material != Material::rigid ||
             system.chuck.has_compliant_machine();
    }



    /** What follows the state where it jumps. */
    std::string
    advice(const ModelParameters &parameters)
    {
      if (parameters.interface.viscosity > 0.)
        return "Smaller steps follow the viscous motion";
      if (parameters.interface.friction->depends_on_rate())
        return "Friction falls with the speed faster than the springs pull: "
               "there is no quasi-static solution. Interface / Viscosity "
               "limits the speed";
      if (parameters.load_steps.follow_path)
        return "A smaller Load steps / Largest slip step follows the path "
               "between";
      return "Load steps / Path following = slip follows the path between";
    }
  } // namespace



  // Whether the state just accepted is on another branch of equilibrium.
  void
  StateChecks::check_for_jump(const std::string      &where,
                              const Chuck::Vector6   &forces_before,
                              const CoupledSystem    &system,
                              const InterfaceSummary &summary)
  {
    const ContactInterface &interface = system.interface;
    const EnergyState       now{system.chuck_forces(),
                          system.chuck.machine_position(),
                          system.chuck.machine_energy() + system.bulk_energy() +
                            summary.energy,
                          interface.work().friction,
                          interface.work().friction_bound};
    const double            released = released_energy.add(now);
    const std::string       change =
      describe_change(forces_before, now.forces, system.R);
    if (released > 0.)
      {
        std::ostringstream text;
        text << where << "in one step " << change << ", and " << released
             << " N mm of stored energy were released without equilibrium: the "
                "load cannot be followed there, the state jumped to another "
                "branch. "
             << advice(parameters);
        note_violation("jump", text.str());
      }
    else if (released_energy.may_hide_a_jump() && can_jump(parameters, system))
      note_violation("steep fall",
                     where + "in one step " + change +
                       ": too much to tell a jump from a steep fall; smaller "
                       "steps do");
  }



  namespace
  {
    // Beyond that a point may find no partner, or the wrong one [mm].
    double
    deepest_penetration(const ModelParameters &parameters,
                        const CoupledSystem   &system)
    {
      double       smallest = 0.1 * std::min(parameters.bone.thickness(),
                                       parameters.implant.thickness());
      const auto   n        = system.implant.surface().n_elements();
      const double area     = system.interface.implant_area();
      return std::min(smallest, std::sqrt(area / n));
    }
  } // namespace



  void
  StateChecks::check_interface(const std::string      &where,
                               const CoupledSystem    &system,
                               const InterfaceSummary &summary)
  {
    if (summary.bonded_opened > 0)
      note_violation(
        "opening",
        where + "bonded points open (" + std::to_string(summary.bonded_opened) +
          "): the law has no strength in tension, so that pulling costs nothing" +
          (parameters.interface.opening_breaks_bond ?
             "" :
             ", and points that close again are "
             "bonded as before"));
    const double too_deep = deepest_penetration(parameters, system);
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



  // Planned turns are divided; jumps and loaded chucks turn as far as they
  // like.
  void
  StateChecks::check_turn(const std::string &where, const double turn)
  {
    if (turn > 1.001 * largest_turn && parameters.has_friction())
      {
        std::ostringstream text;
        text
          << where << "the implant turned by " << turn * 180. / M_PI
          << " degrees in one step: sliding points are pulled along the "
             "chords of their paths, and friction is too small by 1 - cos of "
             "half the angle, "
          << 1. - std::cos(0.5 * turn) << " of itself";
        note_violation("turn", text.str());
      }
  }



  void
  StateChecks::check_reaction(const std::string &where)
  {
    if (last_reaction_defect >
        std::max(1e-6, 100. * parameters.load_steps.residual_tolerance))
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
    if (std::abs(energy_balance.defect()) >
        energy_balance.defect_bound() + 1e-9)
      {
        std::ostringstream text;
        text << where << "of the chuck's work, " << energy_balance.defect()
             << " of its largest value is neither stored nor dissipated; the "
                "size of the steps accounts for "
             << energy_balance.defect_bound();
        note_violation("energy balance", text.str());
      }
  }

} // namespace Debond
