// No byte of a PNG file can be changed or cut off unnoticed; interlaced
// pictures are read as others are.

#include <debond/interface/bonding_source.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace
{
  const std::string pictures = DEBOND_SOURCE_DIR "/tests/fuzz/seeds/image/";



  std::string
  contents(const std::string &filename)
  {
    std::ostringstream text;
    text << std::ifstream(filename, std::ios::binary).rdbuf();
    return text.str();
  }



  bool
  is_refused(const std::string &bytes)
  {
    const std::string name = "results/damaged.png";
    std::ofstream(name, std::ios::binary) << bytes;
    try
      {
        Debond::read_grey_image(name, "File");
      }
    catch (const Debond::InputError &)
      {
        return true;
      }
    return false;
  }



  void
  damage(const std::string &name)
  {
    const std::string bytes    = contents(pictures + name);
    unsigned int      accepted = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      {
        std::string changed = bytes;
        changed[i]          = static_cast<char>(~changed[i]);
        accepted += !is_refused(changed);
        accepted += !is_refused(bytes.substr(0, i));
      }
    std::cout << name << ": read " << (is_refused(bytes) ? "no" : "yes")
              << ", damaged ones that are read: " << accepted << std::endl;
  }
} // namespace



int
main()
{
  std::filesystem::create_directories("results");
  for (const std::string name :
       {"grey_1.png", "grey_16.png", "palette_transparent.png", "rgba.png"})
    damage(name);
  // the level at x, y is 40 y + 11 x of 255
  const auto image =
    Debond::read_grey_image(pictures + "interlaced.png", "File");
  double error = 0.;
  for (unsigned int y = 0; y < image.height; ++y)
    for (unsigned int x = 0; x < image.width; ++x)
      error = std::max(error,
                       std::abs(255. * image.levels[y * image.width + x] -
                                (40. * y + 11. * x)));
  std::cout << "interlaced: " << image.width << " x " << image.height
            << ", right: " << (error < 1e-4 ? "yes" : "no") << std::endl;
}
