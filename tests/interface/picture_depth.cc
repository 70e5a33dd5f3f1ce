// Which level of a picture is white: pictures of 10 to 14 bits in files of 16,
// and masks of 0 and 1, ask for it; the levels of all others are over the
// largest that the format has.

#include <debond/bulk/bulk_space.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/interface/bonding_source.h>
#include <debond/support/input_error.h>

#include <fstream>
#include <sstream>

#include "checks.h"
#include "png_file.h"

using namespace Debond;

namespace
{
  using Levels = std::vector<unsigned int>;

  /** Of one row. */
  void
  write_png(const std::string &name,
            const int          bits,
            const int          n_channels,
            const Levels      &levels)
  {
    std::ofstream(name, std::ios::binary)
      << png_file(levels.size() / n_channels, levels, bits, n_channels);
  }



  void
  reads(const std::string &what,
        const std::string &name,
        const Levels      &levels,
        const double       expected_white,
        const unsigned int white = 0)
  {
    try
      {
        const GreyImage image = read_grey_image(name, "File", white);
        double          error = image.levels.size() == levels.size() ? 0. : 1.;
        for (unsigned int i = 0; i < levels.size(); ++i)
          grow(error, std::abs(image.levels[i] - levels[i] / expected_white));
        report(what, error, 1e-6);
      }
    catch (const EntryError &error)
      {
        std::cout << what << ": NO, " << error.why << std::endl;
      }
  }

  void
  refuses(const std::string &what,
          const std::string &name,
          const unsigned int white = 0)
  {
    try
      {
        const GreyImage image = read_grey_image(name, "File", white);
        std::cout << what << ": NO, the first level is " << image.levels[0]
                  << std::endl;
      }
    catch (const EntryError &error)
      {
        std::cout << what << ": " << error.why << std::endl;
      }
  }



  void
  check_png()
  {
    for (const auto &[bits, largest] : {std::make_pair(1, 1U),
                                        std::make_pair(8, 255U),
                                        std::make_pair(10, 1000U),
                                        std::make_pair(12, 4095U),
                                        std::make_pair(14, 16383U)})
      {
        const Levels      levels{largest, largest / 2, largest / 3, 0};
        const std::string what = std::to_string(bits) + " of 16 bits";
        write_png("few.png", 16, 1, levels);
        refuses(what, "few.png");
        const unsigned int white = (1U << bits) - 1;
        reads("  white as asked for", "few.png", levels, white, white);
        reads("  so dark", "few.png", levels, 65535., 65535);
      }
    const Levels wide{16384, 3, 0}, black{0, 0};
    write_png("wide.png", 16, 1, wide);
    reads("15 of 16 bits", "wide.png", wide, 65535.);
    write_png("black.png", 16, 1, black);
    reads("black", "black.png", black, 65535.);
    write_png("dark.png", 8, 1, {40, 2, 0});
    reads("dark, 8 bits", "dark.png", {40, 2, 0}, 255.);
    write_png("mask.png", 8, 1, {1, 0, 1});
    refuses("a mask of 8 bits", "mask.png");
    reads("  white as asked for", "mask.png", {1, 0, 1}, 1., 1);
    refuses("White level too low", "wide.png", 4095);

    // the weights of red, green and blue are 30, 59 and 11
    write_png("blue.png", 16, 3, {0, 0, 65535, 0, 0, 0});
    reads("blue", "blue.png", {11, 0}, 100.);
    write_png("colours.png", 16, 3, {4095, 4095, 4095, 0, 4095, 0});
    refuses("12 bits in colours", "colours.png");
    reads("  white as asked for", "colours.png", {100, 59}, 100., 4095);
    write_png("alpha.png", 16, 2, {4095, 65535, 2047, 65535, 4095, 0});
    refuses("12 bits and opacity", "alpha.png");
    reads("  white as asked for", "alpha.png", {4095, 2047, 0}, 4095., 4095);
  }



  // uniform, so that the area does not matter
  void
  check_pattern()
  {
    BodyParameters implant;
    implant.shape              = BodyShape::coin;
    implant.cells              = {{4, 4, 2}};
    const NurbsSurface surface = make_contact_surface(implant);
    write_png("uniform.png", 16, 1, {2047, 2048, 2047, 2048});
    BondingParameters bonding;
    bonding.pattern     = BondingPatternKind::image;
    bonding.file        = "uniform.png";
    bonding.white_level = 4095;
    const BondingPattern pattern(bonding,
                                 implant,
                                 surface,
                                 dealii::QGauss<1>(3));
    report("mean phi_0 of 12 bits is a half",
           std::abs(pattern.report().mean - 0.5),
           1e-4);
  }
} // namespace



int
main()
{
  check_png();
  check_pattern();
}
