// Bilinear contact surfaces: the implant's face is the polygon through its
// vertices, with the force and the torque of that polygon; both bodies may have
// them, and they tend to what NURBS give.

#include "driven_scene.h"
#include "pressed_and_turned.h"

const std::string scene_text = R"(
subsection Interface
  set Friction law = coulomb
end
subsection Expert
  subsection Interface
    set Quadrature points = 10
  end
end
)" + pressed_then("Rotation z", "2 * max(t - 1, 0)") +
                               R"(
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 20
end
)";

const std::vector<std::string> coarse{},
  medium{"Bone/Cells=30, 30, 2", "Implant/Cells=6, 2"};

std::vector<std::string>
surfaces(const std::string &bone, const std::string &implant)
{
  return {"Expert/Bone/Contact surface=" + bone,
          "Expert/Implant/Contact surface=" + implant};
}



struct Polygon
{
  double area = 0, integral_of_r = 0;
};

/** The polygon through the knots on the edge of a disk of n x n elements. */
Polygon
polygon(const unsigned int n)
{
  const auto                   disk = Debond::NurbsSurface::disk(2.5, n);
  std::vector<Eigen::Vector3d> corners;
  for (unsigned int i = 0; i < 4 * n; ++i)
    {
      const double s = static_cast<double>(i % n) / n;
      switch (i / n)
        {
          case 0:
            corners.push_back(disk.point({s, 0}));
            break;
          case 1:
            corners.push_back(disk.point({1, s}));
            break;
          case 2:
            corners.push_back(disk.point({1 - s, 1}));
            break;
          default:
            corners.push_back(disk.point({0, 1 - s}));
        }
    }
  Polygon result;
  for (unsigned int i = 0; i < corners.size(); ++i)
    {
      // a triangle of two radii R and the chord between them
      const Eigen::Vector3d &a = corners[i],
                            &b = corners[(i + 1) % corners.size()];
      const double h = 0.5 * (a + b).norm(), tan = 0.5 * (a - b).norm() / h;
      result.area += h * h * tan;
      // int (h / cos)^3 / 3
      result.integral_of_r +=
        std::pow(h, 3) / 3 * (tan * std::sqrt(1 + tan * tan) + std::asinh(tan));
    }
  return result;
}



// Nothing deforms and nearly everything slides: force and torque are those of
// the polygon, p A and mu p int r dA. Points near the axis stick; they lack
// mu p c^3 pi/6 with c = mu p / (eps theta).
void
check_polygon()
{
  for (const unsigned int n : {3, 6})
    {
      const Polygon exact = polygon(n);
      const double  p = 585 * 0.0049, mu = 0.4;
      const double  c = mu * 0.0049 / (2 * M_PI / 180);
      DrivenScene   driven(scene_text,
                         surfaces("bilinear", "bilinear") +
                           std::vector<std::string>{
                               "Bone/Material=rigid",
                               "Implant/Material=rigid",
                               "Implant/Cells=" + std::to_string(n) + ", 2"});
      while (driven.advance())
        ;
      std::cout << "rigid, " << n << " x " << n << " elements" << std::endl;
      report("  force differs from the polygon's",
             std::abs(-driven.system.chuck_forces()[2] / (p * exact.area) - 1),
             1e-10);
      report("  torque differs from the polygon's",
             std::abs(
               driven.system.chuck_forces()[5] /
                 (mu * p * (exact.integral_of_r - M_PI / 6 * std::pow(c, 3))) -
               1),
             1e-4);
    }
}



double
last_torque(const std::vector<std::string> &overrides)
{
  DrivenScene driven(scene_text, overrides);
  double      defect = 0;
  while (driven.advance())
    grow(defect, driven.system.reaction_defect());
  report("  contact and reaction differ", defect, 1e-6);
  return driven.system.chuck_forces()[5];
}



// Deformable bodies: the torque is that of NURBS in the ratio of the polygon to
// the disk, nearly, and nearer to it on the finer mesh.
void
check_deformable()
{
  const double disk   = 2 * M_PI / 3 * std::pow(2.5, 3);
  double       before = 0, before_bone = 0;
  for (const unsigned int n : {3, 6})
    {
      std::cout << "neo-hookean, " << n << " x " << n << " elements"
                << std::endl;
      const auto  &mesh  = n == 3 ? coarse : medium;
      const double nurbs = last_torque(mesh + surfaces("nurbs", "nurbs"));
      const double bone  = last_torque(mesh + surfaces("bilinear", "nurbs"));
      const double both  = last_torque(mesh + surfaces("bilinear", "bilinear"));
      const double from_bone  = std::abs(bone / nurbs - 1);
      const double from_nurbs = std::abs(both / nurbs - 1);
      const double from_polygon =
        std::abs(both / nurbs / (polygon(n).integral_of_r / disk) - 1);
      report("  bilinear bone differs from a NURBS bone", from_bone, 1e-3);
      report("  both bilinear: differs from the polygon's share of NURBS",
             from_polygon,
             n == 3 ? 5e-3 : 2e-3);
      if (n == 6)
        {
          report("  half of the coarse mesh's difference, bone",
                 from_bone / before_bone,
                 0.75);
          report("  a third of the coarse mesh's difference, both",
                 from_nurbs / before,
                 0.33);
        }
      before      = from_nurbs;
      before_bone = from_bone;
    }
}



void
test()
{
  check_polygon();
  check_deformable();
}



int
main()
{
  return run_test(test);
}
