// Following a path of equilibrium that snaps back. Rigid bodies under a
// compliant machine against the closed form: the torque and the machine's angle
// at every row, the limit points. Linear bodies under a rigid machine, where it
// is the implant that stores the energy: against the same scene with the
// rotation prescribed, before and after its jump, and the energy that the jump
// releases against the area that the path encloses with it.

#include <debond/interface/modified_coulomb.h>
#include <debond/models/closed_forms.h>

#include <algorithm>

#include "driven_scene.h"

const char *const brittle_bond = R"(
subsection Interface
  set Characteristic slip distance = 0.005
  set Transition factor = 0.3
end
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 220
end
)";

constexpr double degree = M_PI / 180.;

using Rows = std::vector<Debond::TorqueRow>;



void
check_rigid_bodies()
{
  std::cout << "Rigid bodies, compliant machine" << std::endl;
  const Rows rows = run_scene("rigid", std::string(brittle_bond) + R"(
    subsection Bone
      set Material = rigid
    end
    subsection Implant
      set Material = rigid
      set Cells    = 8, 2
    end
    subsection Chuck
      subsection Press
        set Value = 2.6 / 585 * min(t^1.5, 1) # none before the first time
      end
      subsection Rotation z
        set Value     = 2 * max(t - 1, 0)
        set Stiffness = 3000
      end
    end
    subsection Load steps
      set Path following = slip
    end)");

  Debond::TorsionModel::Disk parameters;
  parameters.radius    = 2.5;
  parameters.pressure  = 2.6;
  parameters.stiffness = 585;
  parameters.friction  = Debond::modified_coulomb({0.40, 0.58, 0.005, 0.3});
  const Debond::RigidBodiesTorsion      bodies(parameters);
  const Debond::CompliantMachineTorsion machine(bodies, 3000, 2. * degree);

  const auto &jump   = machine.jumps.at(0);
  double      torque = 0, angle = 0, highest = 0, lowest = 1e9, T_max = 0,
         lowest_of_curve = 1e9;
  for (double theta = jump.angle_before; theta < jump.angle_after;
       theta += 1e-5)
    lowest_of_curve =
      std::min(lowest_of_curve, machine.machine_angle(theta) / degree);
  for (double theta = 0.1; theta < 0.3; theta += 1e-3)
    T_max = std::max(T_max, bodies.torque(theta * degree));
  for (const auto &row : rows)
    {
      const double theta = row.angle_deg * degree;
      grow(torque, std::abs(row.torque_Nmm - bodies.torque(theta)) / T_max);
      grow(angle,
           std::abs(row.machine_angle_deg -
                    machine.machine_angle(theta) / degree));
      if (row.angle_deg < 0.25)
        highest = std::max(highest, row.machine_angle_deg);
      else
        lowest = std::min(lowest, row.machine_angle_deg);
    }
  report("  torque at the chuck's angle, relative to the largest",
         torque,
         5e-3);
  report("  machine's angle at the chuck's angle [deg]", angle, 5e-3);
  report("  largest machine angle before it snaps back, relative",
         std::abs(highest * degree / jump.machine_angle - 1.),
         2e-3);
  report("  smallest machine angle after that, relative",
         std::abs(lowest / lowest_of_curve - 1.),
         2e-3);
  report("  the last time is met", rows.back().time == 2.);
  report("  time falls on the way",
         std::adjacent_find(rows.begin(), rows.end(), [](auto &a, auto &b) {
           return b.time < a.time;
         }) != rows.end());
  report("  no jump is reported", rows.back().released_energy_Nmm == 0.);
}



/** Torque on the part of a path between two rows where the angle rises. */
double
torque_at(const Rows        &rows,
          const unsigned int begin,
          const unsigned int end,
          const double       angle)
{
  for (unsigned int i = begin; i + 1 < end; ++i)
    if (rows[i].angle_deg <= angle && angle <= rows[i + 1].angle_deg)
      return rows[i].torque_Nmm +
             (angle - rows[i].angle_deg) /
               (rows[i + 1].angle_deg - rows[i].angle_deg) *
               (rows[i + 1].torque_Nmm - rows[i].torque_Nmm);
  return std::numeric_limits<double>::quiet_NaN();
}



