// Fuzz target: pictures. The check sums of PNG files, which no
// mutation keeps, are put right first.

#include <debond/interface/bonding_source.h>

#include <boost/crc.hpp>

#include "fuzz_target.h"

namespace
{
  std::size_t
  big_endian(const std::string &bytes, const std::size_t position)
  {
    std::size_t number = 0;
    for (std::size_t i = position; i < position + 4; ++i)
      number = 256 * number + static_cast<unsigned char>(bytes[i]);
    return number;
  }



  std::string
  with_right_sums(std::string bytes)
  {
    const std::size_t around = 12;
    for (std::size_t position = 8; position + around <= bytes.size();)
      {
        const std::size_t length = big_endian(bytes, position);
        if (length > bytes.size() - position - around)
          break;
        boost::crc_32_type sum;
        sum.process_bytes(bytes.data() + position + 4, length + 4);
        for (unsigned int i = 0; i < 4; ++i)
          bytes[position + 8 + length + i] =
            static_cast<char>(sum.checksum() >> (24 - 8 * i));
        position += length + around;
      }
    return bytes;
  }



  /** Large pictures are right but take long. */
  bool
  is_small(const std::string &bytes)
  {
    return bytes.size() < 24 || bytes[1] != 'P' ||
           big_endian(bytes, 16) * big_endian(bytes, 20) < 1000000;
  }
} // namespace



extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  std::string bytes(reinterpret_cast<const char *>(data), size);
  if (bytes.compare(0, 4, "\x89PNG") == 0)
    bytes = with_right_sums(bytes);
  if (!is_small(bytes))
    return 0;
  const FileInMemory file(bytes);
  must_read_or_refuse([&file]() {
    const auto image = Debond::read_grey_image(file.name(), "File");
    if (image.levels.size() != std::size_t(image.width) * image.height)
      std::abort();
    for (const float level : image.levels)
      if (!(level >= 0.f && level <= 1.f))
        std::abort();
    image.reduced_to(16).threshold_at(0.5);
  });
  return 0;
}
