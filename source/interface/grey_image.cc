#include <debond/input/input_file.h>
#include <debond/interface/bonding_source.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/crc.hpp>
#include <boost/endian/conversion.hpp>

#include <Eigen/SparseCore>
#include <png.h>

#include <algorithm>
#include <limits>

// Pictures of bonded faces, from a microscope or drawn by hand. Their grey
// levels are measured values, and are read as the file has them: without gamma,
// colour profiles or what else makes a picture pleasant.
namespace Debond
{
  namespace
  {
    /** The matrix that makes means over @p n_coarse pixels of equal size of
     *  @p n_fine: each of these belongs to one, or in parts to two. */
    Eigen::SparseMatrix<float, Eigen::RowMajor>
    means(const unsigned int n_fine, const unsigned int n_coarse)
    {
      Eigen::SparseMatrix<float, Eigen::RowMajor> result(n_coarse, n_fine);
      const double size = double(n_fine) / n_coarse; // of a coarse pixel
      for (unsigned int k = 0; k < n_coarse; ++k)
        for (auto i = static_cast<unsigned int>(k * size);
             i < n_fine && i < (k + 1) * size;
             ++i)
          result.insert(k, i) =
            (std::min((k + 1) * size, i + 1.) - std::max(k * size, double(i))) /
            size;
      return result;
    }



    using boost::endian::load_big_u32;

    // What a picture of 400 MB has in 4 bytes for each pixel: a damaged header
    // may ask for more.
    constexpr unsigned int largest_side = 10000; ///< pixels



    /** A file, for messages, and the level that counts as 1 by the scene; 0 if
     *  that of the file does. */
    struct ImageFile
    {
      const std::string &name, &entry;
      const unsigned int white;

      [[noreturn]] void
      refuse(const std::string &why) const
      {
        throw EntryError(entry, why, name);
      }

      void
      check_size(const double width, const double height) const
      {
        if (width < 1 || height < 1 || width > largest_side ||
            height > largest_side)
          refuse("this picture has " + to_text(width) + " x " +
                 to_text(height) + " pixels: expected 1 to " +
                 to_text(largest_side) + " in each direction");
      }

      /** The level that counts as 1 where the format has room for levels up to
       *  @p most and the picture has none above @p largest. Cameras write 10,
       *  12 or 14 bits into files of 16, and masks are 0 and 1: nearly black,
       *  which may not be meant. */
      unsigned int
      white_level(const unsigned int most, const unsigned int largest) const
      {
        const std::string levels =
          "the levels of this picture go up to " + std::to_string(largest);
        if (white > 0 && largest > white)
          refuse(levels +
                 ": expected Expert / Interface / Bonding / White level = " +
                 std::to_string(white) + " at most");
        if (white == 0 && (largest == 1 ||
                           (most == 65535 && largest > 0 && largest < 1 << 14)))
          refuse(
            levels + " of " + std::to_string(most) +
            ": set Expert / Interface / Bonding / White level to the one that is white");
        return white > 0 ? white : most;
      }
    };



    // libraries of bytes want them without a sign
    const unsigned char *
    bytes_at(const std::string &bytes, const std::size_t position)
    {
      return reinterpret_cast<const unsigned char *>(bytes.data()) + position;
    }



