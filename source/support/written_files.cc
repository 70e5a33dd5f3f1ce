#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
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



    /** Whether what was written into a file, or the names in a directory, could
     *  be put on the disk; else errno says why not. */
    bool
    is_on_disk(const std::string &filename)
    {
      const int descriptor = open(filename.c_str(), O_RDONLY | O_CLOEXEC);
      if (descriptor < 0)
        return false;
      const int reason = fsync(descriptor) == 0 ? 0 : errno;
      close(descriptor);
      errno = reason;
      return reason == 0;
    }
  } // namespace



  std::optional<std::string>
  read_whole_file(const std::string &filename)
  {
    Classic<std::ifstream> file(filename, std::ios::binary);
    if (!file && (errno == ENOENT || errno == ENOTDIR))
      return std::nullopt;
    if (!file)
      throw InputError("cannot read '" + filename +
                       "': " + std::strerror(errno));
    Classic<std::ostringstream> bytes;
    bytes << file.rdbuf();
    return bytes.str();
  }



  void
  write_file(const std::string &filename,
             const std::string &text,
             const Durability   durability)
  {
    if (Ranks::is_first())
      write_own_file(filename, text, durability);
  }



  void
  write_own_file(const std::string &filename,
                 const std::string &text,
                 const Durability   durability)
  {
    const std::string      temporary = filename + partial;
    const bool             on_disk   = durability == Durability::on_disk;
    Classic<std::ofstream> file(temporary, std::ios::binary);
    file << text;
    file.close();
    if (!file || (on_disk && !is_on_disk(temporary)) ||
        std::rename(temporary.c_str(), filename.c_str()) != 0)
      {
        const int reason = errno;
        unlink(temporary.c_str()); // what there is of it is of no use
        errno = reason;
        fail(filename);
      }
    const auto parent = std::filesystem::path(filename).parent_path();
    // some file systems cannot do that with a directory
    if (on_disk && !is_on_disk(parent.empty() ? "." : parent.string()) &&
        errno != EINVAL && errno != ENOTSUP)
      fail(filename);
  }



  void
  remove_file(const std::string &filename)
  {
    if (!Ranks::is_first())
      return;
    for (const std::string &name : {filename, filename + partial})
      if (unlink(name.c_str()) != 0 && errno != ENOENT)
        fail(filename);
  }



  void
  put_on_disk(const std::string &filename)
  {
    if (Ranks::is_first() && !is_on_disk(filename))
      fail(filename);
  }



  void
  append_to_file(const std::string &filename, const std::string &text)
  {
    if (!Ranks::is_first())
      return;
    std::error_code ignored;
    const auto      before = std::filesystem::file_size(filename, ignored);
    Classic<std::ofstream> file(filename, std::ios::binary | std::ios::app);
    file << text;
    file.close();
    if (file)
      return;
    const int reason = errno;
    // no part of a text may stay; if this fails as well, it does
    std::filesystem::resize_file(filename, before, ignored);
    errno = reason;
    fail(filename);
  }



  DirectoryLock
  lock_directory(const std::string &directory)
  {
    if (!Ranks::is_first())
      return nullptr;
    // two descriptors of one process would exclude each other
    static std::mutex                                                  mutex;
    static std::map<std::pair<dev_t, ino_t>, std::weak_ptr<const int>> locks;
    const std::lock_guard<std::mutex> guard(mutex);

    const int descriptor =
      open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
      return nullptr;
    const DirectoryLock lock(new int(descriptor), [](const int *const locked) {
      close(*locked);
      delete locked;
    });
    struct stat         identity;
    if (fstat(descriptor, &identity) != 0)
      return nullptr;
    auto &known = locks[{identity.st_dev, identity.st_ino}];
    if (auto own = known.lock())
      return own;
    int result = 0;
    do
      result = flock(descriptor, LOCK_EX | LOCK_NB);
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
