#include <debond/output/earlier_results.h>
#include <debond/output/result_files.h>
#include <debond/support/directory_lock.h>
#include <debond/support/input_error.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace Debond
{
  DirectoryContent
  content_of_result_directory(const OutputParameters &output,
                              const std::string      &completed_parameters)
  {
    std::ifstream file(output.directory + "/parameters.prm", std::ios::binary);
    if (!file)
      return DirectoryContent::no_results;
    std::ostringstream existing;
    existing << file.rdbuf();
    return existing.str() == completed_parameters ?
             DirectoryContent::same_scene :
             DirectoryContent::other_scene;
  }



  ResultDirectory::ResultDirectory(const std::string &path)
    : directory(path)
  {
    while (directory.size() > 1 && directory.back() == '/')
      directory.pop_back();
    lock = DirectoryLock::take(directory);
  }



  ResultDirectory::ResultDirectory(const OutputParameters &output,
                                   const std::string      &completed_parameters)
    : ResultDirectory(output.directory)
  {
    const auto refuse = [&output](const std::string &why) {
      throw EntryError("Output / Directory", why, output.directory);
    };
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
      refuse("this directory cannot be created: " + error.message());
    if (!lock) // there was no directory yet
      lock = DirectoryLock::take(directory);

    const bool is_of_other_scene =
      content_of_result_directory(output, completed_parameters) ==
      DirectoryContent::other_scene;
    if (is_of_other_scene && !output.overwrite_other_results)
      refuse("this directory holds results of another scene (compare its "
             "parameters.prm): choose another one, or overwrite them with "
             "--force");

    try
      {
        if (is_of_other_scene) // nobody must take them for this scene's
          remove_results(directory);
        write_file(file("parameters.prm"), completed_parameters);
      }
    catch (const std::exception &reason)
      {
        refuse(reason.what());
      }
  }



  namespace
  {
    std::string
    quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char c : text)
        if (c == '"' || c == '\\')
          result += std::string("\\") + c;
        else if (c == '\n')
          result += "\\n";
        else if (c == '\t')
          result += "\\t";
        else if (static_cast<unsigned char>(c) < 32)
          {
            char code[8];
            std::snprintf(code, sizeof(code), "\\u%04x", c);
            result += code;
          }
        else
          result += c;
      return result + '"';
    }
  } // namespace



  void
  JsonObject::add(const std::string &name, const double value)
  {
    if (!std::isfinite(value))
      return add_text(name, "null");
    std::ostringstream number;
    number.precision(12);
    number << value;
    add_text(name, number.str());
  }



  void
  JsonObject::add(const std::string &name, const std::string &value)
  {
    add_text(name, quoted(value));
  }



  void
  JsonObject::add(const std::string &name, const char *const value)
  {
    add_text(name, quoted(value));
  }



  void
  JsonObject::add(const std::string              &name,
                  const std::vector<std::string> &values)
  {
    std::string list;
    for (const std::string &value : values)
      list += (list.empty() ? "" : ", ") + quoted(value);
    add_text(name, "[" + list + "]");
  }



  void
  JsonObject::add_text(const std::string &name, const std::string &json)
  {
    for (auto &[other, value] : members)
      if (other == name)
        {
          value = json;
          return;
        }
    members.emplace_back(name, json);
  }



  JsonObject
  JsonObject::from_file(const std::string &filename)
  {
    std::ifstream file(filename);
    if (!file)
      throw InputError("cannot read '" + filename +
                       "': " + std::strerror(errno));
    JsonObject  object;
    std::string line;
    while (std::getline(file, line))
      {
        // as text() writes it: "name": value, with a comma but in the last
        const std::size_t colon = line.find("\": ");
        if (line.compare(0, 3, "  \"") != 0 || colon == std::string::npos)
          continue;
        if (line.back() == ',')
          line.pop_back();
        object.add_text(line.substr(3, colon - 3), line.substr(colon + 3));
      }
    return object;
  }



  std::string
  JsonObject::value(const std::string &name) const
  {
    for (const auto &[other, value] : members)
      if (other == name)
        return value;
    return "null";
  }



  std::string
  JsonObject::text() const
  {
    std::string lines;
    for (const auto &[name, value] : members)
      lines += (lines.empty() ? "  " : ",\n  ") + quoted(name) + ": " + value;
    return "{\n" + lines + "\n}\n";
  }
} // namespace Debond
