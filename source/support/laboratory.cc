#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/laboratory.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace Debond
{
  namespace Laboratory
  {
    const char *const what_it_needs =
      "it needs Python 3 (apt install python3-jinja2 python3-scipy)";

    namespace
    {
      /** The package is where Python looks for it, or beside this program, in
       *  the build or below the same prefix, or where it was built. */
      void
      say_where_the_package_is()
      {
        namespace fs = std::filesystem;
        std::error_code none;
        const fs::path  here = fs::read_symlink("/proc/self/exe", none);
        const std::array<fs::path, 3> places{
          {here.parent_path() / "python",
           here.parent_path().parent_path() / "lib/python3/dist-packages",
           DEBOND_BUILT_PACKAGE}};
        for (const fs::path &place : places)
          if (fs::exists(place / "debond/__main__.py", none))
            {
              const char *const before = std::getenv("PYTHONPATH");
              setenv("PYTHONPATH",
                     ((before != nullptr ? std::string(before) + ":" : "") +
                      place.string())
                       .c_str(),
                     1);
              return;
            }
      }



      /** Words of a command line, as the system calls want them. */
      struct CommandLine
      {
        CommandLine(const std::string              &command,
                    const std::vector<std::string> &words)
          : texts{python(), "-m", "debond", command}
        {
          texts.insert(texts.end(), words.begin(), words.end());
          for (std::string &text : texts)
            pointers.push_back(text.data());
          pointers.push_back(nullptr);
        }

        CommandLine(const CommandLine &) = delete; ///< it points into itself

        /** That for which the module was built, if it is there. */
        static std::string
        python()
        {
          return access(DEBOND_PYTHON, X_OK) == 0 ? DEBOND_PYTHON : "python3";
        }

        std::vector<std::string> texts;
        std::vector<char *>      pointers;
      };
    } // namespace



    void
    become(const std::string &command, const std::vector<std::string> &words)
    {
      std::cout << std::flush;
      say_where_the_package_is();
      ignore_again_what_was_ignored();
      CommandLine line(command, words);
      execvp(line.pointers[0], line.pointers.data());
      throw InputError("debond: this is done in Python: " +
                       std::string(what_it_needs));
    }



    int
    run(const std::string              &command,
        const std::vector<std::string> &words,
        std::string *const              output)
    {
      std::cout << std::flush;
      say_where_the_package_is();
      const CommandLine          line(command, words);
      std::array<int, 2>         pipe_ends{};
      posix_spawn_file_actions_t actions;
      if (output != nullptr && pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
        return 127;
      posix_spawn_file_actions_init(&actions);
      if (output != nullptr)
        posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
      pid_t     child = 0;
      const int error = posix_spawnp(&child,
                                     line.pointers[0],
                                     &actions,
                                     nullptr,
                                     line.pointers.data(),
                                     environ);
      posix_spawn_file_actions_destroy(&actions);
      if (output != nullptr)
        {
          close(pipe_ends[1]);
          std::array<char, 65536> part{};
          for (ssize_t n = 1; n > 0 || (n < 0 && errno == EINTR);)
            {
              n = read(pipe_ends[0], part.data(), part.size());
              output->append(part.data(), std::max<ssize_t>(n, 0));
            }
          close(pipe_ends[0]);
        }
      if (error != 0)
        return 127;
      int status = 0;
      while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
  } // namespace Laboratory
} // namespace Debond
