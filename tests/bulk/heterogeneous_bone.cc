// A bone whose Young's modulus depends on the place. References:
//  - a layered block between a rigid implant and its support in uniaxial
//    strain: springs in series, with M = E (1 - nu) / (1 + nu) / (1 - 2 nu);
//  - a smooth modulus: a manufactured solution, whose loads are integrals of
//    the exact stress with many points;
//  - voxels in three formats: the expression that they were made from;
//  - layers on the lattice, and a modulus with its mirror images: the direct
//    solver on one block;
//  - multigrid, where the modulus jumps or varies across: the direct solver.

#include <debond/bulk/body.h>
#include <debond/bulk/bulk_space.h>
#include <debond/bulk/enriched_cells.h>
#include <debond/models/simulation.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/number_text.h>

#include <deal.II/base/quadrature_lib.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>

#include "cauchy_stress.h"
#include "checks.h"
#include "coin_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;

using Changes = std::vector<std::string>;



void
check_springs_in_series()
{
  const std::string scene_text = R"(
subsection Bone
  set Size          = 4, 4, 5
  set Cells         = 2, 2, 10
  set Material      = linear
  set Young modulus = if(z > -1, 18000, if(z > -2.5, 500, 3000))
end
subsection Implant
  set Shape    = block
  set Size     = 4, 4, 3
  set Cells    = 2, 2
  set Material = rigid
end
subsection Chuck
  subsection Press
    set Value = 0.01 * t
  end
end
subsection Load steps
  set Times = 0, 1
  set Steps = 1
end
subsection Expert
  subsection Load steps
    set Residual tolerance = 1e-12
  end
end
)";
  const Scene       scene      = coin_scene(scene_text);
  const double      nu         = scene.bone.poisson_ratio;
  const double      by_E       = (1. + nu) * (1. - 2. * nu) / (1. - nu);
  const double      compliance = 1. / scene.interface.normal_penalty +
                            by_E * (1. / 18000 + 1.5 / 500 + 2.5 / 3000);
  for (const Changes &changes :
       {Changes{}, Changes{"Expert/Bone/Solver=multigrid"}})
    {
      Simulation simulation(coin_scene(scene_text, changes));
      simulation.run();
      const double force = std::abs(simulation.rows().back().force_N);
      report("trilinear layers as springs in series",
             std::abs(force * compliance / (16. * 0.01) - 1.),
             1e-9);
    }
  // a soft layer of a bone that is stiff in the mean
  Simulation soft(
    coin_scene(scene_text,
               {"Bone/Young modulus=if(z > -3, 18000, if(z > -4, 5, 18000))",
                "Chuck/Press/Value=0.4 * t"}));
  bool is_warned = false;
  soft.signals.warning.connect([&](const Warning &warning) {
    is_warned = is_warned || warning.check == "strain of the bone";
  });
  soft.run();
  report("large strains of a soft layer are warned of", is_warned);
  // A spline has no kink at a border of layers: strain energy is too large, and
  // less so the thinner the layers of cells.
  double last = 0.;
  for (const unsigned int n : {40, 80})
    {
      Simulation simulation(coin_scene(
        scene_text,
        {"Bone/Element=spline", "Bone/Cells=2,2," + std::to_string(n)}));
      simulation.run();
      const double error =
        std::abs(simulation.rows().back().force_N) * compliance / (16. * 0.01) -
        1.;
      report("spline layers, error of the force", std::abs(error), 0.03);
      if (last != 0.)
        report("half of it with half the thickness",
               std::abs(last / error - 2.),
               0.2);
      last = error;
    }
}



/** w(x, y, z) of the manufactured displacement (0, 0, w), and its gradient: 0
 *  at the bottom, without shear at the sides. */
double
exact_w(const Eigen::Vector3d &X, Eigen::Vector3d &gradient)
{
  const double k = 2. * M_PI / 4., H = 3.;
  const double f = std::pow(1. + X[2] / H, 2), df = 2. * (1. + X[2] / H) / H;
  const double c_x = std::cos(k * X[0]), c_y = std::cos(k * X[1]);
  gradient = {-k * std::sin(k * X[0]) * c_y * f,
              -k * c_x * std::sin(k * X[1]) * f,
              (2. + c_x * c_y) * df};
  gradient *= 1e-3;
  return 1e-3 * (2. + c_x * c_y) * f;
}

double
exact_E(const Eigen::Vector3d &X)
{
  return 5000. * (2. + std::sin(X[0]) * std::cos(0.7 * X[1]) + X[2] / 3.);
}

BodyParameters
manufactured_bone(const ElementKind element, const unsigned int n)
{
  BodyParameters bone;
  bone.size               = {{4, 4, 3}};
  bone.cells              = {{n, n, n}};
  bone.layer_grading      = 1.3;
  bone.element            = element;
  bone.material           = Material::linear;
  bone.bulk_solver        = BulkSolver::direct;
  bone.modulus_expression = "5000 * (2 + sin(x) * cos(0.7 * y) + z / 3)";
  bone.read_modulus(1.);
  return bone;
}

/** Root mean square error of the displacement over its own at the Gauss
 *  points. */
