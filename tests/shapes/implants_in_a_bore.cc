// Pin, taper and screw, and the sleeves around them; cups, and their cavities.
// - Contact faces: circles and cones are exact, errors of threads and spheres
//   fall with the order of the faces; normals point out of the bodies; the face
//   of a bore is that of the implant; a thicker implant has the larger radius,
//   exactly.
// - Cells: uniform strain leaves no force inside (patch test) but for what
// Gauss
//   points miss of rational functions, which falls; the sum of all forces is
//   zero, and volumes tend to those of the bodies.

#include <debond/bulk/bulk_space.h>
#include <debond/bulk/enriched_cells.h>
#include <debond/bulk/neo_hookean.h>
#include <debond/scene/scene.h>

#include <cmath>

#include "checks.h"
#include "driven_scene.h"
#include "uniform_strain.h"

using namespace Debond;

Scene
scene_of(const std::string &shape, const unsigned int n)
{
  const bool        is_cup = shape == "cup" || shape == "shallow cup";
  const std::string cells  = std::to_string(8 * n),
                    along  = std::to_string(is_cup ? n : 4 * n);
  std::vector<std::string> entries{"Bone/Cells=" + cells + ", 3, " + along,
                                   "Implant/Cells=" + cells + ", 2, " + along};
  if (is_cup)
    entries.push_back("Implant/Height=" +
                      std::string(shape == "cup" ? "2" : "0.8"));
  if (shape == "screw")
    entries.push_back("Implant/Pitch=3"); // a turn
  return coin_scene("subsection Bone\n"
                    " set Shape = " +
                      std::string(is_cup ? "cavity" : "sleeve") +
                      "\n"
                      " set Outer radius = 6\n"
                      " set Element = quadratic\n"
                      "end\n"
                      "subsection Implant\n"
                      " set Shape = " +
                      (is_cup ? "cup" : shape) +
                      "\n"
                      " set Radius = 2\n"
                      " set Height = 3\n"
                      " set Element = quadratic\n"
                      "end\n"
                      "subsection Chuck\n"
                      " subsection Rotation z\n"
                      "  set Value = t\n"
                      " end\n"
                      "end\n",
                    entries);
}



/** Of a point from the axis, or from the centre of the sphere. */
Eigen::Vector3d
radius_of(const BodyParameters &implant, const Eigen::Vector3d &X)
{
  const auto centre = implant.geometry().centre_of_sphere;
  return {X[0], X[1], centre ? X[2] - *centre : 0.};
}



/** Largest distance of points of a face from the side of the implant, along the
 *  radius; whether normals point out of the body. */
double
distance_from_side(const BodyParameters &implant,
                   const BodyParameters &body,
                   const Side            side,
                   bool                 &points_outwards)
{
  const NurbsSurface face   = make_contact_surface(body, side);
  double             result = 0.;
  for (const auto &point : surface_quadrature(face, dealii::QGauss<1>(6)))
    {
      const auto  &X = point.X;
      const double r = implant.geometry().centre_of_sphere ?
                         implant.radius :
                         implant.geometry().side(X[2], std::atan2(X[1], X[0]));
      grow(result, std::abs(radius_of(implant, X).norm() - r));
      SurfaceGeometry geometry;
      contract(point.basis, face.control_points(), geometry);
      const double outwards =
        (side == Side::bone ? 1. : -1.) *
        geometry.a1.cross(geometry.a2).dot(radius_of(implant, X));
      points_outwards =
        points_outwards && (side == Side::implant) == (outwards > 0.);
    }
  return result;
}



/** Largest force at nodes inside, and the sum of all, for a uniform strain,
 * over the largest at all; and the volume. */
