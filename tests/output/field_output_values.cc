// What the VTU files hold, read back: two rigid bodies, pressed and turned. The
// disk is round, warping gives the turned implant, the interface arrays are
// those of the closed form; a bonding pattern is as sharp as the elements; the
// series names files and times; nothing depends on the date.

#include <debond/interface/friction_law.h>
#include <debond/models/closed_forms.h>
#include <debond/output/field_output.h>
#include <debond/output/result_files.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "driven_scene.h"
#include "vtu_file.h"

using namespace Debond;

/** phi of the default law at a sliding distance. */
double
phi_of(const double phi_0, const double slip)
{
  return modified_coulomb()->coefficient({phi_0, {slip}}, 0.).phi;
}


constexpr double depth = 0.0049;                     // [mm]
constexpr double angle = dealii::numbers::PI / 180.; // [rad]

/** Largest value that @p deviation has at the points of a file; NaN if there
 *  are none. */
double
largest(const unsigned int                               n_points,
        const std::function<double(const unsigned int)> &deviation)
{
  double result = n_points > 0 ? 0. : NAN;
  for (unsigned int i = 0; i < n_points; ++i)
    {
      const double value = deviation(i);
      if (!std::isnan(result) && !(value <= result))
        result = value;
    }
  return result;
}



Eigen::Vector3d
vector_at(const std::vector<float> &values, const unsigned int i)
{
  return {values.at(3 * i), values.at(3 * i + 1), values.at(3 * i + 2)};
}



const char *const turned_coin = R"(
subsection Bone
  set Cells    = 5, 5, 2
  set Material = rigid
end
subsection Implant
  set Cells    = 6, 2
  set Material = rigid
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * t
  end
  subsection Rotation z
    set Value = t
  end
end
subsection Load steps
  set Times = 0, 1
  set Steps = 1
end
)";



/** x - X of a point of the implant. */
Eigen::Vector3d
turned(const Eigen::Vector3d &X)
{
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * X[0] - s * X[1] - X[0], s * X[0] + c * X[1] - X[1], -depth};
}



void
check_bulk(const std::string &vtu)
{
  const auto X = read_array(vtu, ""), u = read_array(vtu, "displacement");
  const auto body             = read_array(vtu, "body");
  const auto v                = read_array(vtu, "displacement_in_frame");
  const auto stress           = read_array(vtu, "stress_MPa");
  const auto mises            = read_array(vtu, "von_Mises_MPa");
  const unsigned int n_points = body.size();
  std::cout << "bulk: arrays of all points: "
            << (X.size() == 3 * n_points && u.size() == 3 * n_points &&
                    v.size() == 3 * n_points && stress.size() == 9 * n_points &&
                    mises.size() == n_points ?
                  "yes" :
                  "NO")
            << std::endl;

  report("bulk: deviation of displacements [mm]",
         largest(n_points,
                 [&](const unsigned int i) {
                   const Eigen::Vector3d expected = body[i] == 1 ?
                                                      turned(vector_at(X, i)) :
                                                      Eigen::Vector3d::Zero();
                   return (vector_at(u, i) - expected).norm() +
                          vector_at(v, i).norm();
                 }),
         1e-6);
  report("bulk: stress of rigid bodies",
         largest(n_points,
                 [&](const unsigned int i) {
                   return std::abs(mises.at(i)) + std::abs(stress.at(9 * i));
                 }),
         1e-300);

  unsigned int n_on_circle = 0;
  const double outside     = largest(n_points, [&](const unsigned int i) {
    if (body[i] == 0)
      return 0.;
    const double r = vector_at(X, i).head<2>().norm();
    if (X[3 * i + 2] == 0 && std::abs(r - 2.5) < 1e-6)
      ++n_on_circle;
    return std::max(0., r - 2.5);
  });
  report("bulk: points outside the circle [mm]", outside, 1e-6);
  // 24 pieces along each of the four sides; points of neighbours coincide
  std::cout << "bulk: points on the circle at the contact face: " << n_on_circle
            << std::endl;
}



