#include <debond/bulk/body.h>
#include <debond/bulk/bulk_space.h>
#include <debond/output/bone_strength.h>
#include <debond/support/ranks.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

#include <algorithm>

namespace Debond
{
  namespace
  {
    /** Largest and smallest principal stress over the strengths, each at least
     *  0. */
    std::array<double, 2>
    ratios(const Eigen::Matrix3d &stress, const BodyParameters &bone)
    {
      const Eigen::Vector3d principal =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress,
                                                       Eigen::EigenvaluesOnly)
          .eigenvalues();
      const auto over = [](const double stress, const double strength) {
        return strength > 0. ? std::max(0., stress / strength) : 0.;
      };
      return {{over(principal[2], bone.tensile_strength),
               over(-principal[0], bone.compressive_strength)}};
    }

  } // namespace



  BeyondStrength
  beyond_strength(const Body &body)
  {
    const BulkSpace      &space = body.mesh();
    const BodyParameters &bone  = space.parameters();
    BeyondStrength        result;
    if (std::max(bone.tensile_strength, bone.compressive_strength) == 0.)
      return result;
    body.for_each_stress([&](const unsigned int      cell,
                             const dealii::Point<3> &point,
                             const Eigen::Matrix3d  &stress,
                             const double            volume) {
      const auto ratio = ratios(stress, bone);
      if (std::max(ratio[0], ratio[1]) > 1.)
        result.volume_mm3 += volume;
      for (const unsigned int kind : {0, 1})
        if (ratio[kind] > std::max(1., result.ratio[kind]))
          {
            result.ratio[kind] = ratio[kind];
            result.X[kind] =
              CellFunctions(space, space.cells()[cell]).position(point);
          }
    });
    if (Ranks::number() > 1)
      result.volume_mm3 =
        dealii::Utilities::MPI::sum(result.volume_mm3, Ranks::communicator());
    result.stress_MPa = {{result.ratio[0] * bone.tensile_strength,
                          -result.ratio[1] * bone.compressive_strength}};
    return result;
  }
} // namespace Debond
