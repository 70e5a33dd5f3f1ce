// Coin and block written to files of Gmsh and read again, Shape = file.
// - Of the first order, also with cells in another order and turned: the curve
//   of the bodies themselves with Contact surface = bilinear, of which they are
//   another description.
// - Coins of straight and of curved faces: the area of the disk, with the order
//   of the faces; of quadratic cells, the curve of splines.
// - Points that slide over the ridges between faces: friction is mu N.

#include <debond/models/simulation.h>
#include <debond/output/torque_curve.h>

#include <algorithm>

#include "driven_scene.h"
#include "mesh_writer.h"
#include "pressed_and_turned.h"

using namespace Debond;

const std::string torsion = R"(
subsection Bone
  set Material = linear
end
subsection Implant
  set Material = linear
end
subsection Expert
  subsection Interface
    set Quadrature points = 5
  end
end
)" + pressed_then("Rotation z", "4 * max(t - 1, 0)") +
                            R"(
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 40
end
subsection Expert
  subsection Load steps
    set Residual tolerance = 1e-11
  end
end
)";

using Overrides = std::vector<std::string>;

/** Writes the bodies of the scene with these entries; the entries for the scene
 *  with the files. */
Overrides
files_of(const std::string &name,
         const Overrides   &entries,
         const unsigned int order,
         const bool         shuffled,
         const std::string &text = torsion)
{
  const Scene scene = coin_scene(text, entries);
  Overrides   result;
  for (const Side side : both_sides)
    {
      const bool        is_bone  = side == Side::bone;
      const std::string section  = is_bone ? "Bone" : "Implant";
      const std::string filename = name + "_" + name_of(side) + ".msh";
      write_msh(BulkSpace(is_bone ? scene.bone : scene.implant, side),
                filename,
                order,
                shuffled);
      result.push_back(section + "/Shape=file");
      result.push_back(section + "/Mesh file=" + filename);
    }
  return result;
}

/** Largest difference of torques and forces, relative to the largest. */
double
difference(const std::vector<TorqueRow> &rows,
           const std::vector<TorqueRow> &others)
{
  double torque = 0, force = 0, torques = 0, forces = 0;
  if (rows.size() != others.size())
    return 1;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      grow(torques, std::abs(rows[i].torque_Nmm));
      grow(forces, std::abs(rows[i].force_N));
      grow(torque, std::abs(rows[i].torque_Nmm - others[i].torque_Nmm));
      grow(force, std::abs(rows[i].force_N - others[i].force_N));
    }
  return std::max(torque / torques, force / forces);
}

void
first_order(const std::string &what, const Overrides &materials)
{
  const Overrides bilinear =
    materials + Overrides{"Expert/Bone/Contact surface=bilinear",
                          "Expert/Implant/Contact surface=bilinear"};
  const auto rows = run_scene("bilinear", torsion, bilinear);
  for (const bool shuffled : {false, true})
    report(what + (shuffled ? ", cells turned" : ""),
           difference(rows,
                      run_scene("file",
                                torsion,
                                materials +
                                  files_of("first", bilinear, 1, shuffled))),
           1e-10);
}

/** Where the bone's file has its contact face: within @p half from the axis.
 * The faces beside it are @p beside. */
void
write_small_face(const BulkSpace                 &bone,
                 const std::string               &filename,
                 const double                     half,
                 const dealii::types::boundary_id beside)
{
  dealii::Triangulation<3> triangulation;
  triangulation.copy_triangulation(bone.dof_handler().get_triangulation());
  for (const auto &face : triangulation.active_face_iterators())
    if (face->at_boundary() && face->boundary_id() == Boundary::contact &&
        std::max(std::abs(face->center()[0]), std::abs(face->center()[1])) >
          half)
      face->set_boundary_id(beside);
  write_msh(
    triangulation,
    [&](const unsigned int cell, const dealii::Point<3> &p) {
      const Eigen::Vector3d X =
        CellFunctions(bone, bone.cells()[cell]).position(p);
      return dealii::Point<3>(X[0], X[1], X[2]);
    },
    filename);
}

