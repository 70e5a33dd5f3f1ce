// A study: its variants, how entries vary together, one that fails, what is
// skipped when it is run again, and the comparison of its curves; and that the
// foundation model with the stiffness of the bodies is close to them.

#include <debond/input_error.h>
#include <debond/study.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include "checks.h"
#include "driven_scene.h"

using namespace Debond;

std::vector<SceneEntry>
entries(const std::string &text, const std::vector<std::string> &more = {})
{
  std::vector<SceneEntry> result = read_scene_text(text, "study");
  for (const std::string &entry : more)
    set_entry(result, read_override(entry));
  return result;
}



void
print_variants(const std::string &text)
{
  std::cout << text << std::endl;
  try
    {
      for (const StudyVariant &variant : study_variants(entries(text)))
        {
          std::cout << " ";
          for (const std::string &value : variant.values)
            std::cout << " [" << value << "]";
          std::cout << std::endl;
        }
    }
  catch (const InputError &error)
    {
      std::cout << "  " << error.what() << std::endl;
    }
}



/** study.csv by column; fields without commas. */
std::map<std::string, std::vector<std::string>>
read_study(const std::string &filename)
{
  std::ifstream                                   file(filename);
  std::string                                     line, item;
  std::vector<std::string>                        columns;
  std::map<std::string, std::vector<std::string>> table;
  std::getline(file, line);
  for (std::istringstream items(line); std::getline(items, item, ',');)
    columns.push_back(item);
  while (std::getline(file, line))
    {
      std::istringstream items(line);
      for (const std::string &column : columns)
        {
          std::getline(items, item, ',');
          table[column].push_back(item);
        }
    }
  return table;
}



const char *const scene_text = R"(
subsection Bone
  set Material = linear
end
subsection Implant
  set Material = linear
end
subsection Chuck
  subsection Translation z
    set Control = force
    set Value   = -51.88 * min(t, 1)
  end
  subsection Rotation z
    set Value = 10 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1 , 100
end
subsection Output
  set Fields every = 0
  set Directory    = results/study
end
)";



void
test()
{
  print_variants("set A = {{1|2}}\nset B = {{x|y|z}}");
  print_variants("set A = {{1||2||3}}\nset B = f{{x||y||z}}.csv");
  print_variants("set A = {{1|2}}\nset B = {{x||y}}");
  print_variants("set A = {{m: 1|2}}\nset B = {{x|y}}\nset C = {{m: 3|4}}");
  print_variants("set A = {{1|2}}\nset B = {{x||y||z}}");
  print_variants("set A = {{m: 1|2}}\nset B = {{m: x|y|z}}");
  print_variants("set A = {{1|2");
  print_variants("set A = {{1|2}} {{3|4}}");

  const auto study_entries = entries(scene_text,
                                     {"Model={{finite elements|foundation}}",
                                      "Chuck/Rotation x/Value={{0|1e-3 * t}}",
                                      "Study/Reference variant=1"});
  std::filesystem::remove_all("results/study");
  Study              study(study_entries, "study");
  std::ostringstream log;
  try
    {
      study.run(2, false, log);
    }
  catch (const RunError &error)
    {
      std::cout << error.what() << std::endl;
    }
  auto table = read_study("results/study/study.csv");
  for (const std::string &column :
       {"variant", "Model", "converged", "dofs", "T_max_Nmm"})
    if (column != "T_max_Nmm")
      {
        std::cout << column << ":";
        for (const std::string &value : table[column])
          std::cout << " [" << value << "]";
        std::cout << std::endl;
      }
  std::cout << "reason of variant 4: " << table["reason"][3] << std::endl;
  report("difference of the reference from itself",
         std::atof(table["difference_max"][0].c_str()),
         1e-15);
  report("foundation against finite elements, largest difference of torque",
         std::atof(table["difference_max"][1].c_str()),
         0.01);
  report("a variant has its own directory",
         std::filesystem::exists("results/study/variant-003/torque.csv"));

  // run again: finished variants are left alone, failed ones tried again
  const auto last_change = [] {
    return std::filesystem::last_write_time(
      "results/study/variant-001/summary.json");
  };
  const auto before = last_change();
  log.str("");
  study = Study(study_entries, "study");
  try
    {
      study.run(2, false, log);
    }
  catch (const RunError &)
    {}
  report("finished variants are skipped", before == last_change());
  std::cout << log.str().substr(0, log.str().find('\n')) << std::endl;
  log.str("");
  try
    {
      Study(entries(scene_text, {"Model={{foundation|finite elements}}"}),
            "study")
        .run(1, false, log);
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}



int
main()
{
  return run_test(&test);
}
