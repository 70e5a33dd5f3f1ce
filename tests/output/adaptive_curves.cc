// What adaptive steps draw: the rates of change at the end of a step equal
// central differences of whole steps; a curve that is a cubic is drawn exactly;
// where points slide round in circles and to and fro, so that the state at the
// end of a step depends on the way there, the curves of all six reactions keep
// the tolerance against 800 steps in each phase; and under a moment that of the
// angle does. A kink that hides in a step is found.

#include <debond/output/torque_curve.h>

#include <fstream>

#include "driven_scene.h"

using namespace Debond;

const std::string coarse =
  "subsection Bone\n set Size = 8, 8, 4\n set Cells = 5, 5, 2\n end\n"
  "subsection Implant\n set Cells = 2, 1\n end\n"
  "subsection Chuck\n"
  "  subsection Press\n set Value = 0.005 * min(t, 1)\n end\n"
  "  subsection Translation x\n set Value = 0.006 * max(t - 1, 0)^2\n end\n"
  "  subsection Rotation x\n set Value = 0.02 * max(t - 1, 0)\n end\n"
  "  subsection Rotation z\n set Value = 3 * max(t - 1, 0)\n end\n"
  "end\n";

/** The end of a step from @p begin to @p end in equilibrium, not accepted. */
void
solve_step(CoupledSystem &system, const double begin, const double end)
{
  NewtonOptions options;
  options.residual_tolerance = 1e-13;
  options.points.duration    = end - begin;
  system.rollback();
  system.predict(end, end, false);
  const NewtonResult result = solve_newton(system, options);
  if (!result.converged)
    throw std::runtime_error(result.why);
}



