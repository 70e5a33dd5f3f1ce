// A directory with results of another scene is only used when this is wanted;
// JSON files keep their order, escape text and know no infinities.

#include <debond/input_error.h>
#include <debond/result_files.h>

#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>

namespace
{
  void
  open(const std::string &path, const std::string &parameters, const bool force)
  {
    Debond::OutputParameters output;
    output.directory               = path;
    output.overwrite_other_results = force;
    try
      {
        const Debond::ResultDirectory directory(output, parameters);
        std::ostringstream            text;
        text << std::ifstream(directory.file("parameters.prm")).rdbuf();
        std::cout << directory.path() << ": " << text.str() << '\n';
      }
    catch (const Debond::InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }
} // namespace



int
main()
{
  open("results/a/", "one scene", true);
  open("results/a", "one scene", false);
  open("results/a", "another scene", false);
  open("results/a", "another scene", true);
  open("results/a/parameters.prm", "a file is no directory", false);

  Debond::JsonObject object;
  object.add("text", "quote \", backslash \\, tab \t");
  object.add("third", 1. / 3);
  object.add("undefined", std::numeric_limits<double>::quiet_NaN());
  object.add("infinite", std::numeric_limits<double>::infinity());
  object.add("steps", 1000U);
  object.add("converged", true);
  object.add("warnings", std::vector<std::string>{"first", "second"});
  object.add("none", std::vector<std::string>{});
  std::cout << object.text();
}
