#ifndef debond_campaigns_calibration_h
#define debond_campaigns_calibration_h

#include <debond/campaigns/fit_statistics.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Debond
{
  /** A calibration that is done: what summary files and console tell. */
  struct Calibration
  {
    std::string          directory;
    std::vector<Optimum> optima; ///< with different curves, best first
    std::unique_ptr<FitStatistics> statistics; ///< of the best
    Evaluation                     at_best;
    bool                           by_closed_form = false;

    /** An experiment that has not been done: by how much it would shrink the
     *  95 % intervals. */
    struct Candidate
    {
      unsigned int    experiment;
      Eigen::VectorXd half_widths; ///< of what is searched
    };
    std::vector<Candidate> candidates;

    /** Fits in which one unknown was held. */
    struct ProfilePoint
    {
      unsigned int    unknown;
      double          value, chi_squared; ///< above that of the best fit
      Eigen::VectorXd unknowns;
    };
    std::vector<ProfilePoint> profiles;

    unsigned int n_evaluations = 0; ///< of the scene's model
    Failures     failures;
    double       seconds = 0;
  };

  /**
   * Finds the unknowns of a scene, see Unknowns, from measured curves: one
   * experiment for each variant of the scene, of which those without a
   * `Reference curve` have not been done yet and are judged as candidates.
   *
   * Searches from many starts with the closed form of the scene if there is
   * one, else with the scene itself; follows the best of them to their ends;
   * and goes on from there with the scene's own model. Writes calibration.json,
   * fit.csv, profile.csv and fitted.prm. A calibration that was interrupted
   * goes on if it is run again, and ends with the same digits.
   *
   * Throws InputError, RunError if nothing that was found comes close enough,
   * and Interrupted.
   */
  void
  run_calibration(const std::vector<SceneEntry> &entries,
                  const std::string             &name,
                  unsigned int                   n_threads,
                  bool                           force,
                  std::ostream                  &out);

  /** Whether entries say `Task = calibrate`. */
  bool
  is_calibration(const std::vector<SceneEntry> &entries);

  /** Says what would be done. */
  void
  check_calibration(const std::vector<SceneEntry> &entries,
                    const std::string             &name,
                    std::ostream                  &out);

  /** Writes the files of a calibration, and what matters to @p out. */
  void
  report(const Calibration &calibration,
         const Misfit      &misfit,
         std::ostream      &out);
} // namespace Debond
#endif
