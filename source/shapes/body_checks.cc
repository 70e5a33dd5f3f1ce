#include <debond/input/entry_table.h>
#include <debond/shapes/body_mesh.h>
#include <debond/shapes/body_parameters.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
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
             "one cell across is too few for Contact surface = nurbs (under "
             "Expert): expected at least 2");

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
      refuse(is_bone ?
               body.shape != BodyShape::block :
               body.shape != BodyShape::coin && body.shape != BodyShape::ring &&
                 body.shape != BodyShape::cap,
             "Cells",
             fitted + "are those of a " +
               (is_bone ? "block" : "coin, cap or ring") +
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



    std::vector<SceneEntry>
    entries_of(BodyParameters body, const bool is_bone)
    {
      EntryTable table;
      if (is_bone)
        body.declare_bone(table);
      else
        body.declare_implant(table);
      return table.entries();
    }



    /** Refuses an entry of another shape that was changed: it was meant to do
     *  something. */
    void
    check_shape(const BodyParameters &body,
                const bool            is_bone,
                const EntryCheck     &refuse)
    {
      const BodyParameters usual =
        is_bone ? BodyParameters() : BodyParameters::default_implant();
      const ShapeRow &own     = body.shape_row();
      const auto      entries = entries_of(body, is_bone),
                 others       = entries_of(usual, is_bone);
      for (std::size_t i = 0; i < entries.size(); ++i)
        if (const std::string &name = entries[i].name;
            entries[i].value != others[i].value && !is_among(own.entries, name))
          refuse(std::any_of(shape_rows().begin(),
                             shape_rows().end(),
                             [&](const ShapeRow &shape) {
                               return is_among(shape.entries, name);
                             }),
                 name,
                 "it has no meaning for this Shape, " + own.name + ": give " +
                   boost::join(own.entries, " and "));
      refuse(body.shape == BodyShape::file && body.cells != usual.cells,
             "Cells",
             "the cells are those of a file: leave it out");
      own.check(body, refuse);
    }
  } // namespace



  EntryCheck
  refusal_in(const std::string &section)
  {
    return [section](const bool         is_mistake,
                     const std::string &entry,
                     const std::string &message) {
      if (is_mistake)
        throw EntryError(section + " / " + entry, message);
    };
  }



  void
  BodyParameters::check(const std::string &section) const
  {
    const bool       is_bone = section == "Bone";
    const EntryCheck refuse  = refusal_in(section);
    check_shape(*this, is_bone, refuse);
    check_number_of_cells(*this, refuse);
    if (is_fitted())
      check_fitted_cells(*this, is_bone, refuse);
    else if (shape_row().is_lattice())
      check_cells(*this, refuse);
  }



  void
  refuse_entries_of_lattices(const BodyParameters &body,
                             const std::string    &reason,
                             const EntryCheck     &refuse)
  {
    const bool is_fitted = body.is_fitted() || body.shape_row().is_lattice();
    const std::string expected = reason + ": expected ";
    refuse(!is_fitted && body.element == ElementKind::spline,
           "Element",
           expected + "trilinear or quadratic");
    refuse(body.coarser_below, "Coarser below", expected + "false");
    refuse(body.cells_under_implant > 0,
           "Cells under implant",
           expected + "none");
    refuse(body.lateral_grading != 1., "Lateral grading", expected + "1");
    refuse(body.bulk_solver == BulkSolver::lattice,
           "Solver",
           expected +
             (is_fitted ? "auto or direct" : "auto, direct or multigrid"));
  }



  void
  check_cells_around(const BodyParameters &body,
                     const bool            has_square,
                     const EntryCheck     &refuse)
  {
    refuse_entries_of_lattices(body, "this shape has no such cells", refuse);
    refuse(body.cells[0] < 8 || (has_square && body.cells[0] % 4 != 0),
           "Cells",
           "cells around, radial and along: expected " +
             std::string(has_square ? "8, 12, 16, ... around" :
                                      "at least 8 around"));
  }
} // namespace Debond
