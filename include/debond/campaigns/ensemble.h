#ifndef debond_campaigns_ensemble_h
#define debond_campaigns_ensemble_h

#include <debond/campaigns/variant.h>
#include <debond/output/torque_curve.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace Debond
{
  /** A variant of a study as a member of an ensemble. Members that agree in
   *  @p values differ by chance only and form a group. */
  struct EnsembleMember
  {
    /** Values of the varied entries other than the one that stands for chance.
     */
    std::vector<std::string> values;
    bool                     converged = false;
    nlohmann::ordered_json   summary; ///< its summary.json
    ReferenceCurve           curve;   ///< rows of its torque.csv
  };

  /**
   * The torque of several curves at common angles. These are the rows of the
   * curve with most rows (of the first of them): each curve is linear between
   * its rows, to the accuracy that it was computed with, and the union of all
   * rows would only add angles at which all but one are interpolated. Rows at
   * an angle that the next row repeats (pressing in before turning) are left
   * out. A curve takes part at the angles that it covers; those that turn back
   * or do not turn at all are left out altogether.
   */
  struct TorqueBand
  {
    struct Row
    {
      double           angle_deg = 0;
      SampleStatistics torque; ///< [N mm]
    };
    std::vector<Row> rows;
    unsigned int     left_out = 0; ///< curves that turn back

    explicit TorqueBand(const std::vector<ReferenceCurve> &curves);
  };

  /** The statistics of all groups, in the order of their first members, as the
   *  texts of the files that doc/results.md describes. */
  struct Ensemble
  {
    /** @p entries: full names of the varied entries that EnsembleMember::values
     *  belong to. */
    Ensemble(const std::vector<std::string>    &entries,
             const std::vector<EnsembleMember> &members);

    std::string curves;  ///< ensemble.csv: the torque band of each group
    std::string summary; ///< ensemble_summary.csv: a row for each group
    /** Lines on curves that had to be left out of the band; empty if none. */
    std::string notes;
  };
} // namespace Debond
#endif
