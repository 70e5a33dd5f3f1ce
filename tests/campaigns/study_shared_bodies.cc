// Variants of a study that have the same bodies inherit them from the study:
// the torque curves are, digit for digit, those of variants that run alone,
// with one thread and with two; a variant that fails leaves the others alone;
// bodies that cannot be built are left to the variants; and only the last ones
// are kept.

#include <debond/campaigns/study.h>
#include <debond/campaigns/variant_queue.h>
#include <debond/system/coupled_system.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "checks.h"
#include "driven_scene.h"

using namespace Debond;

// The block of the implant's chuck tilts, so that the bone needs further
// contact unknowns in the course of the run and condenses anew.
const char *const scene_text = R"(
subsection Interface
  set Quadrature points = 3
  subsection Bonding
    set Pattern = expression
  end
end
subsection Chuck
  subsection Translation x
    set Value = 0.9 * max(t - 1, 0)
  end
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 2 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1, 6
end
subsection Output
  set Fields every = none
end
)";

const char *const expressions[] = {"0.5 + 0.1 * x", "0.5", "y > 0 ? 1 : 0"};



std::string
content(const std::string &filename)
{
  std::ostringstream text;
  text << std::ifstream(filename).rdbuf();
  return text.str();
}



struct Case
{
  std::string  material;
  unsigned int n_threads;

  std::string
  name() const
  {
    return material + "_" + std::to_string(n_threads);
  }

  std::vector<std::string>
  overrides(const std::string &expression) const
  {
    return {"Bone/Material=" + material,
            "Implant/Material=" + material,
            "Interface/Bonding/Expression=" + expression};
  }
};



// The second of three variants fails.
void
run_study(const Case &which)
{
  set_number_of_threads(which.n_threads);
  const std::string place = "results/shared_" + which.name();
  std::string       all;
  for (const std::string expression : expressions)
    all += (all.empty() ? "{{" : "|") + expression;
  std::vector<std::string> overrides = which.overrides(all + "}}");
  overrides.push_back("Output/Directory=" + place);
  std::filesystem::remove_all(place);
  std::filesystem::create_directories(place);
  std::ofstream(place + "/variant-002") << "in the way of its directory\n";
  std::ostringstream log;
  try
    {
      run_study(with_overrides(read_scene_text(scene_text, "shared"),
                               overrides),
                "shared",
                2,
                false,
                log);
    }
  catch (const RunError &error)
    {
      std::cout << error.what() << std::endl;
    }
}



void
compare_with_runs_alone(const Case &which)
{
  std::cout << which.material << ", threads: " << which.n_threads << std::endl;
  set_number_of_threads(which.n_threads);
  for (const unsigned int i : {0, 2})
    {
      const std::string variant = "results/shared_" + which.name() +
                                  "/variant-00" + std::to_string(i + 1) + "/";
      report("  bodies are inherited",
             content(variant + "summary.json").find("shared_set_up") !=
               std::string::npos);
      run_scene("alone", scene_text, which.overrides(expressions[i]));
      const std::string alone = content("results/alone/torque.csv");
      report("  a curve of eight rows",
             std::count(alone.begin(), alone.end(), '\n') == 9);
      report("  the same as alone to the last digit",
             content(variant + "torque.csv") == alone);
      report("  and alone inherits nothing",
             content("results/alone/summary.json").find("shared_set_up") ==
               std::string::npos);
    }
}



