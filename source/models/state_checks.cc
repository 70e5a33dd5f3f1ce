#include <debond/models/state_checks.h>
#include <debond/support/number_text.h>
#include <debond/system/step_solver.h>

#include <cmath>

namespace Debond
{
  namespace
  {
    /** Takes the name of a check that was not passed, and what to say of it. */
    using Note = std::function<void(const std::string &, const std::string &)>;



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
      return Text() << names[k] << " went from " << from[k] << " to " << to[k]
                    << (is_rotation(k) ? " N mm" : " N");
    }



    /** What follows the state where it jumps. */
    std::string
    advice(const ModelParameters &parameters, const bool opens)
    {
      if (opens ? parameters.interface.joint()->tension.viscosity > 0. :
                  parameters.interface.is_viscous())
        return "Smaller steps follow the viscous motion";
      if (parameters.interface.friction->depends_on_rate)
        return "Friction falls with the speed faster than the springs pull: "
               "there is no quasi-static solution. Interface / Viscosity "
               "limits the speed";
      if (parameters.interface.friction->is_frictionless)
        return "Smaller steps show where";
      if (parameters.load_steps.follow_path)
        return "A smaller Expert / Load steps / Largest slip step follows the "
               "path between";
      return "Load steps / Path following = slip follows the path between";
    }



    // Whether the state just accepted is on another branch of equilibrium.
    // There may be one only if anything but the interface stores energy; what
    // that does is judged point by point
    // (InterfaceSummary::steepest_softening).
    void
    check_for_jump(const ModelParameters  &parameters,
                   const CoupledSystem    &system,
                   const InterfaceSummary &summary,
                   const Chuck::Vector6   &forces_before,
                   ReleasedEnergy         &released_energy,
                   const Note             &note)
    {
      const Chuck         &chuck    = system.chuck;
      const InterfaceWork &work     = system.interface.work();
      const Chuck::Vector6 forces   = system.chuck_forces();
      const double         released = released_energy.add(
        {forces,
                 chuck.machine_position(),
                 chuck.machine_energy(forces) + system.bulk_energy() + summary.energy,
                 work.friction,
                 work.friction_bound + system.press_fit.bound,
                 system.press_fit.work});
      const std::string change =
        describe_change(forces_before, forces, system.R);
      if (released_energy.missing > 0. && system.interface.get_law().pulls())
        note("step over equilibrium",
             Text() << "in one step " << change << ", and the law dissipates "
                    << released_energy.missing
                    << " N mm more than there was: the step went over states "
                       "of equilibrium. Smaller steps do not");
      if (released > 0.)
        note("jump",
             Text() << "in one step " << change << ", and " << released
                    << " N mm of stored energy were released without "
                       "equilibrium: the load cannot be followed there, the "
                       "state jumped to another branch. "
                    << advice(parameters, summary.opening_softening > 0.));
      // A jump needs a law that falls faster than all springs in series let go.
      // How compliant bodies and machine are, compared with the interface, is
      // what they store; four times, as the pressure's part tells nothing.
      // Against what opens a bond it is that over the square of the tractions.
      const double stored = system.bulk_energy() + chuck.machine_energy(forces);
      if (released <= 0. && released_energy.may_hide_a_jump &&
          (summary.steepest_softening * (summary.energy + 4. * stored) >
             summary.energy ||
           summary.opening_softening * 2. * stored > summary.squared_traction))
        note("steep fall",
             "in one step " + change +
               ": too much to tell a jump from a steep fall; smaller steps do");
    }



    void
    check_strength(const BeyondStrength &beyond, const Note &note)
    {
      const char *const kinds[] = {"Tensile", "Compressive"};
      for (const unsigned int k : {0, 1})
        if (beyond.ratio[k] > 1.)
          note(std::string(kinds[k]) + " strength",
               Text() << "a principal stress of the bone is "
                      << to_text(beyond.stress_MPa[k], 4) << " MPa at ("
                      << to_text(beyond.X[k][0], 3) << ", "
                      << to_text(beyond.X[k][1], 3) << ", "
                      << to_text(beyond.X[k][2], 3) << ") mm, beyond Bone / "
                      << kinds[k] << " strength; beyond one or the other are "
                      << to_text(beyond.volume_mm3, 3)
                      << " mm^3. The model goes on with elastic bone");
    }



    // Dents are history of the slave's points.
    void
    check_dents(const CoupledSystem &system, const Note &note)
    {
      const ContactInterface &interface = system.interface;
      if (!interface.get_law().bone.crushes() ||
          interface.slave_side() == Side::bone)
        return;
      const double cell   = std::sqrt(interface.implant_area() /
                                    system.implant.surface().n_elements());
      const auto  &points = interface.get_points();
      const auto   n_left =
        std::count_if(points.begin(), points.end(), [&](const auto &point) {
          const PointHistory &state = point.trial.state;
          return state.crushed > 0. &&
                 interface.get_law().slid(state) - state.crushed_at > cell;
        });
      if (n_left > 0)
        note(
          "dents",
          Text() << n_left
                 << " points have slid by more than a cell since they "
                    "began to crush the bone, and take their dents along: with "
                    "Expert / Interface / Slave = bone these stay");
    }



