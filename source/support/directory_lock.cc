#include <debond/support/directory_lock.h>
#include <debond/support/input_error.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <mutex>
#include <utility>

namespace Debond
{
  std::shared_ptr<const DirectoryLock>
  DirectoryLock::take(const std::string &directory)
  {
    // two descriptors of one process would exclude each other
    static std::mutex mutex;
    static std::map<std::pair<dev_t, ino_t>, std::weak_ptr<const DirectoryLock>>
                                      locks;
    const std::lock_guard<std::mutex> guard(mutex);

    const int descriptor =
      open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
      return nullptr;
    auto        lock = std::make_shared<const DirectoryLock>(descriptor);
    struct stat identity;
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



  DirectoryLock::DirectoryLock(const int descriptor)
    : descriptor(descriptor)
  {}



  DirectoryLock::~DirectoryLock()
  {
    close(descriptor);
  }
} // namespace Debond
