// What is read off a torque curve: peak, full sliding, energies, pressure and
// errors against a reference on piecewise linear curves whose values are known;
// null where undefined; messages about reference curves that cannot be read;
// the columns of torque.csv and the members of summary.json.

#include <debond/output/result_files.h>
#include <debond/output/torque_curve.h>
#include <debond/support/input_error.h>

#include <deal.II/base/numbers.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace Debond;

constexpr double radian = dealii::numbers::PI / 180.; // of a degree

void
check(const std::string &what, const double value, const double expected)
{
  std::cout << "  " << what << ": ";
  const bool equal =
    std::isnan(expected) ?
      std::isnan(value) :
      std::abs(value - expected) <= 1e-12 * std::max(1., std::abs(expected));
  if (equal)
    std::cout << "yes" << std::endl;
  else
    std::cout << "NO, " << value << " instead of " << expected << std::endl;
}



struct Sample
{
  double time, angle_deg, torque_Nmm, pressure_MPa;
};

std::vector<TorqueRow>
make_rows(const std::vector<Sample> &samples)
{
  std::vector<TorqueRow> rows;
  for (const Sample &sample : samples)
    {
      TorqueRow row;
      row.step              = rows.size();
      row.time              = sample.time;
      row.angle_deg         = sample.angle_deg;
      row.torque_Nmm        = sample.torque_Nmm;
      row.pressure_MPa      = sample.pressure_MPa;
      row.dissipation_Nmm   = 2 * row.step;
      row.adhesive_work_Nmm = row.step;
      // no two of them are equal, and none is 0
      row.viscous_work_Nmm     = 0.1 * row.step;
      row.work_Nmm             = 3 * row.step;
      row.energy_bulk_Nmm      = 0.4 * row.step;
      row.energy_interface_Nmm = 0.6 * row.step;
      row.force_N              = 20 * sample.pressure_MPa;
      row.energy_defect        = -1e-6 * row.step;
      row.reaction_defect      = 1e-7 * row.step;
      rows.push_back(row);
    }
  return rows;
}



/** Pressed for one unit of time, then turned to ten degrees: up to 50 N mm at
 *  2 degrees, down to 30 N mm at 6, constant from there. */
std::vector<Sample>
triangle()
{
  return {{0, 0, 0, 0},
          {1, 0, 0, 2.5},
          {1.2, 2, 50, 2.501},
          {1.6, 6, 30, 2.502},
          {2, 10, 30, 2.503}};
}



CurveSettings
settings()
{
  CurveSettings settings;
  settings.contact_area_mm2 = 20;
  settings.mean_phi_0       = 0.5;
  settings.phase_times      = {0, 1, 2};
  return settings;
}