    // What they leave between the faces is taken off where they begin, and is
    // another one where they have turned past each other.
    void
    check_facets(const CoupledSystem    &system,
                 const InterfaceSummary &summary,
                 const Note             &note)
    {
      const auto  &at_start = system.interface.faces_at_start();
      const double gap      = 0.25 * at_start.plane,
                   cell     = std::sqrt(system.interface.implant_area() /
                                    system.implant.surface().n_elements()),
                   way = system.chuck.position().tail<3>().norm() * system.R;
      // on a smooth master each facet keeps its gap
      const bool passes = !system.body[other(system.interface.slave_side())]
                             ->surface()
                             .is_one_patch() &&
                          summary.max_penetration > 0.;
      if (passes && way > 0.25 * cell && gap > 0.1 * summary.max_penetration)
        note("facets",
             Text() << "the implant has turned by " << to_text(way, 2)
                    << " mm along plane facets, which leave gaps of some "
                    << to_text(gap, 2)
                    << " mm as they pass each other, and points penetrate by "
                    << to_text(summary.max_penetration, 2)
                    << " mm: pressures and torque come and go with them. "
                       "Finer cells, or mesh files with nodes in the middle "
                       "of edges, make less of that");
    }



    void
    check_interface(const ModelParameters  &parameters,
                    const CoupledSystem    &system,
                    const InterfaceSummary &summary,
                    const Note             &note)
    {
      const ContactInterface &interface = system.interface;
      if (summary.bonded_opened > 0)
        note(
          "opening",
          Text() << "bonded points open (" << summary.bonded_opened
                 << "): the law has no strength in tension, so that opening "
                    "costs nothing"
                 << (parameters.interface.opening_breaks_bond ?
                       "" :
                       ", and points that close again are bonded as before"));
      // Beyond that a point may find no partner, or the wrong one [mm].
      const double too_deep =
        std::min({parameters.bone.penetration_limit(),
                  parameters.implant.penetration_limit(),
                  std::sqrt(interface.implant_area() /
                            system.implant.surface().n_elements())});
      if (summary.max_penetration > too_deep)
        note("penetration",
             Text() << "the bodies penetrate each other by "
                    << summary.max_penetration << " mm, more than " << too_deep
                    << " mm, a tenth of the thinner one or a whole surface "
                       "element: lengths are mm, is the push-in right?");
      if (summary.n_from_side > 0)
        note("side",
             Text() << summary.n_from_side << " points of the "
                    << name_of(interface.slave_side())
                    << " come under the face of the other body over its edge, "
                    << summary.side_depth
                    << " mm deep at once: the implant runs into the side of "
                       "the bone, which is no contact face, and is pressed on "
                       "its top instead. Raise the implant before it comes, or "
                       "enlarge Bone / Size");
      if (interface.n_enclosed() > 0.1 * summary.n_closed)
        note("enclosed",
             Text() << interface.n_enclosed()
                    << " open points lie between closed ones: "
                       "the faces of these cells cannot follow a stiff "
                       "interface, and pressure and stiffness are too large: "
                       "finer Cells, or a smaller Normal stiffness");
      // of the couple, if the normal is not the implant's own, and of the shift
      // along the face, which changes the distance to the axis
      const double n = 1. / parameters.interface.normal_penalty,
                   t = 1. / parameters.interface.tangential_stiffness(),
                   p = summary.pressure, q = summary.tangential,
                   couple =
                     interface.slave_side() == Side::implant ? p * (t - n) : 0.,
                   shift =
                     p > 0.01 * q ? 0.5 * q * q / p * (t * t / n - n) : 0.,
                   springs = std::abs(couple + shift) / system.R;
      if (!system.body[other(interface.slave_side())]->surface().is_flat() &&
          springs > 0.01)
        note("springs that differ",
             Text() << "Normal and Tangential stiffness differ: on a curved "
                       "face the torque changes by some "
                    << to_text(100. * springs, 2)
                    << " %. Tangential stiffness = auto does not change it");
      if (interface.n_unprojected() > 0)
        note("projection",
             Text() << "for " << interface.n_unprojected()
                    << " open points no closest point of the other surface was "
                       "found: they stay open");
    }



