#include <debond/input/input_file.h>
#include <debond/interface/bonding_source.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/crc.hpp>
#include <boost/endian/conversion.hpp>

#include <png.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <locale>

namespace Debond
{
  namespace
  {
    /** For each of @p n_fine pixels the one or two of @p n_coarse that it lies
     *  in, and the share of the area of those that it makes up. */
    std::vector<std::vector<std::pair<unsigned int, double>>>
    overlaps(const unsigned int n_fine, const unsigned int n_coarse)
    {
      std::vector<std::vector<std::pair<unsigned int, double>>> result(n_fine);
      const double size = double(n_fine) / n_coarse; // of a coarse pixel
      for (unsigned int i = 0; i < n_fine; ++i)
        for (auto k = static_cast<unsigned int>(i / size);
             k < n_coarse && k * size < i + 1;
             ++k)
          result[i].emplace_back(k,
                                 (std::min((k + 1) * size, i + 1.) -
                                  std::max(k * size, double(i))) /
                                   size);
      return result;
    }
  } // namespace



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
    // Blocks of equal size in the picture, not in pixels: a pixel on the border
    // of two belongs to both in parts.
    GreyImage result;
    result.width                = (width + n - 1) / n;
    result.height               = (height + n - 1) / n;
    const auto          columns = overlaps(width, result.width);
    const auto          rows    = overlaps(height, result.height);
    std::vector<double> sums(std::size_t(result.width) * result.height);
    for (unsigned int j = 0; j < height; ++j)
      for (unsigned int i = 0; i < width; ++i)
        for (const auto &[row, row_share] : rows[j])
          for (const auto &[column, column_share] : columns[i])
            sums[std::size_t(row) * result.width + column] +=
              row_share * column_share * levels[std::size_t(j) * width + i];
    result.levels.assign(sums.begin(), sums.end());
    return result;
  }



  namespace
  {
    using boost::endian::load_big_u16;
    using boost::endian::load_big_u32;

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

      /** The level that counts as 1, where the file has room for levels up to
       *  @p own and has none above @p largest. Cameras write 10, 12 or 14 bits
       *  into files of 16, and masks are 0 and 1: nearly black, which may not
       *  be meant, unless @p is_told by the file. */
      unsigned int
      white_level(const unsigned int own,
                  const unsigned int largest,
                  const bool         is_told = false) const
      {
        const auto so_many = [&](const std::string &limit) {
          return "the levels of this picture go up to " +
                 std::to_string(largest) + limit;
        };
        if (white > 0 && largest > white)
          refuse(so_many(": expected White level = ") + std::to_string(white) +
                 " at most");
        const bool is_dark =
          largest == 1 ? own >= 255 : own == 65535 && largest < 1 << 14;
        if (white > 0 || largest == 0 || !is_dark || is_told)
          return white > 0 ? white : own;
        unsigned int bits = 1;
        while (largest >> bits != 0)
          ++bits;
        refuse(so_many(" of ") + std::to_string(own) + ", as if they had " +
               std::to_string(bits) + (bits == 1 ? " bit" : " bits") +
               ": which one is white? Set White level = " +
               std::to_string((1 << bits) - 1) + ", or " + std::to_string(own) +
               " if the picture is that dark");
      }
    };



    const unsigned char *
    bytes_at(const std::string &bytes, const std::size_t position)
    {
      return reinterpret_cast<const unsigned char *>(bytes.data()) + position;
    }



    /** A PNG file with those chunks only that make up the picture, their sums
     *  checked: others, such as those about colours, change no grey level.
     *  @p bits: how many of each channel are significant, 0 if it does not say.
     */
    std::string
    essence_of_png(const ImageFile   &file,
                   const std::string &bytes,
                   unsigned int      &bits)
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
          if (type == "sBIT" && length > 0)
            bits = std::min<unsigned int>(16, *bytes_at(bytes, position + 8));
          for (const char *const wanted :
               {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"})
            if (type == wanted)
              result += bytes.substr(position, length + around);
          position += length + around;
        }
      return result;
    }



    /** The level that counts as 1 of @p channels, of which @p n make a pixel.
     * @p bits: of 16 so many are significant; 0: the file does not say. */
    template <typename Channel>
    unsigned int
    white_level(const std::vector<Channel> &channels,
                const unsigned int          n,
                const unsigned int          bits,
                const ImageFile            &file)
    {
      constexpr unsigned int most    = std::numeric_limits<Channel>::max();
      unsigned int           largest = 0, together = 0;
      for (std::size_t i = 0; i < channels.size(); ++i)
        if (i % n < (n < 3 ? 1 : 3)) // no opacity
          {
            largest = std::max<unsigned int>(largest, channels[i]);
            together |= channels[i];
          }
      if (sizeof(Channel) == 1 || bits == 0)
        return file.white_level(most, largest);
      // By the standard significant bits stand at the high end. Where there are
      // none, and the low end has some, they stand there.
      const bool are_high = bits == 16 || largest >> bits != 0,
                 are_low  = !are_high && (together & (most >> bits)) != 0;
      return file.white_level(are_low ? (1U << bits) - 1 : most,
                              largest,
                              are_high || are_low);
    }



    /** The levels of pixels with one or more channels: grey or red, green and
     *  blue, then opacity if their number is even; what is transparent is
     *  black. False if libpng cannot read what
     *  png_image_begin_read_from_memory() has found. */
    template <typename Channel>
    bool
    read_levels(png_image          &png,
                const unsigned int  bits,
                const ImageFile    &file,
                std::vector<float> &levels)
    {
      std::vector<Channel> channels(PNG_IMAGE_SIZE(png) / sizeof(Channel));
      if (png_image_finish_read(&png, nullptr, channels.data(), 0, nullptr) ==
          0)
        return false;
      constexpr double   most  = std::numeric_limits<Channel>::max();
      const unsigned int n     = PNG_IMAGE_PIXEL_CHANNELS(png.format);
      const double       white = white_level(channels, n, bits, file);
      // libpng has multiplied channels of 16 bits by the opacity already
      const bool multiply = n % 2 == 0 && sizeof(Channel) == 1;
      for (auto pixel = channels.cbegin(); pixel != channels.cend(); pixel += n)
        {
          const double level =
            (n < 3 ?
               pixel[0] :
               (30. * pixel[0] + 59. * pixel[1] + 11. * pixel[2]) / 100.) /
            white;
          levels.push_back(multiply ? level * pixel[n - 1] / most : level);
        }
      return true;
    }



    // libpng takes levels of 16 bits for linear in the intensity and others for
    // sRGB: those that are asked for in the same way stay as they are.
    // Boost.GIL reads beyond the end of rows with fewer than 8 bits for a
    // pixel.
    GreyImage
    read_png(const ImageFile &file, const std::string &bytes)
    {
      unsigned int      bits    = 0;
      const std::string essence = essence_of_png(file, bytes, bits);
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
                           read_levels<png_uint_16>(png, bits, file, image.levels) :
                           read_levels<png_byte>(png, bits, file, image.levels);
        }
      if (!is_read)
        file.refuse("this file is damaged: it begins like a PNG file but "
                    "cannot be read as one");
      return image;
    }



    /** The numbers in the header of a PGM file, or all of a plain one. */
    struct PgmNumbers
    {
      const ImageFile   &file;
      const std::string &bytes;
      std::size_t        position = 2; ///< after P2 or P5

      /** Passes over blanks, and over comments from # to the end of the line.
       *  Returns whether nothing else is left. */
      bool
      at_end()
      {
        while (position < bytes.size() &&
               (std::isspace(bytes[position], std::locale::classic()) ||
                bytes[position] == '#'))
          position = bytes[position] == '#' ?
                       std::min(bytes.find('\n', position), bytes.size()) :
                       position + 1;
        return position == bytes.size();
      }

      /** The next number, at most @p largest. */
      unsigned int
      next(const std::string &what, const unsigned int largest)
      {
        at_end();
        unsigned int      value = 0;
        const char *const first = bytes.data() + position;
        const auto [behind, error] =
          std::from_chars(first, bytes.data() + bytes.size(), value);
        if (error == std::errc::invalid_argument)
          file.refuse("this PGM file is damaged or cut off: " + what +
                      " is missing or no number");
        if (error == std::errc::result_out_of_range || value > largest)
          file.refuse(what + " is more than " + std::to_string(largest));
        position += behind - first;
        return value;
      }
    };



    // Boost.GIL reads PGM, but up to 8 bits only, does not scale levels
    // to the largest one, inverts those whose largest is 1, and takes a plain
    // file that is cut off for a whole one.
    GreyImage
    read_pgm(const ImageFile &file, const std::string &bytes)
    {
      PgmNumbers numbers{file, bytes};
      GreyImage  image;
      image.width  = numbers.next("the width", 1000000);
      image.height = numbers.next("the height", 1000000);
      file.check_size(image.width, image.height);
      const unsigned int largest = numbers.next("the largest level", 65535);
      if (largest == 0)
        file.refuse("the largest level of this PGM file is 0: expected 1 to "
                    "65535");

      const std::size_t n     = std::size_t(image.width) * image.height;
      const bool        plain = bytes[1] == '2';
      const std::size_t size  = largest > 255 ? 2 : 1; // bytes of a pixel
      std::size_t       begin = numbers.position + 1;  // after a white space
      // one white space ends the header, but some write a carriage return more
      if (!plain && bytes.size() == begin + n * size + 1 &&
          bytes.compare(begin - 1, 2, "\r\n") == 0)
        ++begin;
      if (bytes.size() < (plain ? n : begin + n * size))
        file.refuse("this PGM file is cut off: it has fewer pixels than its "
                    "header says");
      for (std::size_t i = 0; i < n; ++i)
        {
          const unsigned int level =
            plain     ? numbers.next("a level", largest) :
            size == 1 ? *bytes_at(bytes, begin + i) :
                        load_big_u16(bytes_at(bytes, begin + 2 * i));
          if (level > largest)
            file.refuse("a level of this PGM file is more than its largest, " +
                        std::to_string(largest));
          image.levels.push_back(static_cast<float>(level));
        }
      if (plain ? !numbers.at_end() : bytes.size() > begin + n * size)
        file.refuse("this PGM file has more pixels than its header says");
      const auto white = static_cast<float>(file.white_level(
        largest, *std::max_element(image.levels.begin(), image.levels.end())));
      for (float &level : image.levels)
        level /= white;
      return image;
    }
  } // namespace



  GreyImage
  read_grey_image(const std::string &filename,
                  const std::string &entry,
                  const unsigned int white)
  {
    const ImageFile   file{filename, entry, white};
    const std::string bytes = read_input_bytes(
      filename, [&file](const std::string &why) { file.refuse(why); }, 500);
    if (bytes.compare(0, 4, "\x89PNG") == 0)
      return read_png(file, bytes);
    if (bytes.compare(0, 2, "P2") == 0 || bytes.compare(0, 2, "P5") == 0)
      return read_pgm(file, bytes);
    file.refuse("this is neither a PNG nor a PGM file");
  }
} // namespace Debond
