#include <debond/input/allowed_values.h>
#include <debond/output/console.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <boost/algorithm/string/replace.hpp>

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



    /** "uz/mm" of chuck_uz_mm. */
    std::string
    in_head(std::string column)
    {
      column[column.rfind('_')] = '/';
      return boost::replace_first_copy(column, "chuck_", "");
    }
  } // namespace



  Console::Console(const bool                 quiet,
                   const std::vector<double> &times,
                   const CurveAxes           &axes,
                   std::ostream              &out)
    : quiet(quiet)
    , times(times)
    , axes(axes)
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
      out << "   step " << std::setw(10) << in_head(axes.position_column())
          << ' ' << std::setw(11) << in_head(axes.load_column())
          << "  pressure/MPa  slipping/%  iterations\n";
    columns_named               = true;
    const auto [position, load] = curve_of({row}, axes).front();
    out << std::string(
      Text() << std::setw(7) << row.step << ' ' << std::setw(10)
             << fixed_text(rounded(position), 4) << ' ' << std::setw(11)
             << fixed_text(rounded(load), 4) << ' ' << std::setw(13)
             << fixed_text(rounded(row.pressure_MPa), 4) << ' ' << std::setw(11)
             << fixed_text(100. * (row.share_slip + row.share_shears), 1) << ' '
             << std::setw(11) << row.newton_iterations << '\n');
  }



  void
  Console::show_progress_of(const TorqueRow &row, const unsigned int n_steps)
  {
    const unsigned int n_phases = times.size() - 1;
    const unsigned int phase =
      std::lower_bound(times.begin() + 1, times.end() - 1, row.time) -
      times.begin();
    const double length         = times.back() - times.front();
    const auto [position, load] = curve_of({row}, axes).front();
    progress.show("phase " + std::to_string(phase) + " of " +
                    std::to_string(n_phases) + ", " +
                    fixed_text(rounded(position), 4) + " " +
                    axes.position_unit() + ", " + fixed_text(rounded(load), 4) +
                    " " + axes.load_unit(),
                  n_steps > 0 ? double(row.step) / n_steps :
                                (row.time - times.front()) / length);
  }



  void
  Console::warn(const std::string &key, const std::string &text)
  {
    if (text.empty() || is_among(warning_keys, key))
      return;
    warning_keys.push_back(key);
    warnings.push_back(text);
    out << "warning: " << text << std::endl;
  }
} // namespace Debond
