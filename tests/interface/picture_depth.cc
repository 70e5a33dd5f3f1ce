// Which level of a picture is white: pictures of 10 to 14 bits in files of 16,
// and masks of 0 and 1, ask for it; the levels of all others are what the file
// says. Expected levels are those written, over the white one.

#include <debond/bulk/bulk_space.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/interface/bonding_source.h>
#include <debond/support/input_error.h>

#include <png.h>

#include <cstdint>
#include <fstream>
#include <sstream>

#include "checks.h"

using namespace Debond;

namespace
{
  using Levels = std::vector<unsigned int>;

  /** Of one row, with one, two, three or four channels; @p significant bits, if
   *  it says so. */
  void
  write_png(const std::string &name,
            const int          bits,
            const int          n_channels,
            const Levels      &levels,
            const int          significant = 0)
  {
    const int             types[]{0,
                                  PNG_COLOR_TYPE_GRAY,
                                  PNG_COLOR_TYPE_GRAY_ALPHA,
                                  PNG_COLOR_TYPE_RGB,
                                  PNG_COLOR_TYPE_RGB_ALPHA};
    std::vector<png_byte> row;
    for (const unsigned int level : levels)
      {
        if (bits == 16)
          row.push_back(static_cast<png_byte>(level >> 8));
        row.push_back(static_cast<png_byte>(level & 255));
      }
    std::FILE *const file = std::fopen(name.c_str(), "wb");
    png_structp      png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png,
                 info,
                 levels.size() / n_channels,
                 1,
                 bits,
                 types[n_channels],
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_color_8 depth;
    depth.red = depth.green = depth.blue = depth.gray = depth.alpha =
      static_cast<png_byte>(significant);
    if (significant > 0)
      png_set_sBIT(png, info, &depth);
    png_write_info(png, info);
    png_write_row(png, row.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
  }

  /** Plain, or of two bytes for each pixel. */
  void
  write_pgm(const std::string &name,
            const unsigned int white,
            const Levels      &levels,
            const bool         plain)
  {
    std::ofstream file(name, std::ios::binary);
    file << (plain ? "P2 " : "P5 ") << levels.size() << " 1 " << white << '\n';
    for (const unsigned int level : levels)
      if (plain)
        file << level << '\n';
      else
        file.put(static_cast<char>(level >> 8))
          .put(static_cast<char>(level & 255));
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
    const Levels wide{16384, 3, 0}, black{0, 0}, twelve{4095, 2047, 1};
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

    // significant bits at the high end, as the standard says, or at the low end
    write_png("high.png", 16, 1, {4095 << 4, 100 << 4}, 12);
    reads("12 significant bits", "high.png", {4095 << 4, 100 << 4}, 65535.);
    write_png("high.png", 16, 1, {300 << 4, 100 << 4}, 12);
    reads("  which are dark", "high.png", {300 << 4, 100 << 4}, 65535.);
    write_png("low.png", 16, 1, twelve, 12);
    reads("  at the low end", "low.png", twelve, 4095.);
    write_png("either.png", 16, 1, {2048, 0}, 12);
    refuses("  at either end", "either.png");
    write_png("all.png", 16, 1, twelve, 16);
    reads("16 significant bits", "all.png", twelve, 65535.);

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



  void
  check_pgm()
  {
    const Levels twelve{4095, 2047, 1};
    for (const bool plain : {true, false})
      {
        write_pgm("few.pgm", 65535, twelve, plain);
        refuses("PGM, 12 of 16 bits", "few.pgm");
        reads("  white as asked for", "few.pgm", twelve, 4095., 4095);
        write_pgm("told.pgm", 4095, twelve, plain);
        reads("PGM, white is 4095", "told.pgm", twelve, 4095.);
        write_pgm("told.pgm", 4095, {1000, 3}, plain);
        reads("  and nothing is", "told.pgm", {1000, 3}, 4095.);
      }
    write_pgm("mask.pgm", 255, {1, 0}, true);
    refuses("PGM, a mask of 8 bits", "mask.pgm");
    write_pgm("mask.pgm", 1, {1, 0}, true);
    reads("PGM, a mask of 1 bit", "mask.pgm", {1, 0}, 1.);
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
  check_pgm();
  check_pattern();
}
