#include <debond/shapes/body_geometry.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/mesh_file.h>

#include <cmath>
#include <tuple>

namespace Debond
{
  // Each shape's own file defines it; it is named here, and nowhere else.
  const BodyGeometry &
  coin_geometry();
  const BodyGeometry &
  cap_geometry();
  const BodyGeometry &
  block_geometry();
  const BodyGeometry &
  mesh_geometry();
  const BodyGeometry &
  pin_geometry();
  const BodyGeometry &
  sleeve_geometry();
  const BodyGeometry &
  taper_geometry();
  const BodyGeometry &
  screw_geometry();

  const std::vector<const BodyGeometry *> &
  body_geometries()
  {
    static const std::vector<const BodyGeometry *> all{&coin_geometry(),
                                                       &cap_geometry(),
                                                       &block_geometry(),
                                                       &mesh_geometry(),
                                                       &pin_geometry(),
                                                       &sleeve_geometry(),
                                                       &taper_geometry(),
                                                       &screw_geometry()};
    return all;
  }



  double
  BodyGeometry::reach(const BodyParameters &body) const
  {
    return std::hypot(0.5 * width(body, 0), 0.5 * width(body, 1));
  }



  std::array<Eigen::Vector2d, 2>
  BodyGeometry::box_of_face(const BodyParameters &body) const
  {
    const Eigen::Vector2d half(0.5 * width(body, 0), 0.5 * width(body, 1));
    return {{-half, half}};
  }



  std::shared_ptr<const FileMesh>
  BodyGeometry::make_mesh(const BodyParameters &,
                          const BodyParameters &,
                          const std::string &) const
  {
    return nullptr;
  }



  void
  refuse_entries_of_lattices(const BodyParameters           &body,
                             const std::string              &reason,
                             const BodyGeometry::EntryCheck &refuse)
  {
    for (const auto &[is_set, entry, expected] :
         {std::make_tuple(body.element == ElementKind::spline,
                          "Element",
                          "trilinear or quadratic"),
          std::make_tuple(body.coarser_below, "Coarser below", "false"),
          std::make_tuple(body.cells_under_implant > 0,
                          "Cells under implant",
                          "0"),
          std::make_tuple(body.lateral_grading != 1., "Lateral grading", "1"),
          std::make_tuple(body.bulk_solver == BulkSolver::lattice,
                          "Bulk solver",
                          "auto, direct or multigrid")})
      refuse(is_set, entry, reason + ": expected " + expected);
  }
} // namespace Debond