// Two groups, the second of bodies without positive stiffness, which no scene
// file can ask for.
void
check_queue()
{
  set_number_of_threads(2);
  std::vector<Scene> scenes;
  for (const char *const cells : {"15, 15, 2", "13, 13, 2", "11, 11, 1"})
    for (unsigned int i = 0; i < 2; ++i)
      scenes.push_back(
        Scene::from_text(scene_text, {std::string("Bone/Cells=") + cells}));
  for (const unsigned int i : {2, 3})
    scenes[i].bone.poisson_ratio = 0.7;
  VariantQueue queue(2);
  for (const unsigned int i : {0, 2, 4, 1, 3, 5})
    queue.add(i, scenes[i], i < 4);

  std::weak_ptr<BodyPair> first;
  while (!queue.empty())
    {
      const auto next = queue.next();
      std::cout << "variant " << next.variant
                << (next.bodies ? " has" : " has no")
                << " bodies that are built";
      if (next.variant == 0)
        first = next.bodies;
      if (next.variant == 1)
        std::cout << (next.bodies == first.lock() ? ", those of the first" :
                                                    "");
      std::cout << std::endl;
    }
  report("bodies are gone with their last variant", first.expired());
  report("the number of threads is as before",
         dealii::MultithreadInfo::n_threads() == 2);
}



const std::vector<std::string> small{"Bone/Cells=6, 6, 1",
                                     "Bone/Material=linear",
                                     "Implant/Cells=2, 1",
                                     "Implant/Material=linear",
                                     "Interface/Quadrature points=2"};

// Two variants of the scene and two with one entry changed: do all four have
// the same bodies?
bool
share_bodies(const std::string              &change,
             const std::vector<std::string> &entries = small)
{
  auto changed = entries;
  changed.push_back(change);
  const Scene scene = Scene::from_text(scene_text, entries),
              other = Scene::from_text(scene_text, changed);
  VariantQueue queue(1);
  for (unsigned int i = 0; i < 4; ++i)
    queue.add(i, i < 2 ? scene : other, true);
  std::vector<std::shared_ptr<BodyPair>> bodies; // kept: no address twice
  while (!queue.empty())
    bodies.push_back(queue.next().bodies);
  return bodies.at(0) && bodies.at(0) == bodies.at(2);
}



void
check_what_is_shared()
{
  for (const char *const change : {"Interface/Friction coefficient unbroken=1",
                                   "Interface/Normal stiffness=1000",
                                   "Interface/Bonding/Bonding degree=0.5",
                                   "Load steps/Steps=1, 7",
                                   "Output/Directory=elsewhere"})
    report(std::string("bodies are shared with ") + change,
           share_bodies(change));
  for (const char *const change : {"Bone/Young modulus=17000",
                                   "Bone/Layer grading=1.5",
                                   "Implant/Young modulus=100000",
                                   "Implant/Height=2",
                                   "Implant/Radius=2",
                                   "Implant/Cells=3, 1",
                                   "Interface/Slave=bone",
                                   "Interface/Quadrature points=3",
                                   "Chuck/Translation x/Value=0.1 + t"})
    report(std::string("bodies are not shared with ") + change,
           !share_bodies(change));

  // whether the lattice solver takes the bone depends on what moves the implant
  const std::vector<std::string> splines{"Bone/Element=spline",
                                         "Bone/Cells=16, 16, 1",
                                         "Bone/Material=linear",
                                         "Implant/Cells=2, 1",
                                         "Implant/Material=linear",
                                         "Interface/Quadrature points=4"};
  report("bones on the lattice are shared",
         share_bodies("Chuck/Rotation z/Value=t", splines));
  for (const char *const change :
       {"Chuck/Translation x/Value=3 * max(t - 1, 0)",
        "Chuck/Translation x/Control=force",
        "Load steps/Path following=slip"})
    report(std::string("but not with ") + change,
           !share_bodies(change, splines));
}



void
test()
{
  const std::vector<Case> cases = {{"linear", 1},
                                   {"linear", 2},
                                   {"neo-hookean", 1},
                                   {"neo-hookean", 2}};
  // all studies first: what runs here leaves a pool of threads behind
  for (const Case &which : cases)
    run_study(which);
  for (const Case &which : cases)
    compare_with_runs_alone(which);
  check_queue();
  check_what_is_shared();
}



int
main()
{
  return run_test(&test);
}
