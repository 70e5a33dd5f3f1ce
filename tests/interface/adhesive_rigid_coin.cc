// Law = adhesive between rigid bodies, against its formulas summed over the
// program's own points and weights: a coin is pulled off, half bonded, too; is
// pulled out, pressed back and pulled again; is twisted without a load, and
// under pressure; is pulled and sheared; is pulled with a viscosity. Energies
// balance, and without strength all is as with Law = friction.

#include "driven_scene.h"

using namespace Debond;

const double t_0 = 5., g_0 = 0.005, R = 2.5, mu_b = 0.4, mu_ub = 0.58,
             eps_t = 585., A = M_PI * R * R;

const std::string rigid_coin =
  "subsection Bone\n set Material = rigid\nend\n"
  "subsection Implant\n set Material = rigid\nend\n"
  "subsection Interface\n set Law = adhesive\nend\n";

using Overrides = std::vector<std::string>;

Overrides
moves(const std::string &component, const std::string &value)
{
  return {"Chuck/" + component + "/Value=" + value};
}

Overrides
steps(const std::string &times, const std::string &n)
{
  return {"Load steps/Times=" + times, "Load steps/Steps=" + n};
}

double
envelope(const double gap)
{
  return t_0 * gap / g_0 * std::exp(1. - gap / g_0);
}



void
check_pull_off()
{
  const double w = std::exp(1.) * t_0 * g_0;
  for (const bool half : {false, true})
    {
      const auto rows =
        run_scene("adhesive_pull_off",
                  rigid_coin,
                  moves("Translation z", "0.11 * t") + steps("0, 1", "2200") +
                    (half ? Overrides{"Interface/Bonding/Pattern=disk",
                                      "Interface/Bonding/Bonded fraction=0.5"} :
                            Overrides{}));
      const double bonded = rows[0].phi_mean * A; // by the program's points
      double       force = 0., largest = 0., defect = 0., back = 0.;
      for (const TorqueRow &row : rows)
        {
          const double g = row.chuck_position[2];
          grow(force,
               std::abs(-row.force_N -
                        (g > 20. * g_0 ? 0. : bonded * envelope(g))) /
                 (A * t_0));
          largest = std::max(largest, -row.force_N);
          grow(defect, std::abs(row.energy_defect) - row.energy_defect_bound);
          grow(back, -row.damage_Nmm);
        }
      // up to 20 g_0, where the last of the work is given up
      const double      cut  = w * (1. - 21. * std::exp(-20.));
      const std::string name = half ? "half bonded: " : "pulled off: ";
      report(name + "force, deviation from the envelope over A t_0",
             force,
             1e-10);
      report(name + "largest force over that at g_0, deviation",
             std::abs(largest / (bonded * t_0) - 1.),
             1e-10);
      report(name + "work, deviation from e t_0 g_0 per area",
             std::abs(rows.back().work_Nmm / (bonded * cut) - 1.),
             2e-5);
      report(name + "damage is all of it",
             std::abs(rows.back().damage_Nmm / (bonded * cut) - 1.),
             1e-7);
      report(name + "energies balance within the bound by", defect, 1e-12);
      report(name + "all is dissipated",
             std::abs(rows.back().dissipation_Nmm / rows.back().damage_Nmm -
                      1.) +
               rows.back().energy_interface_Nmm,
             1e-6);
    }
}



// Out to 1.5 g_0, back to -1 um, out again.
void
check_reload()
{
  const auto rows =
    run_scene("adhesive_reload",
              rigid_coin,
              moves("Translation z",
                    "if(t < 1, 0.0075 * t, if(t < 2, 0.0075 - 0.0085 * (t - "
                    "1), -0.001 + 0.016 * (t - 2)))") +
                steps("0, 1, 2, 3", "30, 34, 160"));
  double second = 0., largest = 0., pressed = 0., damage = 0.;
  for (const TorqueRow &row : rows)
    {
      const double g = row.chuck_position[2];
      if (row.time <= 1.)
        continue;
      if (g < -1e-9)
        grow(pressed, std::abs(row.force_N / (-585. * g * A) - 1.));
      else if (g <= 0.0075 + 1e-9)
        grow(second,
             std::abs(-row.force_N / A - envelope(0.0075) * g / 0.0075) / t_0);
      if (row.time > 2.)
        largest = std::max(largest, -row.force_N);
      if (g < 0.0075 - 1e-9)
        grow(damage, std::abs(row.damage_Nmm / rows[30].damage_Nmm - 1.));
    }
  report("pulled again: straight, deviation over t_0", second, 1e-10);
  report("pulled again: the largest force is that at 1.5 g_0, deviation",
         std::abs(largest / (A * envelope(0.0075)) - 1.),
         1e-10);
  report("pressed between: as always, deviation", pressed, 1e-10);
  report("no damage on the way, deviation", damage, 1e-14);
  // a trapezoid is exact on straight lines
  report("energies of the way back and out balance, over the work",
         std::abs(rows[149].energy_defect - rows[30].energy_defect),
         1e-12);
}



