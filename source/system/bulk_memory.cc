#include <debond/shapes/body_geometry.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/ranks.h>
#include <debond/system/bulk_memory.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    constexpr double bytes_per_number = 8.;



    /**
     * Entries of the Cholesky factor of a box of nodes with three unknowns each
     * that is ordered by nested dissection: a layer of nodes in the middle of
     * the longest direction is eliminated last and is coupled with itself and
     * with all around the box that is eliminated later. @p walls: how many of
     * the two sides in each direction are such layers.
     */
    double
    entries_of_factor(std::array<double, 3> n, std::array<double, 3> walls)
    {
      double entries = 0., n_boxes = 1.;
      while (true)
        {
          const double n_nodes = n[0] * n[1] * n[2];
          double       around  = 0.;
          for (unsigned int d = 0; d < 3; ++d)
            around += 3. * walls[d] * n_nodes / n[d];
          const unsigned int d =
            std::max_element(n.begin(), n.end()) - n.begin();
          const bool   is_smallest = n[d] < 3.;
          const double width = 3. * (is_smallest ? n_nodes : n_nodes / n[d]);
          entries += n_boxes * width * (width + around);
          if (is_smallest)
            return entries;
          n[d]     = 0.5 * (n[d] - 1.);
          walls[d] = std::min(2., walls[d] + 1.);
          n_boxes *= 2.;
        }
    }



    /** Whether the stiffness of a body may be one block, as that of a body that
     *  is not its own mirror image. */
    bool
    is_one_block(const BodyParameters &body)
    {
      return body.has_large_strains() ||
             (body.modulus && !body.modulus->is_layered());
    }
  } // namespace



  double
  n_unknowns_of(const BodyParameters &body)
  {
    const auto   n    = body.lattice_of_cells();
    const double more = body.contact_surface == SurfaceKind::nurbs ? 2. : 1.,
                 on_face = (n[0] + more) * (n[1] + more),
                 p       = body.element == ElementKind::quadratic ? 2. : 1.;
    return 3. * (body.element == ElementKind::spline ?
                   on_face * (n[2] + 2.) :
                   (p * n[0] + 1.) * (p * n[1] + 1.) * p * n[2] + on_face);
  }



  double
  bytes_of_body(const ModelParameters &model,
                const Side             side,
                const BulkSolver       solver,
                const bool             draws,
                double                &n_condensed)
  {
    const BodyParameters &body =
      side == Side::bone ? model.bone : model.implant;
    constexpr double per_unknown = 2500., per_spline_cell = 8000.,
                     per_spline_unknown = 7000., per_quadratic_cell = 20000.,
                     per_quadratic_unknown = 5000.;
    // K, its multigrid and the vectors of GMRES, and what all ranks know
    constexpr double of_multigrid = 4300., of_multigrid_for_splines = 12000.,
                     of_multigrid_for_quadratic = 6000., known_to_all = 800.;
    const double per_cell = draws ? 8000. : 3000.;
    const auto   cells    = body.lattice_of_cells();
    const double x = cells[0], y = cells[1], z = cells[2];
    n_condensed = 0.;
    if (body.is_rigid())
      return per_cell * x * y * z;
    // cells that are coarser below stand for a quarter of those above
    const double wide           = body.coarser_below ? 0.5 : 1.,
                 share_of_cells = (1. + (z - 1.) * wide * wide) / z;

    const double more = body.contact_surface == SurfaceKind::nurbs ? 2. : 1.;
    const double nodes_on_face = (x + more) * (y + more);
    double       share         = 1.; // of them that contact can reach
    if (side == Side::bone)
      {
        // whole elements under the implant, and the control points around
        const auto across = [&](const unsigned int d) {
          const double n = cells[d];
          const double width =
            std::min(1., model.implant.width(d) / body.width(d));
          const double n_under =
            body.cells_under_implant > 0 ?
              body.cells_under_implant :
              n * std::pow(width, 1. / body.lateral_grading);
          return (std::min(n, n_under + 2.) + more) / (n + more);
        };
        share =
          across(0) * across(1) * model.implant.geometry().share_of_rectangle();
      }
    n_condensed = 3. * nodes_on_face * share;
    // small strains: four blocks, each of a quarter of the body
    const double parts = is_one_block(body) ? 1. : 2.;
    const auto   factor =
      [&](const double n_x, const double n_y, const double n_z) {
        return bytes_per_number * parts * parts *
               entries_of_factor({{n_x / parts, n_y / parts, n_z}},
                                 {{0., 0., share}});
      };
    if (solver == BulkSolver::lattice) // no factors, functions of few cells
      {
        n_condensed = 0.;
        return (draws ? 16000. : 1300.) * x * y * z;
      }
    if (solver == BulkSolver::multigrid)
      {
        n_condensed               = 0.;
        const bool   is_quadratic = body.element == ElementKind::quadratic;
        const double per_unknown_here =
          body.element == ElementKind::spline ? of_multigrid_for_splines :
          is_quadratic                        ? of_multigrid_for_quadratic :
                                                of_multigrid;
        return share_of_cells *
               (((per_cell + (is_quadratic ? per_quadratic_cell : 0.)) * x * y *
                   z +
                 per_unknown_here * n_unknowns_of(body)) /
                  Ranks::number() +
                known_to_all * x * y * z);
      }
    if (body.element == ElementKind::spline) // two layers of nodes part a box
      return (per_cell + per_spline_cell) * x * y * z +
             per_spline_unknown * 3. * nodes_on_face * (z + 1.) +
             2. * factor(x + more, y + more, z + 1.);
    if (body.element == ElementKind::quadratic)
      return share_of_cells * ((per_cell + per_quadratic_cell) * x * y * z +
                               per_quadratic_unknown * 3. * (2. * x + 1.) *
                                 (2. * y + 1.) * 2. * z) +
             factor(2. * wide * x + 1., 2. * wide * y + 1., 2. * z);
    const double n_unknowns =
      3. * ((x + 1.) * (y + 1.) * (z - 1.) + nodes_on_face);
    return share_of_cells * (per_cell * x * y * z + per_unknown * n_unknowns) +
           factor(wide * x + 1., wide * y + 1., z);
  }



  std::array<double, 2>
  bytes_of_matrices(const ModelParameters &model,
                    const double           n_bone,
                    const double           n_implant)
  {
    // The trailing block of each body's factor and its copy, of a quarter
    // of the size where the body is its mirror image; where a chuck
    // component is an unknown too, also the factors of the coupled system,
    // and those that the row began with.
    const bool   is_assembled = model.needs_matrix();
    const double squares      = n_bone * n_bone + n_implant * n_implant;
    const double assembled =
      is_assembled ?
        1. + 2. * std::pow(n_bone + n_implant, 2) / std::max(1., squares) :
        0.;
    const auto bytes_of_body_matrices = [&](const BodyParameters &body,
                                            const double          n) {
      const double factors = is_one_block(body) ? 2. : 0.5;
      return bytes_per_number * (factors + assembled) * n * n;
    };
    return {{bytes_of_body_matrices(model.bone, n_bone),
             bytes_of_body_matrices(model.implant, n_implant)}};
  }
} // namespace Debond
