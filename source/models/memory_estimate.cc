#include <debond/interface/contact_interface.h>
#include <debond/models/memory_estimate.h>
#include <debond/scene/scene.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/system/bulk_memory.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Debond
{
  const char *const out_of_memory =
    "the memory of this machine is not enough for this scene: lower "
    "Bone / Cells, Implant / Cells or Interface / Quadrature points";



  namespace
  {
    /** An estimate and its parts [MB]. */
    struct Parts
    {
      double bone, implant, points, total;

      explicit Parts(const Scene &scene)
      {
        double     n_bone, n_implant;
        const bool draws = scene.output.fields_every > 0;
        bone =
          bytes_of_body(scene, Side::bone, scene.bulk_solver(), draws, n_bone);
        implant = bytes_of_body(
          scene, Side::implant, BulkSolver::direct, draws, n_implant);

        const auto matrices = bytes_of_matrices(scene, n_bone, n_implant);
        bone += matrices[0];
        implant += matrices[1];

        // those of the bonding pattern are similar, and smaller
        const bool on_implant = scene.interface.slave == Side::implant;
        const auto cells =
          (on_implant ? scene.implant : scene.bone).lattice_of_cells();
        points = 2. * sizeof(SlavePoint) * double(cells[0]) * cells[1] *
                 std::pow(scene.interface.points_per_element(scene.bone,
                                                             scene.implant),
                          2);
        constexpr double program = 150e6; // with its libraries
        if (scene.bone.modulus && scene.bone.modulus->voxels())
          bone += 4. * scene.bone.modulus->voxels()->grey.size();
        total = program + bone + implant + points;
        for (double *const part : {&bone, &implant, &points, &total})
          *part *= 1e-6;
      }
    };



    /** Two digits: it is an estimate. */
    std::string
    in_words(const double MB)
    {
      const double number = MB < 1e3 ? MB : 1e-3 * MB;
      const double unit =
        std::pow(10., std::floor(std::log10(std::max(number, 1.))) - 1.);
      return to_text(unit * std::round(number / unit)) +
             (MB < 1e3 ? " MB" : " GB");
    }
  } // namespace



  double
  estimated_memory_MB(const Scene &scene)
  {
    return Parts(scene).total;
  }



  namespace
  {
    void
    require_own_memory(const Scene &scene, const bool has_bodies)
    {
      const Parts  parts(scene);
      const double needed = has_bodies ? parts.points : parts.total,
                   available =
                     available_memory_MB() / Ranks::number_on_this_machine();
      if (needed <= available)
        return;
      throw NotEnoughMemory(
        has_bodies || parts.points > std::max(parts.bone, parts.implant) ?
          "Interface / Quadrature points" :
        parts.bone > parts.implant ? "Bone / Cells" :
                                     "Implant / Cells",
        "this scene needs some " + in_words(needed) + " of memory" +
          (Ranks::number() > 1 ? " in each process" : "") + ", and " +
          in_words(available) +
          " are available: lower this first (of the memory, Bone / Cells "
          "take " +
          in_words(parts.bone) + ", Implant / Cells " +
          in_words(parts.implant) + ", Interface / Quadrature points " +
          in_words(parts.points) + ")");
    }
  } // namespace



  void
  require_memory(const Scene &scene, const bool has_bodies)
  {
    // machines may have more or less of it
    Ranks::in_agreement([&] { require_own_memory(scene, has_bodies); });
  }
} // namespace Debond
