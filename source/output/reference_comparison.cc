#include <debond/input/csv_table.h>
#include <debond/input/input_file.h>
#include <debond/output/curve_comparison.h>
#include <debond/output/profile_output.h>
#include <debond/output/reference_comparison.h>
#include <debond/output/result_files.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>

namespace Debond
{
  void
  write_reference(const std::string    &directory,
                  const ReferenceCurve &curve,
                  const CurveAxes      &axes)
  {
    std::string text = axes.position_column() + "," + axes.load_column() + "\n";
    for (const auto &[position, load] : curve)
      text += csv_line(std::vector<double>{position, load});
    write_file(directory + "/reference.csv", text);
  }



  std::map<std::string, std::string>
  reference_files(const OutputParameters &output)
  {
    std::map<std::string, std::string> files;
    for (const auto &[what, file] :
         {std::make_pair("curve", output.reference_curve),
          std::make_pair("profiles", output.reference_profiles)})
      if (!file.empty())
        files[what] =
          boost::trim_copy_if(identity_of(file), boost::is_any_of("# \n"));
    return files;
  }



  bool
  has_other_references(const OutputParameters       &output,
                       const nlohmann::ordered_json &summary)
  {
    const nlohmann::ordered_json now   = reference_files(output);
    const auto                   found = summary.find("reference_files");
    return found == summary.end() ? !now.empty() : *found != now;
  }



  namespace
  {
    void
    erase_texts(nlohmann::ordered_json &list, const std::string &beginning)
    {
      nlohmann::ordered_json others = nlohmann::ordered_json::array();
      for (const std::string text : list)
        if (!boost::starts_with(text, beginning))
          others.push_back(text);
      list = others;
    }



    /** Writes the distances into the @p summary of results in a directory. */
    void
    compare_anew(const OutputParameters &output,
                 const std::string      &directory,
                 nlohmann::ordered_json &summary)
    {
      const auto           files = reference_files(output);
      const CurveAxes     &axes  = output.axes;
      const ReferenceCurve curve = read_reference_curve(finest_curve(directory),
                                                        {},
                                                        axes),
                           measured =
                             read_reference_curve(output.reference_curve,
                                                  output.reference_columns,
                                                  axes);
      erase_texts(summary["remarks"], CurveComparison::remark_begins);
      if (!measured.empty())
        {
          erase_texts(summary["warnings"], output.reference_curve);
          write_reference(directory, measured, axes);
          const CurveComparison comparison(curve, measured, axes);
          comparison.put_into(summary);
          for (const std::string &text :
               comparison.warnings(output.reference_curve))
            summary["warnings"].push_back(text);
        }
      const std::string profiles = directory + "/profiles.csv";
      if (!output.reference_profiles.empty() &&
          std::filesystem::exists(profiles))
        summary.update(
          compare_profiles(read_profiles(profiles),
                           read_profiles(output.reference_profiles)));
      summary["reference_files"] = files;
      write_json(directory + "/summary.json", summary);
    }
  } // namespace



  bool
  compare_anew_if_changed(const OutputParameters &output,
                          const std::string      &directory)
  {
    auto summary = read_json(directory + "/summary.json");
    if (!has_other_references(output, summary))
      return false;
    compare_anew(output, directory, summary);
    return true;
  }
} // namespace Debond
