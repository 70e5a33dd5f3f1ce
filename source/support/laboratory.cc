#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/laboratory.h>
#include <debond/support/provenance.h>

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace Debond::Laboratory
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



    /** Python, for which the module was built if it is there, and what it
     *  is to do. */
    std::vector<std::string>
    python(const std::string &command, const std::vector<std::string> &words)
    {
      const bool               is_there = access(DEBOND_PYTHON, X_OK) == 0;
      std::vector<std::string> line{is_there ? DEBOND_PYTHON : "python3",
                                    "-m",
                                    "debond",
                                    command};
      line.insert(line.end(), words.begin(), words.end());
      return line;
    }
  } // namespace



  void
  become(const std::string &command, const std::vector<std::string> &words)
  {
    std::cout << std::flush;
    say_where_the_package_is();
    ignore_again_what_was_ignored();
    std::vector<std::string> line = python(command, words);
    std::vector<char *>      pointers;
    for (std::string &word : line)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    throw InputError("debond: this is done in Python: " +
                     std::string(what_it_needs));
  }



  // A shell has codes of its own, 127 if there is no such program. What is
  // not read is not caught, and goes where this process writes.
  int
  run(const std::string              &command,
      const std::vector<std::string> &words,
      std::string *const              output)
  {
    std::cout << std::flush;
    say_where_the_package_is();
    FILE *const pipe = popen(shell_line(python(command, words)).c_str(),
                             output != nullptr ? "re" : "we");
    if (pipe == nullptr)
      return 127;
    std::array<char, 65536> part{};
    if (output != nullptr)
      while (const auto n = std::fread(part.data(), 1, part.size(), pipe))
        output->append(part.data(), n);
    const int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
} // namespace Debond::Laboratory
