#ifndef debond_output_console_h
#define debond_output_console_h

#include <debond/output/result_files.h>
#include <debond/output/torque_curve.h>

#include <chrono>
#include <iosfwd>
#include <string>
#include <vector>

namespace Debond
{
  /** What a run says on its standard output: lines about the steps, one of
   *  progress that is overwritten if the output is a terminal, warnings. */
  class Console
  {
  public:
    Console(bool quiet, std::ostream &out);

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

    const bool quiet; ///< warnings only
    /** The steps up to this one were not this run's: its pace is that of those
     *  that follow. */
    unsigned int             first_step = 0;
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
    erase_progress();

    std::ostream            &out;
    const bool               on_terminal;
    bool                     progress_shown = false, columns_named = false;
    std::vector<std::string> warning_keys;
    const std::chrono::steady_clock::time_point start;
  };
} // namespace Debond
#endif
