#pragma once

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace Debond
{
  /** Errors of a run, estimated by its difference from a coarser one of the
   *  same scene (finer_scenes.h). */
  struct ErrorEstimate
  {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    /** Shares of the largest load of the curve: of all that is modelled, and
     *  what cells, steps, and bodies that are linear or rigid make of it. */
    double total = unknown, cells = unknown, steps = 0., bodies = 0.;
    /** Errors of members of summary.json, in their units. */
    nlohmann::ordered_json members = nlohmann::ordered_json::object();
    /** Of what answers the load at each row, in its unit. */
    std::vector<double> of_rows;
    std::string         column;      ///< that one
    std::string         why_unknown; ///< else empty

    /** What linear bodies make of it: by how much large strains would change
     *  their displacements, times their share of the elastic energy. */
    static double
    of_linear_bodies(const nlohmann::ordered_json &summary);

    ErrorEstimate() = default;
    /** @p summary: of the run with these @p rows; @p coarser: the directory of
     *  the coarser one. */
    ErrorEstimate(const Scene                  &scene,
                  const std::vector<TorqueRow> &rows,
                  const nlohmann::ordered_json &summary,
                  const std::string            &coarser);

  private:
    /** @p share: of the difference of two runs, what is the error of one. */
    void
    find_members(const std::vector<TorqueRow> &rows,
                 const nlohmann::ordered_json &summary,
                 const nlohmann::ordered_json &other,
                 double                        share);
    void
    find_places(const Scene                  &scene,
                const std::vector<TorqueRow> &rows,
                const nlohmann::ordered_json &summary);
    void
    compare(const Scene                  &scene,
            const std::vector<TorqueRow> &rows,
            const std::string            &coarser,
            double                        share);
  };
} // namespace Debond
