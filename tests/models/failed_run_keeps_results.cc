// A run that cannot be finished stops with an error that says where; the rows
// before are on the disk and summary.json says that it did not converge and
// why. Here the implant is pushed aside with more than friction can bear.

#include <algorithm>
#include <fstream>
#include <sstream>

#include "driven_scene.h"

const char *const scene_text = R"(
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Translation x
    set Control = force
    set Value   = 60 * max(t - 1, 0)
  end
  subsection Rotation z
    set Value = 0.01 * max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 10
end
subsection Output
  set Directory    = results
  set Fields every = 1
end
subsection Expert
  subsection Output
    set Console = quiet
  end
end
)";

bool
contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}



std::string
contents_of(const std::string &filename)
{
  std::ostringstream text;
  text << std::ifstream(filename).rdbuf();
  return text.str();
}



void
check_message(const std::string &message)
{
  report("the error names the step", contains(message, "Step 7 of 11"));
  // friction bears 0.58 x 51.88 N = 30.09 N, which is reached at 1.5015
  report("the time, up to which friction bears the load",
         contains(message, "time 1.501"));
  report("the angle", contains(message, "angle 0.0050"));
  report("where the residual is largest",
         contains(message, "in the chuck's Translation x"));
}



void
check_torque_curve(const std::vector<Debond::TorqueRow> &rows)
{
  std::istringstream text(contents_of("results/torque.csv"));
  std::string        names, line;
  std::getline(text, names);
  std::size_t n_lines  = 0;
  bool        complete = true;
  while (std::getline(text, line))
    {
      ++n_lines;
      complete = complete && std::count(line.begin(), line.end(), ',') ==
                               std::count(names.begin(), names.end(), ',');
    }
  report("rows of the six steps before and of the first time",
         rows.size() == 7 && n_lines == 7);
  report("each row is complete", complete);
  report("the last one holds the load of its time",
         std::abs(rows.back().chuck_reaction[0] - 30) < 1e-6);
}



void
test()
{
  Debond::Scene scene                  = coin_scene(scene_text);
  scene.output.overwrite_other_results = true;
  Debond::DebondingProblem problem(scene);
  try
    {
      problem.run();
      report("the run fails", false);
    }
  catch (const Debond::RunError &error)
    {
      check_message(error.what());
      check_torque_curve(problem.rows);
      const std::string summary = contents_of("results/summary.json");
      report("the summary says that it did not converge",
             contains(summary, "\"converged\": false"));
      report("and why", contains(summary, error.what()));
      report("and ends as it should",
             contains(summary.substr(summary.size() - 3), "}"));
      const std::string series = contents_of("results/interface.pvd");
      report("the fields of the last good step are listed",
             contains(series, "timestep=\"1.5\"") &&
               contains(series, "</VTKFile>"));
    }
}



int
main()
{
  return run_test(test);
}
