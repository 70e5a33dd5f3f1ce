#include <debond/input/input_file.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/replace.hpp>
#include <boost/crc.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <vector>

namespace Debond
{
  std::string
  read_input_bytes(const std::string &filename,
                   const FileRefusal &refuse,
                   const unsigned int largest_MB)
  {
    std::error_code unknown;
    if (std::filesystem::is_directory(filename, unknown))
      refuse("this is a directory");
    const auto refuse_file = [&refuse]() {
      refuse(std::string("this file cannot be read: ") + std::strerror(errno));
    };
    Classic<std::ifstream> file(filename, std::ios::binary);
    if (!file)
      refuse_file();

    // some have no end, and no size that could be asked for
    const std::size_t largest = std::size_t(largest_MB) * 1000000;
    std::string       bytes, part(1 << 20, '\0');
    while (file)
      {
        file.read(&part[0], part.size());
        bytes.append(part, 0, file.gcount());
        if (bytes.size() > largest)
          refuse("this file has more than " + std::to_string(largest_MB) +
                 " MB");
      }
    if (file.bad())
      refuse_file();
    return bytes;
  }



  std::string
  identity_of(const std::string &filename)
  {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(filename, ignored))
      return ""; // or without an end
    // CRC-64/XZ
    boost::crc_optimal<64,
                       0x42F0E1EBA9EA3693ULL,
                       ~std::uint64_t(0),
                       ~std::uint64_t(0),
                       true,
                       true>
                           crc;
    Classic<std::ifstream> file(filename, std::ios::binary);
    std::vector<char>      part(1 << 20);
    std::uint64_t          size = 0;
    while (file)
      {
        file.read(part.data(), part.size());
        crc.process_bytes(part.data(), file.gcount());
        size += file.gcount();
      }
    Classic<std::ostringstream> text;
    text << "# " << filename << ": " << size << " bytes, CRC-64 " << std::hex
         << std::setw(16) << std::setfill('0') << crc.checksum() << "\n";
    return text.str();
  }



  std::string
  plain_text(const std::string &bytes, const FileRefusal &refuse)
  {
    const auto begins_with = [&bytes](const char *const mark) {
      return bytes.compare(0, std::strlen(mark), mark) == 0;
    };
    // the mark, or two letters of it
    const bool is_utf_16 =
      begins_with("\xFF\xFE") || begins_with("\xFE\xFF") ||
      (bytes.size() >= 4 &&
       ((bytes[0] != 0 && bytes[1] == 0 && bytes[2] != 0 && bytes[3] == 0) ||
        (bytes[0] == 0 && bytes[1] != 0 && bytes[2] == 0 && bytes[3] != 0)));
    if (is_utf_16)
      refuse("this text is in UTF-16: save it as UTF-8");
    const auto is_binary = [](const char c) {
      const auto code = static_cast<unsigned char>(c);
      return code == 127 ||
             (code < 32 && c != '\n' && c != '\r' && c != '\t' && c != '\f');
    };
    if (std::any_of(bytes.begin(), bytes.end(), is_binary))
      refuse("this is not a text file");

    std::string text = bytes.substr(begins_with("\xEF\xBB\xBF") ? 3 : 0);
    boost::replace_all(text, "\r\n", "\n");
    std::replace(text.begin(), text.end(), '\r', '\n');
    return text;
  }



  std::string
  utf8(const std::string &text)
  {
    const auto continues = [&](const std::size_t i) {
      return i < text.size() && (text[i] & 0xC0) == 0x80;
    };
    bool        is_utf8 = true;
    std::string from_latin_1;
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        const auto code = static_cast<unsigned char>(text[i]);
        is_utf8 =
          is_utf8 && (code < 0x80 || (code >= 0xC2 && continues(i + 1)) ||
                      (continues(i) && i > 0 && (text[i - 1] & 0x80)));
        if (code < 0x80)
          from_latin_1 += text[i];
        else
          {
            from_latin_1 += static_cast<char>(0xC0 | (code >> 6));
            from_latin_1 += static_cast<char>(0x80 | (code & 0x3F));
          }
      }
    return is_utf8 ? text : from_latin_1;
  }
} // namespace Debond