double
manufactured_error(const ElementKind element, const unsigned int n)
{
  const BodyParameters bone = manufactured_bone(element, n);
  const auto           body = make_body(bone, Side::bone);
  const BulkSpace     &mesh = body->mesh();
  body->set_contact_control_points(
    std::vector<bool>(mesh.surface().n_control_points(), true));

  const NeoHookean        unit = NeoHookean::from_young(1., bone.poisson_ratio);
  const dealii::QGauss<3> quadrature(6);
  const auto              for_each_point = [&](const auto &work) {
    for (const BulkSpace::Cell &cell : mesh.cells())
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const ShapeValues N =
            CellFunctions(mesh, cell).at(quadrature.point(q));
          Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
          Eigen::Vector3d X = Eigen::Vector3d::Zero();
          for (unsigned int a = 0; a < N.rows(); ++a)
            {
              X += N(a, 0) * mesh.reference_position(cell.nodes[a]);
              J += mesh.reference_position(cell.nodes[a]) * N.row(a).tail<3>();
            }
          work(cell, N, X, J, quadrature.weight(q) * J.determinant());
        }
  };
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
  for_each_point([&](const auto  &cell,
                     const auto  &N,
                     const auto  &X,
                     const auto  &J,
                     const double JxW) {
    Eigen::Vector3d w;
    exact_w(X, w);
    Eigen::Matrix3d H           = Eigen::Matrix3d::Zero();
    H.row(2)                    = w;
    const Eigen::Matrix3d sigma = exact_E(X) * hooke_stress(unit, H);
    for (unsigned int a = 0; a < N.rows(); ++a)
      load.segment<3>(3 * cell.nodes[a]) +=
        JxW *
        (sigma * (J.inverse().transpose() * N.row(a).tail(3).transpose()));
  });
  const Bulk::Residual  r = body->condensing()->condense(-load);
  const Eigen::VectorXd v =
    body->condensing()->correction(body->condensing()->solve(-r.condensed), r);

  double error = 0., size = 0.;
  for_each_point([&](const auto &cell,
                     const auto &N,
                     const auto &X,
                     const auto &,
                     const double JxW) {
    Eigen::Vector3d u = Eigen::Vector3d::Zero(), w;
    for (unsigned int a = 0; a < N.rows(); ++a)
      u += N(a, 0) * v.segment<3>(3 * cell.nodes[a]);
    const double exact = exact_w(X, w);
    error += JxW * (u - Eigen::Vector3d(0, 0, exact)).squaredNorm();
    size += JxW * exact * exact;
  });
  return std::sqrt(error / size);
}

void
check_manufactured_solution()
{
  const double coarse = manufactured_error(ElementKind::trilinear, 8),
               fine   = manufactured_error(ElementKind::trilinear, 16);
  report("trilinear, smooth modulus: error", fine, 0.01);
  report("of second order", std::abs(std::log2(coarse / fine) - 2.), 0.2);
  const double coarse_quadratic = manufactured_error(ElementKind::quadratic, 4),
               fine_quadratic   = manufactured_error(ElementKind::quadratic, 8);
  report("quadratic, smooth modulus: error", fine_quadratic, 1e-3);
  report("of third order or better",
         3. - std::log2(coarse_quadratic / fine_quadratic),
         0.2);
  const double coarse_splines = manufactured_error(ElementKind::spline, 6),
               fine_splines   = manufactured_error(ElementKind::spline, 12);
  report("splines, smooth modulus: error", fine_splines, 1e-3);
  report("of third order or better",
         3. - std::log2(coarse_splines / fine_splines),
         0.2);
}



/** Voxels of 0.25 mm, 16 x 16 x 12: grey = 100 + 10 i + 3 j + 5 k. */
struct Voxels
{
  static constexpr unsigned int n[3]{16, 16, 12};

  template <typename Work>
  static void
  for_each(const Work &work)
  {
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          work(-2. + 0.25 * (i + 0.5),
               -2. + 0.25 * (j + 0.5),
               -3. + 0.25 * (k + 0.5),
               100 + 10 * i + 3 * j + 5 * k);
  }

  static void
  write_csv()
  {
    std::ofstream file("voxels.csv");
    file << "grey,z,y,x\n";
    for_each([&](double x, double y, double z, unsigned int grey) {
      file << grey << ',' << z << ',' << y << ',' << x << '\n';
    });
  }

  static void
  write_mhd()
  {
    std::ofstream("voxels.mhd")
      << "NDims = 3\nDimSize = 16 16 12\nElementSpacing = 0.25 0.25 0.25\n"
         "BinaryDataByteOrderMSB = True\nElementType = MET_SHORT\n"
         "ElementDataFile = voxels.raw\n";
    std::ofstream raw("voxels.raw", std::ios::binary);
    for_each([&](double, double, double, const unsigned int grey) {
      raw.put(static_cast<char>(grey >> 8)).put(static_cast<char>(grey & 255));
    });
  }
};



