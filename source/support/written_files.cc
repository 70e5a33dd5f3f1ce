#include <debond/support/run_error.h>
#include <debond/support/written_files.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

namespace Debond
{
  namespace
  {
    /** Ends the names of files that are being written. */
    const std::string partial = ".partial";



    [[noreturn]] void
    fail(const std::string &filename)
    {
      throw WriteError("cannot write '" + filename +
                       "': " + std::strerror(errno));
    }



    /** Closes a file at the end of its scope, if not before. */
    struct OpenFile
    {
      OpenFile(const std::string &filename, const int flags)
        : descriptor(open(filename.c_str(), flags | O_CLOEXEC, 0666))
      {}
      ~OpenFile()
      {
        if (descriptor >= 0)
          close(descriptor);
      }
      /** False if that fails, which may be how a network's file system says
       * that the disk is full. */
      bool
      is_closed()
      {
        return close(std::exchange(descriptor, -1)) == 0;
      }
      int descriptor;
    };



    /** False if not all of it can be written; errno says why. */
    bool
    write_all(const int descriptor, const std::string &text)
    {
      const char *next = text.data();
      for (std::size_t left = text.size(); left > 0;)
        {
          const ssize_t written = write(descriptor, next, left);
          if (written < 0 && errno != EINTR)
            return false;
          if (written > 0)
            {
              next += written;
              left -= written;
            }
        }
      return true;
    }



    void
    put_directory_on_disk(const std::string &filename)
    {
      const auto     parent = std::filesystem::path(filename).parent_path();
      const OpenFile directory(parent.empty() ? "." : parent.string(),
                               O_RDONLY | O_DIRECTORY);
      // some file systems cannot do that with a directory
      if (directory.descriptor < 0 || (fsync(directory.descriptor) != 0 &&
                                       errno != EINVAL && errno != ENOTSUP))
        fail(filename);
    }
  } // namespace



  void
  write_file(const std::string &filename,
             const std::string &text,
             const Durability   durability)
  {
    const std::string temporary = filename + partial;
    const bool        on_disk   = durability == Durability::on_disk;
    bool              written   = false;
    {
      OpenFile file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
      written = file.descriptor >= 0 && write_all(file.descriptor, text) &&
                (!on_disk || fsync(file.descriptor) == 0) && file.is_closed();
    }
    if (!written || std::rename(temporary.c_str(), filename.c_str()) != 0)
      {
        const int reason = errno;
        unlink(temporary.c_str()); // what there is of it is of no use
        errno = reason;
        fail(filename);
      }
    if (on_disk)
      put_directory_on_disk(filename);
  }



  void
  remove_file(const std::string &filename)
  {
    for (const std::string &name : {filename, filename + partial})
      if (unlink(name.c_str()) != 0 && errno != ENOENT)
        fail(filename);
  }



  void
  put_on_disk(const std::string &filename)
  {
    const OpenFile file(filename, O_RDONLY);
    if (file.descriptor < 0 || fsync(file.descriptor) != 0)
      fail(filename);
  }



  GrowingFile::GrowingFile(const std::string &filename, const std::string &text)
    : filename(filename)
  {
    write_file(filename, text);
    descriptor = open(filename.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor < 0)
      fail(filename);
  }



  GrowingFile::~GrowingFile()
  {
    if (descriptor >= 0)
      close(descriptor);
  }



  void
  GrowingFile::finish()
  {
    if (close(std::exchange(descriptor, -1)) != 0)
      fail(filename);
  }



  void
  GrowingFile::append(const std::string &text)
  {
    struct stat before;
    if (fstat(descriptor, &before) == 0 && write_all(descriptor, text))
      return;
    const int reason = errno;
    // no part of a text may stay; if this fails as well, it does
    const int ignored = ftruncate(descriptor, before.st_size);
    static_cast<void>(ignored);
    errno = reason;
    fail(filename);
  }
} // namespace Debond
