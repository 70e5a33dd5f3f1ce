#pragma once

#include <debond/input/expression_parser.h>
#include <debond/input/voxel_image.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>

namespace Debond
{
  /** Young's modulus of a bone as a function of the place X [mm]: an expression
   *  in x, y, z and, with a file of voxels, the grey value there. */
  class ModulusField
  {
  public:
    /** Corners of a box [mm], the lowest and the highest. */
    using Box = std::array<Eigen::Vector3d, 2>;

    /** @p image: voxels, whose lowest corner is at @p corner [mm] in the scene,
     *  or null. @p radius: the constant R [mm]. @p bone: the box around it.
     *  Throws EntryError if the expression is invalid. */
    ModulusField(const std::string                &expression,
                 std::shared_ptr<const VoxelImage> image,
                 const std::array<double, 3>      &corner,
                 double                            radius,
                 const Box                        &bone);

    /** What stands for the box with these corners [MPa]: the mean over a sample
     *  for each voxel in it, or, without voxels, the value at @p point. Throws
     *  EntryError where the modulus is not a number from 1e-6 to 1e12 MPa, or
     *  where there is no voxel. */
    double
    over_box(const Eigen::Vector3d &lower,
             const Eigen::Vector3d &upper,
             const Eigen::Vector3d &point) const;

    /** Moduli in the bone [MPa], by some thousand points. */
    struct Range
    {
      double smallest = 1e300, mean = 0., largest = 0.;
    };
    Range range;

    /** Whether it is the same everywhere at the same z. */
    const bool is_layered;
    const VoxelImage *
    voxels() const
    {
      return image.get();
    }
    /** Lines: of voxels how many there are, of which size, from where to where,
     *  with which grey values, where the bone is, and which voxel is the first
     *  of the file; then the range of moduli. */
    std::string
    in_words() const;

  private:
    double
    at(const Eigen::Vector3d &X) const;

    const std::string                       text;
    const std::shared_ptr<const VoxelImage> image;
    const Box                               bone, of_voxels;
    const Expression                        modulus;
  };
} // namespace Debond
