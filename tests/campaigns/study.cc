// A study: its variants, how entries vary together and how many at once, one
// that fails, what is skipped when it is run again, repetitions and their
// medians, and the comparison of its curves; and that the foundation model with
// the stiffness of the bodies is close to them.

#include <debond/campaigns/study.h>
#include <debond/input/parameter_loop.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>
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
  return with_overrides(read_scene_text(text, "study"), more);
}



void
print_variants(const std::string &text, const unsigned int factors_at_once = 0)
{
  std::cout << text << std::endl;
  if (factors_at_once > 0)
    std::cout << "  at most " << factors_at_once
              << " factors differ from their first value" << std::endl;
  try
    {
      for (const StudyVariant &variant :
           study_variants(entries(text), factors_at_once))
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
          if (items.peek() == '"') // a text with commas in it
            {
              std::getline(items.ignore(), item, '"');
              items.ignore();
            }
          else
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
  subsection Press
    set Control = force
    set Value   = 51.88 * min(t, 1)
  end
  subsection Rotation z
    set Value = 10 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1 , 100
end
subsection Output
  set Fields every = 100
  set Directory    = results/study
end
)";



/** wall_seconds of a summary. */
double
seconds_in(const std::string &filename)
{
  std::ostringstream text;
  text << std::ifstream(filename).rdbuf();
  const std::string name = "\"wall_seconds\": ";
  return std::atof(text.str().c_str() + text.str().find(name) + name.size());
}



// Every variant is run three times; seconds are the middle ones. A repetition
// that is missing is made up for, and no other.
void
check_repetitions()
{
  const auto study_entries =
    entries(scene_text,
            {"Model=foundation",
             "Interface/Friction coefficient broken={{0.3|0.4}}",
             "Study/Repetitions=3",
             "Output/Directory=results/repetitions"});
  std::filesystem::remove_all("results/repetitions");
  std::ostringstream log;
  run_study(study_entries, "study", 2, false, log);
  const std::string place = "results/repetitions/variant-002/";
  const auto        file  = [&](const unsigned int number) {
    return place + "repetition-" + std::to_string(number) + ".json";
  };
  report("three repetitions are kept",
         std::filesystem::exists(file(3)) && !std::filesystem::exists(file(4)));

  const auto check_median = [&] {
    std::vector<double> seconds;
    for (unsigned int i = 1; i <= 3; ++i)
      seconds.push_back(seconds_in(file(i)));
    std::sort(seconds.begin(), seconds.end());
    auto table = read_study("results/repetitions/study.csv");
    report("seconds are medians",
           std::abs(std::atof(table["wall_seconds"][1].c_str()) - seconds[1]) <
             1e-9 * seconds[1]);
  };
  check_median();

  std::filesystem::remove(file(3));
  const auto first  = std::filesystem::last_write_time(file(1));
  const auto others = std::filesystem::last_write_time(
    "results/repetitions/variant-001/summary.json");
  run_study(study_entries, "study", 2, false, log);
  report("a missing repetition is made up for",
         std::filesystem::exists(file(3)));
  report("and no other run is made",
         first == std::filesystem::last_write_time(file(1)) &&
           others == std::filesystem::last_write_time(
                       "results/repetitions/variant-001/summary.json"));
  check_median();
  auto table = read_study("results/repetitions/study.csv");
  report("set-up and stepping are not more than the whole",
         std::atof(table["seconds_before_steps"][0].c_str()) > 0 &&
           std::atof(table["seconds_stepping"][0].c_str()) > 0 &&
           std::atof(table["seconds_before_steps"][0].c_str()) <
             std::atof(table["wall_seconds"][0].c_str()));
}



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
  print_variants("set A = {{1..3}}\nset B = {{m: -1..0|5}}\n"
                 "set C = {{m: x|y|z}}");
  print_variants("set A = f{{8..10}}.csv\nset B = {{p||q||../r}}");
  print_variants("set A = {{4..4}}");
  print_variants("set A = {{5..1}}");
  print_variants("set A = {{1..2.5}}");
  print_variants("set A = {{1...5}}");
  print_variants("set A = {{1..}}");
  print_variants("set A = {{0..100000}}");
  print_variants("set A = {{1..1000}}\nset B = {{1..101}}");
  const std::string four =
    "set A = {{1|2|3}}\nset B = {{m: x|y}}\nset C = {{m: p|q}}\n"
    "set D = {{u|v}}";
  print_variants(four, 1);
  print_variants(four, 2);
  report("as many factors as there are give all combinations",
         study_variants(entries(four), 3).size() ==
           study_variants(entries(four)).size());
  print_variants("set A = {{1|2}}\nset B = {{x||y}}", 1);
  check_repetitions();

  const auto study_entries = entries(scene_text,
                                     {"Model={{finite elements|foundation}}",
                                      "Chuck/Rotation x/Value={{0|1e-3 * t}}",
                                      "Study/Reference variant=1"});
  std::filesystem::remove_all("results/study");
  std::ostringstream log;
  try
    {
      run_study(study_entries, "study", 2, false, log);
    }
  catch (const RunError &error)
    {
      std::cout << error.what() << std::endl;
    }
  auto table = read_study("results/study/study.csv");
  for (const std::string column :
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
  const std::string &place = table["bone_tension_at_mm"][0];
  report("a list of numbers stands in one field",
         std::count(place.begin(), place.end(), ';') == 2);
  report("a variant has its own directory",
         std::filesystem::exists("results/study/variant-003/torque.csv"));

  // run again: finished variants are left alone, failed ones tried again
  const auto last_change = [] {
    return std::filesystem::last_write_time(
      "results/study/variant-001/summary.json");
  };
  const auto before = last_change();
  log.str("");
  try
    {
      run_study(study_entries, "study", 2, false, log);
    }
  catch (const RunError &)
    {}
  report("finished variants are skipped", before == last_change());
  std::cout << log.str().substr(0, log.str().find('\n')) << std::endl;
  log.str("");
  try
    {
      run_study(entries(scene_text, {"Model={{foundation|finite elements}}"}),
                "study",
                1,
                false,
                log);
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