    /** A PNG file with those chunks only that make up the picture, their sums
     *  checked: others, such as those about colours, change no grey level. */
    std::string
    essence_of_png(const ImageFile &file, const std::string &bytes)
    {
      const std::size_t signature = 8, around = 12; // length, type, sum
      if (bytes.compare(0, signature, "\x89PNG\r\n\x1a\n") != 0)
        file.refuse("this PNG file is damaged");
      std::string result   = bytes.substr(0, signature);
      std::size_t position = signature;
      for (std::string type; type != "IEND";)
        {
          const auto number = [&](const std::size_t from) {
            return load_big_u32(bytes_at(bytes, position + from));
          };
          const std::size_t left   = bytes.size() - position;
          const std::size_t length = left < around ? left : number(0);
          if (left < around || length > left - around)
            file.refuse("this PNG file is cut off");
          type = bytes.substr(position + 4, 4);
          boost::crc_32_type sum;
          sum.process_bytes(bytes_at(bytes, position + 4), length + 4);
          if (sum.checksum() != number(8 + length))
            file.refuse("this PNG file is damaged");
          if (type == "IHDR" && length == 13)
            file.check_size(number(8), number(12));
          for (const char *const wanted :
               {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"})
            if (type == wanted)
              result += bytes.substr(position, length + around);
          position += length + around;
        }
      return result;
    }



    /** The levels of pixels with one or more channels: grey or red, green and
     *  blue, then opacity if their number is even; what is transparent is
     *  black. False if libpng cannot read what
     *  png_image_begin_read_from_memory() has found. */
    template <typename Channel>
    bool
    read_levels(png_image          &png,
                const ImageFile    &file,
                std::vector<float> &levels)
    {
      std::vector<Channel> channels(PNG_IMAGE_SIZE(png) / sizeof(Channel));
      if (png_image_finish_read(&png, nullptr, channels.data(), 0, nullptr) ==
          0)
        return false;
      constexpr unsigned int most    = std::numeric_limits<Channel>::max();
      const unsigned int     n       = PNG_IMAGE_PIXEL_CHANNELS(png.format);
      unsigned int           largest = 0;
      for (std::size_t i = 0; i < channels.size(); ++i)
        if (i % n < (n < 3 ? 1 : 3)) // no opacity
          largest = std::max<unsigned int>(largest, channels[i]);
      const double white = file.white_level(most, largest);
      // Grey of a colour is its brightness, 30 % red, 59 % green and 11 % blue;
      // a grey picture that was stored in colours keeps its levels.
      // libpng has multiplied channels of 16 bits by the opacity already
      const bool multiply = n % 2 == 0 && sizeof(Channel) == 1;
      for (auto pixel = channels.cbegin(); pixel != channels.cend(); pixel += n)
        {
          const double level =
            (n < 3 ?
               pixel[0] :
               (30. * pixel[0] + 59. * pixel[1] + 11. * pixel[2]) / 100.) /
            white;
          levels.push_back(multiply ? level * pixel[n - 1] / double(most) :
                                      level);
        }
      return true;
    }



    // libpng takes levels of 16 bits for linear in the intensity and others for
    // sRGB: those that are asked for in the same way stay as they are.
    // Boost.GIL reads beyond the end of rows with fewer than 8 bits for a
    // pixel.
    //
    // A palette is resolved into the colours that it stands for, as the numbers
    // of its entries mean nothing.
    GreyImage
    read_png(const ImageFile &file, const std::string &bytes)
    {
      const std::string essence = essence_of_png(file, bytes);
      GreyImage         image;
      png_image         png{};
      png.version = PNG_IMAGE_VERSION;
      bool is_read =
        png_image_begin_read_from_memory(&png, essence.data(), essence.size());
      if (is_read)
        {
          png.format &= ~PNG_FORMAT_FLAG_COLORMAP;
          image.width  = png.width;
          image.height = png.height;
          is_read      = (png.format & PNG_FORMAT_FLAG_LINEAR) != 0 ?
                           read_levels<png_uint_16>(png, file, image.levels) :
                           read_levels<png_byte>(png, file, image.levels);
        }
      if (!is_read)
        file.refuse("this file is damaged: it begins like a PNG file but "
                    "cannot be read as one");
      return image;
    }



  } // namespace



  // The first row of a picture is its top, v = 1. Without interpolation: an
  // edge between bonded and not is as sharp as it was drawn.
  double
  GreyImage::at(const double u, const double v) const
  {
    const auto pixel = [](const double t, const unsigned int n) {
      return static_cast<unsigned int>(std::clamp(t * n, 0., n - 1.));
    };
    return levels[static_cast<std::size_t>(pixel(1. - v, height)) * width +
                  pixel(u, width)];
  }



  GreyImage
  GreyImage::threshold_at(const double threshold) const
  {
    GreyImage result = *this;
    // as float, so that a threshold that is a grey level is not exceeded by it
    for (float &level : result.levels)
      level = level > static_cast<float>(threshold) ? 1.f : 0.f;
    return result;
  }



  GreyImage
  GreyImage::reduced_to(const unsigned int side) const
  {
    const unsigned int n = (std::max(width, height) + side - 1) / side;
    if (n <= 1)
      return *this;
    // blocks of equal size in the picture, not in pixels
    using Levels =
      Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    GreyImage result{(width + n - 1) / n, (height + n - 1) / n, {}};
    result.levels.resize(std::size_t(result.width) * result.height);
    const Levels rows = means(height, result.height) *
                        Eigen::Map<const Levels>(levels.data(), height, width);
    Eigen::Map<Levels>(result.levels.data(), result.height, result.width) =
      rows * means(width, result.width).transpose();
    return result;
  }



  // Formats that lose, such as JPEG, blur the very edges that matter; others
  // can be converted to PNG without loss.
  GreyImage
  read_grey_image(const std::string &filename,
                  const std::string &entry,
                  const unsigned int white)
  {
    const ImageFile   file{filename, entry, white};
    const std::string bytes = read_input_bytes(
      filename, [&file](const std::string &why) { file.refuse(why); }, 500);
    if (bytes.compare(0, 4, "\x89PNG") != 0)
      file.refuse("this is no PNG file: convert the picture");
    return read_png(file, bytes);
  }
} // namespace Debond
