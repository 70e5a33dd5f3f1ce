#include <debond/output/console.h>
#include <debond/support/ranks.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace Debond
{
  Console::Console(const bool quiet, std::ostream &out)
    : quiet(quiet)
    , out(out)
    // mpirun writes to a terminal of its own, whatever becomes of it
    , on_terminal(&out == &std::cout && isatty(STDOUT_FILENO) &&
                  !Ranks::are_launched())
    , start(std::chrono::steady_clock::now())
  {}



  void
  Console::erase_progress()
  {
    if (progress_shown)
      out << "\r\033[K";
    progress_shown = false;
  }



  void
  Console::headline(const std::string &text)
  {
    if (!quiet)
      out << text << std::endl;
  }



  void
  Console::row(const TorqueRow &row, const unsigned int n_steps)
  {
    // of very many planned steps some hundred lines tell as much
    const unsigned int stride = std::max(1U, n_steps / 100);
    if (quiet || (row.step % stride != 0 && row.step != n_steps))
      return;
    erase_progress();
    if (!columns_named)
      out
        << "   step  angle/deg  torque/Nmm  pressure/MPa  slipping/%  iterations\n";
    columns_named = true;
    char line[120];
    // no negative zeros
    const auto rounded = [](const double value) {
      return std::abs(value) < 5e-5 ? 0. : value;
    };
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
    if (!on_terminal || row.step <= first_step || row.step >= n_steps)
      return;
    const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
    std::snprintf(line,
                  sizeof(line),
                  "%5.1f %% done, %.0f s so far, about %.0f s to go",
                  100. * row.step / n_steps,
                  seconds.count(),
                  seconds.count() * (n_steps - row.step) /
                    (row.step - first_step));
    out << line << std::flush;
    progress_shown = true;
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
    erase_progress();
    out << "warning: " << text << std::endl;
  }
} // namespace Debond
