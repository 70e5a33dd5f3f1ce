#include <debond/interface/contact_interface.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/system/load_step_parameters.h>
#include <debond/system/memory_estimate.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  const char *const out_of_memory =
    "the memory of this machine is not enough for this scene: lower "
    "Bone / Cells, Implant / Cells or Expert / Interface / Quadrature points";



  double
  n_unknowns_of(const BodyParameters &body)
  {
    const auto n = body.lattice_of_cells();
    if (body.has_tetrahedra()) // 1.8 nodes each
      return 3. * 1.8 / 4. * n[0] * n[1] * n[2];
    const double more    = body.contact_surface == SurfaceKind::nurbs ? 2. : 1.,
                 on_face = (n[0] + more) * (n[1] + more),
                 p       = body.element == ElementKind::quadratic ? 2. : 1.;
    return 3. * (body.element == ElementKind::spline ?
                   on_face * (n[2] + 2.) :
                   (p * n[0] + 1.) * (p * n[1] + 1.) * p * n[2] + on_face);
  }

  double
  n_unknowns_of(const ModelParameters &model)
  {
    double sum = 0.;
    for (const BodyParameters *const body : {&model.bone, &model.implant})
      if (!body->is_rigid())
        sum += n_unknowns_of(*body);
    return sum;
  }



  namespace
  {
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



    /** The part of a contact face that the other body can reach: whole elements
     *  under the implant, and the control points around. */
    double
    share_in_contact(const ModelParameters &model, const Side side)
    {
      if (side == Side::implant)
        return 1.;
      double share = model.bone.is_fitted() ?
                       1. :
                       model.implant.geometry().share_of_rectangle;
      for (const unsigned int d : {0, 1})
        {
          const double n = model.bone.lattice_of_cells()[d],
                       width =
                         std::min(1.,
                                  model.implant.width(d) / model.bone.width(d)),
                       under =
                         model.bone.is_fitted() ?
                           std::sqrt(model.bone.n_fitted_elements(true)) :
                         model.bone.cells_under_implant > 0 ?
                           model.bone.cells_under_implant :
                           n * std::pow(width, 1. / model.bone.lateral_grading);
          share *= (std::min(n, under + 2.) + 2.) / (n + 2.);
        }
      return share;
    }



    constexpr double bytes_per_number = 8.;



    /** Bytes that a body takes on a rank: triangulation, shape functions and
     *  sparse matrices, the text of VTU files if it @p draws any (measured),
     *  and factors with their dense part, or multigrid. @p n_condensed: its
     *  unknowns that contact can reach, if it is condensed on them. */
    double
    bytes_of_body(const ModelParameters &model,
                  const Side             side,
                  const BulkSolver       solver,
                  const bool             draws,
                  double                &n_condensed)
    {
      const BodyParameters &body =
        side == Side::bone ? model.bone : model.implant;
      const auto   cells = body.lattice_of_cells();
      const double x = cells[0], y = cells[1], z = cells[2],
                   n_cells = x * y * z, per_cell = draws ? 8000. : 3000.;
      n_condensed = 0.;
      if (body.is_rigid())
        return per_cell * n_cells;
      if (solver == BulkSolver::lattice) // no factors, functions of few cells
        return (draws ? 16000. : 1300.) * n_cells;

      // cells that are coarser below stand for a quarter of those above
      const double wide           = body.coarser_below ? 0.5 : 1.,
                   share_of_cells = (1. + (z - 1.) * wide * wide) / z;
      const bool is_spline        = body.element == ElementKind::spline,
                 has_tetrahedra   = body.has_tetrahedra(),
                 is_quadratic =
                   body.element == ElementKind::quadratic && !has_tetrahedra;
      const double of_element = is_spline      ? 8000. :
                                is_quadratic   ? 20000. :
                                has_tetrahedra ? 2500. :
                                                 0.;
      const auto   of_cells   = [&](const double per_unknown) {
        return share_of_cells * ((per_cell + of_element) * n_cells +
                                 per_unknown * n_unknowns_of(body));
      };
      if (solver == BulkSolver::multigrid)
        // K, its multigrid and the vectors of GMRES, and what all ranks know
        return of_cells(is_spline    ? 9500. :
                        is_quadratic ? 6000. :
                                       4300.) /
                 Ranks::number() +
               800. * share_of_cells * n_cells;

      // four blocks, each of a quarter of the body, if it is its own mirror
      // image
      const bool is_one_block = body.has_large_strains() || has_tetrahedra ||
                                (body.modulus && !body.modulus->is_layered);
      const double parts  = is_one_block ? 1. : 2.,
                   p      = is_quadratic   ? 2. :
                            has_tetrahedra ? 0.8 :
                                             1.,
                   layers = is_spline ? 2. : 1., // that part a box
        share             = share_in_contact(model, side);
      // of a triangle, of three faces, two nodes
      n_condensed =
        has_tetrahedra ? 2. * x * y : 3. * (x + 2.) * (y + 2.) * share;
      const double factor = parts * parts * layers *
                            entries_of_factor({{(p * wide * x + 1.) / parts,
                                                (p * wide * y + 1.) / parts,
                                                p * z}},
                                              {{0., 0., share}});
      // the trailing block of the factor and its copy
      const double dense =
        (is_one_block ? 2. : 0.5) * n_condensed * n_condensed;
      return of_cells(is_spline    ? 7000. :
                      is_quadratic ? 5000. :
                                     2500.) +
             bytes_per_number * (factor + dense);
    }
  } // namespace



  MemoryEstimate::MemoryEstimate(const ModelParameters &model,
                                 const BulkSolver       solver,
                                 const bool             draws)
  {
    double n_bone, n_implant;
    bone = bytes_of_body(model, Side::bone, solver, draws, n_bone);
    implant =
      bytes_of_body(model, Side::implant, BulkSolver::direct, draws, n_implant);
    const auto &chuck = model.chuck.component;
    if (solver == BulkSolver::direct &&
        (model.load_steps.follow_path ||
         std::any_of(chuck.begin(), chuck.end(), [](const auto &component) {
           return component.is_unknown();
         })))
      {
        // the matrix of the coupled system, its factors, and what it is made of
        const double twice = 2. * (n_bone + n_implant);
        bone += bytes_per_number * n_bone * (n_bone + twice);
        implant += bytes_per_number * n_implant * (n_implant + twice);
      }
    if (model.bone.modulus && model.bone.modulus->voxels())
      bone += 4. * model.bone.modulus->voxels()->grey.size();

    // those of the bonding pattern are similar, and smaller
    const auto cells =
      (model.interface.slave == Side::implant ? model.implant : model.bone)
        .lattice_of_cells();
    points =
      2. * sizeof(SlavePoint) * double(cells[0]) * cells[1] *
      std::pow(
        model.interface.points_per_element(model.bone, model.implant).size(),
        2);
    constexpr double program = 150e6; // with its libraries
    total                    = program + bone + implant + points;
    for (double *const part : {&bone, &implant, &points, &total})
      *part *= 1e-9;
  }



  void
  require_memory(const ModelParameters &model,
                 const bool             draws,
                 const bool             has_bodies)
  {
    const auto check = [&] {
      const MemoryEstimate estimate(model, model.bulk_solver(), draws);
      const double needed = has_bodies ? estimate.points : estimate.total;
      const double available =
        1e-3 * available_memory_MB() / Ranks::number_on_this_machine();
      if (needed <= available)
        return;
      const auto GB = [](const double number) {
        return to_text(number, 3) + " GB";
      };
      throw NotEnoughMemory(
        has_bodies ||
            estimate.points > std::max(estimate.bone, estimate.implant) ?
          "Expert / Interface / Quadrature points" :
        estimate.bone > estimate.implant ? "Bone / Cells" :
                                           "Implant / Cells",
        "this scene needs some " + GB(needed) + " of memory" +
          (Ranks::number() > 1 ? " in each process" : "") + ", and " +
          GB(available) +
          " are available: lower this first (of the memory, Bone / Cells "
          "take " +
          GB(estimate.bone) + ", Implant / Cells " + GB(estimate.implant) +
          ", Expert / Interface / Quadrature points " + GB(estimate.points) +
          ")");
    };
    // machines may have more or less of it
    Ranks::in_agreement(check);
  }
} // namespace Debond
