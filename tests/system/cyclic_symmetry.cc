// Scenes that look the same after a turn about the axis are computed in one
// sector. Against the same scenes with all points and unknowns: rows, forces of
// both faces and tractions of all points must be the same but for rounding and
// what is left of the residual. And what has no such symmetry, a bond on one
// side, a way across, a law whose uniqueness is asked for among all motions,
// must be computed as a whole.

#include <algorithm>

#include "driven_scene.h"

const std::string coin = R"(
subsection Bone
  set Cells    = 12, 12, 4
  set Material = linear
end
subsection Implant
  set Cells    = 6, 2
  set Material = linear
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 3 * max(t - 1, 0)
  end
end
subsection Load steps
  set Times              = 0, 1, 2
  set Steps              = 1, 12
  set Residual tolerance = 1e-11
end
)";

const std::string pin = R"(
subsection Bone
  set Shape        = sleeve
  set Outer radius = 6
  set Element      = quadratic
  set Cells        = 12, 3, 1
  set Material     = linear
end
subsection Implant
  set Shape    = pin
  set Radius   = 2
  set Height   = 5
  set Element  = quadratic
  set Cells    = 12, 1, 1
  set Material = linear
end
subsection Interface
  set Interference = 0.02
end
subsection Chuck
  subsection Translation z
    set Value = 0.05 * t
  end
  subsection Rotation z
    set Value = 4 * t
  end
end
subsection Load steps
  set Times              = 0, 1
  set Steps              = 10
  set Residual tolerance = 1e-11
end
)";



/** Largest difference, relative to the largest of the second. */
template <typename Numbers>
double
difference(const Numbers &a, const Numbers &b)
{
  return a.size() != b.size() ? std::nan("") :
                                (a - b).cwiseAbs().maxCoeff() /
                                  std::max(b.cwiseAbs().maxCoeff(), 1e-6);
}



Eigen::MatrixXd
tractions(const Debond::ContactInterface &interface)
{
  std::vector<Debond::SlavePoint> images;
  const auto     &points = interface.points_of_all_sectors(images);
  Eigen::MatrixXd result(11, points.size());
  for (unsigned int q = 0; q < points.size(); ++q)
    result.col(q) << points[q].X, points[q].JxW, points[q].trial.traction,
      interface.traction(points[q]).tangential, points[q].trial.state.slip;
  return result;
}



/** All sums over the points. */
Eigen::ArrayXd
sums(const Debond::ContactInterface &interface)
{
  const Debond::InterfaceSummary s = interface.summarise();
  const Debond::InterfaceWork   &w = interface.work();
  Eigen::ArrayXd                 result(24);
  result << s.phi_mean, s.share_stick, s.share_slip, s.share_open, s.pressure,
    s.energy, s.max_softening, s.steepest_softening, s.max_penetration,
    s.max_traction, s.n_closed, s.bonded_opened, interface.n_enclosed(),
    interface.n_unprojected(), interface.implant_area(),
    interface.faces_at_start().bonding_area, w.dissipation, w.dissipation_bound,
    w.step_dissipation, w.adhesive, w.viscous, w.damage, w.friction,
    w.friction_bound;
  return result;
}



/** Both computations, step by step. */
void
compare(const std::string              &name,
        const unsigned int              n_sectors,
        const std::string              &text,
        const std::vector<std::string> &overrides = {})
{
  using namespace Debond;
  DrivenScene sector(text, overrides),
    whole(text,
          overrides +
            std::vector<std::string>{"Load steps/Cyclic symmetry=none"});
  std::cout << name << ": " << sector.system.interface.n_sectors() << " sectors"
            << std::endl;
  report("as many as expected",
         sector.system.interface.n_sectors() == n_sectors);
  double forces = 0, nodes = 0, points = 0, works = 0;
  bool   has_slid = false;
  do
    {
      const auto &own = sector.system, &all = whole.system;
      grow(forces, difference(own.chuck_forces(), all.chuck_forces()));
      for (const Side side : both_sides)
        grow(nodes,
             difference(own.interface.force(side), all.interface.force(side)));
      grow(points,
           difference(tractions(own.interface), tractions(all.interface)));
      const Eigen::ArrayXd a = sums(own.interface), b = sums(all.interface);
      grow(works, ((a - b).abs() / b.abs().max(1e-3)).maxCoeff());
      has_slid = has_slid || b[2] > 0.9;
    }
  while (sector.advance() && whole.advance());
  report("it slides", has_slid);
  report("forces of the chuck", forces, 1e-8);
  report("forces on both faces", nodes, 1e-8);
  report("tractions and slip of all points", points, 1e-7);
  report("sums over the points", works, 1e-7);
}



/** Rows of runs, adaptive or along a path, whose steps end where their states
 *  have them end: times of all rows, numbers of the last one. */