void
check_rates(const std::string &what, const std::vector<std::string> &overrides)
{
  std::cout << what << std::endl;
  std::vector<std::string> all{"Load steps/Times=0, 1, 1.1, 1.2",
                               "Load steps/Steps=1, 2, 2"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  DrivenScene driven(coarse, all);
  driven.advance_to(1.2);
  CoupledSystem               &system = driven.system;
  constexpr double             end = 1.25, dt = 1e-5;
  std::vector<Eigen::VectorXd> states;
  for (const double time : {end + dt, end - dt})
    {
      solve_step(system, 1.2, time);
      Eigen::VectorXd state(18);
      state << system.chuck_forces(), system.chuck_resultant(),
        system.chuck.position();
      states.push_back(state);
    }
  solve_step(system, 1.2, end);
  const auto summary = system.interface.summarise();
  report("  some points slide", summary.share_slip > 0.2);
  const CoupledSystem::Rates rates = system.rates();
  Eigen::VectorXd            ours(18);
  ours << rates.forces, rates.reaction, rates.position;
  const Eigen::VectorXd difference = (states[0] - states[1]) / (2. * dt);
  for (const auto &[name, first] : {std::pair<const char *, int>{"forces", 0},
                                    {"resultant", 6},
                                    {"position", 12}})
    for (const int half : {0, 3})
      report(std::string("  rates of ") + name +
               (half == 0 ? ", translation" : ", rotation"),
             (ours - difference).segment<3>(first + half).norm() /
               difference.segment<3>(first + half).norm(),
             1e-5);
}



void
check_cubic()
{
  const auto f  = [](const double t) { return 2. + t * (1. - t * (3. - t)); };
  const auto df = [](const double t) { return 1. - t * (6. - 3. * t); };
  std::vector<TorqueRow> rows(3);
  for (unsigned int i = 0; i < 3; ++i)
    {
      TorqueRow &row        = rows[i];
      row.step              = i;
      row.time              = std::vector<double>{0., 0.7, 2.}[i];
      row.torque_Nmm        = f(row.time);
      row.chuck_position[5] = row.angle_deg = 3. * f(row.time);
      if (i == 0)
        continue;
      row.rates_at_begin.fill(0.);
      row.rates_at_end.fill(0.);
      row.rates_at_begin[0]  = df(rows[i - 1].time);
      row.rates_at_end[0]    = df(row.time);
      row.rates_at_begin[12] = 3. * row.rates_at_begin[0];
      row.rates_at_end[12]   = 3. * row.rates_at_end[0];
    }
  const std::vector<TorqueRow> fine  = fine_curve(rows);
  double                       error = 0.;
  for (const TorqueRow &row : fine)
    grow(error,
         std::max(std::abs(row.torque_Nmm - f(row.time)),
                  std::abs(row.angle_deg - 3. * f(row.time))));
  std::cout << "A cubic in two steps, " << fine.size() << " points"
            << std::endl;
  report("  error", error, 1e-14);
  // up and down: f(t) = 2.05 twice; angles on chords of 1/16 of a step
  const std::vector<TorqueRow> at = rows_at(fine, {6.15});
  report("  passes the angle twice", at.size() == 2);
  for (const TorqueRow &row : at)
    {
      report("  at the angle", std::abs(row.angle_deg - 6.15), 1e-12);
      report("  is there at this time", std::abs(f(row.time) - 2.05), 0.01);
    }
}



// The law of mixed mode ends abruptly: pulled at 45 degrees in one phase, the
// forces fall to nothing within one of the long steps that are smooth before.
// Against 400 equal steps, and drawn as if it were smooth, off by five
// tolerances.
void
check_hidden_kink()
{
  const std::string pulled =
    "subsection Bone\n set Cells = 6, 6, 2\n set Material = linear\nend\n"
    "subsection Implant\n set Cells = 3, 4\n set Material = linear\nend\n"
    "subsection Interface\n set Law = mixed mode\n"
    " set Normal stiffness = 622\n set Tangential stiffness = 305\n"
    " set Characteristic slip distance = 0.042\n"
    " set Friction coefficient unbroken = 0.586\n"
    " subsection Mixed mode\n"
    "  set Normal strength = 5\n set Shear strength = 8\n"
    "  set Fracture energy I = 0.05\n set Fracture energy II = 0.15\n"
    "  set Stiffness = 2000\n set Criterion = benzeggagh-kenane\n"
    " end\nend\n"
    "subsection Chuck\n"
    " subsection Translation x\n  set Value = 0.12 * t\n end\n"
    " subsection Press\n  set Value = -0.12 * t\n end\nend\n"
    "subsection Load steps\n set Times = 0, 1\n set Steps = 10\nend\n"
    "subsection Expert\n"
    " subsection Bone\n  set Layer grading = 1.5\n end\n"
    " subsection Implant\n  set Layer grading = 1.5\n end\n"
    " subsection Interface\n  subsection Mixed mode\n   set Exponent = 2\n"
    "  end\n end\nend\n";
  const auto rows = run_scene("equal", pulled, {"Load steps/Steps=400"});
  const auto fine = fine_curve(
    run_scene("adaptive",
              pulled,
              {"Load steps/Adaptive=true", "Load steps/Tolerance=1e-2"}));
  std::cout << "A kink within a step" << std::endl;
  double error = 0., largest = 0.;
  auto   after = fine.begin();
  for (const TorqueRow &row : rows)
    {
      while (after->time < row.time - 1e-12)
        ++after;
      const auto   before = after == fine.begin() ? after : std::prev(after);
      const double part   = after == before ? 0. :
                                              (row.time - before->time) /
                                              (after->time - before->time);
      const double force =
        before->chuck_reaction[0] +
        part * (after->chuck_reaction[0] - before->chuck_reaction[0]);
      grow(error, std::abs(force - row.chuck_reaction[0]));
      grow(largest, std::abs(row.chuck_reaction[0]));
    }
  report("  error over the tolerance", error / largest / 1e-2, 1.5);
}



const std::string rigid_coin =
  "subsection Bone\n set Material = rigid\nend\n"
  "subsection Implant\n set Material = rigid\n set Cells = 8, 2\nend\n"
  "subsection Chuck\n"
  "  subsection Press\n set Value = 0.0049 * min(t, 1)\n end\n"
  "end\n";

/** Largest differences of forces, moments, and the angle, over the largest of
 *  them. */
double
largest_error(const std::vector<TorqueRow> &reference,
              const std::vector<TorqueRow> &fine)
{
  double error[3]{0., 0., 0.}, largest[3]{0., 0., 1e-12};
  auto   after = fine.begin();
  for (const TorqueRow &row : reference)
    {
      while (after->time < row.time - 1e-12)
        ++after;
      const TorqueRow &before = after == fine.begin() ? *after : after[-1];
      const double     h      = after->time - before.time,
                   s          = h > 0. ? (row.time - before.time) / h : 0.;
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double value =
            before.chuck_reaction[k] +
            s * (after->chuck_reaction[k] - before.chuck_reaction[k]);
          grow(error[k / 3], std::abs(value - row.chuck_reaction[k]));
          grow(largest[k / 3], std::abs(row.chuck_reaction[k]));
        }
      grow(error[2],
           std::abs(before.angle_deg +
                    s * (after->angle_deg - before.angle_deg) - row.angle_deg));
      grow(largest[2], std::abs(row.angle_deg));
    }
  return std::max(
    {error[0] / largest[0], error[1] / largest[1], error[2] / largest[2]});
}



