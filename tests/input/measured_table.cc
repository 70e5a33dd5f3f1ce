// Curves as instruments and spreadsheets write them: separators, decimal
// commas, names and units of columns, what stands above the numbers; and what
// is said of files that cannot be understood. Expected are the angles and
// torques that the texts say, in degrees and N mm.

#include <debond/input/allowed_values.h>
#include <debond/scene/reference_data.h>
#include <debond/support/input_error.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <string>

using namespace Debond;

/** Rows 0.5 deg, 20 N mm and 1 deg, 50 N mm. */
void
read(const std::string &what,
     const std::string &text,
     const std::string &columns = "")
{
  std::ofstream("curve.csv", std::ios::binary) << text;
  std::cout << what << ": ";
  try
    {
      const ReferenceCurve curve =
        read_reference_curve("curve.csv", split_list(columns));
      const auto is = [](const double value, const double expected) {
        return std::abs(value - expected) < 1e-12 * expected;
      };
      std::cout << (curve.size() == 2 && is(curve[0].first, 0.5) &&
                        is(curve[0].second, 20.) && is(curve[1].first, 1.) &&
                        is(curve[1].second, 50.) ?
                      "read" :
                      "NOT WHAT IT SAYS")
                << '\n';
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << '\n';
    }
}



int
main()
{
  read("a table of this program",
       "step,time,angle_deg,torque_Nmm,chuck_Mx_Nmm,chuck_rx_deg\n"
       "0,0,0.5,20,1,2\n1,1,1,50,3,nan\n");
  read(
    "semicolons, decimal commas, units in brackets",
    "\xEF\xBB\xBFWinkel [\xC2\xB0];Drehmoment [Nm]\r\n0,5;0,02\r\n1,0;5e-2\r\n");
  read("tabs, a line of units, lines above",
       "Torque meter 4711\nOperator\tA. B.\n\n"
       "time\tangle\ttorque\ns\tdeg\tN cm\n0\t0.5\t2\n1\t1\t5\n");
  read("blanks, commas in numbers",
       "  angle/rad  torque/N.mm\n 0,00872664625997164788  20\n"
       " 0,0174532925199432958   50\n");
  read("quotes",
       "\"angle (deg)\",\"torque, mean (mNm)\"\n\"0.5\",\"20\"\n1,\"50\"\n");
  read("times of day",
       "time;angle in deg;torque in N*m\n12:00:01;0,5;0,02\n12:00:02;1;0,05\n");
  read("no names", "1\t20\t0.5\n2\t50\t1\n", "3 [deg], 2 [N mm]");
  read("columns by name",
       "M1 [N m],M2 [N m],phi\n9,0.02,0.5\n9,0.05,1\n",
       "phi [deg], M2");
  read("comments", "# first\nangle_deg,torque_Nmm\n0.5,20\n# between\n1,50\n");

  read("Latin-1, capitals, separators at the end",
       "WINKEL [\xB0];Drehmoment [cNm];\n0,5;2;\n1;5;;\n;;;\n");
  read("capitals", "ANGLE (DEG)\tTORQUE (Nmm)\n0.5\t20\n1\t50\n");

  read("no unit", "angle,torque\n0.5,20\n1,50\n");
  read("two torques", "angle_deg,M1 [Nm],M2 [Nm]\n0.5,1,2\n1,2,3\n");
  read("no names, no choice", "0.5 20\n1 50\n");
  read("one choice", "0.5 20\n1 50\n", "1 [deg]");
  read("a wrong unit", "0.5 20\n1 50\n", "1 [mm], 2 [N m]");
  read("no such column", "phi,M\n0.5,20\n1,50\n", "phi [deg], T [N m]");
  read("beyond the last column", "0.5 20\n1 50\n", "1 [deg], 3 [N m]");
  read("decimal commas among commas",
       "angle_deg,torque_Nmm\n0,5,20,1\n1,1,50,2\n");
  read("a word among numbers", "angle_deg,torque_Nmm\n0.5,20\nend,50\n");
  read("thousands", "angle_deg;torque_Nmm\n0,5;20\n1;1.050\n");
  read("blanks in numbers", "angle_deg\ttorque_Nmm\n0.5\t1 020\n1\t1 050\n");
  read("the other sign",
       "angle [deg];torque [Nm]\n0,5;-0,02\n1;-0,05\n",
       "angle, 2 [ -N m]");
  read("a factor", "angle [deg];torque [Nm] x10\n0,5;2\n1;5\n");
  read("a gap", "angle_deg;torque_Nmm\n0.5;20\n1;\n");
  read("a short line", "angle_deg;torque_Nmm\n0.5;20\n1\n");
  read("no numbers", "angle_deg,torque_Nmm\n");
  read("nothing", "");
}
