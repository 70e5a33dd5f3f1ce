// The memory that a run takes at its peak is within a factor of two of the
// estimate made before anything is built, without what the program takes by
// itself: a flat mesh, the same with a machine whose stiffness makes the
// coupled system a dense matrix, and a thick mesh. The measured peak is that of
// the process, so each case needs more than the one before.

#include <debond/support/runtime.h>
#include <debond/system/memory_estimate.h>

#include <sys/resource.h>

#include "driven_scene.h"
#include "pressed_and_turned.h"

const std::string scene_text = R"(
subsection Bone
  set Material = linear
end
subsection Implant
  set Material = linear
end
)" + pressed_then("Rotation z", "0.05 * max(t - 1, 0)") +
                               R"(
subsection Load steps
  set Steps = 1, 1
end
subsection Output
  set Fields every = none
end
)";



void
compare(const std::string              &what,
        const std::vector<std::string> &overrides,
        const double                    before_MB)
{
  run_scene("memory_estimate", scene_text, overrides);
  const double measured = Debond::peak_memory_MB() - before_MB;
  const auto   estimate = [](const std::vector<std::string> &overrides) {
    const auto scene = coin_scene(scene_text, overrides);
    return 1e3 *
           Debond::MemoryEstimate(scene, scene.bulk_solver(), false).total;
  };
  const double estimated =
    estimate(overrides) -
    estimate({"Bone/Material=rigid", "Implant/Material=rigid"});
  report(what + ": factor between estimate and peak",
         std::max(measured / estimated, estimated / measured),
         2.);
}



// A limit that leaves a gigabyte more than what is taken already.
void
check_limit()
{
  const double taken = Debond::peak_memory_MB();
  rlimit       limit{};
  getrlimit(RLIMIT_AS, &limit);
  const double before = Debond::available_memory_MB();
  limit.rlim_cur      = 8000000000;
  setrlimit(RLIMIT_AS, &limit);
  const double within = Debond::available_memory_MB();
  report("there is some memory", before > 0.);
  report("a limit of 8000 MB leaves less than that, as some is taken",
         taken > 0. && within < 8000. && within <= before + 1000.);
  const auto large =
    coin_scene(scene_text, {"Bone/Cells=200, 200, 20", "Implant/Cells=60, 20"});
  const auto is_refused = [&](const bool has_bodies) {
    try
      {
        Debond::require_memory(large, false, has_bodies);
        return false;
      }
    catch (const Debond::NotEnoughMemory &)
      {
        return true;
      }
  };
  report("a scene that needs more is refused", is_refused(false));
  report("not if its bodies are there already", !is_refused(true));
}



void
test()
{
  // what the program itself takes, with the smallest bodies
  run_scene("memory_estimate",
            scene_text,
            {"Bone/Material=rigid", "Implant/Material=rigid"});
  const double before_MB = Debond::peak_memory_MB();
  compare("lattice solver",
          {"Bone/Element=spline",
           "Bone/Cells=100, 100, 8",
           "Implant/Cells=4, 2"},
          before_MB);
  compare("flat mesh",
          {"Bone/Cells=60, 60, 2", "Implant/Cells=12, 2"},
          before_MB);
  compare("the same with a compliant machine",
          {"Bone/Cells=60, 60, 2",
           "Implant/Cells=12, 2",
           "Chuck/Rotation z/Stiffness=3000"},
          before_MB);
  compare("thick mesh",
          {"Bone/Cells=34, 34, 16", "Implant/Cells=10, 10"},
          before_MB);
  check_limit();
}



int
main()
{
  return run_test(test);
}