void
check_tolerance(const std::string              &name,
                const std::vector<std::string> &motion,
                const unsigned int              n_rows)
{
  std::vector<std::string> planned(motion), adaptive(motion);
  planned.push_back("Load steps/Steps=1, 800, 800");
  adaptive.push_back("Load steps/Steps=1, 10, 10");
  adaptive.push_back("Load steps/Adaptive=true");
  const auto rows = run_scene("adaptive " + name, rigid_coin, adaptive);
  std::cout << name << std::endl;
  report("  error over the tolerance",
         largest_error(run_scene("planned " + name, rigid_coin, planned),
                       fine_curve(rows)) /
           1e-3,
         1.5);
  report("  rows", rows.size(), n_rows);
}



// Time is a parameter: loads in another unit of it take as many rows.
void
check_unit_of_time()
{
  std::cout << "another unit of time" << std::endl;
  std::vector<double> n_rows;
  for (const std::string unit : {"1", "1e-5"})
    n_rows.push_back(
      run_scene("unit " + unit,
                rigid_coin,
                {"Chuck/Press/Value=0.0049 * min(t / " + unit + ", 1)",
                 "Chuck/Rotation z/Value=2 * max(t / " + unit + " - 1, 0)",
                 "Load steps/Times=0, " + unit + ", 2" + unit.substr(1),
                 "Load steps/Steps=1, 10",
                 "Load steps/Adaptive=true"})
        .size());
  report("  rows, over those before", n_rows[1] / n_rows[0], 1.1);
}



void
check_files()
{
  run_scene("at angles",
            rigid_coin,
            {"Chuck/Rotation z/Value=2 * max(t - 1, 0)",
             "Load steps/Steps=1, 10",
             "Load steps/Adaptive=true",
             "Expert/Output/Curve angles=7, 1.5, 0, 0.5, -3"});
  std::ifstream table("results/at angles/curve_at.csv");
  std::string   line;
  std::getline(table, line);
  while (std::getline(table, line))
    std::cout << "curve_at.csv has "
              << std::stod(line.substr(line.find(',') + 1))
              << " degrees, not before time " << std::floor(std::stod(line))
              << std::endl;
}



void
test()
{
  check_rates("Linear bodies",
              {"Bone/Material=linear", "Implant/Material=linear"});
  check_rates("Neo-Hookean bodies", {});
  check_rates("The bone as slave, viscosity",
              {"Bone/Material=linear",
               "Implant/Material=linear",
               "Expert/Interface/Slave=bone",
               "Interface/Viscosity=0.5"});
  check_rates("A machine with springs and loads",
              {"Bone/Material=linear",
               "Implant/Material=linear",
               "Chuck/Press/Control=force",
               "Chuck/Press/Value=50 * (0.1 + min(t, 1))",
               "Chuck/Rotation x/Control=moment",
               "Chuck/Rotation x/Value=2 * max(t - 1, 0)",
               "Chuck/Rotation z/Stiffness=20000"});
  check_rates("A machine as stiff as can be",
              {"Bone/Material=linear",
               "Implant/Material=linear",
               "Chuck/Press/Stiffness=1e18",
               "Chuck/Rotation z/Stiffness=1e18"});
  check_unit_of_time();
  check_cubic();
  check_tolerance("circle",
                  {"Load steps/Times=0, 1, 2, 3",
                   "Chuck/Translation x/Value=0.01 * (min(max(t - 1, 0), 1) + "
                   "cos(2 * pi * max(t - 2, 0)) - 1)",
                   "Chuck/Translation y/Value=0.01 * sin(2 * pi * max(t - 2, "
                   "0))"},
                  200);
  check_tolerance("fretting",
                  {"Load steps/Times=0, 1, 2, 3",
                   "Chuck/Translation x/Value=0.01 * sin(2 * pi * max(t - 1, "
                   "0))",
                   "Chuck/Rotation z/Value=0.3 * max(t - 1, 0)"},
                  250);
  check_tolerance("moment",
                  {"Load steps/Times=0, 1, 2, 3",
                   "Chuck/Rotation z/Control=moment",
                   "Chuck/Rotation z/Value=52 * (min(max(t - 1, 0), 1) - 1.8 * "
                   "max(t - 2, 0))"},
                  80);
  check_hidden_kink();
  check_files();
}



int
main()
{
  return run_test(test);
}
