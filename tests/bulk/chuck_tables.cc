// Values of the chuck from files: a table of two rows is an expression, over
// the angle it is what it is over the time, a run with the torque.csv of
// another one is that run, and results belong to the content of the file; the
// torque under N(theta) is that of rings of a rigid disk under N(theta).

#include <algorithm>
#include <fstream>

#include "driven_scene.h"

using namespace Debond;

using Rows      = std::vector<TorqueRow>;
using Overrides = std::vector<std::string>;

const std::string scene_text = R"(
subsection Bone
  set Cells    = 8, 8, 2
  set Material = linear
end
subsection Implant
  set Cells    = 3, 2
  set Material = linear
end
subsection Chuck
  subsection Rotation z
    set Value = 3 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 2, 12
end
subsection Expert
  subsection Load steps
    set Residual tolerance = 1e-12
  end
end
)";

const std::string z = "Chuck/Translation z/", twist = "Chuck/Rotation z/";



void
write(const std::string &file, const std::string &text)
{
  std::ofstream(file) << text;
}



Overrides
with(Overrides first, const Overrides &second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}



/** The largest difference of the torques and of the axial forces, relative to
 *  the largest; infinite if the rows are others. */
double
difference(const Rows &rows, const Rows &others)
{
  double torque = 0, force = 0, largest_torque = 0, largest_force = 0;
  bool   same = rows.size() == others.size();
  for (std::size_t i = 0; same && i < rows.size(); ++i)
    {
      same = std::abs(rows[i].time - others[i].time) < 1e-7;
      grow(torque, std::abs(rows[i].torque_Nmm - others[i].torque_Nmm));
      grow(force, std::abs(rows[i].force_N - others[i].force_N));
      grow(largest_torque, std::abs(rows[i].torque_Nmm));
      grow(largest_force, std::abs(rows[i].force_N));
    }
  return same ? std::max(torque / largest_torque, force / largest_force) :
                1. / 0.;
}



void
check_expression(const std::string &what, const Overrides &bodies)
{
  std::cout << what << std::endl;
  write("push.csv", "time,chuck_uz_mm\n0,0\n2,-0.0098\n");
  const Rows pushed =
    run_scene("value",
              scene_text,
              with(bodies, {z + "Value = -0.0049 * (0.2 + 0.8 * min(t, 1))"}));
  report("  displacement, table of two rows and expression",
         difference(
           pushed,
           run_scene(
             "file",
             scene_text,
             with(bodies,
                  {z + "File = push.csv",
                   z + "Value = 0.2 * -0.0049 + 0.8 * max(table, -0.0049)"}))),
         1e-10);

  write("force.csv",
        "Winkel [rad];Kraft [kN]\n0;0,04\n0,0523598775598299;0,07\n");
  const Overrides force  = with(bodies, {z + "Control = force"});
  const Rows      loaded = run_scene(
    "value",
    scene_text,
    with(force,
         {z + "Value = -(40 + 30 * max(t - 1, 0)) * (0.2 + 0.8 * min(t, 1))"}));
  report("  force over the angle",
         difference(
           loaded,
           run_scene("file",
                     scene_text,
                     with(force,
                          {z + "File = force.csv",
                           z + "Value = -(0.2 + 0.8 * min(t, 1)) * table"}))),
         1e-10);

  write("angle.csv", "time [min];phi [deg]\n0;-3\n0,0333333333333333;3\n");
  report(
    "  angle over time",
    difference(loaded,
               run_scene("file",
                         scene_text,
                         with(force,
                              {z + "File = force.csv",
                               z + "Value = -(0.2 + 0.8 * min(t, 1)) * table",
                               twist + "Value = max(table, 0)",
                               twist + "File = angle.csv"}))),
    1e-10);
  write("moment.csv", "time,chuck_Mz_Nmm\n0,-15\n2,15\n");
  const Overrides moment =
    with(bodies,
         {z + "Value = -0.0049 * (0.2 + 0.8 * min(t, 1))",
          twist + "Control = moment"});
  report("  moment",
         difference(run_scene("value",
                              scene_text,
                              with(moment,
                                   {twist + "Value = 15 * max(t - 1, 0)"})),
                    run_scene("file",
                              scene_text,
                              with(moment,
                                   {twist + "Value = max(table, 0)",
                                    twist + "File = moment.csv"}))),
         1e-10);
}



// The table of a run is what the chuck has done in it, over time; in the steps
// of that run it passes through the same places.
void
check_rerun()
{
  std::cout << "the torque.csv of a run" << std::endl;
  const Overrides   push{z + "Value = -0.0049 * (0.2 + 0.8 * min(t, 1))"};
  const Rows        first = run_scene("first", scene_text, push);
  const std::string file  = "results/first/torque.csv";
  report("  forces in the place of places",
         difference(first,
                    run_scene("again",
                              scene_text,
                              {z + "Control = force", z + "File = " + file})),
         1e-8);
  report("  places in the place of expressions",
         difference(first,
                    run_scene("again",
                              scene_text,
                              {z + "File = " + file,
                               twist + "File = " + file,
                               twist + "Value = 0"})),
         1e-8);
}



