// Tables of measured values: plain ones, which are read here, and others, which
// are read by Python. Numbers are those of the file in the units of the names;
// what is wrong is said with the entry that it belongs to.

#include <debond/input/measured_table.h>
#include <debond/support/input_error.h>

#include <fstream>
#include <iostream>

using namespace Debond;

void
read(const std::string              &text,
     const std::vector<std::string> &choice = {})
{
  std::ofstream("table.csv") << text;
  try
    {
      for (const auto &row : read_measured_table("table.csv",
                                                 "Entry",
                                                 {"angle_deg", "torque_Nmm"},
                                                 choice,
                                                 "Columns"))
        std::cout << row[0] << ' ' << row[1] << '\n';
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << '\n';
    }
  std::cout << "---\n";
}



int
main()
{
  read("torque_Nmm,note,angle_deg\n2.5,a,1\n3.5,b,2\n");
  read("Winkel [rad];Moment [N m]\n0,5;1,25\n1,0;2,5\n");
  read("Zeit;x;y\n0;90;1\n1;180;2\n", {"x [deg]", "y [-N cm]"});
  read("Zeit;x;y\n0;90;1\n1;180;2\n", {"x [deg]", "z [N m]"});
  read("angle_deg,torque_Nmm\n1,two\n2,3\n");
  read("nothing of the kind\n");
}
