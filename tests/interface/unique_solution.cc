// A law that softens faster than the interface is stiff has no unique
// solution, and the run refuses it: with rigid bodies, p = eps_n d, where
//   p / (eps_t + eta / dt) > 4 a_s b_s / (pi phi_0 (mu_ub - mu_b)),
// dt being the step's duration. Viscosity makes steps unique that are short
// enough. What was computed before stays.

#include <fstream>
#include <sstream>

#include "driven_scene.h"

const char *const scene_text = R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
end
subsection Interface
  set Characteristic slip distance = 0.001
  set Transition factor = 0.5
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * t
  end
  subsection Rotation z
    set Value = 2 * max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 10, 40
end
)";

// 585 MPa/mm * 0.0049 mm = 2.8665 MPa at t = 1, twice that at t = 2
const double slope  = M_PI * 0.18 / (4 * 0.001 * 0.5); // 282.7 / mm
const double needed = slope * 585 * 0.0049;            // 810.5 MPa/mm at t = 1

struct Outcome
{
  std::vector<Debond::TorqueRow> rows;
  std::string                    why;
  std::string                    summary;
};

Outcome
run(const std::vector<std::string> &overrides)
{
  Outcome       outcome;
  Debond::Scene scene       = Debond::Scene::from_text(scene_text, overrides);
  scene.output.directory    = "results/unique_solution";
  scene.output.fields_every = 0;
  scene.output.quiet        = true;
  scene.output.overwrite_other_results = true;
  Debond::DebondingProblem problem(scene);
  try
    {
      problem.run();
    }
  catch (const Debond::RunError &error)
    {
      outcome.why = error.what();
    }
  outcome.rows = problem.rows;
  std::ostringstream text;
  text << std::ifstream("results/unique_solution/summary.json").rdbuf();
  outcome.summary = text.str();
  return outcome;
}

bool
contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}



void
test()
{
  const auto stiffness = [](const double eps_t) {
    return "Interface/Tangential stiffness=" + std::to_string(eps_t);
  };
  const auto viscosity = [](const double eta) {
    return "Interface/Viscosity=" + std::to_string(eta);
  };

  std::cout << "Too soft" << std::endl;
  // the pressure grows with t: eps_t = 0.65 needed is too soft after t = 0.65
  const Outcome soft = run({stiffness(0.65 * needed)});
  report("  refused in the step from 0.6 to 0.7",
         contains(soft.why, "Step 7, after time 0.6:") &&
           soft.rows.size() == 7);
  report("  with the reason", contains(soft.why, "not unique"));
  report("  with its numbers",
         contains(soft.why, "p = 2.00655 MPa") &&
           contains(soft.why, "by up to 567.3") &&
           contains(soft.why, ", 526.8"));
  report("  and what helps", contains(soft.why, "Interface / Viscosity"));
  report("  the summary says so",
         contains(soft.summary, "\"converged\": false") &&
           contains(soft.summary, "not unique"));

  std::cout << "Just stiff enough, and not quite" << std::endl;
  report("  1.001 times the bound runs to the end",
         run({stiffness(2.001 * needed)}).rows.size() == 51);
  report("  0.999 times the bound is refused in the last step",
         run({stiffness(1.999 * needed)}).rows.size() == 50);

  std::cout << "Viscosity" << std::endl;
  // steps of 0.1 and 0.025; at t = 1 the long ones need most
  const double  missing = 0.35 * needed;
  const Outcome enough =
    run({stiffness(0.65 * needed), viscosity(1.001 * missing * 0.1)});
  report("  enough: the steps as planned",
         enough.rows.size() == 51 && contains(enough.summary, "\"steps\": 50"));
  const Outcome cut =
    run({stiffness(0.65 * needed), viscosity(0.999 * missing * 0.1)});
  report("  not quite: the step to t = 1 is halved",
         cut.rows.size() == 51 && contains(cut.summary, "\"steps\": 51"));

  std::cout << "Where uniqueness is no matter" << std::endl;
  for (const char *override : {"Interface/Friction law=coulomb",
                               "Expert/Friction update=explicit",
                               "Interface/Friction starts at=2",
                               "Interface/Bonding/Bonding degree=0"})
    report(std::string("  ") + override,
           run({stiffness(0.65 * needed), override}).rows.size() == 51);
}



int
main()
{
  return run_test(test);
}
