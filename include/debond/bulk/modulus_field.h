#ifndef debond_bulk_modulus_field_h
#define debond_bulk_modulus_field_h

#include <debond/input/expression_parser.h>
#include <debond/input/voxel_image.h>

#include <Eigen/Core>

#include <optional>
#include <string>

namespace Debond
{
  /** Young's modulus of a bone as a function of the place X [mm]: an expression
   *  in x, y, z and, with a file of voxels, the grey value there. */
  class ModulusField
  {
  public:
    /** @p image, with its corner where it is in the scene, or none. @p radius:
     *  the constant R [mm]. Throws EntryError if the expression is invalid. */
    ModulusField(const std::string        &expression,
                 std::optional<VoxelImage> image,
                 double                    radius);

    /** What stands for the box with these corners [MPa]: the mean over a sample
     *  for each voxel in it, or, without voxels, the value at @p point. Throws
     *  EntryError where the modulus is not a number from 1e-6 to 1e12 MPa, or
     *  where there is no voxel. */
    double
    over_box(const Eigen::Vector3d &lower,
             const Eigen::Vector3d &upper,
             const Eigen::Vector3d &point) const;

    /** Mean over a box [MPa], by some thousand points. */
    double
    mean(const Eigen::Vector3d &lower, const Eigen::Vector3d &upper) const;

    /** Whether it is the same everywhere at the same z. */
    bool
    is_layered() const
    {
      return layered;
    }
    const std::optional<VoxelImage> &
    voxels() const
    {
      return image;
    }

  private:
    double
    at(const Eigen::Vector3d &X) const;

    const std::string               text;
    const std::optional<VoxelImage> image;
    const bool                      layered;
    const Expression                modulus;
  };
} // namespace Debond
#endif
