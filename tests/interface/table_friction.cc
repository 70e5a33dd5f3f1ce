// The law of a table: sampled ever finer from Eq. (13) it becomes the modified
// Coulomb law; between the rows it is monotone; its integral, slope and
// steepest fall are those of its curve. What is wrong in a table is said with
// its place.

#include <debond/interface/modified_coulomb.h>
#include <debond/models/closed_forms.h>
#include <debond/support/input_error.h>

#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

#include "checks.h"
#include "law_of_text.h"

using namespace Debond;

FrictionLawPointer
table_of(const std::vector<double> &slip, const std::vector<double> &phi)
{
  std::ofstream file("table_friction.csv");
  file << "slip_mm,phi\n" << std::setprecision(17);
  for (std::size_t i = 0; i < slip.size(); ++i)
    file << slip[i] << ',' << phi[i] << '\n';
  file.close();
  return law_of_text(
    "set Friction law = table\nset Friction table = table_friction.csv\n");
}



/** @p n equal intervals over the whole fall of the default law. */
FrictionLawPointer
sampled(const unsigned int n)
{
  const auto          law = modified_coulomb();
  std::vector<double> slip, phi;
  for (unsigned int i = 0; i <= n; ++i)
    {
      slip.push_back(1.1 * law->kinks.back() * i / n);
      phi.push_back(law->coefficient({1., {slip.back()}}, 0.).phi);
    }
  return table_of(slip, phi);
}



void
check_convergence()
{
  const auto   exact      = modified_coulomb();
  const double end        = exact->kinks.back();
  double       last_curve = 0, last_work = 0, last_torque = 0;
  bool         converges = true;
  for (const unsigned int n : {25, 50, 100, 200, 400})
    {
      const auto table = sampled(n);
      double     curve = 0, work = 0, torque = 0;
      for (unsigned int k = 0; k <= 1000; ++k)
        {
          const double g_s = 1.5 * end * k / 1000.;
          grow(curve,
               std::abs(table->coefficient({0.8, {0.3 * g_s}}, 0.7 * g_s).mu -
                        exact->coefficient({0.8, {g_s}}, 0.).mu));
          grow(work,
               std::abs(table->work({0.8}, 1., g_s).friction -
                        exact->work({0.8}, 1., g_s).friction));
        }
      TorsionModel::Disk parameters;
      parameters.radius    = 2.5;
      parameters.pressure  = 2.6;
      parameters.stiffness = 585;

      const RigidBodiesTorsion expected(parameters);
      parameters.friction = table;
      const RigidBodiesTorsion bodies(parameters);
      for (const double theta : {0.001, 0.01, 0.016, 0.02, 0.1})
        grow(torque,
             std::abs(bodies.torque(theta) / expected.torque(theta) - 1.));
      if (n > 25)
        converges =
          converges && curve < 0.4 * last_curve && work < 0.4 * last_work;
      last_curve  = curve;
      last_work   = work;
      last_torque = torque;
    }
  report("errors of mu and work fall with the second order", converges);
  report("  mu with 400 intervals", last_curve, 3e-6);
  report("  work per pressure [mm]", last_work, 1e-7);
  report("  torque of two rigid bodies, relative", last_torque, 3e-6);
}



void
check_coarse_table()
{
  const std::vector<double> slip{0., 0.01, 0.012, 0.03, 0.05, 0.051, 0.08},
    phi{0.95, 0.95, 0.9, 0.4, 0.35, 0.1, 0.05};
  const auto table = table_of(slip, phi);
  double     rows = 0, outside = 0, slope = 0, integral = 0, too_small = 0,
         too_large = 0;
  const auto mu    = [&](const double g_s) {
    return table->coefficient({0.7, {g_s}}, 0.).mu;
  };
  for (std::size_t i = 0; i < slip.size(); ++i)
    grow(rows, std::abs(mu(slip[i]) - (0.4 + 0.18 * 0.7 * phi[i])));
  for (std::size_t i = 0; i + 1 < slip.size(); ++i)
    {
      double       sum = 0, steepest = 0;
      const double h = slip[i + 1] - slip[i];
      for (unsigned int k = 0; k <= 100; ++k)
        {
          const double g_s  = slip[i] + h * k / 100.;
          const auto   here = table->coefficient({0.7, {g_s}}, 0.);
          grow(outside, here.phi / 0.7 - phi[i]);
          grow(outside, phi[i + 1] - here.phi / 0.7);
          if (k > 0 && k < 100)
            grow(slope,
                 std::abs(here.dmu - (mu(g_s + 1e-6 * h) - mu(g_s - 1e-6 * h)) /
                                       (2e-6 * h)) *
                   h);
          sum += (k == 0 || k == 100 ? 1. : k % 2 == 1 ? 4. : 2.) * here.mu;
          grow(steepest, -here.dmu);
          grow(too_small,
               (-here.dmu - table->steepest_fall({0.7, {g_s}}, 1.)) * h);
        }
      sum *= h / 300.;
      grow(integral,
           std::abs(table->work({0.7, {slip[i]}}, 1., h).friction - sum) / h);
      if (i == 4) // the steepest of all
        grow(too_large, table->steepest_fall({0.7}, 1.) / steepest - 1.);
    }
  report("goes through the rows", rows, 1e-15);
  report("  and not beyond them in between", outside, 1e-14);
  report("  slope and differences, deviation", slope, 1e-8);
  report("  integral and Simpson's rule, relative deviation", integral, 1e-13);
  report("  falls no steeper than it says", too_small, 1e-12);
  report("  and as steep somewhere, deviation", too_large, 1e-3);
  const auto after = table->coefficient({0.7, {0.05}}, 1.);
  report("  constant after the last row",
         after.phi == 0.7 * 0.05 && after.dmu == 0. &&
           table->steepest_fall({0.7, {0.08}}, 1.) == 0.);
  report("  integral after it, deviation",
         std::abs(table->work({0.7, {0.1}}, 1., 2.).friction -
                  2. * (0.4 + 0.18 * 0.7 * 0.05)),
         1e-14);
}



void
check_message(const std::vector<double> &slip, const std::vector<double> &phi)
{
  try
    {
      table_of(slip, phi);
      std::cout << "NO: accepted" << std::endl;
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}



int
main()
{
  check_convergence();
  check_coarse_table();
  check_message({0.1, 1, 2, 3}, {1, 1, 1, 1});
  check_message({0, 2, 1, 3}, {1, 1, 1, 1});
  check_message({0, 1, 2, 3}, {1, 1.1, 1, 1});
  check_message({0, 1, 2, 3}, {1, 0.5, 0.6, 0});
  check_message({0, 1, 2}, {1, 0.5, 0});
  try
    {
      law_of_text("set Friction law = table\n");
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}
