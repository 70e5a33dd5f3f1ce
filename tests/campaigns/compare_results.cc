// Finished results compared with a measured curve of 11 and 22 N mm at 1 and 2
// degrees: a run, a study and an ensemble made by hand, whose curves are
// straight lines, so that all numbers follow from their slopes.

#include <debond/campaigns/compare_results.h>
#include <debond/support/input_error.h>

#include <filesystem>
#include <fstream>
#include <iostream>

using namespace Debond;

void
write(const std::string &filename, const std::string &text)
{
  std::filesystem::create_directories(
    std::filesystem::path(filename).parent_path());
  std::ofstream(filename) << text;
}



/** A torque of @p slope [N mm/deg] up to 10 degrees. */
std::string
line(const int slope)
{
  return "angle_deg,torque_Nmm\n0,0\n10," + std::to_string(10 * slope) + "\n";
}



void
compare(const std::string &directory, const std::string &measured)
{
  try
    {
      compare_results(directory, measured, {}, std::cout);
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << '\n';
    }
}



int
main()
{
  std::filesystem::remove_all("results");
  write("results/measured.csv", "angle [deg];torque [Nm]\n1;0,011\n2;0,022\n");
  write("results/in_Nm.csv", "angle_deg,torque_Nmm\n1,0.011\n2,0.022\n");

  // a run, whose curve.csv is finer than its torque.csv
  write("results/run/torque.csv", line(99));
  write("results/run/curve.csv", line(10));
  compare("results/run", "results/measured.csv");
  compare("results/run", "results/in_Nm.csv");

  const std::string studies = "results/study/";
  write(studies + "study.csv",
        "variant,Bone / Cells,Interface / Seed,T_max_Nmm\n"
        "1,\"3, 3, 2\",1,100\n2,\"4, 4, 2\",1,110\n3,\"5, 5, 2\",1,nan\n"
        "4,\"6, 6, 2\",1,0\n");
  write(studies + "variant-001/torque.csv", line(10));
  write(studies + "variant-002/torque.csv", line(11));
  write(studies + "variant-004/torque.csv", "angle_deg,torque_Nmm\n0,0\n0,0\n");
  compare("results/study", "results/measured.csv");

  write(studies + "ensemble.csv",
        "Bone / Cells,angle_deg,members,torque_mean_Nmm,torque_sd_Nmm,"
        "torque_p05_Nmm,torque_p50_Nmm,torque_p95_Nmm\n"
        "\"3, 3, 2\",0,9,0,0,0,0,0\n\"3, 3, 2\",10,9,100,0,90,100,115\n"
        "\"4, 4, 2\",0,9,0,0,0,0,0\n\"4, 4, 2\",10,9,110,0,105,100,200\n"
        "\"5, 5, 2\",0,9,0,0,0,0,0\n\"5, 5, 2\",10,9,100,0,90,100,105\n");
  compare("results/study", "results/measured.csv");

  compare("results/nothing", "results/measured.csv");
  compare("results/run", "results/missing.csv");
}
