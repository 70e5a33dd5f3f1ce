#include <debond/bulk/body_mesh.h>
#include <debond/interface/contact_interface.h>
#include <debond/models/memory_estimate.h>
#include <debond/scene/scene.h>
#include <debond/support/available_memory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Debond
{
  const char *const out_of_memory =
    "the memory of this machine is not enough for this scene: lower "
    "Bone / Cells, Implant / Cells or Interface / Quadrature points";



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



    /** A body's numbers of things. */
    struct Counts
    {
      double cells = 0, unknowns = 0;
      double condensed = 0; ///< unknowns that contact can reach
      double factor    = 0; ///< entries, without those of condensed ones
    };



    /** Share of the body's width that is under the implant, in cells. */
    double
    share_under(const Scene &scene, const unsigned int d)
    {
      const double covered = scene.implant.width(d) / scene.bone.size[d];
      return std::pow(std::min(1., covered), 1. / scene.bone.lateral_grading);
    }



    Counts
    counts_of(const Scene &scene, const Side side)
    {
      const BodyParameters &body =
        side == Side::bone ? scene.bone : scene.implant;
      const double x = body.cells[0], y = body.cells[1], z = body.cells[2];
      const double more = body.contact_surface == SurfaceKind::nurbs ? 2. : 1.;
      Counts       counts;
      counts.cells = x * y * z;
      if (body.material == Material::rigid)
        return counts;
      const double on_face = (x + more) * (y + more);
      counts.unknowns      = 3. * ((x + 1.) * (y + 1.) * (z - 1.) + on_face);
      counts.condensed     = 3. * on_face;
      if (side == Side::bone)
        {
          // whole elements, and the control points around them
          const auto across = [&](const unsigned int d, const double n) {
            return std::min(n, n * share_under(scene, d) + 2.) + more;
          };
          counts.condensed = 3. * across(0, x) * across(1, y) *
                             (scene.implant.is_round() ? 0.25 * M_PI : 1.);
        }
      counts.factor =
        entries_of_factor({{x + 1., y + 1., z}},
                          {{0., 0., counts.condensed / (3. * on_face)}});
      return counts;
    }



    /** Bytes that a body takes without its factors: triangulation, shape
     *  functions, sparse matrices, and the text of VTU files where there are
     *  any. Measured. */
    double
    bytes_of_body(const Scene &scene, const Counts &body)
    {
      constexpr double per_cell = 3000., per_unknown = 2500.;
      const double     per_cell_in_files =
        scene.output.fields_every > 0 ? 5000. : 0.;
      return (per_cell + per_cell_in_files) * body.cells +
             per_unknown * body.unknowns;
    }



    /** Dense matrices of the condensed unknowns: the trailing block of each
     *  body's factor and its copy; the matrix of the coupled system and its
     *  factors where a chuck component is an unknown too. */
    double
    dense_entries(const Scene &scene, const Counts &bone, const Counts &implant)
    {
      const double squares =
        bone.condensed * bone.condensed + implant.condensed * implant.condensed;
      const double n            = bone.condensed + implant.condensed;
      bool         is_assembled = scene.load_steps.follow_path;
      for (const auto &component : scene.chuck.component)
        is_assembled =
          is_assembled || component.loaded || component.stiffness != 0.;
      return 2. * squares + (is_assembled ? 2. * n * n + squares : 0.);
    }



    double
    number_of_points(const Scene &scene)
    {
      const auto &cells =
        (scene.interface.slave == Side::implant ? scene.implant : scene.bone)
          .cells;
      const double n = scene.interface.quadrature_points;
      return double(cells[0]) * cells[1] * n * n;
    }



    /** The parts of an estimate [bytes]. */
    struct Parts
    {
      double bone, implant, points;
    };



    Parts
    parts_of(const Scene &scene)
    {
      const Counts bone    = counts_of(scene, Side::bone);
      const Counts implant = counts_of(scene, Side::implant);
      const double dense =
        bytes_per_number * dense_entries(scene, bone, implant);
      const double squares = std::max(1.,
                                      bone.condensed * bone.condensed +
                                        implant.condensed * implant.condensed);
      const auto   part    = [&](const Counts &body) {
        return bytes_of_body(scene, body) + bytes_per_number * body.factor +
               dense * body.condensed * body.condensed / squares;
      };
      // those of the bonding pattern are similar, and smaller
      constexpr double bytes_per_point = 2. * sizeof(SlavePoint);
      return {part(bone),
              part(implant),
              bytes_per_point * number_of_points(scene)};
    }
  } // namespace



  double
  estimated_memory_MB(const Scene &scene)
  {
    constexpr double program = 150e6; // with its libraries
    const Parts      parts   = parts_of(scene);
    return 1e-6 * (program + parts.bone + parts.implant + parts.points);
  }



  namespace
  {
    /** Two digits, without exponent. */
    std::string
    in_words(const double MB)
    {
      if (MB < 0.1)
        return "0 MB";
      const double number = MB < 1000. ? MB : 1e-3 * MB;
      const double unit   = std::pow(10., std::floor(std::log10(number)) - 1.);
      std::ostringstream text;
      text << std::fixed << std::setprecision(number < 10. ? 1 : 0)
           << unit * std::round(number / unit) << (MB < 1000. ? " MB" : " GB");
      return text.str();
    }
  } // namespace



  void
  require_memory(const Scene &scene)
  {
    const double needed    = estimated_memory_MB(scene);
    const double available = available_memory_MB();
    if (needed <= available)
      return;
    const Parts       parts = parts_of(scene);
    const std::string entry =
      parts.points > std::max(parts.bone, parts.implant) ?
        "Interface / Quadrature points" :
      parts.bone > parts.implant ? "Bone / Cells" :
                                   "Implant / Cells";
    throw NotEnoughMemory(
      entry + ": this scene needs some " + in_words(needed) +
      " of memory, and " + in_words(available) +
      " are available: lower this first (of the memory, "
      "Bone / Cells take " +
      in_words(1e-6 * parts.bone) + ", Implant / Cells " +
      in_words(1e-6 * parts.implant) + ", Interface / Quadrature points " +
      in_words(1e-6 * parts.points) + ")");
  }
} // namespace Debond