/** int T dtheta along rows [N mm]. */
double
work(const Rows &rows, const unsigned int begin, const unsigned int end)
{
  double sum = 0;
  for (unsigned int i = begin; i + 1 < end; ++i)
    sum += 0.5 * (rows[i].torque_Nmm + rows[i + 1].torque_Nmm) *
           (rows[i + 1].angle_deg - rows[i].angle_deg) * degree;
  return sum;
}



void
check_linear_bodies()
{
  std::cout << "A soft implant, rigid machine" << std::endl;
  const std::string text    = std::string(brittle_bond) + R"(
    subsection Bone
      set Size     = 10, 10, 4
      set Cells    = 8, 8, 2
      set Material = linear
    end
    subsection Implant
      set Material      = linear
      set Cells         = 5, 3
      set Young modulus = 400
      set Poisson ratio = 0
    end
    subsection Interface
      set Friction starts at = 1
    end
    subsection Chuck
      subsection Press
        set Value = 2.6 / 105 * min(t, 1)
      end
      subsection Rotation z
        set Value = 1.5 * max(t - 1, 0)
      end
    end)";
  const Rows        jumping = run_scene("jumping", text);
  const Rows        path    = run_scene("path",
                              text,
                              {"Load steps/Path following=slip",
                                         "Expert/Load steps/Largest slip step=5e-5"});

  // where the path turns back, and where it comes forward for good
  unsigned int turn = 0, last_turn = 0;
  for (unsigned int i = 1; i < path.size(); ++i)
    if (path[i].angle_deg < path[i - 1].angle_deg)
      {
        turn      = turn == 0 ? i : turn;
        last_turn = i;
      }
  unsigned int jump = 0;
  for (unsigned int i = 1; i < jumping.size() && jump == 0; ++i)
    if (jumping[i].released_energy_Nmm > 0.)
      jump = i;
  report("  the path snaps back", turn > 0);
  report("  the jump is reported", jump > 0);
  double worst = 0;
  for (unsigned int i = 1; i < jumping.size(); ++i)
    {
      // all of the path before its turn; beyond it its last branch
      const double T =
        i < jump ?
          torque_at(path, 0, turn, jumping[i].angle_deg) :
          torque_at(path, last_turn, path.size(), jumping[i].angle_deg);
      if (jumping[i].angle_deg > 0. && i != jump)
        grow(worst, std::abs(T / jumping[i].torque_Nmm - 1.));
    }
  report("  torque beside the jump, relative", worst, 5e-3);
  report("  the jump is where the path turns back [deg]",
         std::abs(jumping[jump].angle_deg - path[turn - 1].angle_deg),
         1.5 / 220.);

  // Work of the jumping run less that of the path between the same states. The
  // former is that of all sub-steps; it contains the trapezoid of the one that
  // jumps.
  const auto  &before = jumping[jump - 1], &after = jumping[jump];
  unsigned int begin = 0, end = path.size() - 1;
  while (path[begin + 1].angle_deg < before.angle_deg)
    ++begin;
  while (path[end - 1].angle_deg > after.angle_deg)
    --end;
  const double along_path =
    work(path, begin, end + 1) -
    path[begin].torque_Nmm * (before.angle_deg - path[begin].angle_deg) *
      degree -
    path[end].torque_Nmm * (path[end].angle_deg - after.angle_deg) * degree;
  const double released = after.work_Nmm - before.work_Nmm - along_path;
  report("  released energy against the area of the loop, relative",
         std::abs(after.released_energy_Nmm / released - 1.),
         0.01);
}



void
test()
{
  check_rigid_bodies();
  check_linear_bodies();
}

int
main()
{
  return run_test(test);
}
