#include <debond/scene/curve_axes.h>

#include <boost/algorithm/string/trim.hpp>

#include <array>

namespace Debond
{
  namespace
  {
    const std::array<const char *, 6> loads{
      {"Force x", "Force y", "Force z", "Moment x", "Moment y", "Moment z"}};
  }



  std::string
  CurveAxes::position_column() const
  {
    return is_torsion() ? "angle_deg" :
                          ChuckParameters::column_name(position, false);
  }
  std::string
  CurveAxes::load_column() const
  {
    return is_torsion() ? "torque_Nmm" :
                          ChuckParameters::column_name(load, true);
  }
  const char *
  CurveAxes::position_word() const
  {
    return is_rotation(position) ? "angle" : "displacement";
  }
  const char *
  CurveAxes::load_word() const
  {
    return is_torsion() ? "torque" : is_rotation(load) ? "moment" : "force";
  }
  const char *
  CurveAxes::position_unit() const
  {
    return is_rotation(position) ? "deg" : "mm";
  }
  const char *
  CurveAxes::load_unit() const
  {
    return is_rotation(load) ? "N mm" : "N";
  }



  std::optional<CurveAxes>
  CurveAxes::read(const std::string &text)
  {
    const auto        comma  = text.find(',');
    const std::string first  = boost::trim_copy(text.substr(0, comma)),
                      second = comma == std::string::npos ?
                                 "" :
                                 boost::trim_copy(text.substr(comma + 1));
    for (unsigned int p = 0; p < ChuckParameters::n_components; ++p)
      for (unsigned int l = 0; l < ChuckParameters::n_components; ++l)
        if (first == ChuckParameters::names[p] && second == loads[l])
          return CurveAxes{p, l};
    return {};
  }



  std::optional<CurveAxes>
  CurveAxes::of_columns(const std::string &position, const std::string &load)
  {
    for (unsigned int p = 0; p < ChuckParameters::n_components; ++p)
      for (unsigned int l = 0; l < ChuckParameters::n_components; ++l)
        if (const CurveAxes axes{p, l};
            axes.position_column() == position && axes.load_column() == load)
          return axes;
    return {};
  }
} // namespace Debond
