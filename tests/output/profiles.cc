// profiles.csv and friction_law.csv: two rigid bodies have at every slave point
// the traction, sliding distance and friction coefficient of the closed form at
// that radius, at the angles that were asked for; so that against reference
// profiles of the closed form the local errors vanish, and against one whose
// pressure is 1 % higher and whose sliding distance is 2 % larger they are
// that.

#include <debond/models/closed_forms.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "checks.h"
#include "driven_scene.h"

using namespace Debond;

std::map<std::string, std::vector<double>>
read_columns(const std::string &filename)
{
  std::ifstream                              file(filename);
  std::string                                line, item;
  std::vector<std::string>                   names;
  std::map<std::string, std::vector<double>> columns;
  std::getline(file, line);
  for (std::istringstream items(line); std::getline(items, item, ',');)
    names.push_back(item);
  while (std::getline(file, line))
    {
      std::istringstream items(line);
      for (const std::string &name : names)
        {
          std::getline(items, item, ',');
          columns[name].push_back(std::stod(item));
        }
    }
  return columns;
}



const char *const text_of_scene = R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
end
subsection Chuck
  subsection Press
    set Value = 2.6 / 585 * min(t, 1)
  end
  subsection Rotation z
    set Value = 2 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1, 40
end
subsection Expert
  subsection Output
    set Profile angles     = 1.5, 0.1
    set Friction law curve = true
  end
end
)";



/** Profiles of the closed form along a radius, multiplied by these factors. */
void
write_reference(const std::string        &filename,
                const RigidBodiesTorsion &exact,
                const double              pressure_factor,
                const double              slip_factor)
{
  std::ofstream file(filename);
  file.precision(12);
  file << "angle_deg,x_mm,y_mm,area_mm2,pressure_MPa,slip_mm\n";
  for (const double angle : {0.1, 1.5})
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const double r = 2.5 * (i + 0.5) / 2000;
        file << angle << ',' << r << ",0,1," << 2.6 * pressure_factor << ','
             << slip_factor * exact.slip(r, angle * M_PI / 180.) << '\n';
      }
}



/** A number of the summary.json in results/profiles. */
double
summary(const std::string &name)
{
  std::ostringstream text;
  text << std::ifstream("results/profiles/summary.json").rdbuf();
  const auto begin = text.str().find("\"" + name + "\": ");
  return begin == std::string::npos ?
           NAN :
           std::atof(text.str().c_str() + begin + name.size() + 4);
}



void
check_local_errors(const RigidBodiesTorsion &exact)
{
  std::filesystem::create_directories("results");
  for (const double by : {0., 0.01})
    {
      write_reference("results/reference.csv", exact, 1. + by, 1. + 2. * by);
      run_scene("profiles",
                text_of_scene,
                {"Expert/Output/Reference profiles=results/reference.csv"});
      report("both angles compared", summary("reference_angles_used") == 2);
      report("local error of the pressure",
             std::abs(summary("pressure_difference_rms") - by / (1. + by)),
             1e-9);
      // root mean square of the sliding distance over its mean, twice the
      // area integrals of the closed form
      double square = 0;
      for (const double angle : {0.1, 1.5})
        {
          double mean = 0, mean_square = 0;
          for (unsigned int i = 0; i < 2000; ++i)
            {
              const double r = 2.5 * (i + 0.5) / 2000;
              const double s = exact.slip(r, angle * M_PI / 180.);
              mean += s * r;
              mean_square += s * s * r;
            }
          const double weight = 2.5 * 2000 / 2; // sum of all r
          square += mean_square / weight / std::pow(mean / weight, 2) / 2;
        }
      const double expected = 2. * by / (1. + 2. * by) * std::sqrt(square);
      report("local error of the sliding distance",
             std::abs(summary("slip_difference_rms") - expected),
             5e-4);
    }
}



void
test()
{
  run_scene("profiles", text_of_scene);
  TorsionModel::Disk parameters;
  parameters.radius    = 2.5;
  parameters.pressure  = 2.6;
  parameters.stiffness = 585;
  const RigidBodiesTorsion exact(parameters);

  auto   profile  = read_columns("results/profiles/profiles.csv");
  double traction = 0, slip = 0, mu = 0, pressure = 0, area = 0;
  for (unsigned int i = 0; i < profile["r_mm"].size(); ++i)
    {
      const auto point =
        exact.point(profile["r_mm"][i], profile["angle_deg"][i] * M_PI / 180.);
      grow(traction, std::abs(profile["traction_MPa"][i] - point.traction));
      grow(slip, std::abs(profile["slip_mm"][i] - point.slip));
      grow(mu, std::abs(profile["mu"][i] - point.mu));
      grow(pressure, std::abs(profile["pressure_MPa"][i] - 2.6));
      area += profile["area_mm2"][i] / 2; // of two angles
    }
  report("points of both angles", profile["r_mm"].size() == 2 * 225);
  report("angles",
         std::abs(profile["angle_deg"].front() - 0.1) < 1e-9 &&
           std::abs(profile["angle_deg"].back() - 1.5) < 1e-9);
  report("traction [MPa]", traction, 1e-4);
  report("sliding distance [mm]", slip, 1e-5);
  report("friction coefficient", mu, 1e-4);
  report("pressure [MPa]", pressure, 1e-9);
  report("area of the disk, relative",
         std::abs(area / (M_PI * 2.5 * 2.5) - 1.),
         1e-6);

  auto law = read_columns("results/profiles/friction_law.csv");
  mu       = 0;
  for (unsigned int i = 0; i < law["slip_mm"].size(); ++i)
    {
      // Eqs. (11) and (13) with a_s = 22 um, b_s = 0.74, 0.58 and 0.40
      const double s = law["slip_mm"][i] / 0.022;
      const double phi =
        s < 1.   ? 1. :
        s > 2.48 ? 0. :
                   0.5 - 0.5 * std::sin(M_PI / 1.48 * (s - 1.74));
      grow(mu, std::abs(law["mu"][i] - (0.4 + 0.18 * phi)));
      grow(mu, std::abs(law["mu_over_initial"][i] - law["mu"][i] / 0.58));
    }
  report("friction law", mu, 1e-10);
  check_local_errors(exact);
}



int
main()
{
  return run_test(&test);
}
