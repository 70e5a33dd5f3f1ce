#ifndef debond_support_written_files_h
#define debond_support_written_files_h

#include <string>

namespace Debond
{
  /** on_disk: a loss of power does not undo it either. */
  enum class Durability
  {
    in_system,
    on_disk
  };

  /** Writes a whole file or leaves what was there before: the text goes to a
   *  temporary file that then takes the place of @p filename. Throws
   *  WriteError. */
  void
  write_file(const std::string &filename,
             const std::string &text,
             Durability         durability = Durability::in_system);

  /** Removes a file if there is one, and what a write_file() that was killed
   * may have left of it. Throws WriteError. */
  void
  remove_file(const std::string &filename);

  /** Waits until a file that has been written is on the disk. Throws
   *  WriteError. */
  void
  put_on_disk(const std::string &filename);

  /** A file that grows by whole texts. */
  class GrowingFile
  {
  public:
    /** Begins the file anew with this text. Throws WriteError. */
    GrowingFile(const std::string &filename, const std::string &text);
    ~GrowingFile();
    GrowingFile(const GrowingFile &) = delete;
    GrowingFile &
    operator=(const GrowingFile &) = delete;

    /** Appends all of @p text, which is then with the system, or nothing:
     *  throws WriteError. */
    void
    append(const std::string &text);

    /** Nothing more is to come. Throws WriteError if the system says only now
     *  that it could not write all. */
    void
    finish();

  private:
    const std::string filename;
    int               descriptor = -1;
  };
} // namespace Debond
#endif
