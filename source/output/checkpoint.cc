#include <debond/output/checkpoint.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>

#include <boost/crc.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

namespace Debond
{
  const std::array<const char *, 2> CheckpointFiles::names{
    {"checkpoint-1", "checkpoint-2"}};



  namespace
  {
    const std::string first_line = "debond checkpoint\n";



    /** The second line of a file that continues with @p text. */
    std::string
    crc_line(const std::string &text, const std::size_t begin = 0)
    {
      boost::crc_32_type crc;
      crc.process_bytes(text.data() + begin, text.size() - begin);
      char line[32];
      std::snprintf(line,
                    sizeof(line),
                    "CRC-32 %08lx\n",
                    static_cast<unsigned long>(crc.checksum()));
      return line;
    }



    std::string
    text_of(const Checkpoint &checkpoint)
    {
      std::ostringstream header;
      header << "format " << CheckpointFiles::format << "\nprogram "
             << DEBOND_VERSION << "\nstep " << checkpoint.step
             << "\nparameters " << checkpoint.parameters.size() << "\nstate "
             << checkpoint.state.size() << '\n';
      const std::string text =
        header.str() + checkpoint.parameters + checkpoint.state;
      return first_line + crc_line(text) + text;
    }



    /** What a file says of itself, and where the rest begins. */
    struct FileContent
    {
      std::string  text;
      std::string  format, program;
      unsigned int step         = 0;
      std::size_t  n_parameters = 0, n_state = 0;
      std::size_t  begin             = 0;
      bool         has_known_members = false;
    };



    /** Nothing if there is no such file. Throws InputError if it cannot be
     *  read. */
    std::optional<std::string>
    bytes_of(const std::string &filename)
    {
      std::ifstream file(filename, std::ios::binary);
      if (!file && errno == ENOENT)
        return std::nullopt;
      if (!file)
        throw InputError("cannot read '" + filename +
                         "': " + std::strerror(errno));
      std::ostringstream bytes;
      bytes << file.rdbuf();
      return bytes.str();
    }



    /** Nothing if these bytes of a file are damaged. */
    std::optional<FileContent>
    read(const std::string &bytes)
    {
      FileContent content;
      content.text = bytes;
      // all CRC lines are equally long
      const std::size_t begin = first_line.size() + crc_line("").size();
      if (content.text.size() < begin ||
          content.text.compare(0,
                               begin,
                               first_line + crc_line(content.text, begin)) != 0)
        return std::nullopt;
      std::istringstream lines(content.text.substr(begin, 1000));
      std::string        word;
      lines >> word >> content.format >> word >> content.program;
      if (content.format != std::to_string(CheckpointFiles::format))
        return content;
      lines >> word >> content.step >> word >> content.n_parameters >> word >>
        content.n_state;
      content.begin             = begin + std::size_t(lines.tellg()) + 1;
      content.has_known_members = true;
      return content;
    }
  } // namespace



  CheckpointFiles::CheckpointFiles(const ResultDirectory &directory)
  {
    for (unsigned int i = 0; i < 2; ++i)
      files[i] = directory.file(names[i]);
  }



  void
  CheckpointFiles::write(const Checkpoint &checkpoint)
  {
    write_file(files[next], text_of(checkpoint), Durability::on_disk);
    next = 1 - next;
  }



  std::optional<Checkpoint>
  CheckpointFiles::newest(std::vector<std::string> &remarks)
  {
    std::optional<FileContent> newest;
    for (unsigned int i = 0; i < 2; ++i)
      {
        const auto bytes = bytes_of(files[i]);
        if (!bytes)
          continue;
        auto content = read(*bytes);
        if (!content)
          remarks.push_back("'" + files[i] + "' is damaged");
        else if (!newest || content->step >= newest->step)
          {
            newest = std::move(content);
            next   = 1 - i;
          }
      }
    if (!newest)
      return std::nullopt;
    if (!newest->has_known_members || newest->program != DEBOND_VERSION)
      throw OtherProgram("'" + files[1 - next] + "' was written by debond " +
                         newest->program + ", format " + newest->format +
                         ", and this is debond " DEBOND_VERSION ", format " +
                         std::to_string(format) +
                         ": only the same program can go on with the run");
    return Checkpoint{newest->step,
                      newest->text.substr(newest->begin, newest->n_parameters),
                      newest->text.substr(newest->begin + newest->n_parameters,
                                          newest->n_state)};
  }



  void
  CheckpointFiles::remove() const
  {
    for (const std::string &file : files)
      remove_file(file);
  }
} // namespace Debond