// A contact face that ends on the top of the bone: cells beside it have nodes
// on its border, which follow its control points. Bilinear faces and trilinear
// cells have the same functions whichever faces are named, so that the curve
// is that of the whole face.
void
small_face(const std::string &what, const Overrides &materials)
{
  const Overrides bilinear =
    materials + Overrides{"Expert/Bone/Contact surface=bilinear",
                          "Expert/Implant/Contact surface=bilinear"};
  const Scene     scene = coin_scene(torsion, bilinear);
  const BulkSpace bone(scene.bone, Side::bone);
  write_small_face(bone, "small.msh", 4.3, Boundary::free);
  const Overrides small{"Bone/Shape=file",
                        "Bone/Mesh file=small.msh",
                        "Expert/Implant/Contact surface=bilinear"};
  report(what + ", a contact face that ends on the top",
         difference(run_scene("bilinear", torsion, bilinear),
                    run_scene("small", torsion, materials + small)),
         1e-10);

  // held by the cells beside: then the border of the face is
  write_small_face(bone, "held.msh", 4.3, Boundary::held);
  const BulkSpace held(
    coin_scene(torsion, {"Bone/Shape=file", "Bone/Mesh file=held.msh"}).bone,
    Side::bone);
  unsigned int n_held = 0, n_wrong = 0;
  for (unsigned int A = 0; A < held.surface().n_control_points(); ++A)
    {
      const unsigned int    node = held.control_point_node(A);
      const Eigen::Vector3d X    = held.reference_position(node);
      // 11 x 11 cells of 12.5 mm / 15
      const bool is_border =
        std::max(std::abs(X[0]), std::abs(X[1])) > 5.4 * 12.5 / 15.;
      const bool is_held = held.is_fixed(node, 0) && held.is_fixed(node, 1) &&
                           held.is_fixed(node, 2);
      n_held += is_held;
      n_wrong += is_held != is_border;
    }
  report("its border, held by the cells beside",
         n_held == 4 * 11 && n_wrong == 0);
}

// Rigid bodies, pressed together: the force over stiffness and depth is the
// area of the faces.
double
area_of_coin(const unsigned int n, const unsigned int order)
{
  write_coin("area.msh", 2.5, 3., n, order);
  const auto rows = run_scene("area",
                              torsion,
                              {"Bone/Material=rigid",
                               "Implant/Material=rigid",
                               "Implant/Shape=file",
                               "Implant/Mesh file=area.msh",
                               order == 1 ? "Implant/Element=trilinear" :
                                            "Implant/Element=quadratic",
                               "Chuck/Rotation z/Value=0",
                               "Load steps/Times=0, 1",
                               "Load steps/Steps=1"});
  return std::abs(rows.back().force_N) / (585 * 0.0049);
}

void
area()
{
  for (const unsigned int order : {1, 2})
    {
      double before = 0;
      for (const unsigned int n : {0, 1, 2, 3})
        {
          const double error =
            std::abs(area_of_coin(n, order) / (M_PI * 2.5 * 2.5) - 1);
          if (n > 1)
            report("area of a coin of faces of degree " +
                     std::to_string(order) + ": error over that before",
                   error / before,
                   order == 1 ? 0.26 : 0.066);
          before = error;
        }
    }
}

// The coin of quadratic cells from a file and that of splines, on the same
// bone: with finer cells the same curve.
void
quadratic()
{
  const Overrides bone{"Bone/Element=quadratic",
                       "Bone/Cells=16, 16, 3",
                       "Expert/Bone/Cells under implant=8"};
  const auto      splines = run_scene("splines",
                                 torsion,
                                 bone + Overrides{"Implant/Element=spline",
                                                  "Implant/Cells=16, 4"});
  for (const unsigned int n : {0, 1, 2})
    {
      write_coin("quadratic.msh", 2.5, 3., n, 2);
      const double error =
        difference(splines,
                   run_scene("quadratic",
                             torsion,
                             bone +
                               Overrides{"Implant/Element=quadratic",
                                         "Implant/Shape=file",
                                         "Implant/Mesh file=quadratic.msh"}));
      report("curve of a coin of quadratic cells",
             error,
             n == 0 ? 3e-2 :
             n == 1 ? 3e-3 :
                      3e-4);
    }
}

// Pushed sideways over ten faces, in steps of a few micrometres: on ridges,
// where the equations have no solution on either side, points are held, and no
// step fails. With all bonds broken the force is mu_b N.
void
ridges()
{
  const std::string shear = R"(
subsection Bone
  set Material = linear
  set Cells    = 18, 18, 3
end
subsection Implant
  set Material = linear
end
subsection Expert
  subsection Bone
    set Contact surface = bilinear
  end
end
)" + pressed_then("Translation x", "0.4 * max(t - 1, 0)") +
                            R"(
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 100
end
)";
  const auto rows = run_scene("ridges", shear);
  report("sliding over ridges: rows are those planned", rows.size() == 102);
  const auto &end = rows.back().chuck_reaction;
  report("friction over the normal force",
         std::abs(std::abs(end[0] / end[2]) / 0.4 - 1),
         1e-3);
}