void
check_interface(const std::string &vtu)
{
  const auto X = read_array(vtu, ""), u = read_array(vtu, "displacement");
  const auto traction = read_array(vtu, "traction_MPa");
  const auto pressure = read_array(vtu, "pressure_MPa");
  const auto gap = read_array(vtu, "gap_mm"), slip = read_array(vtu, "slip_mm");
  const auto phi = read_array(vtu, "phi"), phi_0 = read_array(vtu, "phi_0");
  const auto mu = read_array(vtu, "mu"), state = read_array(vtu, "state");
  const unsigned int n_points = state.size();

  report("interface: deviation of displacements [mm]",
         largest(n_points,
                 [&](const unsigned int i) {
                   return (vector_at(u, i) - turned(vector_at(X, i))).norm();
                 }),
         1e-6);
  report("interface: deviation of pressure [MPa]",
         largest(n_points,
                 [&](const unsigned int i) {
                   return std::abs(pressure.at(i) - 585 * depth);
                 }),
         1e-6);
  report("interface: deviation of gap [mm]",
         largest(n_points,
                 [&](const unsigned int i) {
                   return std::abs(gap.at(i) + depth);
                 }),
         1e-8);
  report("interface: deviation of phi_0",
         largest(n_points,
                 [&](const unsigned int i) {
                   return std::abs(phi_0.at(i) - 1.);
                 }),
         1e-6);

  TorsionModel::Disk parameters;
  parameters.radius    = 2.5;
  parameters.pressure  = 585 * depth;
  parameters.stiffness = 585;
  const RigidBodiesTorsion exact(parameters);
  // Between quadrature points values are interpolated, and beyond the outermost
  // they are constant: that is no more than a picture needs.
  report("interface: deviation of slip [mm]",
         largest(n_points,
                 [&](const unsigned int i) {
                   const double r = vector_at(X, i).norm();
                   return std::abs(slip.at(i) - exact.slip(r, angle));
                 }),
         1e-3);
  report("interface: deviation of traction against the rotation [MPa]",
         largest(n_points,
                 [&](const unsigned int i) {
                   const Eigen::Vector3d x = vector_at(X, i);
                   const double          r = x.norm();
                   if (r < 0.3) // sticks near the axis, with a kink
                     return 0.;
                   const double c = std::cos(angle), s = std::sin(angle);
                   const Eigen::Vector3d direction(s * x[0] + c * x[1],
                                                   s * x[1] - c * x[0],
                                                   0);
                   return (vector_at(traction, i) -
                           exact.point(r, angle).traction * direction / r)
                     .norm();
                 }),
         0.1);
  report("interface: deviation of phi",
         largest(n_points,
                 [&](const unsigned int i) {
                   const double r = vector_at(X, i).norm();
                   if (r > 2.4) // beyond the outermost quadrature points
                     return 0.;
                   return std::abs(phi.at(i) -
                                   phi_of(1., exact.slip(r, angle)));
                 }),
         0.005);
  report("interface: deviation of mu from 0.4 + 0.18 phi",
         largest(n_points,
                 [&](const unsigned int i) {
                   return std::abs(mu.at(i) - 0.4 - 0.18 * phi.at(i));
                 }),
         1e-6);
  unsigned int wrong = 0, n_stick = 0;
  for (unsigned int i = 0; i < n_points; ++i)
    {
      const double r = vector_at(X, i).norm();
      n_stick += (state[i] == 1);
      wrong += (r < 0.05 && state[i] != 1) || (r > 0.3 && state[i] != 2);
    }
  std::cout << "interface: points that stick, if any, are near the axis: "
            << (n_stick > 0 && wrong == 0 ? "yes" : "NO") << std::endl;
}



/** A pattern of 1 and 0, and in one ring of elements a share, on 6 x 6
 *  elements, which are drawn as 16 x 16 pieces each. */
