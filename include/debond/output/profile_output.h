#ifndef debond_output_profile_output_h
#define debond_output_profile_output_h

#include <debond/scene/reference_data.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace Debond
{
  class ContactInterface;
  class ResultDirectory;
  struct Scene;

  /** A point of the interface in profiles.csv, by the columns behind the angle:
   *  reference position x, y and distance r from the axis [mm], pressure and
   *  magnitude of the tangential traction [MPa], accumulated sliding distance
   *  g_s [mm], bonding state phi, friction coefficient mu, PointStatus, area
   *  that the point stands for [mm^2], the parts of the bond that opening and
   *  slip have left (BondLeft), PointTraction::mode_deg() [deg]. */
  using InterfacePoint = std::array<double, 13>;

  /** Those of the slave points that face the implant, in the trial state. */
  std::vector<InterfacePoint>
  profile_points(const ContactInterface &interface);



  /**
   * Members of summary.json: pressure_difference_rms and slip_difference_rms,
   * the root mean square of the difference over all points, weighted by their
   * areas, relative to the area mean of the reference, and then over the angles
   * that both have, whose number is reference_angles_used; NaN where undefined.
   *
   * Compares local values at the points of @p profiles with those of a
   * reference, whose points lie elsewhere: at each point a parabola in x and y
   * is fitted to the 20 nearest points of the reference, the nearer the more
   * weight (moving least squares, Lancaster and Salkauskas 1981). The error of
   * this interpolation falls with the third power of the distance of the
   * reference's points, which therefore should lie more densely.
   *
   * A reference whose points all have y = 0, as those of closed forms, holds at
   * that radius in every direction. Angles that only one of both has are left
   * out.
   */
  nlohmann::ordered_json
  compare_profiles(const Profiles &profiles, const Profiles &reference);



  /**
   * profiles.csv, an InterfacePoint a line at the rows whose angle first
   * reaches one of `Output / Profile angles`, and friction_law.csv.
   */
  class ProfileOutput
  {
  public:
    ProfileOutput(const Scene &scene, const ResultDirectory &directory);

    /** Adds the @p points of a row, if its angle [deg] reaches a profile angle;
     *  only then they are asked for. */
    void
    write(double                                              angle_deg,
          const std::function<std::vector<InterfacePoint>()> &points);

    /** Writes profiles.csv, if there is any angle to write about. Returns a
     *  warning about angles that were never reached, or nothing. */
    std::string
    finish();

    /** Distance of the written profiles from `Output / Reference profiles`;
     *  undefined without any. To be called after finish(). */
    nlohmann::ordered_json
    measures() const;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &angles_to_come &has_points &table;
    }

  private:
    const ResultDirectory &directory;
    std::vector<double>    angles_to_come; ///< ascending [deg]
    const Profiles         reference;      ///< empty: none
    bool                   wanted;
    bool                   has_points = false;
    std::string            table;
  };
} // namespace Debond
#endif