const Overrides growing{z + "Control = force",
                        z + "File = growing.csv",
                        z + "Value = -(0.2 + 0.8 * min(t, 1)) * table"};

// The tables of growing.csv over the angle, and of its angles over time.
void
write_growing()
{
  write(
    "growing.csv",
    "# made up\nangle_deg,axial force [N]\n0,30\n0.5,33\n1,42\n2,70\n3,75\n");
  write("over_time.csv",
        "time,axial force [N]\n1,30\n1.16666666666666667,33\n"
        "1.33333333333333333,42\n1.66666666666666667,70\n2,75\n");
}



// Steps that are tried and taken back see the same values.
void
check_steps()
{
  std::cout << "steps" << std::endl;
  write_growing();
  const Overrides adaptive{"Load steps/Adaptive = true",
                           "Load steps/Times = 1, 2",
                           "Load steps/Steps = 4",
                           z + "Value = -table"};
  const Rows angle = run_scene("angle", scene_text, with(growing, adaptive));
  report("  over time as over the angle, adaptive steps",
         difference(angle,
                    run_scene("time",
                              scene_text,
                              with(with(growing, adaptive),
                                   {z + "File = over_time.csv"}))),
         1e-7); // what steps make of rounding, 1e-9
  double              off = 0;
  const MonotoneCurve curve({0, 0.5, 1, 2, 3}, {30, 33, 42, 70, 75});
  for (const TorqueRow &row : angle)
    grow(off, std::abs(row.force_N / curve(row.angle_deg) - 1.));
  report("  the force is that of the table, differs", off, 1e-10);
}



// A checkpoint belongs to the content of the file.
void
check_identity()
{
  write_growing();
  const auto text = [] {
    return coin_scene(scene_text, growing).completed_parameters;
  };
  const std::string before = text();
  report("the scene is the same again", text() == before);
  write("growing.csv", "angle_deg,axial force [N]\n0,30\n3,75\n");
  report("  another one with another content", text() != before);
  Scene made = coin_scene(scene_text, growing);
  made.complete();
  report("  and the same if a program completes it",
         made.completed_parameters == text());
}



// Traction t and sliding distance g_s of rings, in small steps:
//   t = eps_t (g + r dtheta - dg_s) <= mu(g_s) N / (pi R^2).
void
check_rings()
{
  write_growing();
  const Rows          rows  = run_scene("rings",
                              scene_text,
                              with(growing,
                                   {"Bone/Material = rigid",
                                              "Implant/Material = rigid",
                                              "Implant/Cells = 8, 2",
                                              "Load steps/Steps = 1, 150"}));
  const Scene         scene = coin_scene(scene_text, growing);
  const MonotoneCurve force({0, 0.5, 1, 2, 3}, {30, 33, 42, 70, 75});
  constexpr double    R = 2.5, eps = 585, dtheta = 2e-3;
  constexpr unsigned  n_rings = 200;
  std::vector<double> gap(n_rings, 0.), slip(n_rings, 0.);
  const auto          law       = scene.interface.friction;
  double              deviation = 0, largest = 0;
  std::size_t         row = 1;
  for (unsigned int i = 0; i <= 1500; ++i)
    {
      const double p      = force(i * dtheta) / (M_PI * R * R);
      double       torque = 0;
      for (unsigned int k = 0; k < n_rings; ++k)
        {
          const double r = (k + 0.5) * R / n_rings;
          if (i > 0)
            gap[k] += r * dtheta * M_PI / 180.;
          for (unsigned int n = 0; n < 10; ++n) // a contraction
            {
              const double excess =
                gap[k] - law->coefficient({1., {slip[k]}}, 0.).mu * p / eps;
              if (excess <= 0.)
                break;
              gap[k] -= excess;
              slip[k] += excess;
            }
          torque += 2. * M_PI * r * r * eps * gap[k] * R / n_rings;
        }
      grow(largest, torque);
      if (row < rows.size() &&
          std::abs(rows[row].angle_deg - i * dtheta) < 1e-9)
        grow(deviation, std::abs(rows[row++].torque_Nmm - torque));
    }
  report("all rows of N(theta) compared", row == rows.size());
  report("  torque and that of rings, relative to the largest",
         deviation / largest,
         5e-4);
  // the bond is left around the axis
  report("  at the end 2/3 mu_b N R, differs",
         std::abs(rows.back().torque_Nmm / (2. / 3. * 0.4 * 75. * R) - 1.),
         2e-2);
}



void
test()
{
  check_expression("rigid bodies",
                   {"Bone/Material = rigid", "Implant/Material = rigid"});
  check_expression("linear bodies", {});
  check_rerun();
  check_steps();
  check_identity();
  check_rings();
}



int
main()
{
  return run_test(test);
}
