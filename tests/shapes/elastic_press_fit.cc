// An elastic pin on a rigid rod, thicker than the bore of an elastic sleeve, in
// plane strain: the pressure is Lame's of both tubes in series with the
// interface. The ends of the pin slide along plates like those of the sleeve,
// and the chuck holds its bore instead of its top.

#include <debond/models/simulation.h>
#include <debond/scene/scene.h>
#include <debond/shapes/mesh_builder.h>
#include <debond/shapes/revolved_mesh.h>

#include <cmath>

#include "checks.h"
#include "driven_scene.h"

using namespace Debond;

constexpr double rod = 0.5, a = 2., b = 5., height = 1., interference = 2e-6,
                 eps_n = 1e5, E_pin = 2000., E_bone = 18000., nu = 0.3;

/** |u_r(a)| / p of a tube that is held at the radius c. */
double
compliance(const double E, const double c)
{
  return (1. + nu) / E * std::abs(a - c * c / a) /
         (1. / (1. - 2. * nu) + c * c / (a * a));
}

double
lame_pressure()
{
  return 0.5 * interference /
         (1. / eps_n + compliance(E_bone, b) + compliance(E_pin, rod));
}

double
error_with(const unsigned int n_around)
{
  const std::string cells =
    std::to_string(n_around) + ", " + std::to_string(n_around / 2) + ", 1";
  Scene        scene = coin_scene("subsection Bone\n"
                                  "  set Shape = sleeve\n"
                                  "  set Outer radius = 5\n"
                                  "  set Ends = slide\n"
                                  "  set Material = linear\n"
                                  "  set Element = quadratic\n"
                                  "end\n"
                                  "subsection Implant\n"
                                  "  set Shape = pin\n"
                                  "  set Radius = 2\n"
                                  "  set Height = 1\n"
                                  "  set Material = linear\n"
                                  "  set Young modulus = 2000\n"
                                  "  set Element = quadratic\n"
                                  "end\n"
                                  "subsection Interface\n"
                                  "  set Interference = 2e-6\n"
                                  "  set Normal stiffness = 1e5\n"
                                  "end\n"
                                  "subsection Chuck\n"
                                  "  subsection Rotation z\n"
                                  "    set Value = 0\n"
                                  "  end\n"
                                  "end\n"
                                  "subsection Load steps\n"
                                  "  set Times = 0, 1\n"
                                  "  set Steps = 1\n"
                                  "end\n"
                                  "subsection Expert\n"
                                  "  subsection Load steps\n"
                                  "    set Residual tolerance = 1e-10\n"
                                  "  end\n"
                                  "end\n",
                           {"Bone/Cells=" + cells, "Implant/Cells=" + cells});
  RevolvedBody pin;
  pin.cells       = {{n_around, n_around / 2, 1}};
  pin.lowest      = -height;
  pin.height      = height;
  pin.outer       = [](double, double) { return a; };
  pin.inner       = [](double, double) { return rod; };
  pin.inner_name  = "held";
  pin.bottom_name = pin.top_name = "slides z";
  scene.implant.mesh =
    MeshBuilder(mesh_of_revolution(pin), [](const std::string &why) {
      throw std::runtime_error(why);
    }).mesh;
  Simulation simulation(scene);
  simulation.run();
  return std::abs(simulation.rows().back().pressure_MPa / lame_pressure() - 1.);
}

int
main()
{
  return run_test([] {
    const double coarse = error_with(8), fine = error_with(16);
    report("8 cells around: error of the pressure", coarse, 1e-3);
    report("16 cells around", fine, 5e-5);
    report("of third order or better", 3. - std::log2(coarse / fine), 0.);
  });
}
