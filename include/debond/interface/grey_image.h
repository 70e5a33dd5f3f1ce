#ifndef debond_interface_grey_image_h
#define debond_interface_grey_image_h

#include <string>
#include <vector>

namespace Debond
{
  /** A picture of grey levels from 0 (black) to 1 (white). */
  struct GreyImage
  {
    unsigned int       width = 0, height = 0; ///< pixels
    std::vector<float> levels; ///< row by row from the top, left to right

    /** The level of the pixel at @p u, @p v in [0, 1]: u from the left to the
     *  right, v from the bottom to the top. */
    double
    at(double u, double v) const;

    /** The picture in black and white: levels above @p threshold are 1. */
    GreyImage
    threshold_at(double threshold) const;
    /** The picture with at most @p side pixels in each direction, which have
     *  the area means of what they stand for. */
    GreyImage
    reduced_to(unsigned int side) const;
  };

  /**
   * Reads a PNG file (colours become grey, what is transparent black) or a PGM
   * file (plain or raw, up to 16 bits), told apart by their first bytes. Throws
   * InputError that begins with the @p entry of the scene that gave the file.
   */
  GreyImage
  read_grey_image(const std::string &filename, const std::string &entry);
} // namespace Debond
#endif