void
check_pattern(const std::string &resolution)
{
  DrivenScene      driven(turned_coin,
                     {"Interface/Bonding/Pattern=disk",
                           "Interface/Bonding/Bonded fraction=0.5",
                           "Expert/Interface/Bonding/Resolution=" + resolution});
  OutputParameters output;
  output.overwrite_other_results = true;
  output.directory               = "results/pattern";
  const ResultDirectory directory(output, "");
  driven.advance();
  FieldOutput(directory, driven.system).write(1);
  const std::string vtu = contents("results/pattern/interface-0000.vtu");
  const auto phi_0 = read_array(vtu, "phi_0"), phi = read_array(vtu, "phi");
  const auto mu = read_array(vtu, "mu"), slip = read_array(vtu, "slip_mm");

  // first and last drawn point of an element next to its first and last
  // quadrature point; with one value per element so are all others
  constexpr unsigned int n_drawn = 17 * 17, n_q = 5 * 5;
  const auto            &points    = driven.system.interface.get_points();
  double                 deviation = 0;
  unsigned int           n_bonded = 0, n_free = 0;
  for (unsigned int i = 0; i < phi_0.size(); ++i)
    {
      const unsigned int in_element = i % n_drawn, first = i / n_drawn * n_q;
      const bool         is_last = in_element == n_drawn - 1;
      if (resolution == "quadrature point" && in_element != 0 && !is_last)
        continue;
      const double expected = points.at(first + (is_last ? n_q - 1 : 0)).phi_0;
      deviation = std::max(deviation, std::abs(phi_0[i] - expected));
      n_bonded += (expected == 1.);
      n_free += (expected == 0.);
    }
  std::cout << "pattern: drawn points of the bonded and the free part: "
            << n_bonded << ", " << n_free << " of " << phi_0.size()
            << std::endl;
  report("pattern: deviation of phi_0 from the element's own", deviation, 1e-6);
  report("pattern: deviation of phi from phi_0 s(slip)",
         largest(phi_0.size(),
                 [&](const unsigned int i) {
                   return std::abs(phi.at(i) - phi_of(phi_0[i], slip.at(i)));
                 }),
         1e-5);
  report("pattern: deviation of mu from 0.4 + 0.18 phi",
         largest(phi_0.size(),
                 [&](const unsigned int i) {
                   return std::abs(mu.at(i) - 0.4 - 0.18 * phi.at(i));
                 }),
         1e-6);
}



void
test()
{
  OutputParameters output;
  output.overwrite_other_results = true;
  std::vector<std::string> names{"bulk-0000.vtu",
                                 "bulk-0001.vtu",
                                 "bulk.pvd",
                                 "interface-0000.vtu",
                                 "interface-0001.vtu",
                                 "interface.pvd",
                                 "points-0000.vtu",
                                 "points-0001.vtu",
                                 "points.pvd"};
  for (const std::string name : {"results/fields", "results/again"})
    {
      output.directory = name;
      const ResultDirectory directory(output, "");
      DrivenScene           driven(turned_coin);
      FieldOutput           fields(directory, driven.system);
      fields.write(0);
      driven.advance();
      fields.write(1. / 3.);
    }

  check_bulk(contents("results/fields/bulk-0001.vtu"));
  check_interface(contents("results/fields/interface-0001.vtu"));

  check_pattern("element");
  check_pattern("quadrature point");

  bool equal = true, dated = false;
  for (const std::string &name : names)
    {
      const std::string text = contents("results/fields/" + name);
      equal =
        equal && !text.empty() && text == contents("results/again/" + name);
      dated = dated || text.find("library on") != std::string::npos;
    }
  report("a second run writes the same files", equal);
  report("no file holds the date", !dated);
  for (const std::string series : {"bulk", "interface", "points"})
    {
      const std::string list = contents("results/fields/" + series + ".pvd");
      bool              all  = true;
      for (const std::string part : {"timestep=\"0\"",
                                     "timestep=\"0.333333333333\"",
                                     "-0000.vtu\"",
                                     "-0001.vtu\""})
        all = all && list.find(part) != list.npos;
      report(series + ".pvd: times and files", all);
    }
}



int
main()
{
  return run_test(&test);
}