void
check_triangle()
{
  std::cout << "Measures are as computed by hand" << std::endl;
  const auto m = measure_torque_curve(make_rows(triangle()), settings());
  check("T_max", m["T_max_Nmm"], 50);
  check("angle of T_max", m["theta_max_deg"], 2);
  check("T_inf", m["T_inf_Nmm"], 30);
  // 5 N mm a degree: 0.05 N mm below the peak after 0.01 degrees
  check("angle of full sliding", m["theta_full_deg"], 2.01);
  check("pressure", m["pressure_MPa"], 2.5);
  const double E_deb = (50 + 160 + 120) * radian, E_fric = 30 * 7.99 * radian;
  check("E_deb", m["E_deb_Nmm"], E_deb);
  check("E_fric", m["E_fric_Nmm"], E_fric);
  check("W_adh", m["W_adh_Nmm"], E_deb - E_fric);
  check("w_adh", m["w_adh_N_per_m"], 1e3 * (E_deb - E_fric) / 20 / 0.5);
  check("w_adh*", m["w_adh_star_N_per_m"], 1e3 * (E_deb - E_fric) / 20);
  check("D_adh", m["D_adh_Nmm"], 4);
  check("dissipation", m["dissipation_Nmm"], 8);
  check("viscous part", m["viscous_dissipation_Nmm"], 0.4);
  check("work", m["work_Nmm"], 12);
  check("stored in the bodies", m["E_bulk_Nmm"], 1.6);
  check("and in the interface", m["E_interface_Nmm"], 2.4);
  check("force", m["force_end_N"], 20 * 2.503);
  check("energy defect", m["largest_energy_defect"], 4e-6);
  check("reaction defect", m["largest_reaction_defect"], 4e-7);
  check("initial stiffness",
        m["initial_stiffness_Nmm_per_rad"],
        50 / (2 * radian));
  check("nothing debonds", m["theta_debonding_deg"], NAN);
  std::vector<TorqueRow> debonding = make_rows(triangle());
  for (TorqueRow &row : debonding)
    row.phi_mean = row.angle_deg < 5 ? 0.7 : 0.6;
  check("up to where nothing is broken",
        measure_torque_curve(debonding, settings())["theta_bonded_deg"],
        2);
  check("debonding begins",
        measure_torque_curve(debonding, settings())["theta_debonding_deg"],
        6);
  check("no error without a reference", m["e_mp"], NAN);
  check("no error without a reference", m["e_rel"], NAN);

  auto twisted = triangle(); // and held at 1 degree and 3 N mm before
  for (unsigned int i = 0; i < 2; ++i)
    twisted[i] = {double(i), 1, 3, 2.5};
  check("initial stiffness from there",
        measure_torque_curve(make_rows(twisted),
                             settings())["initial_stiffness_Nmm_per_rad"],
        47 / (1 * radian));

  std::cout
    << "The entry Friction energy from angle is what E_fric is counted from"
    << std::endl;
  CurveSettings given          = settings();
  given.full_sliding_angle_deg = 4;
  const auto overridden = measure_torque_curve(make_rows(triangle()), given);
  check("that of the curve stays", overridden["theta_full_deg"], 2.01);
  check("E_fric", overridden["E_fric_Nmm"], 30 * 6 * radian);
  check("E_deb", overridden["E_deb_Nmm"], m["E_deb_Nmm"]);

  std::cout << "Turned the other way, energies are the same" << std::endl;
  auto mirrored = triangle();
  for (Sample &sample : mirrored)
    {
      sample.angle_deg  = -sample.angle_deg;
      sample.torque_Nmm = -sample.torque_Nmm;
    }
  const auto n = measure_torque_curve(make_rows(mirrored), settings());
  check("T_max", n["T_max_Nmm"], 50);
  check("T_inf", n["T_inf_Nmm"], -30);
  check("angle of full sliding", n["theta_full_deg"], -2.01);
  check("E_deb", n["E_deb_Nmm"], m["E_deb_Nmm"]);
  check("W_adh", n["W_adh_Nmm"], m["W_adh_Nmm"]);

  std::cout << "What jumps release while it turns is no part of E_deb"
            << std::endl;
  std::vector<TorqueRow> jumping = make_rows(triangle());
  for (unsigned int i = 1; i < jumping.size(); ++i)
    jumping[i].released_energy_Nmm = i < 3 ? 0.1 : 0.3;
  const auto j = measure_torque_curve(jumping, settings());
  check("E_deb", j["E_deb_Nmm"], m["E_deb_Nmm"].get<double>() - 0.2);
  check("W_adh", j["W_adh_Nmm"], m["W_adh_Nmm"].get<double>() - 0.2);
  check("E_fric", j["E_fric_Nmm"], m["E_fric_Nmm"]);
  check("a remark says so", j["remarks"].size(), m["remarks"].size() + 1);
}



void
check_pressure()
{
  std::cout << "Pressure is that of the last phase before the rotation"
            << std::endl;
  CurveSettings longer = settings();
  longer.phase_times   = {0, 1, 3};
  check("rotation begins within a phase",
        measure_torque_curve(make_rows({{0, 0, 0, 0},
                                        {1, 0, 0, 2.5},
                                        {1.5, 0, 0, 2.6},
                                        {2, 1, 40, 2.7},
                                        {3, 2, 40, 2.8}}),
                             longer)["pressure_MPa"],
        2.5);
  check("rotation begins at once",
        measure_torque_curve(
          make_rows({{0, 0, 0, 2.4}, {1, 1, 0, 2.5}, {2, 2, 0, 2.6}}),
          settings())["pressure_MPa"],
        2.4);
  check("no rotation",
        measure_torque_curve(make_rows(
                               {{0, 0, 0, 0}, {1, 0, 0, 2.5}, {2, 0, 0, 2.6}}),
                             settings())["pressure_MPa"],
        2.6);
}



