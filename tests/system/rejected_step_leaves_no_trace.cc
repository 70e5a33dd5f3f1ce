// Steps that fail and are taken back leave no trace: history, displacements and
// forces right afterwards are bit for bit those before, and small steps from
// there lead to the same states as in a run without failures.

#include <debond/scene/scene.h>
#include <debond/support/runtime.h>
#include <debond/system/newton.h>

#include <sstream>
#include <string>
#include <vector>

#include "checks.h"
#include "coin_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;

/** A copy of everything a run knows of its accepted state. */
struct State
{
  std::vector<SlavePoint>          points;
  std::array<std::vector<bool>, 2> is_contact;
  std::array<ControlNet, 2>        surface_displacements, forces;
  std::array<Eigen::VectorXd, 2>   displacements;
  Chuck::Vector6                   position, chuck_forces;
  double                           dissipation, adhesive_work, energy;
};

/** One simulation, driven step by step. */
class Run
{
public:
  explicit Run(const Scene &scene)
    : system(scene)
  {
    system.start(0.);
  }

  /** Tries a step; what failed is taken back. */
  bool
  step(const double       time,
       const bool         extrapolate,
       const unsigned int max_iterations = 25)
  {
    NewtonOptions options;
    options.residual_tolerance = 1e-12;
    options.points.stick_first = !extrapolate;
    options.max_iterations     = max_iterations;
    options.points.duration    = time - accepted_time;
    system.predict(time, time, extrapolate);
    const bool converged = solve_newton(system, options).converged;
    if (converged)
      {
        system.commit(time);
        accepted_time = time;
      }
    else
      system.rollback();
    return converged;
  }

  /** The accepted state; forces are evaluated anew from it. */
  State
  state()
  {
    State result;
    result.points     = system.interface.get_points();
    result.position   = system.chuck.position();
    unsigned int side = 0;
    for (Body *body : {&system.bone, &system.implant})
      {
        result.is_contact[side]            = body->contact_control_points();
        result.surface_displacements[side] = body->contact_displacement();
        result.displacements[side]         = body->full_displacement();
        ++side;
      }
    system.predict(accepted_time, accepted_time, false);
    system.evaluate(ContactPointMode());
    result.forces        = {{system.interface.force(Side::bone),
                             system.interface.force(Side::implant)}};
    result.chuck_forces  = system.chuck_forces();
    result.dissipation   = system.interface.work().dissipation;
    result.adhesive_work = system.interface.work().adhesive;
    result.energy        = system.bulk_energy();
    return result;
  }

private:
public:
  CoupledSystem system;
  double        accepted_time = 0;
};



bool
same_history(const ContactPointState &a, const ContactPointState &b)
{
  return a.status == b.status && a.has_partner == b.has_partner &&
         a.broken == b.broken && a.xi == b.xi && a.slip == b.slip &&
         a.internal == b.internal;
}

/** Bit for bit: history, position, forces, and the surfaces where they may
 *  touch. Which control points of a body these are may have grown in between;
 *  its energy then is a sum of other numbers. */
bool
identical(const State &before, const State &after)
{
  bool result = before.position == after.position &&
                before.chuck_forces == after.chuck_forces &&
                before.dissipation == after.dissipation &&
                before.adhesive_work == after.adhesive_work &&
                std::abs(before.energy - after.energy) <= 1e-13 * before.energy;
  for (unsigned int side = 0; side < 2; ++side)
    {
      result = result && before.forces[side] == after.forces[side];
      for (unsigned int A = 0; A < before.is_contact[side].size(); ++A)
        if (before.is_contact[side][A])
          result = result && before.surface_displacements[side].col(A) ==
                               after.surface_displacements[side].col(A);
    }
  for (unsigned int q = 0; q < before.points.size(); ++q)
    {
      const SlavePoint &p = before.points[q], &r = after.points[q];
      result = result && same_history(p.accepted, r.accepted) &&
               p.clearance == r.clearance &&
               p.accepted_traction == r.accepted_traction &&
               p.accepted.normal_gap == r.accepted.normal_gap;
    }
  return result;
}



