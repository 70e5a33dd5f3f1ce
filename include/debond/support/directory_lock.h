#ifndef debond_support_directory_lock_h
#define debond_support_directory_lock_h

#include <memory>
#include <string>

namespace Debond
{
  /** Keeps other processes out of a directory of results as long as it lives.
   *  Children of the process inherit it, programs that it starts do not; it
   * ends with the last of them, however they end. */
  class DirectoryLock
  {
  public:
    /** The lock of this process on @p directory: one that it has already, or a
     *  new one. None where there is no such directory or the file system knows
     *  no locks. Throws InputError if another process has it. */
    static std::shared_ptr<const DirectoryLock>
    take(const std::string &directory);

    /** Takes over an open descriptor that has the lock. */
    explicit DirectoryLock(int descriptor);
    ~DirectoryLock();
    DirectoryLock(const DirectoryLock &) = delete;
    DirectoryLock &
    operator=(const DirectoryLock &) = delete;

  private:
    const int descriptor;
  };
} // namespace Debond
#endif
