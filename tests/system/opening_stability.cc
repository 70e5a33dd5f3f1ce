// A bond that falls more slowly than bodies and machine let go is pulled off
// without a warning, one that falls by more jumps, and the run says so. Closed
// forms: a bar of bone under a block as wide, nu = 0, holds with E/H, a machine
// with k/A; of half a bond the fall is half.

#include "driven_scene.h"

using namespace Debond;

const std::string blocks = "subsection Bone\n"
                           " set Size = 5, 5, 5\n"
                           " set Cells = 3, 3, 2\n"
                           " set Young modulus = 1000\n"
                           " set Poisson ratio = 0\n"
                           "end\n"
                           "subsection Implant\n"
                           " set Shape = block\n"
                           " set Size = 5, 5, 3\n"
                           " set Cells = 2, 2\n"
                           " set Material = rigid\n"
                           " set Young modulus = 500\n"
                           " set Poisson ratio = 0\n"
                           "end\n"
                           "subsection Interface\n"
                           " set Law = adhesive\n"
                           "end\n"
                           "subsection Chuck\n"
                           " subsection Translation z\n"
                           "  set Value = 0.12 * t\n"
                           " end\n"
                           " subsection Rotation z\n"
                           "  set Value = 0\n"
                           " end\n"
                           "end\n"
                           "subsection Load steps\n"
                           " set Times = 0, 1\n"
                           " set Steps = 200\n"
                           "end\n";

// It falls by phi_0 t_0/(e g_0) at most, and the bar holds with E/H = 200
// MPa/mm.
void
check_warning()
{
  for (const double phi_0 : {1., 0.5})
    for (const double softening : {0.95 * 200., 1.05 * 200.})
      {
        const std::string gap =
          std::to_string(5. * phi_0 / (std::exp(1.) * softening));
        bool warned = false;
        for (const TorqueRow &row :
             run_scene("opening_stability",
                       blocks,
                       {"Interface/Adhesive/Gap at strength=" + gap,
                        "Interface/Bonding/Bonding degree=" +
                          std::to_string(phi_0)}))
          warned = warned || row.warnings > 0;
        report(softening < 200. ?
                 "no warning of a bond that falls more slowly" :
                 "a warning of one that falls faster",
               warned == (softening > 200.));
      }
}



// A machine of 10000 N/mm shears a face of 16 mm^2 between rigid blocks: it
// holds with 625 MPa/mm. In pure shear a bilinear bond falls by T / (2 G_II/T -
// T/K), in mode I far more slowly.
void
check_shear()
{
  const double T = 5., K = 10000.;
  for (const double softening : {0.95 * 625., 1.05 * 625.})
    {
      const double G      = 0.5 * T * (T / softening + T / K);
      bool         warned = false;
      for (const TorqueRow &row : run_scene(
             "opening_stability",
             blocks,
             {"Bone/Material=rigid",
              "Implant/Size=4, 4, 3",
              "Interface/Law=mixed mode",
              "Interface/Mixed mode/Stiffness=" + std::to_string(K),
              "Interface/Mixed mode/Shear strength=" + std::to_string(T),
              "Interface/Mixed mode/Fracture energy I=1",
              "Interface/Mixed mode/Fracture energy II=" + std::to_string(G),
              "Chuck/Translation z/Value=0",
              "Chuck/Translation x/Value=0.05 * t",
              "Chuck/Translation x/Stiffness=10000"}))
        warned = warned || row.warnings > 0;
      report(softening < 625. ?
               "no warning of a sheared bond that falls more slowly" :
               "a warning of one that falls faster",
             warned == (softening > 625.));
    }
}



int
main()
{
  return run_test([] {
    check_warning();
    check_shear();
  });
}
