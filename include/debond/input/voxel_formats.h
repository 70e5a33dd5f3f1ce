#pragma once

#include <debond/input/input_file.h>

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace Debond
{
  /** Size of the largest file of voxels, also unpacked. */
  constexpr unsigned int largest_image_MB = 4000;

  /** What a file says: grey values in its own order, and where they are in the
   *  axes x, y, z of the scene. For a file that knows of a body, x runs to its
   *  left, y to its back and z to its head, as in a MetaImage. */
  struct StoredVoxels
  {
    std::array<unsigned int, 3> n{{0, 0, 0}};       ///< along each index
    std::array<double, 3>       spacing{{1, 1, 1}}; ///< along each index [mm]
    /** Along which axis the indices run, 1, 2, 3 for x, y, z; negative if they
     *  run from its high end to its low end. */
    std::array<int, 3>       along{{1, 2, 3}};
    Eigen::Vector3d          first{0., 0., 0.}; ///< centre of the first voxel
    std::vector<float>       grey;              ///< the first index is fastest
    std::string              data_file;         ///< as in VoxelImage
    std::vector<std::string> remarks;           ///< as in VoxelImage

    /** The number of voxels, if there are not too many for this program. */
    std::size_t
    n_voxels(const FileRefusal &refuse) const;
  };

  /** A file `.mhd` or `.mha`. */
  StoredVoxels
  read_meta_image(const std::string &filename, const FileRefusal &refuse);
} // namespace Debond
