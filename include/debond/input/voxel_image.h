#ifndef debond_input_voxel_image_h
#define debond_input_voxel_image_h

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
    /** The lowest corner of the grid in the file's own coordinates [mm]. */
    std::array<double, 3> corner{{0, 0, 0}};
    std::vector<float>    grey;      ///< x is fastest
    std::string           data_file; ///< that the file refers to, if any
    /** What the file says, or does not say, and is not heeded, as sentences. */
    std::vector<std::string> remarks;

    double
    length(const unsigned int direction) const
    {
      return n[direction] * spacing[direction];
    }
    /** "125 x 125 x 50" */
    std::string
    grid_text() const;
  };

  /**
   * Reads what the end of the name says:
   *
   *  - `.mhd`, `.mha`: MetaImage, a header of lines `name = value` and raw,
   *    uncompressed numbers in a file of their own or behind the header, in mm;
   *  - `.nii`, `.nii.gz`: NIfTI-1 or 2, by the library; grey values are scaled
   *    as the file says, the axes are taken as they are stored;
   *  - `.csv`: columns x, y, z [mm], the centres of all voxels in any order,
   *    and grey.
   *
   * An image that is in use is not read again unless the file has changed.
   * Throws EntryError for the @p entry of the scene that gave the file.
   */
  std::shared_ptr<const VoxelImage>
  read_voxel_image(const std::string &filename, const std::string &entry);
} // namespace Debond
#endif
