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
  subsection Translation z
    set Value = -0.0049 * min(t, 1)
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
  Eigen::MatrixXd result(8, points.size());
  for (unsigned int q = 0; q < points.size(); ++q)
    result.col(q) << points[q].X, points[q].JxW, points[q].trial.traction,
      points[q].trial.state.slip;
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
  std::cout << name << ": " << sector.system.n_sectors() << " sectors"
            << std::endl;
  report("as many as expected", sector.system.n_sectors() == n_sectors);
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
      const InterfaceSummary a = own.interface.summarise(),
                             b = all.interface.summarise();
      grow(works,
           std::abs(own.interface.work().dissipation -
                    all.interface.work().dissipation) /
             std::max(all.interface.work().dissipation, 1e-6));
      grow(works, std::abs(a.energy - b.energy) / std::max(b.energy, 1e-6));
      grow(works, std::abs(a.share_slip - b.share_slip));
      grow(works, std::abs(double(a.n_closed) - b.n_closed));
      has_slid = has_slid || b.share_slip > 0.9;
    }
  while (sector.advance() && whole.advance());
  report("it slides", has_slid);
  report("forces of the chuck", forces, 1e-8);
  report("forces on both faces", nodes, 1e-8);
  report("tractions and slip of all points", points, 1e-7);
  report("energy, work, shares", works, 1e-7);
}



void
expect_whole(const std::string              &name,
             const std::string              &text,
             const std::vector<std::string> &overrides)
{
  report(name + " is computed as a whole",
         DrivenScene(text, overrides).system.n_sectors() == 1);
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
           "Interface/Penalty stiffness=1e5"});
  compare("pressed by a force, twisted through a spring",
          4,
          coin,
          {"Chuck/Translation z/Control=force",
           "Chuck/Translation z/Value=-60 * min(t, 1)",
           "Chuck/Rotation z/Stiffness=50000"});
  compare("bonded in a ring",
          4,
          coin,
          {"Interface/Bonding/Pattern=annulus",
           "Interface/Bonding/Bonded fraction=0.6"});
  compare("a bone that is not square", 2, coin, {"Bone/Size=12, 11, 4"});
  compare("solid pin in a sleeve, with a square core", 4, pin);
  compare("hollow pin in a sleeve", 12, pin, {"Implant/Inner radius=1"});

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
