// Runs scenes after a program has set its locale, as one that uses the library
// may do: in_locale LOCALE SCENE.prm... What is said goes to said.txt.

#include <debond/campaigns/run_scene.h>
#include <debond/output/result_files.h>
#include <debond/scene/scene.h>
#include <debond/support/runtime.h>

#include <fstream>
#include <iostream>
#include <locale>
#include <sstream>

using namespace Debond;

namespace
{
  void
  run(const std::string &scene_file, std::ostream &said)
  {
    const Scene scene = Scene::from_file(scene_file);
    run_scene(scene, nullptr, &said); // the plan
    print_parameters(said, &scene);
    run_scene(scene);
    write_page(scene.output.directory);
  }
} // namespace



int
main(const int argc, const char *const argv[])
{
  std::locale::global(std::locale(argv[1])); // and setlocale()
  std::cout.imbue(std::locale());
  std::ostringstream number;
  number << 1234.5;
  std::cout << number.str() << '\n';

  set_up_libraries();
  std::ofstream said("said.txt");
  for (int i = 2; i < argc; ++i)
    run(argv[i], said);
}
