#ifndef debond_scene_reference_data_h
#define debond_scene_reference_data_h

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  /** A measured or computed curve to compare with: angle [deg], torque [N mm].
   */
  using ReferenceCurve = std::vector<std::pair<double, double>>;

  /**
   * Reads a reference curve from a CSV file whose first line names the columns;
   * `angle_deg` and `torque_Nmm` must be among them (so another run's
   * torque.csv will do), others are ignored, as are empty lines and lines that
   * begin with
   * `#`. Throws InputError that names the entry `Output / Reference curve`, the
   * file, the line and what was expected. An empty @p filename gives an empty
   * curve.
   */
  ReferenceCurve
  read_reference_curve(const std::string &filename);

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

  /** Reads a profiles.csv. Throws EntryError that names the entry `Output /
   *  Reference profiles`, the file, the line and what was expected. An empty
   *  @p filename gives no profiles. */
  Profiles
  read_profiles(const std::string &filename);
} // namespace Debond
#endif
