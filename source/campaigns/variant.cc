#include <debond/campaigns/variant.h>
#include <debond/output/reference_comparison.h>
#include <debond/output/torque_curve.h>
#include <debond/support/provenance.h>
#include <debond/support/ranks.h>

#include <boost/math/statistics/univariate_statistics.hpp>
#include <boost/range/algorithm_ext/erase.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace Debond
{
  namespace
  {
    /** Of those that are known; NaN of none. */
    double
    median_of(std::vector<double> values)
    {
      boost::remove_erase_if(values,
                             [](const double x) { return !std::isfinite(x); });
      return values.empty() ? std::numeric_limits<double>::quiet_NaN() :
                              boost::math::statistics::median(values);
    }
  } // namespace



  std::vector<std::string>
  names_of_variants(const std::vector<std::string>              &entries,
                    const std::vector<std::vector<std::string>> &values)
  {
    constexpr std::size_t many         = 4;
    std::size_t           most_changes = 0;
    for (const auto &row : values)
      {
        std::size_t n = 0;
        for (std::size_t e = 0; e < entries.size(); ++e)
          n += row[e] != values[0][e];
        most_changes = std::max(most_changes, n);
      }
    const bool only_changes =
      most_changes > 0 &&
      (entries.size() >= many || most_changes < entries.size());
    std::vector<std::string> names;
    for (const auto &row : values)
      {
        std::string text;
        for (std::size_t e = 0; e < entries.size(); ++e)
          if (!only_changes || row[e] != values[0][e])
            text += (text.empty() ? "" : "; ") + entries[e] + " = " + row[e];
        names.push_back(text.empty() && !entries.empty() ? "first values" :
                                                           text);
      }
    return names;
  }



  namespace
  {
    std::string
    repetition_file(const Variant &variant, const std::size_t number)
    {
      return variant.scene.output.directory + "/repetition-" +
             std::to_string(number) + ".json";
    }
  } // namespace



  void
  Variant::look_up()
  {
    const OutputParameters &output   = scene.output;
    const auto              existing = parameters_in(output.directory);
    has_this_scene                   = existing == scene.completed_parameters;
    has_other_scene                  = existing && !has_this_scene;
    if (has_this_scene)
      summary = read_json(output.directory + "/summary.json");
    done = summary.value("converged", false) &&
           std::filesystem::exists(rows_file(output.directory));
    const std::string program =
      summary.value("/provenance/program"_json_pointer, std::string());
    other_program = done && program != program_and_version() ? program : "";
    done          = done && other_program.empty();
    has_other_references =
      done && Debond::has_other_references(output, summary);
    if (n_repetitions == 1)
      return;
    repetitions.clear();
    while (repetitions.size() < n_repetitions)
      {
        const auto next =
          read_json(repetition_file(*this, repetitions.size() + 1));
        if (next.empty())
          break;
        repetitions.push_back(next);
      }
    // the members that are seconds are medians over all runs
    for (auto &member : summary.items())
      if (!repetitions.empty() && (member.key() == "wall_seconds" ||
                                   member.key().rfind("seconds_", 0) == 0))
        {
          std::vector<double> seconds;
          for (const auto &repetition : repetitions)
            seconds.push_back(number_in(repetition, member.key()));
          member.value() = median_of(std::move(seconds));
        }
    done = done && repetitions.size() == n_repetitions;
  }



  void
  Variant::forget_repetitions()
  {
    std::error_code none;
    for (unsigned int i = 1;
         Ranks::is_first() &&
         std::filesystem::remove(repetition_file(*this, i), none);
         ++i)
      ;
    repetitions.clear();
  }



  bool
  Variant::end_run(const std::string &why_failed)
  {
    failure = why_failed;
    // the next run writes a new summary in the place of this one
    if (n_repetitions > 1 && failure.empty())
      std::filesystem::copy_file(
        scene.output.directory + "/summary.json",
        repetition_file(*this, repetitions.size() + 1),
        std::filesystem::copy_options::overwrite_existing);
    look_up();
    done = done && failure.empty();
    return n_repetitions > 1 && failure.empty() &&
           summary.value("converged", false) &&
           repetitions.size() < n_repetitions;
  }



  void
  Variant::compare_with(const Variant &other)
  {
    if (compared)
      return;
    compared                         = done && other.done;
    nlohmann::ordered_json distances = CurveComparison().members();
    for (const char *const name :
         {"pressure_difference_rms", "slip_difference_rms"})
      distances[name] = std::numeric_limits<double>::quiet_NaN();
    distances["reference_angles_used"] = 0;
    if (compared)
      {
        const CurveAxes  &axes      = scene.output.axes;
        const std::string own       = scene.output.directory + "/",
                          reference = other.scene.output.directory + "/";
        distances.update(
          CurveComparison(
            read_reference_curve(finest_curve(own), {}, axes),
            read_reference_curve(finest_curve(reference), {}, axes),
            axes)
            .members());
        if (std::filesystem::exists(own + "profiles.csv") &&
            std::filesystem::exists(reference + "profiles.csv"))
          distances.update(
            compare_profiles(read_profiles(own + "profiles.csv"),
                             read_profiles(reference + "profiles.csv")));
      }
    for (const auto &[name, value] : distances.items())
      if (summary.contains(name))
        summary[name] = value;
  }
} // namespace Debond