    void
    check_energy_balance(const EnergyBalance &energy_balance,
                         const double         step_dissipation,
                         const Note          &note)
    {
      if (energy_balance.dissipates_too_much())
        note(
          "dissipation",
          "more energy is dissipated than was put in: the steps are too large "
          "for the energy balance to be trusted");
      if (energy_balance.is_given_back(step_dissipation))
        note("dissipation falls",
             "sliding gives energy back: points slide along their traction "
             "instead of against it, or climb on each other by more than "
             "friction pays for");
      if (std::abs(energy_balance.missing_share()) >
          energy_balance.missing_share_bound())
        note("energy balance",
             Text() << "of the chuck's work in this phase, "
                    << energy_balance.missing_share()
                    << " of the largest work so far is neither stored nor "
                       "dissipated; the size of the steps accounts for "
                    << energy_balance.missing_share_bound());
    }
  } // namespace



  StateChecks::StateChecks(const ModelParameters               &parameters,
                           std::function<void(const Warning &)> warn)
    : parameters(parameters)
    , warn(std::move(warn))
    , path(parameters.chuck)
  {}



  void
  StateChecks::note(const unsigned int step,
                    const std::string &check,
                    const std::string &text)
  {
    violated.insert(check);
    warn({check, "step " + std::to_string(step) + ": " + text});
  }



  // What slides does so by less than it should.
  void
  StateChecks::add_motion(const unsigned int   step,
                          const CoupledSystem &system,
                          const double         from,
                          const double         to)
  {
    path.add(system.chuck, from, to, system.press_fit.interference);
    if (path.missed_share() > ChuckPath::largest_missed_share)
      note(step,
           "way",
           "steps go straight from state to state, and have missed " +
             path.describe() +
             " so far: what turns back or goes along a curve needs shorter "
             "steps, or Load steps / Times where it turns");
  }



  // Asking costs as much as an iteration of a Neo-Hookean body. So it is done
  // when the face has another shape than before, and not in bodies as stiff as
  // bone and metal: even a slender one that bends has strains of not more than
  // some twenty times the tractions over Young's modulus.
  void
  StateChecks::ask_for_strains(const CoupledSystem &system,
                               const double         max_traction)
  {
    for (const Side side : both_sides)
      {
        const BodyParameters &body =
          side == Side::bone ? parameters.bone : parameters.implant;
        const ControlNet v      = system.body[side]->contact_displacement();
        ControlNet      &judged = judged_displacement[side];
        if (body.material != Material::linear ||
            max_traction < 5e-4 * body.softest_modulus() ||
            (judged.size() > 0 && (v - judged).norm() < 0.2 * v.norm()))
          continue;
        judged = v;
        change_at_strains[side] =
          std::max(change_at_strains[side],
                   system.body[side]->change_at_large_strains());
      }
  }



  void
  StateChecks::judge_strains(const CoupledSystem &system,
                             const bool           in_any_case)
  {
    for (const Side side : both_sides)
      {
        double &change = change_at_strains[side];
        if (judged_displacement[side].size() > 0 ||
            (in_any_case &&
             (side == Side::bone ? parameters.bone : parameters.implant)
                 .material == Material::linear))
          change =
            std::max(change, system.body[side]->change_at_large_strains());
        if (change > 0.02)
          warn(
            {Text() << "strain of the " << name_of(side),
             Text() << "large strains or rotations of the " << name_of(side)
                    << " would change its displacement by up to some "
                    << to_text(100. * change, 2)
                    << " %, and forces perhaps by more: too much for Material "
                       "= linear; compare with neo-hookean"});
      }
  }



  void
  StateChecks::add(const unsigned int      step,
                   const CoupledSystem    &system,
                   const InterfaceSummary &summary,
                   const double            reaction_defect)
  {
    const Note note = [&](const std::string &check, const std::string &text) {
      this->note(step, check, text);
    };
    const bool        is_first = !energy_balance.has_state();
    const EnergyState before   = energy_balance.state();
    energy_balance.add(
      {system.chuck_forces(),
       system.chuck.position(),
       system.bulk_energy() + summary.energy,
       system.interface.work().dissipation,
       system.interface.work().dissipation_bound + system.press_fit.bound,
       system.press_fit.work});
    // Between rigid bodies that are all held where the scene wants them each
    // point has the one state that its law allows. The explicit law does not
    // dissipate what InterfaceWork::friction says.
    const bool has_one_state =
      system.chuck.unknowns().empty() &&
      system.bone.n_unknowns() + system.implant.n_unknowns() == 0;
    if (!has_one_state && !parameters.interface.explicit_friction)
      {
        check_for_jump(
          parameters, system, summary, before.forces, released_energy, note);
      }
    check_interface(parameters, system, summary, note);
    check_dents(system, note);
    check_facets(system, summary, note);
    beyond = Debond::beyond_strength(system.bone);
    check_strength(beyond, note);
    ask_for_strains(system, summary.max_traction);

    // Planned turns are divided; jumps and loaded chucks turn as far as they
    // like.
    const double turn =
      (system.chuck.position() - before.position).tail<3>().norm();
    if (!is_first && turn > 1.001 * largest_turn && parameters.has_friction())
      note("turn",
           Text() << "the implant turned by " << turn * 180. / M_PI
                  << " degrees in one step: dissipation is summed over the "
                     "chords of paths, and too small by a sixth of the square "
                     "of the angle, "
                  << turn * turn / 6. << " of itself");
    if (reaction_defect >
        std::max(1e-6, 100. * parameters.load_steps.residual_tolerance))
      note("reaction",
           Text() << "contact forces and the reaction of the implant's top "
                     "differ by "
                  << reaction_defect << " of the larger");
    check_energy_balance(energy_balance,
                         system.interface.work().step_dissipation,
                         note);
  }
} // namespace Debond