// What is said of bodies that overlap where they are made, and of faces with no
// bone in front of them.
void
faces_at_start()
{
  const auto faces_of = [](const std::string &what, const Overrides &entries) {
    const Simulation simulation(coin_scene(torsion, entries));
    std::cout << what << ":";
    for (const Warning &warning : simulation.warnings())
      std::cout << " [" << warning.check << "]";
    std::cout << std::endl;
    return simulation.system().interface.faces_at_start();
  };
  write_coin("coin.msh", 2.5, 3., 1, 1);
  write_coin("low.msh", 2.5, 3., 1, 1, -0.1);
  Overrides file{"Implant/Shape=file", "Implant/Mesh file=coin.msh"};
  faces_of("a coin", file);
  report(
    "gap across the face of a coin",
    std::abs(
      faces_of("in the bone", {file[0], "Implant/Mesh file=low.msh"}).overlap -
      0.1),
    1e-12);
  // a stem that ends where its bone does
  write_coin("deep.msh", 2.5, 3., 1, 1, -3.);
  report("the chuck's point is at the top",
         std::abs(coin_scene(torsion, {file[0], "Implant/Mesh file=deep.msh"})
                    .implant.geometry()
                    .chuck_height),
         1e-12);
  write_coin("middle.msh", 2.5, 3., 1, 1, 0., 1.9);
  faces_of("a ring left out", {file[0], "Implant/Mesh file=middle.msh"});
  write_coin("above.msh", 2.5, 3., 1, 1, 0.1);
  faces_of("a coin above its bone", {file[0], "Implant/Mesh file=above.msh"});
  // a segment of the disk
  report("area beside the bone",
         std::abs(faces_of("half beside it", {"Chuck/Translation x/Value=6.5"})
                      .facing_area /
                    (6.25 * std::acos(0.1) - 0.25 * std::sqrt(6.25 - 0.0625)) -
                  1.),
         0.05);
  report("half a pin",
         std::abs(faces_of("a pin longer than its bone",
                           {"Implant/Shape=pin",
                            "Implant/Height=8",
                            "Implant/Cells=16, 1, 4",
                            "Bone/Shape=sleeve",
                            "Bone/Outer radius=6",
                            "Bone/Height=4",
                            "Bone/Cells=16, 2, 2",
                            "Chuck/Press/Value=0"})
                      .facing_area /
                    (M_PI * 5. * 4.) -
                  1.),
         1e-6);
}

// A pin that has grown into its sleeve, and the same as files, whose sides are
// parabolas instead of circles: twisted while all sticks.
void
pin()
{
  const std::string text   = R"(
subsection Bone
  set Material = linear
  set Element  = quadratic
end
subsection Implant
  set Material = linear
  set Element  = quadratic
end
subsection Interface
  set Law = adhesive
end
subsection Chuck
  subsection Rotation z
    set Value = 0.001 * t
  end
end
subsection Load steps
  set Times = 0, 1
  set Steps = 1
end
)";
  double            before = 0;
  for (const unsigned int n : {8, 16})
    {
      const std::string cells =
        std::to_string(n) + ", 2, " + std::to_string(n / 4);
      const Overrides own{"Bone/Shape=sleeve",
                          "Bone/Outer radius=5",
                          "Bone/Cells=" + cells,
                          "Implant/Shape=pin",
                          "Implant/Radius=2",
                          "Implant/Cells=" + cells};
      const Overrides files = files_of("pin", own, 2, false, text);
      const double    error =
        std::abs(run_scene("pin_files", text, files).back().torque_Nmm /
                   run_scene("pin", text, own).back().torque_Nmm -
                 1.);
      if (n > 8)
        report("pin of parabolas: difference over that before",
               error / before,
               0.1);
      before = error;
    }
}

void
test()
{
  first_order("linear", {});
  first_order("neo-hookean",
              {"Bone/Material=neo-hookean", "Implant/Material=neo-hookean"});
  small_face("linear", {});
  small_face("neo-hookean",
             {"Bone/Material=neo-hookean", "Implant/Material=neo-hookean"});
  area();
  faces_at_start();
  quadratic();
  ridges();
  pin();
}

int
main()
{
  return run_test(test);
}
