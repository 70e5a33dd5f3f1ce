#include <debond/support/input_error.h>
#include <debond/support/written_files.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
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



  std::optional<std::string>
  read_whole_file(const std::string &filename)
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
                (!on_disk || fsync(file.descriptor) == 0) && file.close();
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



  OpenFile::OpenFile(const std::string &filename, const int flags)
    : descriptor(open(filename.c_str(), flags | O_CLOEXEC, 0666))
  {}



  OpenFile::~OpenFile()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }



  bool
  OpenFile::close()
  {
    return ::close(std::exchange(descriptor, -1)) == 0;
  }



  GrowingFile::GrowingFile(const std::string &filename, const std::string &text)
    : filename(filename)
  {
    write_file(filename, text);
    file.emplace(filename, O_WRONLY | O_APPEND);
    if (file->descriptor < 0)
      fail(filename);
  }



  void
  GrowingFile::finish()
  {
    if (!file->close())
      fail(filename);
  }



  void
  GrowingFile::append(const std::string &text)
  {
    struct stat before;
    if (fstat(file->descriptor, &before) == 0 &&
        write_all(file->descriptor, text))
      return;
    const int reason = errno;
    // no part of a text may stay; if this fails as well, it does
    const int ignored = ftruncate(file->descriptor, before.st_size);
    static_cast<void>(ignored);
    errno = reason;
    fail(filename);
  }



  DirectoryLock
  lock_directory(const std::string &directory)
  {
    // two descriptors of one process would exclude each other
    static std::mutex mutex;
    static std::map<std::pair<dev_t, ino_t>, std::weak_ptr<const OpenFile>>
                                      locks;
    const std::lock_guard<std::mutex> guard(mutex);

    const auto lock =
      std::make_shared<const OpenFile>(directory, O_RDONLY | O_DIRECTORY);
    struct stat identity;
    if (fstat(lock->descriptor, &identity) != 0)
      return nullptr;
    auto &known = locks[{identity.st_dev, identity.st_ino}];
    if (auto own = known.lock())
      return own;
    int result = 0;
    do
      result = flock(lock->descriptor, LOCK_EX | LOCK_NB);
    while (result != 0 && errno == EINTR);
    if (result != 0 && errno == EWOULDBLOCK)
      throw InputError("another run of debond is at work in " + directory +
                       ": wait for it, or choose another Output / Directory");
    if (result != 0)
      return nullptr;
    known = lock;
    return lock;
  }

} // namespace Debond
