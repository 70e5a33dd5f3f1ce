#ifndef debond_output_interface_maps_h
#define debond_output_interface_maps_h

#include <debond/output/profile_output.h>
#include <debond/output/torque_curve.h>

#include <Eigen/Core>

#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace Debond
{
  /**
   * maps.csv: the contact face at the rows where something happens, written at
   * the end on a grid of places for pictures; doc/reference/results.md says
   * what and when.
   */
  class InterfaceMaps
  {
  public:
    explicit InterfaceMaps(const Scene &scene);

    using Points = std::function<std::vector<InterfacePoint>()>;

    /** @p points are those of the interface at this row. */
    void
    look(const TorqueRow &row, const Points &points);

    /** Writes maps.csv: for each event all places of the grid, with values
     *  between the points of an element, or of the nearest point where that of
     *  the bone is the slave; nan where there is none. @p last_row and its
     *  @p points end the run. */
    void
    write(const ResultDirectory &directory,
          const TorqueRow       &last_row,
          const Points          &points);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &n_rows &first_phi &largest_load &has_been &snapshots &largest;
    }

  private:
    struct Snapshot
    {
      std::string                 events;
      unsigned int                step      = 0;
      double                      angle_deg = 0, time = 0;
      std::vector<InterfacePoint> points;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &events &step &angle_deg &time &points;
      }
    };

    static Snapshot
    snapshot(const std::string &event,
             const TorqueRow   &row,
             const Points      &points);
    std::vector<Snapshot>
    in_order(const TorqueRow &last_row, const Points &points) const;

    const bool   wanted;
    const double radius; ///< R [mm], of a torque's force
    const bool   is_mesh;
    const std::function<bool(const Eigen::Vector2d &)> has_face_at;
    const std::array<Eigen::Vector2d, 2> box; ///< of the grid [mm]
    const bool pulls; ///< the law has strength in tension
    /** Points per direction and element; 1 with the bone as the slave, of whose
     *  elements not all points face the implant. */
    const unsigned int n;
    unsigned int       n_rows    = 0;
    double             first_phi = 0.,
           largest_load          = 0.; ///< [N], of a snapshot
    std::set<std::string> has_been;    ///< events
    std::vector<Snapshot> snapshots;
    Snapshot              largest; ///< at the largest load so far
  };
} // namespace Debond
#endif
