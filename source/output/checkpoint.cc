#include <debond/output/checkpoint.h>
#include <debond/output/result_files.h>
#include <debond/support/number_text.h>
#include <debond/support/serialization.h>
#include <debond/support/written_files.h>

#include <boost/crc.hpp>

#include <iomanip>
#include <sstream>

namespace Debond
{
  namespace
  {
    const std::string first_line = "debond checkpoint\n";



    /** The second line of a file that continues with @p text. */
    std::string
    crc_line(const std::string &text)
    {
      boost::crc_32_type crc;
      crc.process_bytes(text.data(), text.size());
      Classic<std::ostringstream> line;
      line << "CRC-32 " << std::hex << std::setw(8) << std::setfill('0')
           << crc.checksum() << '\n';
      return line.str();
    }



    std::string
    text_of(Checkpoint checkpoint)
    {
      std::string text = "format " + std::to_string(CheckpointFiles::format) +
                         "\nprogram " DEBOND_VERSION "\n";
      SavingArchive(text) & checkpoint;
      return first_line + crc_line(text) + text;
    }



    /** Nothing if these bytes of a file are damaged; no more than the versions
     *  if they are of another format. */
    std::optional<Checkpoint>
    read(const std::string &bytes)
    {
      // all CRC lines are equally long
      const std::size_t begin = first_line.size() + crc_line("").size();
      if (bytes.size() < begin)
        return std::nullopt;
      const std::string text = bytes.substr(begin);
      if (bytes.compare(0, begin, first_line + crc_line(text)) != 0)
        return std::nullopt;
      Checkpoint                  content;
      Classic<std::istringstream> lines(text.substr(0, 1000));
      std::string                 word;
      lines >> word >> content.format >> word >> content.program;
      if (content.format == std::to_string(CheckpointFiles::format))
        {
          const std::string state = text.substr(std::size_t(lines.tellg()) + 1);
          LoadingArchive(state) & content;
        }
      return content;
    }
  } // namespace



  CheckpointFiles::CheckpointFiles(const ResultDirectory &directory)
    : files{{directory.file("checkpoint-1"), directory.file("checkpoint-2")}}
  {}



  void
  CheckpointFiles::write(const Checkpoint &checkpoint)
  {
    write_file(files[next], text_of(checkpoint), Durability::on_disk);
    next = 1 - next;
  }



  std::optional<Checkpoint>
  CheckpointFiles::newest(std::vector<std::string> &remarks)
  {
    std::optional<Checkpoint> newest;
    for (unsigned int i = 0; i < 2; ++i)
      {
        const auto bytes = read_whole_file(files[i]);
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
    if (newest && (newest->format != std::to_string(format) ||
                   newest->program != DEBOND_VERSION))
      throw ForeignCheckpoint(
        "'" + files[1 - next] + "' was written by debond " + newest->program +
        ", format " + newest->format +
        ", and this is debond " DEBOND_VERSION ", format " +
        std::to_string(format) +
        ": only the same program can go on with the run; --force begins anew");
    return newest;
  }



  void
  CheckpointFiles::remove_older() const
  {
    remove_file(files[next]);
  }



  void
  CheckpointFiles::remove() const
  {
    for (const std::string &file : files)
      remove_file(file);
  }
} // namespace Debond
