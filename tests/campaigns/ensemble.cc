// The statistics of ensembles against numbers computed by hand, curves that do
// not have the same rows, and a study over seeds of which one member fails.

#include <debond/campaigns/ensemble.h>
#include <debond/campaigns/study.h>
#include <debond/input/csv_table.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "checks.h"
#include "driven_scene.h"

using namespace Debond;

void
print(const std::string &name, const SampleStatistics &s)
{
  std::cout << name << ": n " << s.n << ", mean " << s.mean << ", sd " << s.sd
            << ", p05 " << s.p05 << ", p50 " << s.p50 << ", p95 " << s.p95
            << std::endl;
}



// By hand: of 4, 1, 3, 2 the mean is 2.5, the sum of squared deviations
// 2.25 + 0.25 + 0.25 + 2.25 = 5, sd sqrt(5/3) = 1.290994; p05 lies 0.05 * 3 =
// 0.15 behind the first order statistic, 1.15, and p95 3.85.
void
check_samples()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  print("four values", sample_statistics({4, 1, 3, 2}));
  print("two that are undefined", sample_statistics({nan, 4, 1, nan, 3, 2}));
  print("one value", sample_statistics({7}));
  print("none", sample_statistics({}));
  report("equal values have no deviation",
         sample_statistics({0.1, 0.1, 0.1, 0.1, 0.1, 0.1}).sd == 0.);
}



void
print(const std::string &name, const TorqueBand &band)
{
  std::cout << name << ", left out: " << band.left_out << std::endl;
  for (const TorqueBand::Row &row : band.rows)
    print("  " + std::to_string(row.angle_deg).substr(0, 4) + " deg",
          row.torque);
}



// The first curve is 10, the second 20 times the angle, bent at 2 degrees; the
// third ends at 1.5 degrees. Pressing in makes three rows at angle 0.
void
check_band()
{
  const ReferenceCurve first{{0, -1}, {0, 0}, {1, 10}, {2, 20}, {4, 20}};
  const ReferenceCurve second{{0, 0}, {0, 3}, {0, 0}, {2, 40}, {4, 20}};
  const ReferenceCurve third{{0, 0}, {1.5, 45}};
  const ReferenceCurve back{{0, 0}, {1, 10}, {0.5, 0}};
  const ReferenceCurve still{{0, 1}, {0, 2}};
  print("three curves, one that turns back, one that stands still",
        TorqueBand({back, second, first, third, still}));
  print("turning the other way",
        TorqueBand({{{0, 0}, {-1, -10}, {-2, -12}}, {{0, 0}, {-2, -8}}}));
  print("no curve", TorqueBand({}));
}



void
check_groups()
{
  std::vector<EnsembleMember> members(4);
  const char *const           values[] = {"0.5", "a, b", "0.5", "0.5"};
  for (unsigned int i = 0; i < 4; ++i)
    {
      members[i].values    = {values[i]};
      members[i].converged = i != 2;
      members[i].summary   = {{"T_max_Nmm", 10. * (i + 1)}};
      members[i].curve     = {{0, 0}, {1, 10. * (i + 1)}};
    }
  members[1].curve.push_back({0, 0});
  const Ensemble ensemble({"Some / Entry"}, members);
  std::cout << ensemble.curves << ensemble.notes;
  std::istringstream lines(ensemble.summary);
  for (std::string line; std::getline(lines, line);)
    std::cout << line.substr(0, line.find("theta_max_mean")).substr(0, 90)
              << std::endl;
}



const char *const scene_text = R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Cells    = 6, 1
  set Material = rigid
end
subsection Interface
  set Quadrature points = 2
  subsection Bonding
    set Pattern         = random
    set Bonded fraction = {{0.5|1}}
    set Seed            = {{1..4}}
  end
end
subsection Chuck
  subsection Translation z
    set Value = -0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 10 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1, 50
end
subsection Output
  set Fields every = 0
  set Directory    = results/ensemble
end
)";



// With everything bonded the seed does not matter. Variant 3 (half bonded, seed
// 2) cannot write its results, because its directory is a file.
void
check_study()
{
  const std::string place = "results/ensemble";
  std::filesystem::remove_all(place);
  std::filesystem::create_directories(place);
  std::ofstream(place + "/variant-003") << "in the way\n";
  std::ostringstream log;
  try
    {
      run_study(
        read_scene_text(scene_text, "ensemble"), "ensemble", 2, false, log);
    }
  catch (const RunError &error)
    {
      std::cout << error.what() << std::endl;
    }
  report("progress is counted", log.str().find("\n8/8 ") != std::string::npos);

  const auto rows = read_csv_columns(place + "/ensemble_summary.csv",
                                     "test",
                                     {"Interface / Bonding / Bonded fraction",
                                      "members",
                                      "failed",
                                      "T_max_mean_Nmm",
                                      "T_max_sd_Nmm",
                                      "T_max_p95_Nmm"});
  for (const auto &row : rows)
    std::cout << "bonded fraction " << row[0] << ": " << row[1] << " members, "
              << row[2] << " failed" << std::endl;
  report("seeds make half bonded implants differ", rows[0][4] > 1e-6);
  report("and not those that are bonded everywhere", rows[1][4] == 0.);
  double mean = 0.;
  for (const char *const variant : {"001", "005", "007"})
    mean +=
      read_json(place + "/variant-" + variant + "/summary.json")["T_max_Nmm"]
        .get<double>() /
      3.;
  report("mean of T_max over those that ran, difference",
         std::abs(mean / rows[0][3] - 1.),
         1e-10);

  // all steps are the same, so the band has their rows, the last of those at
  // angle 0 among them
  const auto band = read_csv_columns(place + "/ensemble.csv",
                                     "test",
                                     {"Interface / Bonding / Bonded fraction",
                                      "angle_deg",
                                      "members",
                                      "torque_p95_Nmm"});
  std::cout << band.size() << " rows in ensemble.csv" << std::endl;
  double largest = 0.;
  for (const auto &row : band)
    if (row[0] == 1.)
      largest = std::max(largest, row[3]);
  report("largest p95 of equal curves is their T_max, difference",
         std::abs(largest / rows[1][5] - 1.),
         1e-10);
}



void
test()
{
  check_samples();
  check_band();
  check_groups();
  check_study();
}



int
main()
{
  return run_test(&test);
}