void
check_undefined_measures()
{
  CurveSettings with_reference = settings();
  with_reference.reference     = {{1, 20}, {2, 40}};

  std::cout << "Without a rotation angles and energies are undefined"
            << std::endl;
  // rounding errors of a chuck that is free to turn are no rotation
  const auto still = measure_torque_curve(
    make_rows({{0, 0, 0, 0}, {1, 1e-15, 0, 2.5}, {2, -1e-14, 3, 2.6}}),
    with_reference);
  check("T_max is defined", still["T_max_Nmm"], 3);
  check("angle of T_max", still["theta_max_deg"], NAN);
  check("angle of full sliding", still["theta_full_deg"], NAN);
  check("E_deb", still["E_deb_Nmm"], NAN);
  check("E_fric", still["E_fric_Nmm"], NAN);
  check("W_adh", still["W_adh_Nmm"], NAN);
  check("w_adh", still["w_adh_N_per_m"], NAN);
  check("w_adh*", still["w_adh_star_N_per_m"], NAN);
  check("e_mp", still["e_mp"], NAN);

  std::cout << "So they are if the rotation reverses" << std::endl;
  auto back = triangle();
  back.push_back({2.1, 9, -20, 2.8});
  const auto reversed = measure_torque_curve(make_rows(back), with_reference);
  check("T_max is defined", reversed["T_max_Nmm"], 50);
  check("T_inf is defined", reversed["T_inf_Nmm"], -20);
  check("angle of full sliding", reversed["theta_full_deg"], NAN);
  check("E_deb", reversed["E_deb_Nmm"], NAN);
  check("W_adh", reversed["W_adh_Nmm"], NAN);
  check("e_rel", reversed["e_rel"], NAN);
  auto pausing = triangle();
  pausing.push_back({2.1, 10 - 1e-12, 30, 2.8});
  check("a pause is no reversal",
        measure_torque_curve(make_rows(pausing), settings())["theta_full_deg"],
        2.01);

  std::cout << "A run that ends before full sliding has no E_fric" << std::endl;
  CurveSettings late          = settings();
  late.full_sliding_angle_deg = 11;
  const auto early = measure_torque_curve(make_rows(triangle()), late);
  check("E_deb is defined", early["E_deb_Nmm"], 330 * radian);
  check("E_fric", early["E_fric_Nmm"], NAN);
  check("W_adh", early["W_adh_Nmm"], NAN);

  std::cout << "Nor one whose torque still rises" << std::endl;
  auto rising = triangle();
  rising.resize(3);
  const auto r = measure_torque_curve(make_rows(rising), settings());
  check("E_deb is defined", r["E_deb_Nmm"], 50 * radian);
  check("angle of full sliding", r["theta_full_deg"], NAN);
  check("E_fric", r["E_fric_Nmm"], NAN);
  check("W_adh", r["W_adh_Nmm"], NAN);

  std::cout << "Nor one whose pressure changes, or that keeps its bond"
            << std::endl;
  auto pressed = make_rows(triangle()), kept = pressed;
  pressed.back().pressure_MPa = 2.53;
  for (TorqueRow &row : kept)
    row.phi_mean = row.angle_deg < 5 ? 0.7 : 0.141;
  check("by 1.2 %",
        measure_torque_curve(pressed, settings())["W_adh_Nmm"],
        NAN);
  check("more than a fifth of it",
        measure_torque_curve(kept, settings())["W_adh_Nmm"],
        NAN);

  std::cout << "Without a bond or a row" << std::endl;
  CurveSettings frictional = settings();
  frictional.is_bonded     = false;
  check("W_adh",
        measure_torque_curve(make_rows(triangle()), frictional)["W_adh_Nmm"],
        NAN);
  CurveSettings unbonded = settings();
  unbonded.mean_phi_0    = 0;
  check("w_adh",
        measure_torque_curve(make_rows(triangle()), unbonded)["w_adh_N_per_m"],
        NAN);
  check("T_max", measure_torque_curve({}, settings())["T_max_Nmm"], NAN);
}



void
write_text(const std::string &filename, const std::string &text)
{
  std::ofstream(filename, std::ios::binary) << text;
}



