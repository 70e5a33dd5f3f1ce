#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /** Grey values on a regular grid of voxels, as a computed tomograph writes
   *  them. */
  struct VoxelImage
  {
    std::array<unsigned int, 3> n{{0, 0, 0}};       ///< voxels along x, y, z
    std::array<double, 3>       spacing{{1, 1, 1}}; ///< edges of a voxel [mm]
    /** The lowest corner of the grid where the file says that it is [mm]. */
    std::array<double, 3> corner{{0, 0, 0}};
    std::vector<float>    grey;      ///< from the lowest corner, x is fastest
    std::string           data_file; ///< that the file refers to, if any
    /** In words, from which corner on and along which axes the file has them.
     */
    std::string order;
    std::string identity; ///< of the files, see identity_of()
    /** What the file says, or does not say, and is not heeded, as sentences. */
    std::vector<std::string> remarks;

    double
    length(const unsigned int direction) const
    {
      return n[direction] * spacing[direction];
    }
  };

  /**
   * Reads what the end of the name says:
   *
   *  - `.mhd`, `.mha`: MetaImage, a header of lines `name = value` and raw,
   *    uncompressed numbers in a file of their own or behind the header, in mm;
   *  - `.csv`: columns x, y, z [mm], the centres of all voxels in any order,
   *    and grey.
   *
   * The axes are those of MetaImage: where a file knows of a body, x runs to
   * its left, y to its back and z to its head. Oblique axes are refused, and so
   * is what a header says in two ways that differ.
   *
   * An image that is in use is not read again unless the content of the file,
   * or of the data that it refers to, is another.
   * Throws EntryError for the @p entry of the scene that gave the file.
   */
  std::shared_ptr<const VoxelImage>
  read_voxel_image(const std::string &filename, const std::string &entry);
} // namespace Debond
