// Local values against those of a reference whose points lie elsewhere: known
// differences of pressure and sliding distance come out as they are, weighted
// by area and averaged over the angles; the interpolation is exact for
// parabolas and of third order for smooth fields; references along a radius.

#include <debond/output/profile_output.h>
#include <debond/support/input_error.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>

#include "checks.h"

using namespace Debond;

using Field = std::function<double(double x, double y)>;

/** An n x n grid of points over the square of 2 x 2 mm that none of another
 *  grid coincides with. */
std::vector<ProfilePoint>
grid(const unsigned int n, const Field &pressure, const Field &slip)
{
  std::vector<ProfilePoint> points;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      {
        const double x = -1 + (2. * i + 1) / n, y = -1 + (2. * j + 1) / n;
        points.push_back({x, y, 4. / (n * n), pressure(x, y), slip(x, y)});
      }
  return points;
}

double
bowl(const double x, const double y)
{
  return 2 + x - 0.3 * y + 0.5 * x * x + 0.2 * x * y + 0.25 * y * y;
}

double
wave(const double x, const double y)
{
  return 3 + std::sin(2 * x + 0.5) * std::cos(3 * y);
}



/** Means of the grids: x and y are odd, the mean of x^2 over n points is
 *  (1 - 1/n^2)/3. */
double
mean_of_bowl(const unsigned int n)
{
  return 2 + 0.75 * (1 - 1. / (n * n)) / 3;
}



double
error_of_wave(const unsigned int n_reference)
{
  return compare_profiles(
    {{1., grid(17, wave, bowl)}},
    {{1., grid(n_reference, wave, bowl)}})["pressure_difference_rms"];
}



void
check_differences()
{
  const Profiles reference{{1., grid(40, bowl, wave)},
                           {10., grid(40, bowl, bowl)}};
  // pressure 0.01 too large, sliding distance 0.3 too small in the half x > 0
  const auto shifted = [](const double x, const double y) {
    return bowl(x, y) - (x > 0 ? 0.3 : 0.);
  };
  const auto higher = [](const double x, const double y) {
    return bowl(x, y) + 0.01;
  };
  const auto m =
    compare_profiles({{10., grid(16, higher, shifted)}}, reference);
  report("one angle in both", m["reference_angles_used"].get<double>() == 1);
  report("pressure",
         std::abs(m["pressure_difference_rms"].get<double>() *
                    mean_of_bowl(16) / 0.01 -
                  1),
         1e-10);
  report("sliding distance, wrong on half of the area",
         std::abs(m["slip_difference_rms"].get<double>() * mean_of_bowl(16) /
                    0.3 -
                  std::sqrt(0.5)),
         1e-10);

  // the same number of points, but the wrong ones stand for a tenth of the area
  auto weighted = grid(16, bowl, shifted);
  for (ProfilePoint &point : weighted)
    point.area *= point.x > 0 ? 0.2 : 1.8;
  double mean = 0;
  for (const ProfilePoint &point : weighted)
    mean += point.area / 4 * bowl(point.x, point.y);
  report("points count by their area",
         std::abs(
           compare_profiles({{10., weighted}}, reference)["slip_difference_rms"]
               .get<double>() *
             mean / 0.3 -
           std::sqrt(0.1)),
         1e-10);

  const auto two = compare_profiles({{1., grid(16, bowl, wave)},
                                     {10., grid(16, higher, bowl)}},
                                    reference);
  report("two angles in both", two["reference_angles_used"].get<double>() == 2);
  report("mean square over the angles",
         std::abs(two["pressure_difference_rms"].get<double>() *
                    mean_of_bowl(16) / 0.01 -
                  std::sqrt(0.5)),
         1e-8);

  const auto none = compare_profiles({{2., grid(16, bowl, bowl)}}, reference);
  report("no common angle: undefined",
         none["reference_angles_used"].get<double>() == 0 &&
           std::isnan(none["pressure_difference_rms"].get<double>()) &&
           std::isnan(none["slip_difference_rms"].get<double>()));
}



void
check_interpolation()
{
  const double coarse = error_of_wave(40), fine = error_of_wave(80);
  report("interpolation of a smooth field from 80 x 80 points", fine, 1e-4);
  report("its error with twice as many points across, ratio",
         fine / coarse,
         0.2); // 1/8 if of third order
}



// As closed forms write them: along a radius, whatever the direction.
void
check_radial_reference()
{
  const auto radial = [](const double x, const double y) {
    return 1 + std::pow(std::hypot(x, y), 2);
  };
  std::vector<ProfilePoint> line;
  for (unsigned int i = 0; i < 200; ++i)
    {
      const double r = 1.5 * (i + 0.5) / 200;
      line.push_back({r, 0, r, radial(r, 0), 2 * radial(r, 0)});
    }
  const auto m =
    compare_profiles({{1., grid(16, radial, radial)}}, {{1., line}});
  report("reference along a radius",
         m["pressure_difference_rms"].get<double>(),
         1e-12);
  report("half of its sliding distance, below the mean of the other half",
         m["slip_difference_rms"].get<double>() > 0.5 &&
           m["slip_difference_rms"].get<double>() < 0.6);
}



void
check_files()
{
  std::ofstream("profiles.csv")
    << "# comment\nangle_deg,x_mm,y_mm,pressure_MPa,slip_mm,area_mm2\n"
       "1,0.5,0.25,2.5,nan,0.1\n10,0,0,3,0.2,0.1\n";
  const Profiles profiles = read_profiles("profiles.csv");
  report("two angles in the file", profiles.size() == 2);
  const ProfilePoint point = profiles.at(1.).at(0);
  report("columns",
         point.x == 0.5 && point.y == 0.25 && point.area == 0.1 &&
           point.pressure == 2.5 && std::isnan(point.slip));
  std::ofstream("columns.csv") << "angle_deg,x_mm,y_mm\n1,2,3\n";
  try
    {
      read_profiles("columns.csv");
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}



int
main()
{
  check_differences();
  check_interpolation();
  check_radial_reference();
  check_files();
}