// T = (2 pi/3) L R^3 less the core that sticks, while the rim has not slid by
// a_s.
void
check_twist()
{
  std::vector<double> errors;
  for (const std::string points : {"5", "20"})
    for (const double pressed : {0., 0.002})
      {
        const auto rows =
          run_scene("adhesive_twist",
                    rigid_coin,
                    moves("Translation z",
                          "-" + std::to_string(pressed) + " * min(t, 1)") +
                      moves("Rotation z", "0.4 * max(t - 1, 0)") +
                      steps("0, 1, 2", "1, 20") +
                      Overrides{"Interface/Quadrature points=" + points});
        const double L     = mu_ub * (t_0 + 585. * pressed),
                     theta = 0.4 * M_PI / 180., r_s = L / (eps_t * theta),
                     T = 2. * M_PI / 3. * L *
                         (R * R * R - 0.25 * r_s * r_s * r_s);
        errors.push_back(std::abs(rows.back().torque_Nmm / T - 1.));
      }
  for (const unsigned int i : {0, 1})
    {
      const std::string name =
        i == 0 ? "twisted: " : "twisted under pressure: ";
      report(name + "torque, deviation from the formula", errors[2 + i], 1e-4);
      report(name + "more with few points", errors[i] > errors[2 + i]);
    }
}



// On the envelope L = mu_ub (t_0 - sigma_e) up to g_0.
void
check_pull_and_shear()
{
  const auto   rows = run_scene("adhesive_shear",
                              rigid_coin,
                              moves("Translation z", "0.0025 * min(t, 1)") +
                                moves("Translation x", "0.01 * max(t - 1, 0)") +
                                steps("0, 1, 2", "10, 10"));
  const double force =
    std::hypot(rows.back().chuck_reaction[0], rows.back().chuck_reaction[1]);
  report("pulled and sheared: deviation from mu_ub t_0 (1 - sqrt(e)/2)",
         std::abs(force / (A * mu_ub * t_0 * (1. - 0.5 * std::sqrt(M_E))) - 1.),
         1e-9);
  // beyond g_0 nothing is left of it
  const auto beyond =
    run_scene("adhesive_shear",
              rigid_coin,
              moves("Translation z", "0.006 * min(t, 1)") +
                moves("Translation x", "0.01 * max(t - 1, 0)") +
                steps("0, 1, 2", "10, 10"));
  report("pulled beyond g_0: no force along the face, over A t_0",
         std::hypot(beyond.back().chuck_reaction[0],
                    beyond.back().chuck_reaction[1]) /
           (A * t_0),
         1e-12);
  report("all of it is pulled, and slips",
         beyond.back().share_pulled > 1. - 1e-12 &&
           beyond.back().adhesive_work_Nmm == beyond.back().damage_Nmm);
}



// With a viscosity a coin that is pulled at the speed v carries A d eta v more
// while it opens, and none on its way back.
void
check_viscosity()
{
  const double eta = 20., v = 0.0075;
  const auto   rows =
    run_scene("adhesive_viscous",
              rigid_coin,
              moves("Translation z",
                    "if(t < 1, 0.0075 * t, 0.015 - 0.0075 * t)") +
                steps("0, 1, 1.8", "60, 20") +
                Overrides{"Interface/Adhesive/Opening viscosity=20"});
  double out = 0., back = 0., work = 0., g_before = 0., before = 0.;
  for (const TorqueRow &row : rows)
    {
      const double g      = row.chuck_position[2];
      const bool   opens  = row.step > 0 && row.time <= 1.;
      const double left   = g <= g_0 ? 1. : envelope(g) / t_0,
                   resist = opens ? left * eta * v : 0.;
      grow(opens ? out : back,
           std::abs(
             -row.force_N / A - resist -
             (row.time <= 1. ? envelope(g) : envelope(0.0075) * g / 0.0075)) /
             t_0);
      // a trapezoid, of which the step that turns back has a part as well
      work += 0.5 * A * (before + resist) * (g - g_before);
      g_before = g;
      before   = resist;
    }
  report("viscous: d eta v more, deviation over t_0", out, 1e-10);
  report("viscous: nothing more on the way back, deviation over t_0",
         back,
         1e-10);
  report("viscous work, deviation",
         std::abs(rows.back().viscous_work_Nmm / work - 1.),
         1e-9);
  report("viscous: energies balance within the bound",
         std::abs(rows.back().energy_defect) < rows.back().energy_defect_bound);
}



// The tolerance of adaptive steps holds for the axial force as for the torque.
void
check_adaptive_steps()
{
  const auto rows =
    run_scene("adhesive_adaptive",
              rigid_coin,
              moves("Translation z", "0.11 * t") + steps("0, 1", "10") +
                Overrides{"Load steps/Adaptive=true",
                          "Load steps/Tolerance=1e-3"});
  double force = 0.;
  for (const TorqueRow &row : fine_curve(rows))
    if (const double g = row.chuck_position[2]; g < 20. * g_0)
      grow(force, std::abs(-row.force_N / A - envelope(g)) / t_0);
  report("adaptive steps of a tolerance of 1e-3: force, deviation over A t_0",
         force,
         1e-3);
  report("they are few", rows.size() < 60);
}



void
check_without_strength()
{
  const std::string motion = "if(t < 1, -0.003 * t, -0.003 + 0.002 * (t - 1))";
  const auto        run    = [&](const std::string &law) {
    return torque_table(
      run_scene("adhesive_none",
                rigid_coin,
                moves("Translation z", motion) + moves("Rotation z", "2 * t") +
                  steps("0, 1, 2", "10, 10") + Overrides{law}));
  };
  report("without strength every digit is that of Law = friction",
         run("Interface/Adhesive/Strength=0") == run("Interface/Law=friction"));
}



int
main()
{
  return run_test([] {
    check_pull_off();
    check_reload();
    check_twist();
    check_pull_and_shear();
    check_viscosity();
    check_adaptive_steps();
    check_without_strength();
  });
}
