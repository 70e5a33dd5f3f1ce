#pragma once

#include <debond/output/profile_output.h>
#include <debond/output/torque_curve.h>

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  class ResultDirectory;

  /** Tables of the points of the interface: profiles.csv at the rows whose
   * angle first reaches one of `Expert / Output / Profile angles`, maps.csv at
   * those where something happens, on a grid for pictures
   * (doc/reference/results.md), and friction_law.csv. */
  class InterfaceTables
  {
  public:
    /** The points at the newest row. */
    using Points =
      std::function<std::vector<InterfacePoint>(const TorqueRow &)>;

    /** Keeps references. */
    InterfaceTables(const Scene           &scene,
                    const ResultDirectory &directory,
                    Points                 points);

    /** Adds the points of a row if it belongs to a table; only then they are
     *  asked for. */
    void
    look(const TorqueRow &row);

    /** Writes profiles.csv, if there is any angle to write about. Returns a
     *  warning about angles that were never reached, or nothing. */
    std::string
    write_profiles() const;
    /** Distance of the written profiles from the reference; undefined
     *  without any. */
    nlohmann::ordered_json
    measures() const;
    /** Writes maps.csv. @p last_row ends the run. */
    void
    write_maps(const TorqueRow &last_row) const;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &angles_to_come &profiles &first_phi &snapshots;
    }

  private:
    using Snapshot = std::pair<TorqueRow, std::vector<InterfacePoint>>;

    const Scene           &scene;
    const ResultDirectory &directory;
    const Points           points;
    const bool             has_maps;
    const Profiles         reference;      ///< empty: none
    std::vector<double>    angles_to_come; ///< ascending [deg]
    std::string            profiles;       ///< lines of the table
    double                 first_phi = std::numeric_limits<double>::quiet_NaN();
    std::map<unsigned int, Snapshot> snapshots; ///< by the numbers of events
  };
} // namespace Debond