void
check_errors()
{
  std::cout << "Errors against a reference curve" << std::endl;
  write_text("reference.csv",
             "\xEF\xBB\xBF# measured\r\n\r\n"
             "torque_Nmm, angle_deg, remark\r\n"
             "0,0,angle must be positive\r\n"
             "20,1,ours is 25\r\n"
             "0.4,1.5,ours is 37.5 where e_mp leaves out what is small\r\n"
             "50,4,ours is 40\r\n"
             "30,10.0000000000001,ours is 30\r\n"
             "30,11,beyond\r\n");
  CurveSettings with_reference = settings();
  with_reference.reference     = read_reference_curve("reference.csv");
  check("rows read", with_reference.reference.size(), 6);
  const auto m = measure_torque_curve(make_rows(triangle()), with_reference);
  check("rows used", m["reference_rows_used"], 4);
  check("e_mp", m["e_mp"], (5. / 20 + 10. / 50 + 0.) / 3);
  check("e_rel", m["e_rel"], (5. / 50 + 37.1 / 50 + 10. / 50 + 0.) / 4);
  check("largest difference", m["difference_max"], 37.1 / 50);
  check("where it is [deg]", m["difference_max_deg"], 1.5);
  check("mean difference",
        m["difference_mean"],
        (5. + 37.1 + 10. + 0.) / 4 / 50);
  check("rows read without a file", read_reference_curve("").size(), 0);

  // in N m, in radians, with the other sign: what is said of the file's curve
  for (const auto &[angle, torque] : {std::make_pair(1., 1e-3),
                                      std::make_pair(M_PI / 180., 1.),
                                      std::make_pair(1., -1.)})
    {
      CurveSettings other = with_reference;
      for (auto &row : other.reference)
        row = {angle * row.first, torque * row.second};
      const auto measures = measure_torque_curve(make_rows(triangle()), other);
      for (const auto &remark : measures["remarks"])
        if (remark.get<std::string>().rfind("e_mp", 0) == 0)
          std::cout << remark << std::endl;
    }
}



void
show_refusal(const std::string &filename)
{
  try
    {
      read_reference_curve(filename);
      std::cout << "  NOT REFUSED" << std::endl;
    }
  catch (const InputError &error)
    {
      std::cout << "  " << error.what() << std::endl;
    }
}



void
show_refusals()
{
  std::cout << "Reference curves that cannot be read" << std::endl;
  show_refusal("missing.csv");
  write_text("columns.csv", "angle,torque_Nmm\n1,2\n");
  show_refusal("columns.csv");
  write_text("word.csv", "angle_deg,torque_Nmm\n1,2\n2,nan\n");
  show_refusal("word.csv");
  write_text("short.csv", "angle_deg,torque_Nmm\n# half a line\n1\n");
  show_refusal("short.csv");
  write_text("empty.csv", "angle_deg,torque_Nmm\n");
  show_refusal("empty.csv");
}



std::string
contents(const std::string &filename)
{
  std::ostringstream text;
  text << std::ifstream(filename, std::ios::binary).rdbuf();
  return text.str();
}



void
show_files()
{
  OutputParameters output;
  output.directory               = "results";
  output.overwrite_other_results = true;
  const ResultDirectory directory(output, "");

  std::cout << "torque.csv" << std::endl;
  const std::string file = directory.file("torque.csv");
  write_file(file, torque_table({}));
  auto rows                 = make_rows(triangle());
  rows[2].torque_Nmm        = 50. / 3.;
  rows[2].chuck_reaction[5] = -1e-7;
  append_to_file(file, torque_line(rows[1]));
  append_to_file(file, torque_line(rows[2]));
  std::cout << contents("results/torque.csv");
  write_text("own.csv", contents("results/torque.csv"));
  check("it can be a reference itself",
        read_reference_curve("own.csv").at(1).second,
        16.6666666667);

  std::cout << "summary.json" << std::endl;
  auto json      = measure_torque_curve(make_rows({{0, 0, 0, 0}}), settings());
  json["reason"] = "test";
  json["warnings"] = {"one", "two"};
  std::cout << json.dump(2) << std::endl;
}



int
main()
{
  check_triangle();
  check_pressure();
  check_undefined_measures();
  check_errors();
  show_refusals();
  show_files();
}
