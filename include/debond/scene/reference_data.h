#pragma once

#include <debond/scene/curve_axes.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  /** A measured or computed curve to compare with: angle [deg] and torque
   *  [N mm], or what CurveAxes say. */
  using ReferenceCurve = std::vector<std::pair<double, double>>;

  /**
   * Reads a reference curve from a table as instruments write them, or the
   * torque.csv, reactions.csv or curve.csv of a run, see read_measured_table().
   * @p columns: `Output / Reference columns`. Throws EntryError that names the
   * entry, the file, the line and what was expected. An empty @p filename gives
   * an empty curve.
   */
  ReferenceCurve
  read_reference_curve(const std::string              &filename,
                       const std::vector<std::string> &columns = {},
                       const CurveAxes                &axes    = {});

  /** What a profiles.csv holds of one point, as far as it is compared. */
  struct ProfilePoint
  {
    double x = 0, y = 0; ///< reference position [mm]
    double area     = 0; ///< weight [mm^2]
    double pressure = 0; ///< [MPa]
    double slip     = 0; ///< g_s [mm]; NaN: not part of the model
  };

  /** Angle [deg] -> points. */
  using Profiles = std::map<double, std::vector<ProfilePoint>>;

  /** Reads a profiles.csv. Throws EntryError that names the entry, the
   *  file, the line and what was expected. An empty @p filename gives no
   *  profiles. */
  Profiles
  read_profiles(const std::string &filename);
} // namespace Debond