struct Difference
{
  unsigned int status = 0;
  double       slip = 0, xi = 0, displacements = 0, forces = 0, works = 0;

  /** Lengths relative to a_s, everything else to its largest value. */
  void
  add(const State &a, const State &b)
  {
    for (unsigned int q = 0; q < a.points.size(); ++q)
      {
        const ContactPointState &p = a.points[q].accepted;
        const ContactPointState &r = b.points[q].accepted;
        status += (p.status != r.status || p.has_partner != r.has_partner ||
                   p.broken != r.broken);
        grow(slip, std::abs(p.slip - r.slip) / 0.022);
        grow(xi, (p.xi - r.xi).norm());
      }
    for (unsigned int side = 0; side < 2; ++side)
      {
        grow(displacements,
             (a.displacements[side] - b.displacements[side]).norm() /
               b.displacements[side].norm());
        grow(forces,
             (a.forces[side] - b.forces[side]).norm() / b.forces[side].norm());
      }
    grow(works, std::abs(a.energy / b.energy - 1.));
    grow(works, std::abs(a.dissipation - b.dissipation) / b.energy);
    grow(works, std::abs(a.adhesive_work - b.adhesive_work) / b.energy);
  }
};



void
check(const std::string &name, const std::string &changes)
{
  std::cout << name << std::endl;
  const Scene scene =
    coin_scene(pressed_then("Rotation z", "max(t - 1, 0)") + changes);
  Run failing(scene), clean(scene);
  for (Run *run : {&failing, &clean})
    for (const double time : {1., 1.1})
      if (!run->step(time, false))
        std::cout << "  no convergence at " << time << std::endl;

  bool         all_fail = true, all_converge = true, no_trace = true;
  unsigned int n_slip = 0;
  Difference   difference;
  for (unsigned int k = 1; k <= 5; ++k)
    {
      const double time = 1.1 + 0.3 * k;
      for (const bool extrapolate : {true, false})
        {
          const State before = failing.state();
          all_fail = all_fail && !failing.step(time + 20., extrapolate, 1) &&
                     !failing.step(time + 1., extrapolate, 1);
          const State after = failing.state();
          no_trace          = no_trace && identical(before, after);
        }
      for (Run *run : {&failing, &clean})
        all_converge = all_converge && run->step(time, k > 1);
      difference.add(failing.state(), clean.state());
      for (const auto &point : failing.system.interface.get_points())
        n_slip += (point.accepted.status == PointStatus::slip);
    }
  report("  steps that have to fail do", all_fail);
  report("  the others converge", all_converge);
  report("  no trace right afterwards", no_trace);
  report("  points slip in the steps that are compared", n_slip > 100);
  report("  all points in the same state", difference.status == 0);
  report("  difference of g_s", difference.slip, 1e-10);
  report("  difference of interacting points", difference.xi, 1e-10);
  report("  difference of displacements", difference.displacements, 1e-10);
  report("  difference of forces", difference.forces, 1e-10);
  report("  difference of works", difference.works, 1e-10);
}



int
main()
{
  set_up_libraries();
  const std::string linear        = bodies_of("linear");
  const std::string bone_is_slave = R"(
    subsection Expert
      subsection Interface
        set Slave = bone
      end
    end)";
  // a failing step that ends beyond the elements that contact has reached
  const std::string shear          = R"(
    subsection Chuck
      subsection Translation x
        set Value = 0.06 * max(t - 1, 0)
      end
    end)";
  const std::string rate_and_state = R"(
    subsection Interface
      set Friction law = rate and state
    end)";
  const std::string loaded         = R"(
    subsection Chuck
      subsection Translation y
        set Control = force
        set Value   = 3 * max(t - 1, 0)
      end
      subsection Rotation x
        set Control = moment
      end
    end)";
  check("Neo-Hookean bodies", "");
  check("Linear bodies", linear);
  check("The bone is the slave", linear + bone_is_slave);
  check("Linear bodies, shear", linear + shear);
  check("Neo-Hookean bodies, shear", shear);
  check("The bone is the slave, shear", linear + shear + bone_is_slave);
  check("Under a force and a moment", linear + loaded);
  check("Rate and state friction", linear + rate_and_state);
}