BodyParameters
bone_of(const std::string &expression,
        const std::string &voxels,
        const unsigned int n)
{
  BodyParameters bone;
  bone.size               = {{4, 4, 3}};
  bone.cells              = {{n, n, 3 * n / 4}};
  bone.modulus_expression = expression;
  bone.voxel_file         = voxels;
  bone.read_modulus(1.);
  return bone;
}

void
check_voxels()
{
  Voxels::write_csv();
  Voxels::write_mhd();
  // the same by the place: voxel numbers i, j, k
  const std::string of_place =
    "40 * (100 + 10 * floor(4 * (x + 2)) + 3 * floor(4 * (y + 2)) + 5 * "
    "floor(4 * (z + 3)))";
  // cells of a voxel: all points are in voxels of their own; cells of 4 x 4 x
  // 4: a point has the mean of 2 x 2 x 2
  for (const unsigned int n : {16, 4})
    {
      const BulkSpace     mesh(bone_of(of_place, "", n), Side::bone);
      const EnrichedCells by_place(mesh, NeoHookean());
      for (const std::string voxels : {"voxels.csv", "voxels.mhd"})
        {
          const BulkSpace other(bone_of("40 * grey", voxels, n), Side::bone);
          const EnrichedCells by_voxels(other, NeoHookean());
          const BulkSpace     smooth(
            bone_of("40 * (100 + 10 * (4 * x + 7.5) + 3 * (4 * y + 7.5) + 5 * "
                        "(4 * z + 11.5))",
                    "",
                    n),
            Side::bone);
          double difference = 0.;
          for (unsigned int cell = 0; cell < by_place.n_cells(); ++cell)
            {
              // the mean over a cell, and over 2 x 2 x 2 voxels
              const Eigen::ArrayXd own = other.parameters().young_modulus *
                                         by_voxels.stiffness_factors(cell);
              const Eigen::ArrayXd expected =
                n == 16 ? Eigen::ArrayXd(mesh.parameters().young_modulus *
                                         by_place.stiffness_factors(cell)) :
                          Eigen::ArrayXd(smooth.parameters().young_modulus *
                                         EnrichedCells(smooth, NeoHookean())
                                           .stiffness_factors(cell));
              if (n == 16)
                grow(difference, (own - expected).abs().maxCoeff());
              else // of a linear field, the mean of the points is the same
                grow(difference, std::abs(own.mean() - expected.mean()));
            }
          report(voxels + " on " + std::to_string(n) + " cells [MPa]",
                 difference,
                 1e-6);
        }
    }
}



const std::string coin = pressed_and_turned + R"(
subsection Bone
  set Cells    = 16, 16, 4
  set Element  = spline
  set Material = linear
end
subsection Implant
  set Cells         = 3, 2
  set Element       = spline
  set Material      = linear
end
subsection Load steps
  set Times = 0, 1, 1.05, 1.2
  set Steps = 1, 5, 4
end
subsection Expert
  subsection Bone
    set Layer grading = 2
  end
  subsection Load steps
    set Residual tolerance = 1e-10
  end
end
)";

/** Rows of a run, which is done once. */
const std::vector<TorqueRow> &
rows_of(const Changes &changes)
{
  static std::map<Changes, std::vector<TorqueRow>> known;
  auto                                            &rows = known[changes];
  if (rows.empty())
    {
      Simulation simulation(coin_scene(coin, changes));
      simulation.run();
      rows = simulation.rows();
    }
  return rows;
}

double
difference_of_torques(const Changes &one, const Changes &other)
{
  const auto &a = rows_of(one), &b = rows_of(other);
  double      change = 0., largest = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    {
      grow(change, std::abs(a[i].torque_Nmm - b[i].torque_Nmm));
      grow(largest, std::abs(b[i].torque_Nmm));
    }
  return change / largest;
}

void
check_solvers()
{
  const std::string layers = "Bone/Young modulus=2000 + 16000 * exp(2 * z)";
  const std::string direct = "Expert/Bone/Solver=direct";
  report("layers on the lattice",
         difference_of_torques({layers}, {layers, direct}),
         1e-6);
  report("layers are no matter of course",
         difference_of_torques({layers}, {}) > 0.01);
  // which is not its own mirror image to the last digits: one block
  const std::string shell = "Bone/Young modulus=18000 * exp(-(x^2 + y^2) / 10)";
  report("mirror images in four parts or one",
         difference_of_torques({shell}, {shell + " * (1 + 1e-9 * x)"}),
         1e-8);
  report("a Neo-Hookean bone under small loads as a linear one",
         difference_of_torques({shell}, {shell, "Bone/Material=neo-hookean"}),
         2e-3);
}



/** A modulus that varies by 1 to 400, or jumps by 1000. */
void
check_multigrid()
{
  for (const std::string modulus :
       {"18000 * exp(x / 2)", "if(x > 0.1, 18000, 18)"})
    report("by multigrid, " + modulus,
           difference_of_torques(
             {"Bone/Young modulus=" + modulus, "Expert/Bone/Solver=multigrid"},
             {"Bone/Young modulus=" + modulus, "Expert/Bone/Solver=direct"}),
           1e-8);
}



int
main()
{
  check_springs_in_series();
  check_manufactured_solution();
  check_voxels();
  check_solvers();
  check_multigrid();
}
