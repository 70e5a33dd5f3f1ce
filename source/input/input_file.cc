#include <debond/input/input_file.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace Debond
{
  namespace
  {
    /** A scene's file that is not here may be where the program was installed
     *  with its scenes. */
    std::string
    installed_instead(const std::string &filename)
    {
      std::error_code             none;
      const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe", none);
      const std::string scenes =
        (program.parent_path().parent_path() / "share/debond/prm").string();
      return filename.rfind("prm/", 0) == 0 &&
                 std::filesystem::exists(scenes + filename.substr(3), none) ?
               "; it is in " + scenes + ": `ln -s " + scenes +
                 "' makes prm here" :
               "";
    }
  } // namespace



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
    if (!file && errno == ENOENT)
      refuse("this file cannot be read: No such file or directory" +
             installed_instead(filename));
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
  plain_text(const std::string &bytes, const FileRefusal &refuse)
  {
    const auto begins_with = [&bytes](const char *const mark) {
      return bytes.compare(0, std::strlen(mark), mark) == 0;
    };
    if (begins_with("\xFF\xFE") || begins_with("\xFE\xFF"))
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
} // namespace Debond
