#ifndef debond_tests_expectations_h
#define debond_tests_expectations_h

// What comments of scenes say that their results must be:
//
//   T_max_Nmm = 50.32 within 0.1 %  (where the number is from)
//   converged = 1 within 0
//   T_max_Nmm below 60
//   T_max_Nmm above 40
//   difference_max below error_estimate
//   torque_Nmm at angle_deg 0.05 = 31.32 within 0.15 %
//   torque_Nmm at angle_deg 0.05 above 31
//   energy_defect max below 1e-3
//   force_N ripple after time 1 below 0.01
//   T_max_Nmm of variant 3 = 50.32 within 0.1 %
//   torque_Nmm of variant 3 at angle_deg 0.05 above 31
//   difference_max of every level below estimate
//   estimate of every level 10 % off tolerance
//
// A name alone is a key of summary.json (true counts as 1), in a study a column
// of study.csv; so may the bound of `below' and `above' be. `at COLUMN VALUE`
// is the last row of the run with that value in that column, `max` the
// largest absolute value in a column, `ripple after COLUMN VALUE` the largest
// less the smallest value, relative to their mean, in rows where the other
// column is at least that. Levels are those of Model = auto, in all variants,
// and the estimate that of auto.csv: an answer that is expected must not hang
// on an estimate next to the tolerance of its scene. A tolerance without % is
// absolute.

#include <map>
#include <string>
#include <vector>

namespace Expectations
{
  /** A file of numbers whose first line names the columns. */
  struct Table
  {
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> rows;

    /** Number of a column; throws std::runtime_error if there is none. */
    std::size_t
    column(const std::string &name) const;
  };

  /** What a run has written. */
  struct Results
  {
    std::string                   directory;
    Table                         table;   ///< the rows
    std::map<std::string, double> summary; ///< its numbers and booleans
  };

  struct Verdict
  {
    std::string expectation;
    bool        is_met      = false;
    bool        is_readable = true; ///< false: it cannot be evaluated
    std::string line;     ///< "ok: EXPECTATION" or "FAILED: EXPECTATION: ..."
    std::string measured; ///< the value, or what is wrong with it
    /** The value (of levels that nearest to the limit, in parts of the estimate
     *  or the tolerance), and the ends of the band that it must be in. */
    double value = 0., low = 0., high = 0.;
  };

  /** All of a file. Throws std::runtime_error if it cannot be read. */
  std::string
  contents_of(const std::string &filename);

  /** The results in a directory. */
  Results
  read_results(const std::string &directory);

  /** The results of a calibration: best values of unknowns under their names,
   *  widths of their 95 % intervals as NAME_width, half widths with a candidate
   *  as NAME_after_experiment_2, the first curve's e_mp and e_rel. */
  Results
  read_calibration(const std::string &directory);

  /** The results of each variant of a study: the numbers in its row of
   * study.csv and its torque curve. */
  std::vector<Results>
  read_study(const std::string &directory);

  /** What follows @p keyword in comment lines of the scene. */
  std::vector<std::string>
  comments(const std::string &scene_text, const std::string &keyword);

  /** The arguments of the options `--set ENTRY=VALUE`, quoted or not, in
   *  @p text. */
  std::vector<std::string>
  overrides(const std::string &text);

  /** Whether @p results, one for each variant of a study or one alone, are as
   *  @p expectation says. */
  Verdict
  judge(const std::string &expectation, const std::vector<Results> &results);

  /** Writes values and bands, for tests/spread.py, to expectations.csv in
   *  @p directory. */
  void
  write_verdicts(const std::vector<Verdict> &verdicts,
                 const std::string          &directory);
} // namespace Expectations
#endif
