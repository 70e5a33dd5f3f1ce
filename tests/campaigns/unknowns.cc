// Unknowns in the entries of a scene: which there are, what entries become for
// values of them, which experiments share them; and what is refused.

#include <debond/campaigns/unknowns.h>
#include <debond/support/input_error.h>

#include <iostream>

using namespace Debond;

void
print(const std::string &text)
{
  std::cout << "---\n" << text;
  try
    {
      const auto experiments = study_variants(read_scene_text(text, "scene"));
      const Unknowns unknowns(experiments);
      for (const Unknown &u : unknowns.list)
        std::cout << "unknown " << u.name << " from " << u.start << " in "
                  << u.lower << ".." << u.upper << (u.logarithmic ? " log" : "")
                  << '\n';
      Eigen::VectorXd values = unknowns.starts();
      for (Eigen::Index j = 0; j < values.size(); ++j)
        values[j] = unknowns.list[j].upper;
      for (unsigned int i = 0; i < experiments.size(); ++i)
        for (const SceneEntry &entry : unknowns.varied_entries(i, values))
          std::cout << "experiment " << i + 1 << ": " << entry.full_name()
                    << " = " << entry.value << '\n';
    }
  catch (const InputError &error)
    {
      std::cout << "refused: " << error.what() << '\n';
    }
}



int
main()
{
  print("set A = <<0.5 in 0.1..2>>\n");
  print(
    "set A = <<0.5 in 0.1..2 log>>\nset B = -<< 1e-3 in -1e-2..1e-2 >> * t\n");
  print("set A = <<mu: 0.4 in 0.1..0.5>>\nset B = <<1.5 * mu>>\n"
        "set C = -<<-mu>> + <<mu>>\n");
  // experiments share what has a name or one value; else each has its own
  print("set A = <<1 in 0..2>>\nset B = {{<<1 in 0..2>>||<<3 in 2..4>>}}\n"
        "set C = {{<<k: 1 in 0..5>>||<<2 * k>>}}\n");
  for (const char *const mistake : {"<<0.5>",
                                    "<<0.5>>",
                                    "<<a>>",
                                    "<<0.5 in 1..2>>",
                                    "<<0.5 in 2..1>>",
                                    "<<0.5 in 0..1 log>>",
                                    "<<0.5 in 0..x>>",
                                    "<<x in 0..1>>",
                                    "<<0.5 in 0,1>>",
                                    "<<1a: 0.5 in 0..1>>",
                                    "<<a: 0.5 in 0..1>> <<a: 0.5 in 0..2>>",
                                    "<<a: 0.5 in 0..1>> <<b>>",
                                    "<<a: 0.5 in 0..1>> <<1 / (a - a)>>"})
    print(std::string("set A = ") + mistake + "\n");
}
