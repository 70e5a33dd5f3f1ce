#pragma once

// What tests of interrupted runs share: files that are compared byte for byte.

#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

/** The text of a file without lines that differ from run to run. */
inline std::string
contents_of(const std::filesystem::path &file)
{
  std::ifstream stream(file, std::ios::binary);
  std::string   text;
  for (std::string line; std::getline(stream, line);)
    if (line.find("seconds") == std::string::npos &&
        line.find("peak_memory_MB") == std::string::npos &&
        line.find("\"date\"") == std::string::npos &&
        line.find("# Written by") == std::string::npos &&
        line.find("\"command\"") == std::string::npos &&
        line.find("set Directory") == std::string::npos)
      text += line + (stream.eof() ? "" : "\n");
  return text;
}



/** Whether two directories hold the same results, but for checkpoints; says
 *  what differs. */
inline bool
same_files(const std::string &directory, const std::string &other)
{
  namespace fs             = std::filesystem;
  const auto is_checkpoint = [](const fs::path &name) {
    return name.string().rfind("checkpoint-", 0) == 0;
  };
  bool same = fs::exists(directory + "/torque.csv");
  for (const auto &entry : fs::directory_iterator(directory))
    {
      const auto name = entry.path().filename();
      if (!is_checkpoint(name) &&
          (!fs::exists(other / name) ||
           contents_of(entry.path()) != contents_of(other / name)))
        {
          std::cout << "  differs: " << name.string() << std::endl;
          same = false;
        }
    }
  for (const auto &entry : fs::directory_iterator(other))
    if (const auto name = entry.path().filename();
        !is_checkpoint(name) && !fs::exists(directory / name))
      {
        std::cout << "  too much: " << name.string() << std::endl;
        same = false;
      }
  return same;
}