struct Patch
{
  double inside = 0, sum = 0, volume = 0;
};
Patch
patch_test(const BodyParameters &implant,
           const BodyParameters &body,
           const Side            side)
{
  const BulkSpace       mesh(body, side);
  const NeoHookean      material = NeoHookean::from_young(18000., 0.3);
  const EnrichedCells   cells(mesh, material);
  const Eigen::VectorXd force = forces_of_uniform_strain(mesh, cells);

  Patch           result;
  Eigen::Vector3d sum     = Eigen::Vector3d::Zero();
  const double    largest = force.lpNorm<Eigen::Infinity>();
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    {
      const Eigen::Vector3d &X       = mesh.reference_position(node);
      const double           r       = radius_of(implant, X).norm();
      const bool             at_axis = side == Side::implant && r < 1.5;
      sum += force.segment<3>(3 * node);
      if (X[2] > -2.99 && X[2] < -0.01 &&
          (at_axis || (side == Side::bone && r > 2.4 && r < 5.9)))
        grow(result.inside, force.segment<3>(3 * node).norm() / largest);
    }
  result.sum    = sum.norm() / largest;
  result.volume = cells.volume();
  return result;
}



void
check(const std::string &shape, const double volume, const double of_both)
{
  std::cout << shape << std::endl;
  double distance[2], of_volume[2], inside[2] = {0., 0.}, sum = 0.;
  bool   points_outwards = true;
  for (unsigned int n = 1; n <= 2; ++n)
    {
      const Scene  scene   = scene_of(shape, n);
      const double of_bone = distance_from_side(scene.implant,
                                                scene.bone,
                                                Side::bone,
                                                points_outwards);
      distance[n - 1]      = distance_from_side(scene.implant,
                                           scene.implant,
                                           Side::implant,
                                           points_outwards);
      grow(distance[n - 1], of_bone);
      const Patch implant =
                    patch_test(scene.implant, scene.implant, Side::implant),
                  bone = patch_test(scene.implant, scene.bone, Side::bone);
      for (const Patch &one : {implant, bone})
        {
          grow(inside[n - 1], one.inside);
          grow(sum, one.sum);
        }
      of_volume[n - 1] = std::abs(implant.volume / volume - 1.) +
                         std::abs(bone.volume / (of_both - volume) - 1.);
    }
  const double order = std::log2(distance[0] / distance[1]);
  if (shape == "screw")
    report("  order of the thread", order > 2.5);
  else if (scene_of(shape, 1).bone.shape == BodyShape::cavity)
    report("  order of the sphere", order > 4.);
  else
    report("  distance from circles [mm]", distance[1], 1e-14);
  report("  normals point out of the bodies", points_outwards);
  report("  order of volumes", std::log2(of_volume[0] / of_volume[1]) > 3.);
  if (shape == "screw")
    report("  forces inside", inside[1], 1e-12);
  else
    report("  order of forces inside", std::log2(inside[0] / inside[1]) > 3.);
  report("  sum of forces", sum, 1e-12);
}



// Every point of the face moves along the radius as its control points do.
void
check_press_fit(const std::string &shape)
{
  const Scene           scene   = scene_of(shape, 1);
  const BodyParameters &implant = scene.implant;
  const NurbsSurface    face    = make_contact_surface(implant);
  ControlNet            grown   = face.control_points();
  for (unsigned int A = 0; A < grown.cols(); ++A)
    grown.col(A) +=
      0.1 * implant.geometry().outwards(face.control_points().col(A));
  double error = 0.;
  for (const auto &point : surface_quadrature(face, dealii::QGauss<1>(5)))
    grow(error,
         (interpolate(point.basis, grown) - point.X -
          0.1 * implant.geometry().outwards(point.X))
           .norm());
  report(shape + ": a radius that grows by 0.1 mm", error, 1e-14);
}



int
main()
{
  return run_test([] {
    const double tube = M_PI * 36. * 3.;
    check("pin", M_PI * 4. * 3., tube);
    const double low = 2. - 3. * std::tan(3. * M_PI / 180.);
    check("taper", M_PI * (4. + 2. * low + low * low), tube);
    // R^2 + d^2/8, the mean of the square over whole turns
    check("screw", M_PI * (4. + 0.2 * 0.2 / 8.) * 3., tube);
    check("cup", 2. / 3. * M_PI * 8., 2. / 3. * M_PI * 216.);
    // of the height 0.8 of one sphere, and 6 - 1.2 of the other
    const auto cap = [](const double R, const double h) {
      return M_PI * h * h * (R - h / 3.);
    };
    check("shallow cup", cap(2., 0.8), cap(6., 4.8));
    check_press_fit("pin");
    check_press_fit("taper");
    check_press_fit("cup");
    check_press_fit("shallow cup");
  });
}
