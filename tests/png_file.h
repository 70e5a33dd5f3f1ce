#pragma once

#include <png.h>

#include <string>
#include <vector>

/** Bytes of a PNG file with rows of @p width pixels of one, two, three or four
 *  channels of 8 or 16 bits: grey or red, green and blue, then opacity. Not
 *  compressed, so that they are the same with all versions of zlib. */
inline std::string
png_file(const unsigned int               width,
         const std::vector<unsigned int> &levels,
         const int                        bits       = 8,
         const unsigned int               n_channels = 1)
{
  const int   types[]{0,
                      PNG_COLOR_TYPE_GRAY,
                      PNG_COLOR_TYPE_GRAY_ALPHA,
                      PNG_COLOR_TYPE_RGB,
                      PNG_COLOR_TYPE_RGB_ALPHA};
  std::string bytes;
  png_structp png =
    png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
    png,
    &bytes,
    [](png_structp png, png_bytep data, const png_size_t size) {
      static_cast<std::string *>(png_get_io_ptr(png))
        ->append(reinterpret_cast<const char *>(data), size);
    },
    nullptr);
  png_set_compression_level(png, 0);
  png_set_IHDR(png,
               info,
               width,
               levels.size() / (n_channels * width),
               bits,
               types[n_channels],
               PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (std::size_t i = 0; i < levels.size(); i += n_channels * width)
    {
      std::vector<png_byte> row;
      for (std::size_t j = i; j < i + n_channels * width; ++j)
        {
          if (bits == 16)
            row.push_back(static_cast<png_byte>(levels[j] >> 8));
          row.push_back(static_cast<png_byte>(levels[j] & 255));
        }
      png_write_row(png, row.data());
    }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}
