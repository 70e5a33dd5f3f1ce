#pragma once


#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Debond
{
  class ResultDirectory;

  /** A run after one of its rows. */
  struct Checkpoint
  {
    unsigned int step = 0;   ///< of the last row
    std::string  parameters; ///< completed parameters of the scene
    std::string  state;      ///< an archive, see serialization.h
    std::string  format = "", program = ""; ///< versions of what wrote it

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &step &parameters &state;
    }
  };

  /**
   * The files checkpoint-1 and checkpoint-2 of a result directory, written in
   * turn, so that there is a whole one at any moment. A file appears under its
   * name only when all of it is on the disk.
   *
   * Its first lines are text: `debond checkpoint`, the CRC-32 of everything
   * after that line, version of the format, version of the program.
   * An archive follows.
   */
  class CheckpointFiles
  {
  public:
    /** To be raised when the state of any class has other members. */
    static constexpr unsigned int format = 14;

    explicit CheckpointFiles(const ResultDirectory &directory);

    /** Replaces the older one. Throws WriteError. */
    void
    write(const Checkpoint &checkpoint);

    /** The newest checkpoint that is whole; none if there is none. @p remarks
     *  gets a line for each file that is damaged. Throws InputError if a file
     *  cannot be read, ForeignCheckpoint if it is one of another version of the
     *  program. */
    std::optional<Checkpoint>
    newest(std::vector<std::string> &remarks);

    /** Removes both. Throws WriteError. */
    void
    remove() const;
    /** Leaves the one that was written last. Throws WriteError. */
    void
    remove_older() const;

  private:
    std::array<std::string, 2> files;
    unsigned int               next = 0; ///< to be written
  };
} // namespace Debond
