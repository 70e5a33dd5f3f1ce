// What is dissipated where points open within a step. Rigid bodies on the
// elastic interface, a constant coefficient of friction; all numbers are closed
// forms of doc/theory.md, Energies:
//
//  - points that stick at u and are lifted lose eps_t u^2 / 2, in one step;
//  - points that are shifted while they are lifted first stick, then slide;
//  - where the gap turns on its way, one step loses what 1000 do;
//  - what goes over the edge while it is pressed loses both springs.
//
// In each of them the normal spring gives back what it has stored.

#include <algorithm>
#include <array>

#include "driven_scene.h"

const char *const rigid = R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
end
subsection Interface
  set Friction law = coulomb
end
)";

const double eps = 585., d = 0.0049, mu = 0.4, radius = 2.5;
const double area = M_PI * radius * radius, limit = mu * d; // [mm]

/** Pressed until 1, shifted by a vector until 2; then lifted by twice the depth
 *  and shifted by another one, in @p n steps. */
std::vector<Debond::TorqueRow>
lifted(const std::array<double, 2> &before,
       const std::array<double, 2> &while_lifted,
       const unsigned int           n)
{
  const auto shift = [](const double a, const double b) {
    return std::to_string(a) + " * min(max(t - 1, 0), 1) + " +
           std::to_string(b) + " * max(t - 2, 0)";
  };
  return run_scene(
    "points_that_open",
    rigid,
    {"Implant/Cells=6, 2",
     "Interface/Friction coefficient broken=" + std::to_string(mu),
     "Interface/Penalty stiffness=" + std::to_string(eps),
     "Chuck/Translation z/Value=-0.0049 * min(t, 1) + 0.0098 * max(t - 2, 0)",
     "Chuck/Translation x/Value=" + shift(before[0], while_lifted[0]),
     "Chuck/Translation y/Value=" + shift(before[1], while_lifted[1]),
     "Load steps/Times=0, 1, 2, 3",
     "Load steps/Steps=1, 4, " + std::to_string(n)});
}



double
lost_in_lift(const std::array<double, 2> &before,
             const std::array<double, 2> &while_lifted,
             const unsigned int           n = 1)
{
  const auto rows = lifted(before, while_lifted, n);
  report("  no row with a warning",
         std::all_of(rows.begin(), rows.end(), [](const auto &row) {
           return row.warnings == 0;
         }));
  return rows.back().dissipation_Nmm - rows[5].dissipation_Nmm;
}



// Closed until the middle of the step, where the chuck has gone by half of its
// way.
void
check_closed_forms()
{
  std::cout << "stuck, lifted" << std::endl;
  const double u = 0.7 * limit;
  report("  dissipation differs by",
         std::abs(lost_in_lift({{u, 0.}}, {{0., 0.}}) /
                    (0.5 * eps * u * u * area) -
                  1.),
         1e-4);
  std::cout << "lifted and shifted from rest" << std::endl;
  for (const double way : {0.2 * limit, 2. * limit, 0.05})
    {
      const double k = 0.5 * way / limit;
      report("  dissipation differs by",
             std::abs(lost_in_lift({{0., 0.}}, {{way, 0.}}) /
                        (0.5 * eps * limit * limit * k * k / (1. + k) * area) -
                      1.),
             1e-4);
    }
  std::cout << "let go as the limit falls" << std::endl;
  report("  dissipation over what was stored",
         std::abs(
           lost_in_lift({{limit * (1. - 1e-9), 0.}}, {{-2. * limit, 0.}})) /
           (0.5 * eps * limit * limit * area),
         1e-6);
}



void
check_turning()
{
  const std::array<std::array<double, 2>, 3> cases{
    {{{-3. * limit, 0.}}, {{0., 4. * limit}}, {{1.5 * limit, -0.02}}}};
  for (const auto &while_lifted : cases)
    {
      std::cout << "slid, lifted and shifted elsewhere" << std::endl;
      const double one  = lost_in_lift({{0.02, 0.}}, while_lifted),
                   many = lost_in_lift({{0.02, 0.}}, while_lifted, 1000);
      report("  dissipation of one step and of many differs by",
             std::abs(one / many - 1.),
             0.01);
      report("  it is no matter of course",
             std::abs(many / (0.5 * eps * limit * limit * area) - 1.) > 0.05);
    }
}



// A frictionless block of 4 x 4 mm is pushed until half of it hangs over the
// edge: the chuck does no work along the edge, and half of what the push-in has
// stored is lost. With friction the work is mu p int A(x) dx as well.
void
check_edge(const double coefficient)
{
  std::cout << "pushed over the edge, mu = " << coefficient << std::endl;
  const auto rows =
    run_scene("points_over_edge",
              rigid,
              {"Bone/Size=6, 6, 3",
               "Implant/Shape=block",
               "Implant/Size=4, 4, 2",
               "Implant/Cells=20, 4, 2",
               "Interface/Friction coefficient broken=" +
                 std::to_string(coefficient),
               "Interface/Penalty stiffness=" + std::to_string(eps),
               "Chuck/Translation z/Value=-0.0049 * min(t, 1)",
               "Chuck/Translation x/Value=3 * max(t - 1, 0)",
               "Load steps/Times=0, 1, 1.001, 2",
               "Load steps/Steps=1, 10, 37"});
  const double stored  = 0.5 * eps * d * d,
               springs = stored * (1. + coefficient * coefficient) * 8.,
               rubbed  = coefficient * eps * d * (16. * 1. + 12. * 2.);
  report("  dissipation differs by",
         std::abs(rows.back().dissipation_Nmm / (springs + rubbed) - 1.),
         0.01);
  report("  no row with a warning",
         std::all_of(rows.begin(), rows.end(), [](const auto &row) {
           return row.warnings == 0;
         }));
}



void
test()
{
  check_closed_forms();
  check_turning();
  check_edge(0.);
  check_edge(mu);
}



int
main()
{
  return run_test(test);
}
