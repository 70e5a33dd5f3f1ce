#include <debond/output/console.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
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
    const ClassicNumbers classic(out);
    out << std::setw(7) << row.step << ' ' << std::setw(10)
        << fixed_text(rounded(row.angle_deg), 4) << ' ' << std::setw(11)
        << fixed_text(rounded(row.torque_Nmm), 4) << ' ' << std::setw(13)
        << fixed_text(rounded(row.pressure_MPa), 4) << ' ' << std::setw(11)
        << fixed_text(100. * row.share_slip, 1) << ' ' << std::setw(11)
        << row.newton_iterations << '\n';
  }



  void
  Console::show_progress_of(const TorqueRow &row, const unsigned int n_steps)
  {
    const unsigned int n_phases = times.size() - 1;
    const unsigned int phase =
      std::lower_bound(times.begin() + 1, times.end() - 1, row.time) -
      times.begin();
    const double length = times.back() - times.front();
    progress.show("phase " + std::to_string(phase) + " of " +
                    std::to_string(n_phases) + ", " +
                    fixed_text(rounded(row.angle_deg), 4) + " deg, " +
                    fixed_text(rounded(row.torque_Nmm), 4) + " N mm",
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
