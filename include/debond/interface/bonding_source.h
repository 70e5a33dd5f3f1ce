#pragma once

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/bonding_parameters.h>

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace Debond
{
  struct BodyParameters;

  /** The patterns expression, image and file: phi_0 of all elements or, with
   *  that resolution, of all points of surface_quadrature(), whose places are
   *  the @p centres [mm].
   *
   *  Elements take area means. Those of expressions take some 200 quadrature
   *  points across the face; pictures are first reduced to means over 256 x 256
   *  parts, and then take two points in each direction for every part.
   *  @p remark: what a user should know of it, if anything. Throws EntryError.
   */
  std::vector<double>
  bonding_from_source(const BondingParameters            &parameters,
                      const BodyParameters               &implant,
                      const NurbsSurface                 &surface,
                      const dealii::Quadrature<1>        &along,
                      const std::vector<Eigen::Vector2d> &centres,
                      std::string                        &remark);



  /** The numbers 0 ... n-1 in random order, every order equally likely. */
  std::vector<unsigned int>
  random_order(unsigned int n, std::uint64_t seed);

  /**
   * A smooth random function of the place: nearly Gaussian, with mean 0,
   * variance 1 and the correlation exp(-(d/l)^2) between places at the distance
   * d in space. A sum of plane waves with random directions, lengths and
   * phases, so that it does not depend on any mesh.
   */
  class RandomField
  {
  public:
    /** @p correlation_length: l > 0 [mm]. */
    RandomField(std::uint64_t seed, double correlation_length);

    /** The value at @p place [mm]. */
    double
    operator()(const Eigen::Vector3d &place) const;

  private:
    struct Wave
    {
      Eigen::Vector3d k;     ///< wave vector [1/mm]
      double          phase; ///< [rad]
    };
    std::vector<Wave> waves;
  };



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
   * Reads a PNG file; colours become grey, what is transparent black. @p
   * white: the level that counts as 1; 0: the largest that the format has.
   * Throws InputError that begins with the @p entry of the scene that gave the
   * file.
   */
  GreyImage
  read_grey_image(const std::string &filename,
                  const std::string &entry,
                  unsigned int       white = 0);
} // namespace Debond
