#include <debond/input/csv_table.h>
#include <debond/input/measured_table.h>
#include <debond/scene/reference_data.h>

namespace Debond
{
  namespace
  {
    ReferenceCurve
    read_curve(const std::string              &filename,
               const std::string              &entry,
               const std::vector<std::string> &columns,
               const std::string              &columns_entry,
               std::string                    *read_from = nullptr)
    {
      ReferenceCurve curve;
      if (!filename.empty())
        for (const std::vector<double> &row :
             read_measured_table(filename,
                                 entry,
                                 {{"angle_deg", Quantity::angle},
                                  {"torque_Nmm", Quantity::moment}},
                                 columns,
                                 columns_entry,
                                 read_from))
          curve.emplace_back(row[0], row[1]);
      return curve;
    }
  } // namespace



  ReferenceCurve
  read_reference_curve(const std::string              &filename,
                       const std::vector<std::string> &columns)
  {
    return read_curve(filename,
                      "Output / Reference curve",
                      columns,
                      "Output / Reference columns");
  }



  ReferenceCurve
  read_curve_to_compare(const std::string              &filename,
                        const std::vector<std::string> &columns,
                        std::string                    &read_from)
  {
    return read_curve(filename, "--compare", columns, "--columns", &read_from);
  }



  Profiles
  read_profiles(const std::string &filename)
  {
    Profiles profiles;
    if (filename.empty())
      return profiles;
    for (const std::vector<double> &row : read_csv_columns(
           filename,
           "Output / Reference profiles",
           {"angle_deg", "x_mm", "y_mm", "area_mm2", "pressure_MPa", "slip_mm"},
           true))
      profiles[row[0]].push_back({row[1], row[2], row[3], row[4], row[5]});
    return profiles;
  }
} // namespace Debond
