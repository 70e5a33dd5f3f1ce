#include <debond/input/csv_table.h>
#include <debond/input/measured_table.h>
#include <debond/scene/reference_data.h>

namespace Debond
{
  ReferenceCurve
  read_reference_curve(const std::string              &filename,
                       const std::vector<std::string> &columns,
                       const CurveAxes                &axes)
  {
    ReferenceCurve curve;
    if (!filename.empty())
      for (const std::vector<double> &row :
           read_measured_table(filename,
                               "Output / Reference curve",
                               {axes.position_column(), axes.load_column()},
                               columns,
                               "Output / Reference columns"))
        curve.emplace_back(row[0], row[1]);
    return curve;
  }



  Profiles
  read_profiles(const std::string &filename)
  {
    Profiles profiles;
    if (filename.empty())
      return profiles;
    for (const std::vector<double> &row : read_csv_columns(
           filename,
           "Expert / Output / Reference profiles",
           {"angle_deg", "x_mm", "y_mm", "area_mm2", "pressure_MPa", "slip_mm"},
           true))
      profiles[row[0]].push_back({row[1], row[2], row[3], row[4], row[5]});
    return profiles;
  }
} // namespace Debond
