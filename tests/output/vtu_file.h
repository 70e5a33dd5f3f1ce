#pragma once

// What tests read of VTU files as deal.II writes them.

#include <deal.II/base/utilities.h>

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

/** The text of a file. */
inline std::string
contents(const std::string &filename)
{
  std::ostringstream text;
  text << std::ifstream(filename, std::ios::binary).rdbuf();
  return text.str();
}



/** Values of an array of a VTU file, or its points if @p name is empty: one
 *  compressed block after a header of four numbers. */
template <typename Number = float>
std::vector<Number>
read_array(const std::string &vtu, const std::string &name)
{
  const std::string key   = name.empty() ? "<Points>" : "Name=\"" + name + "\"";
  const auto        found = vtu.find(key);
  if (found == std::string::npos)
    return {};
  const auto array  = vtu.find("format=\"binary\"", found);
  const auto begin  = vtu.find_first_not_of(" \n", vtu.find('>', array) + 1);
  const auto end    = vtu.find_first_of(" \n<", begin);
  const auto header = dealii::Utilities::decode_base64(vtu.substr(begin, 24));
  const auto data =
    dealii::Utilities::decode_base64(vtu.substr(begin + 24, end - begin - 24));
  std::uint32_t sizes[4];
  std::memcpy(sizes, header.data(), sizeof(sizes));
  std::vector<Number> values(sizes[1] / sizeof(Number));
  uLongf              n_bytes = sizes[1];
  const int status = uncompress(reinterpret_cast<Bytef *>(values.data()),
                                &n_bytes,
                                data.data(),
                                sizes[3]);
  return status == Z_OK ? values : std::vector<Number>();
}
