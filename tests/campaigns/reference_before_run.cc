// What --check says of a reference curve before anything is run: torques and
// angles that go against the rotation that the scene prescribes, angles in
// radians, a curve that turns back. A right curve has no warning, whichever way
// the implant turns. The same of all models.

#include <debond/campaigns/run_scene.h>
#include <debond/scene/scene.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "coin_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;



/** A file of the curve 30 (1 - 0.01 (angle - 5)^2) N mm at 1 to 10 degrees,
 *  with factors. */
std::string
curve(const std::string &name, const double of_angle, const double of_torque)
{
  const std::string path = "results/" + name + ".csv";
  std::ofstream     file(path);
  file << "angle_deg,torque_Nmm\n";
  for (int i = 1; i <= 10; ++i)
    file << of_angle * i << ','
         << of_torque * 30. * (1. - 0.01 * (i - 5) * (i - 5)) << '\n';
  return path;
}



void
print_warnings(const std::ostringstream &out)
{
  std::istringstream lines(out.str());
  std::string        line;
  while (std::getline(lines, line))
    if (line.rfind("warning: results/", 0) == 0)
      std::cout << "  " << line << '\n';
}



void
check_scene(const std::string &what, const std::vector<std::string> &changes)
{
  std::ostringstream out;
  run_scene(coin_scene(pressed_and_turned, changes, "scene.prm"),
            nullptr,
            &out);
  std::cout << what << '\n';
  print_warnings(out);
}



int
main()
{
  std::filesystem::remove_all("results");
  std::filesystem::create_directories("results");
  const std::string reference = "Output/Reference curve=",
                    columns   = "Output/Reference columns=",
                    twist     = "Chuck/Rotation z/",
                    right     = reference + curve("right", 1., 1.),
                    opposite  = reference + curve("opposite", 1., -1.),
                    backwards = reference + curve("backwards", -1., -1.),
                    radians =
                      reference + curve("radians", std::acos(-1.) / 180., 1.);
  check_scene("right", {right});
  check_scene("opposite", {opposite});
  check_scene("turned by a minus", {opposite, columns + "1 [deg], 2 [-N mm]"});
  check_scene("opposite, of a foundation", {opposite, "Model=foundation"});
  check_scene("backwards", {backwards});
  check_scene("backwards, as the scene",
              {backwards, twist + "Value=-10 * max(t - 1, 0)"});
  check_scene("right, of a scene that turns backwards",
              {right, twist + "Value=-10 * max(t - 1, 0)"});
  check_scene("radians", {radians});
  check_scene("under a moment",
              {right,
               twist + "Control=moment",
               twist + "Value=30 * max(t - 1, 0)"});
  check_scene("under the opposite moment",
              {opposite,
               twist + "Control=moment",
               twist + "Value=30 * max(t - 1, 0)"});
  check_scene("nothing turns", {right, twist + "Value=0"});
}
