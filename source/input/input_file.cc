#include <debond/input/input_file.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace Debond
{
  std::string
  read_input_bytes(const std::string &filename,
                   const std::string &where,
                   const unsigned int largest_MB)
  {
    std::error_code unknown;
    if (std::filesystem::is_directory(filename, unknown))
      throw InputError(where + "this is a directory");
    const auto refuse = [&where]() {
      throw InputError(where +
                       "this file cannot be read: " + std::strerror(errno));
    };
    std::ifstream file(filename, std::ios::binary);
    if (!file)
      refuse();

    // some have no end, and no size that could be asked for
    const std::size_t largest = std::size_t(largest_MB) * 1000000;
    std::string       bytes, part(1 << 20, '\0');
    while (file)
      {
        file.read(&part[0], part.size());
        bytes.append(part, 0, file.gcount());
        if (bytes.size() > largest)
          throw InputError(where + "this file has more than " +
                           std::to_string(largest_MB) + " MB");
      }
    if (file.bad())
      refuse();
    return bytes;
  }



  std::string
  read_input_text(const std::string &filename,
                  const std::string &where,
                  const unsigned int largest_MB)
  {
    return plain_text(read_input_bytes(filename, where, largest_MB), where);
  }



  std::string
  plain_text(const std::string &bytes, const std::string &where)
  {
    const auto begins_with = [&bytes](const char *const mark) {
      return bytes.compare(0, std::strlen(mark), mark) == 0;
    };
    if (begins_with("\xFF\xFE") || begins_with("\xFE\xFF"))
      throw InputError(where + "this text is in UTF-16: save it as UTF-8");
    const auto is_binary = [](const char c) {
      const auto code = static_cast<unsigned char>(c);
      return code == 127 ||
             (code < 32 && c != '\n' && c != '\r' && c != '\t' && c != '\f');
    };
    if (std::any_of(bytes.begin(), bytes.end(), is_binary))
      throw InputError(where + "this is not a text file");

    std::string text;
    text.reserve(bytes.size());
    for (std::size_t i = begins_with("\xEF\xBB\xBF") ? 3 : 0; i < bytes.size();
         ++i)
      if (bytes[i] != '\r')
        text += bytes[i];
      else if (i + 1 == bytes.size() || bytes[i + 1] != '\n')
        text += '\n';
    return text;
  }
} // namespace Debond
