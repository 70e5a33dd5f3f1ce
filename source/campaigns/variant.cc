#include <debond/campaigns/variant.h>
#include <debond/output/torque_curve.h>
#include <debond/support/number_text.h>
#include <debond/support/sample_statistics.h>

#include <boost/algorithm/string/join.hpp>

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Debond
{
  std::string
  member(const StudyRow &members, const std::string &name)
  {
    for (const auto &[other, value] : members)
      if (other == name)
        return value;
    return "";
  }



  void
  set_member(StudyRow          &members,
             const std::string &name,
             const std::string &value)
  {
    for (auto &[other, text] : members)
      if (other == name)
        text = value;
  }



  namespace
  {
    /** A member of a summary as a field of a table: lists joined, null as nan.
     */
    std::string
    text_of(const nlohmann::ordered_json &value)
    {
      if (value.is_string())
        return value;
      if (value.is_number_float())
        return to_text(value);
      if (value.is_array())
        return boost::join(value.get<std::vector<std::string>>(), "; ");
      return value.is_null() ? "nan" : value.dump();
    }



    /** StudyRow of a summary.json. Empty if there is none. */
    StudyRow
    read_summary(const std::string &filename)
    {
      const nlohmann::ordered_json summary = read_json(filename);
      StudyRow                     members;
      for (const auto &[name, value] : summary.items())
        members.emplace_back(name, text_of(value));
      return members;
    }



    /** Gives the members that are seconds the medians over all runs. */
    void
    take_medians(StudyRow &summary, const std::vector<StudyRow> &repetitions)
    {
      for (auto &[name, text] : summary)
        if (name == "wall_seconds" || name.rfind("seconds_", 0) == 0)
          {
            std::vector<double> seconds;
            for (const StudyRow &repetition : repetitions)
              seconds.push_back(std::atof(member(repetition, name).c_str()));
            text = to_text(sample_statistics(std::move(seconds)).p50);
          }
    }



    std::string
    repetition_file(const std::string &directory, const unsigned int number)
    {
      return directory + "/repetition-" + std::to_string(number) + ".json";
    }



    /** Distance of one torque curve from another, both from files. */
    CurveMeasures
    compare_curves(const std::string &file, const std::string &reference_file)
    {
      std::vector<TorqueRow> rows;
      for (const auto &[angle, torque] : read_reference_curve(file))
        {
          rows.emplace_back();
          rows.back().angle_deg  = angle;
          rows.back().torque_Nmm = torque;
        }
      CurveSettings settings;
      settings.reference = read_reference_curve(reference_file);
      return measure_torque_curve(rows, settings);
    }



    using NamedNumbers = std::vector<std::pair<std::string, double>>;

    NamedNumbers
    all_measures(const CurveMeasures &curve, const ProfileMeasures &local)
    {
      NamedNumbers measures = error_measures(curve);
      for (const auto &measure : error_measures(local))
        measures.push_back(measure);
      return measures;
    }



    /** Columns of study.csv that compare the results in one directory with
     *  those in another: torque curve and, if both have them, profiles. */
    NamedNumbers
    compare(const std::string &directory, const std::string &reference)
    {
      ProfileMeasures   local;
      const std::string own      = directory + "/profiles.csv",
                        expected = reference + "/profiles.csv";
      if (std::filesystem::exists(own) && std::filesystem::exists(expected))
        local = compare_profiles(read_profiles(own), read_profiles(expected));
      return all_measures(compare_curves(directory + "/torque.csv",
                                         reference + "/torque.csv"),
                          local);
    }
  } // namespace



  void
  Variant::look_up()
  {
    const OutputParameters &output = scene.output;
    content = content_of_result_directory(output, scene.completed_parameters);
    if (content == DirectoryContent::same_scene)
      summary = read_summary(output.directory + "/summary.json");
    done = member(summary, "converged") == "true" &&
           std::filesystem::exists(output.directory + "/torque.csv");
    if (n_repetitions == 1)
      return;
    repetitions.clear();
    while (repetitions.size() < n_repetitions)
      {
        const StudyRow next = read_summary(
          repetition_file(output.directory, repetitions.size() + 1));
        if (next.empty())
          break;
        repetitions.push_back(next);
      }
    if (!repetitions.empty())
      take_medians(summary, repetitions);
    done = done && repetitions.size() == n_repetitions;
  }



  // The next run writes a new summary in the place of this one.
  void
  Variant::keep_repetition() const
  {
    const std::string &place = scene.output.directory;
    std::ostringstream text;
    text << std::ifstream(place + "/summary.json").rdbuf();
    write_file(repetition_file(place, repetitions.size() + 1), text.str());
  }



  void
  Variant::forget_repetitions()
  {
    const std::string &place = scene.output.directory;
    std::error_code    none;
    for (unsigned int i = 1;
         std::filesystem::remove(repetition_file(place, i), none);
         ++i)
      ;
    repetitions.clear();
  }



  bool
  Variant::wants_another_run() const
  {
    return n_repetitions > 1 && failure.empty() &&
           member(summary, "converged") == "true" &&
           repetitions.size() < n_repetitions;
  }



  void
  Variant::end_run(const std::string &why_failed)
  {
    failure = why_failed;
    if (n_repetitions > 1 && failure.empty())
      keep_repetition();
    look_up();
    done = done && failure.empty();
  }



  void
  Variant::compare_with(const Variant &other)
  {
    if (compared)
      return;
    compared = done && other.done;
    for (const auto &[name, value] :
         compared ?
           compare(scene.output.directory, other.scene.output.directory) :
           all_measures({}, {}))
      set_member(summary, name, to_text(value));
  }
} // namespace Debond
