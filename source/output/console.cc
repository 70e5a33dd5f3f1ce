#include <debond/output/console.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace Debond
{
  namespace
  {
    /** For all ranks but the one that speaks. */
    std::ostream unheard(nullptr);



    /** No negative zeros. */
    double
    rounded(const double value)
    {
      return std::abs(value) < 5e-5 ? 0. : value;
    }
  } // namespace



  Console::Console(const bool                 quiet,
                   const std::vector<double> &times,
                   std::ostream              &out)
    : quiet(quiet)
    , times(times)
    , out(Ranks::is_first() ? out : unheard)
  {}



  void
  Console::headline(const std::string &text)
  {
    if (!quiet)
      out << text << std::endl;
  }



  // On a terminal the last row is enough; a file keeps them, of very many
  // planned ones a hundred, which tell as much.
  void
  Console::row(const TorqueRow &row, const unsigned int n_steps)
  {
    if (quiet)
      return;
    if (progress_is_shown())
      return show_progress_of(row, n_steps);
    const unsigned int stride = std::max(1U, n_steps / 100);
    if (row.step % stride != 0 && row.step != n_steps)
      return;
    if (!columns_named)
      out
        << "   step  angle/deg  torque/Nmm  pressure/MPa  slipping/%  iterations\n";
    columns_named = true;
    char line[120];
    std::snprintf(line,
                  sizeof(line),
                  "%7u %10.4f %11.4f %13.4f %11.1f %11u\n",
                  row.step,
                  rounded(row.angle_deg),
                  rounded(row.torque_Nmm),
                  rounded(row.pressure_MPa),
                  100. * row.share_slip,
                  row.newton_iterations);
    out << line;
  }



  void
  Console::show_progress_of(const TorqueRow &row, const unsigned int n_steps)
  {
    const unsigned int n_phases = times.size() - 1;
    const unsigned int phase =
      std::lower_bound(times.begin() + 1, times.end() - 1, row.time) -
      times.begin();
    const double length = times.back() - times.front();
    char         text[120];
    std::snprintf(text,
                  sizeof(text),
                  "phase %u of %u, %.4f deg, %.4f N mm",
                  phase,
                  n_phases,
                  rounded(row.angle_deg),
                  rounded(row.torque_Nmm));
    progress.show(text,
                  n_steps > 0 ? double(row.step) / n_steps :
                                (row.time - times.front()) / length);
  }



  void
  Console::warn(const std::string &key, const std::string &text)
  {
    if (text.empty() ||
        std::find(warning_keys.begin(), warning_keys.end(), key) !=
          warning_keys.end())
      return;
    warning_keys.push_back(key);
    warnings.push_back(text);
    out << "warning: " << text << std::endl;
  }
} // namespace Debond
