#include <debond/shapes/body_geometry.h>
#include <debond/shapes/body_mesh.h>
#include <debond/shapes/body_parameters.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace Debond
{
  namespace
  {
    using EntryCheck = BodyGeometry::EntryCheck;



    void
    check_number_of_cells(const BodyParameters &body, const EntryCheck &refuse)
    {
      const double largest_number = 2e6 * Ranks::number();
      const auto   lattice        = body.lattice_of_cells();
      const double n_cells =
        static_cast<double>(lattice[0]) * lattice[1] * lattice[2];
      refuse(n_cells > largest_number,
             body.mesh ? "Mesh file" : "Cells",
             to_text(n_cells) +
               " cells are more than this program can solve for, " +
               to_text(largest_number));
      refuse(body.element != ElementKind::trilinear &&
               body.contact_surface == SurfaceKind::bilinear,
             "Contact surface",
             "only trilinear cells have such faces: with another Element "
             "expected nurbs");
    }



    void
    check_cells(const BodyParameters &body, const EntryCheck &refuse)
    {
      // nine control points over one face: 2 x 2 Gauss points do not see all
      // their motions, and the stiffness is singular
      refuse(!body.is_rigid() && body.contact_surface == SurfaceKind::nurbs &&
               std::min(body.cells[0], body.cells[1]) < 2,
             "Cells",
             "one cell across is too few for Contact surface = nurbs: expected "
             "at least 2");

      refuse(body.coarser_below && body.element == ElementKind::spline,
             "Coarser below",
             "splines have cells of one width: expected false");
      refuse(body.coarser_below &&
               (body.cells[0] % 2 != 0 || body.cells[1] % 2 != 0 ||
                body.cells[2] < 2),
             "Coarser below",
             "two cells across become one below the first layer: expected even "
             "numbers of Cells across, and two layers or more");
      constexpr double  thinnest = 1e-6;
      const std::string thinner  = "thinner than a millionth of the body";
      refuse(std::pow(1. / body.cells[2], body.layer_grading) < thinnest,
             "Layer grading",
             "it makes the first of " + std::to_string(body.cells[2]) +
               " layers " + thinner);
      const unsigned int under = body.cells_under_implant;
      for (const unsigned int d : {0, 1})
        {
          const unsigned int n = body.cells[d];
          refuse(under > 0 && body.lateral_grading != 1.,
                 "Lateral grading",
                 "cells heed the rim (Cells under implant) or the centre, not "
                 "both: expected 1");
          refuse(under > 0 && (under + 2 > n || (n - under) % 2 != 0),
                 "Cells under implant",
                 "of " + std::to_string(n) +
                   " cells across as many are beside the implant to the left "
                   "as to the right: expected " +
                   std::to_string(n) + " less 2, 4, ...");
          refuse(under > 0 && !(body.rim[d] < 0.499 * body.size[d]),
                 "Cells under implant",
                 "the implant has no rim above this bone: expected none");
          double     thin      = 1.;
          const auto fractions = body.lateral_fractions(d);
          for (unsigned int i = 0; i < n; ++i)
            thin = std::min(thin, fractions[i + 1] - fractions[i]);
          refuse(thin<thinnest, under> 0 ? "Rim grading" : "Lateral grading",
                 "it makes some of " + std::to_string(n) + " cells across " +
                   thinner);
        }
    }



    void
    check_fitted_cells(const BodyParameters &body,
                       const bool            is_bone,
                       const EntryCheck     &refuse)
    {
      const std::string fitted = "cells that are fitted to the rim ";
      refuse(body.shape != (is_bone ? BodyShape::block : BodyShape::coin),
             "Cells",
             fitted + "are those of a " + (is_bone ? "block" : "coin") +
               ": expected numbers");
      refuse(body.fitted_cells[0] % 4 != 0,
             "Cells",
             fitted + "have a square core: expected 4, 8, 12, ... around");
      refuse(body.element != ElementKind::spline,
             "Element",
             fitted + "are splines: expected spline");
      refuse(body.contact_surface != SurfaceKind::nurbs,
             "Contact surface",
             fitted + "have smooth faces: expected nurbs");
      refuse(is_bone &&
               !(body.rim[0] < 0.499 * std::min(body.size[0], body.size[1])),
             "Cells",
             fitted + "lie around an implant that the bone extends beyond: "
                      "expected numbers");
      const std::string small = fitted + "are as small as they should";
      refuse(body.layer_grading != 1., "Layer grading", small + ": expected 1");
      refuse_entries_of_lattices(body, small, refuse);
    }



    /** An entry of another shape that was changed was meant to do something:
     *  refuse it rather than ignore it. */
    void
    check_shape(const BodyParameters &body,
                const BodyParameters &usual,
                const EntryCheck     &refuse)
    {
      const BodyGeometry            &geometry = body.geometry();
      const std::vector<std::string> own      = geometry.entries();
      for (const auto &[entry, is_set] :
           {std::pair("Size", body.size != usual.size),
            std::pair("Radius", body.radius != usual.radius),
            std::pair("Height",
                      body.height != usual.height ||
                        body.sleeve_height != usual.sleeve_height),
            std::pair("Cap radius", body.cap_radius != usual.cap_radius),
            std::pair("Inner radius", body.inner_radius != usual.inner_radius),
            std::pair("Outer radius", body.outer_radius != usual.outer_radius),
            std::pair("Ends", body.ends != usual.ends),
            std::pair("Support radius",
                      body.support_radius != usual.support_radius),
            std::pair("Taper angle", body.taper_angle != usual.taper_angle),
            std::pair("Pitch", body.pitch != usual.pitch),
            std::pair("Thread depth", body.thread_depth != usual.thread_depth),
            std::pair("Starts", body.starts != usual.starts),
            std::pair("Mesh file", body.mesh_file != usual.mesh_file)})
        refuse(is_set && std::find(own.begin(), own.end(), entry) == own.end(),
               entry,
               "it has no meaning for this Shape, " + geometry.name() +
                 ": give " + boost::join(own, " and "));
      refuse(body.shape == BodyShape::file && body.cells != usual.cells,
             "Cells",
             "the cells are those of a file: leave it out");
      geometry.check(body, refuse);
    }
  } // namespace



  void
  BodyParameters::check(const std::string &section) const
  {
    const EntryCheck refuse = [&](const bool         is_mistake,
                                  const std::string &entry,
                                  const std::string &message) {
      if (is_mistake)
        throw EntryError(section + " / " + entry, message);
    };
    check_shape(*this,
                section == "Bone" ? BodyParameters() : default_implant(),
                refuse);
    check_number_of_cells(*this, refuse);
    if (is_fitted())
      check_fitted_cells(*this, section == "Bone", refuse);
    else if (geometry().is_lattice())
      check_cells(*this, refuse);
  }



  void
  refuse_entries_of_lattices(const BodyParameters           &body,
                             const std::string              &reason,
                             const BodyGeometry::EntryCheck &refuse)
  {
    const bool is_fitted = body.geometry().is_lattice();
    for (const auto &[is_set, entry, expected] :
         {std::make_tuple(!is_fitted && body.element == ElementKind::spline,
                          "Element",
                          "trilinear or quadratic"),
          std::make_tuple(body.coarser_below, "Coarser below", "false"),
          std::make_tuple(body.cells_under_implant > 0,
                          "Cells under implant",
                          "none"),
          std::make_tuple(body.lateral_grading != 1., "Lateral grading", "1"),
          std::make_tuple(body.bulk_solver == BulkSolver::lattice,
                          "Solver",
                          is_fitted ? "auto or direct" :
                                      "auto, direct or multigrid")})
      refuse(is_set, entry, reason + ": expected " + expected);
  }
} // namespace Debond
