// What is dissipated where points open within a step. Closed forms of rigid
// bodies on the elastic interface with a constant coefficient of friction:
//
//  - points that stick at u and are lifted lose eps_t u^2 / 2, in one step;
//  - points that are shifted while they are lifted first stick, then slide:
//    from rest they lose eps_t L^2/2 k^2/(1 + k), L the gap at the limit of
//    friction and k the way until they open over L;
//  - what goes over the edge while it is pressed loses both springs.
//
// Where the gap turns on its way, the bond breaks, or bodies give way, one step
// loses what many do.
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
lifted(const std::array<double, 2>    &before,
       const std::array<double, 2>    &while_lifted,
       const unsigned int              n,
       const std::vector<std::string> &others = {})
{
  const auto shift = [](const double a, const double b) {
    return std::to_string(a) + " * min(max(t - 1, 0), 1) + " +
           std::to_string(b) + " * max(t - 2, 0)";
  };
  const bool               breaks  = std::count(others.begin(),
                                 others.end(),
                                 "Interface/Friction law=modified coulomb") > 0;
  std::vector<std::string> entries = {
    "Implant/Cells=6, 2",
    "Interface/Friction coefficient" + std::string(breaks ? " broken=" : "=") +
      std::to_string(mu),
    "Interface/Normal stiffness=" + std::to_string(eps),
    "Chuck/Press/Value=0.0049 * min(t, 1) - 0.0098 * max(t - 2, 0)",
    "Chuck/Translation x/Value=" + shift(before[0], while_lifted[0]),
    "Chuck/Translation y/Value=" + shift(before[1], while_lifted[1]),
    "Load steps/Times=0, 1, 2, 3",
    "Load steps/Steps=1, 4, " + std::to_string(n)};
  entries.insert(entries.end(), others.begin(), others.end());
  return run_scene("points_that_open", rigid, entries);
}



double
lost_in_lift(const std::array<double, 2>    &before,
             const std::array<double, 2>    &while_lifted,
             const unsigned int              n      = 1,
             const std::vector<std::string> &others = {})
{
  const auto rows = lifted(before, while_lifted, n, others);
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
  std::cout << "held by viscosity until it opens" << std::endl;
  const double way = 20. * limit;
  report("  dissipation differs by",
         std::abs(lost_in_lift(
                    {{0., 0.}}, {{way, 0.}}, 1, {"Interface/Viscosity=1e7"}) /
                    (0.5 * eps * 0.25 * way * way * area) -
                  1.),
         1e-3);
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



/** Shifted by @p before, then lifted and shifted, in one step and in @p n. */
void
check_steps(const std::string              &what,
            const std::array<double, 2>    &before,
            const std::array<double, 2>    &while_lifted,
            const unsigned int              n,
            const std::vector<std::string> &others)
{
  std::cout << what << std::endl;
  const auto lost = [&](const unsigned int steps) {
    const auto rows = lifted(before, while_lifted, steps, others);
    return rows.back().dissipation_Nmm - rows[5].dissipation_Nmm;
  };
  report("  dissipation of one step and of many differs by",
         std::abs(lost(1) / lost(n) - 1.),
         0.01);
}



// The bond of the paper breaks on a way of some 50 um.
void
check_bond()
{
  const std::vector<std::string> bond = {
    "Interface/Friction law=modified coulomb"};
  check_steps(
    "the bond breaks while lifted", {{0.024, 0.}}, {{0.06, 0.}}, 1000, bond);
  check_steps("and turns", {{0.024, 0.}}, {{0., 0.1}}, 1000, bond);
}



// Bodies store a tenth of the energy, or most of it, and friction takes it.
// There is no friction in the push-in, which would lock tractions in the face.
void
check_bodies()
{
  for (const char *const stiffness : {"585", "1800", "20000"})
    {
      const std::vector<std::string> elastic = {
        "Bone/Material=linear",
        "Implant/Material=linear",
        "Interface/Friction starts at=1",
        std::string("Interface/Normal stiffness=") + stiffness};
      const std::string name = std::string(", ") + stiffness + " MPa/mm";
      check_steps(
        "slid, lifted" + name, {{0.02, 0.}}, {{0., 0.}}, 200, elastic);
      // tractions under so stiff an interface do not fall evenly: 3 %
      if (stiffness != std::string("20000"))
        check_steps("stuck, lifted" + name,
                    {{0.7 * limit, 0.}},
                    {{0., 0.}},
                    200,
                    elastic);
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
               "Interface/Friction coefficient=" + std::to_string(coefficient),
               "Interface/Normal stiffness=" + std::to_string(eps),
               "Chuck/Press/Value=0.0049 * min(t, 1)",
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
  check_bond();
  check_bodies();
  check_edge(0.);
  check_edge(mu);
}



int
main()
{
  return run_test(test);
}
