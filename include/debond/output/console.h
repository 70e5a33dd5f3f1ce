#pragma once

#include <debond/output/result_files.h>
#include <debond/output/torque_curve.h>
#include <debond/support/progress.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Debond
{
  /** What a run says on its standard output: lines about the steps, or one of
   *  progress if that is shown, and warnings. */
  class Console
  {
  public:
    /** @p times: `Load steps / Times`; @p axes: of the curve that is told. */
    Console(bool                       quiet,
            const std::vector<double> &times,
            const CurveAxes           &axes,
            std::ostream              &out);

    void
    headline(const std::string &text);
    /** The row that was just accepted, of @p n_steps planned ones (0: their
     *  number is not known). */
    void
    row(const TorqueRow &row, unsigned int n_steps);
    /** Printed the first time only; kept for the summary. An empty text is no
     *  warning. */
    void
    warn(const std::string &key, const std::string &text);

    const bool               quiet;    ///< warnings only
    std::vector<std::string> warnings; ///< those printed

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &warning_keys &warnings;
    }

  private:
    void
    show_progress_of(const TorqueRow &row, unsigned int n_steps);

    const std::vector<double> times;
    const CurveAxes           axes;
    std::ostream             &out;
    bool                      columns_named = false;
    std::vector<std::string>  warning_keys;
    Progress                  progress;
  };
} // namespace Debond
