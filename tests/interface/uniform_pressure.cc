// Two blocks of equal outline are pressed together (Poisson's ratio 0): the
// pressure is uniform and that of bars in series; to rounding where the meshes
// match, and up to the error of the quadrature, falling with it, elsewhere.

#include "driven_scene.h"

const char *const scene_text = R"(
subsection Bone
  set Size          = 5, 4, 4
  set Cells         = 4, 4, 2
  set Material      = linear
  set Poisson ratio = 0
end
subsection Implant
  set Shape         = block
  set Size          = 5, 4, 3
  set Cells         = 4, 4, 2
  set Material      = linear
  set Young modulus = 30000
  set Poisson ratio = 0
end
subsection Chuck
  subsection Press
    set Value = 0.02 * t
  end
end
subsection Load steps
  set Times = 0, 1
  set Steps = 1
end
subsection Expert
  subsection Load steps
    set Residual tolerance = 1e-13
  end
end
)";

struct Pressure
{
  double mean      = 0;
  double deviation = 0; ///< largest, relative to the mean
};

Pressure
press(const std::vector<std::string> &overrides)
{
  DrivenScene driven(scene_text, overrides);
  driven.advance_to(1);
  const auto &points = driven.system.interface.get_points();
  double      area   = 0;
  Pressure    result;
  for (const auto &point : points)
    {
      result.mean += point.trial.pressure * point.JxW;
      area += point.JxW;
    }
  result.mean /= area;
  for (const auto &point : points)
    grow(result.deviation, std::abs(point.trial.pressure / result.mean - 1));
  return result;
}



// Two bars and the interface in series: the displacement that the pressure p
// takes. Neo-Hooke without lateral strain: p = E/2 (1/lambda - lambda).
double
displacement(const double p, const std::string &material)
{
  const auto stretch = [&](const double E) {
    return material == "linear" ? 1 - p / E :
                                  -p / E + std::sqrt(1 + p * p / (E * E));
  };
  return p / 585 + 4 * (1 - stretch(18000)) + 3 * (1 - stretch(30000));
}



double
pressure_of_bars(const std::string &material)
{
  double p = 0;
  for (unsigned int i = 0; i < 10; ++i) // secant through zero, nearly straight
    p +=
      0.02 / displacement(1, "linear") * (1 - displacement(p, material) / 0.02);
  return p;
}



void
check_matching()
{
  for (const std::string slave : {"implant", "bone"})
    for (const std::string material : {"linear", "neo-hookean"})
      for (const std::string surface : {"nurbs", "bilinear", "spline"})
        {
          std::cout << "slave " << slave << ", " << material << ", " << surface
                    << std::endl;
          const bool        is_spline = surface == "spline";
          const std::string expert    = is_spline ? "" : "Expert/",
                            entry =
                              is_spline ? "/Element=" : "/Contact surface=";
          const Pressure pressure =
            press({"Expert/Interface/Slave=" + slave,
                   "Bone/Material=" + material,
                   "Implant/Material=" + material,
                   expert + "Bone" + entry + surface,
                   expert + "Implant" + entry + surface});
          report("  deviation from uniform pressure",
                 pressure.deviation,
                 1e-10);
          report("  deviation from the bars in series",
                 std::abs(pressure.mean / pressure_of_bars(material) - 1),
                 1e-10);
        }
}



void
check_not_matching(const std::string &implant_cells, const std::string &slave)
{
  std::cout << "bone 4, 4, 2, implant " << implant_cells << ", slave " << slave
            << std::endl;
  double before = 0;
  for (const unsigned int n : {2, 4, 8, 16, 32})
    {
      const Pressure pressure =
        press({"Expert/Interface/Slave=" + slave,
               "Implant/Cells=" + implant_cells,
               "Expert/Interface/Quadrature points=" + std::to_string(n)});
      if (before == 0)
        report("  deviation with 2 points", pressure.deviation, 2e-3);
      else
        report("  deviation with " + std::to_string(n) +
                 " points, relative to that with half of them",
               pressure.deviation / before,
               0.5);
      report("  that of the mean from the bars in series, relative to it",
             std::abs(pressure.mean / pressure_of_bars("linear") - 1) /
               pressure.deviation,
             0.1);
      before = pressure.deviation;
    }
  report("  deviation in the end", before, 1e-6);
}



void
test()
{
  check_matching();
  check_not_matching("6, 6, 2", "bone");
  check_not_matching("5, 5, 2", "implant");
  check_not_matching("5, 5, 2", "bone");
}



int
main()
{
  return run_test(test);
}