void
compare_runs(const std::string              &name,
             const std::string              &text,
             const std::vector<std::string> &overrides,
             const double                    limit)
{
  const auto rows = run_scene("sector", text, overrides),
             all  = run_scene("whole",
                             text,
                             overrides + std::vector<std::string>{
                                            "Load steps/Cyclic symmetry=none"});
  double largest = 0, change = 0, late = 0;
  for (const Debond::TorqueRow &row : all)
    grow(largest, std::abs(row.torque_Nmm));
  for (std::size_t i = 0; i < std::min(rows.size(), all.size()); ++i)
    grow(late, std::abs(rows[i].time - all[i].time));
  const Debond::TorqueRow &a = rows.back(), &b = all.back();
  for (const auto &[x, y] :
       {std::pair(a.torque_Nmm / largest, b.torque_Nmm / largest),
        std::pair(a.work_Nmm / b.work_Nmm, 1.),
        std::pair(a.dissipation_Nmm / b.work_Nmm,
                  b.dissipation_Nmm / b.work_Nmm),
        std::pair(a.phi_mean, b.phi_mean),
        std::pair(a.chuck_position[5] / b.chuck_position[5], 1.)})
    grow(change, std::abs(x - y));
  report(name + ", as many rows", rows.size() == all.size());
  report(name + ", change of times", late, limit);
  report(name + ", change at the end", change, limit);
}



void
expect_whole(const std::string              &name,
             const std::string              &text,
             const std::vector<std::string> &overrides)
{
  report(name + " is computed as a whole",
         DrivenScene(text, overrides).system.interface.n_sectors() == 1);
}



void
test()
{
  compare("coin", 4, coin);
  compare("bone as slave", 4, coin, {"Interface/Slave=bone"});
  compare("Neo-Hookean bodies",
          4,
          coin,
          {"Bone/Material=neo-hookean", "Implant/Material=neo-hookean"});
  compare("splines on a lattice", 4, coin, {"Bone/Element=spline"});
  compare("fitted cells",
          4,
          coin,
          {"Bone/Element=spline",
           "Implant/Element=spline",
           "Bone/Cells=fitted 16, 2, 3, 3",
           "Implant/Cells=fitted 12, 2, 2",
           "Interface/Normal stiffness=1e5"});
  compare("pressed by a force, twisted through a spring",
          4,
          coin,
          {"Chuck/Press/Control=force",
           "Chuck/Press/Value=60 * min(t, 1)",
           "Chuck/Rotation z/Stiffness=50000"});
  compare("bonded in a ring",
          4,
          coin,
          {"Interface/Bonding/Pattern=annulus",
           "Interface/Bonding/Bonded fraction=0.6"});
  compare("rigid implant", 4, coin, {"Implant/Material=rigid"});
  compare("viscous", 4, coin, {"Interface/Viscosity=30"});
  compare("rate and state", 4, coin, {"Interface/Friction law=rate and state"});
  compare("dilatant faces", 4, coin, {"Interface/Law=dilatant"});
  compare("splines pressed by a force, on a lattice",
          4,
          coin,
          {"Bone/Element=spline",
           "Chuck/Press/Control=force",
           "Chuck/Press/Value=60 * min(t, 1)"});
  compare("a bone that is not square", 2, coin, {"Bone/Size=12, 11, 4"});
  compare("solid pin in a sleeve, with a square core", 4, pin);
  compare("hollow pin in a sleeve", 12, pin, {"Implant/Inner radius=1"});

  compare_runs("adaptive steps", coin, {"Load steps/Adaptive=true"}, 1e-7);
  // points of a ring slide all at once, which takes Newton's method around
  compare_runs("adaptive steps, stiff interface",
               coin,
               {"Load steps/Adaptive=true",
                "Load steps/Tolerance=0.02",
                "Interface/Normal stiffness=30000",
                "Interface/Tangential stiffness=auto"},
               1e-8);
  compare_runs("a path that snaps back",
               coin,
               {"Load steps/Path following=slip",
                "Chuck/Rotation z/Stiffness=3000",
                "Interface/Characteristic slip distance=0.005",
                "Load steps/Steps=1, 40",
                "Load steps/Residual tolerance=1e-9"},
               1e-4);

  expect_whole("a half bonded coin",
               coin,
               {"Interface/Bonding/Pattern=expression",
                "Interface/Bonding/Expression=x > 0"});
  expect_whole("a coin beside the middle of its bone",
               coin,
               {"Chuck/Translation x/Value=0.1"});
  expect_whole("a coin that is pushed aside",
               coin,
               {"Chuck/Translation x/Value=0.01 * max(t - 1, 0)"});
  expect_whole("a coin that a spring may push aside",
               coin,
               {"Chuck/Translation x/Stiffness=1000"});
  expect_whole("a coin that turns about its edge",
               coin,
               {"Chuck/Point=2.5, 0, 0"});
  expect_whole("a bone with a hard half",
               coin,
               {"Bone/Young modulus=10000 + 5000 * (x > 0)"});
  expect_whole("a bone that is symmetric but for 1e-9",
               coin,
               {"Bone/Young modulus=18000 * (1 + 1e-9 * x)"});
  expect_whole("a bond with strength in tension",
               coin,
               {"Interface/Law=adhesive"});
}



int
main()
{
  return run_test(test);
}
