#pragma once

#include <debond/scene/scene.h>
#include <debond/support/written_files.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace Debond
{
  /** Moves the curve, summary and parameters of a run into the folder
   *  `coarser` of its directory, for the run that follows. @p
   *  completed_parameters: of what would have given the same. */
  void
  keep_as_coarser(const std::string &directory,
                  const std::string &completed_parameters);

  /** The directory that a run writes to. No other process can open it while
   * this object or a copy of it lives; that process gets an InputError. */
  class ResultDirectory
  {
  public:
    /** Creates the directory and writes parameters.prm, the text of
     *  @p completed_parameters, into it. Throws InputError that begins with the
     *  name of the entry if this is impossible, or if there is a parameters.prm
     *  with another text and @p output does not allow to overwrite it. If it
     *  does, the results of that other scene are removed first. */
    ResultDirectory(const OutputParameters &output,
                    const std::string      &completed_parameters);
    /** A directory that holds the results of an earlier run, which goes on. */
    explicit ResultDirectory(const std::string &path);

    /** The directory, without a slash at its end. */
    const std::string &
    path() const
    {
      return directory;
    }

    /** Writes parameters.prm. Throws WriteError. */
    void
    write_parameters(const std::string &completed_parameters) const;

    /** The path of the file @p name in the directory. */
    std::string
    file(const std::string &name) const
    {
      return directory + "/" + name;
    }

  private:
    std::string   directory;
    DirectoryLock lock;
  };

  /** The completed parameters of the scene whose results are in a directory:
   *  its parameters.prm without the first line, which says when it was written
   *  and by what. None if there is no such file. */
  std::optional<std::string>
  parameters_in(const std::string &directory);

  /** The file in a directory of results with the finest curve: curve.csv, or
   *  that of the rows where there is none, see CurveAxes::rows_file(). */
  std::string
  finest_curve(const std::string &directory);

  /** Writes report.html of the results in a directory, by Python; the first
   *  rank does. Returns whether there is one; why there is none has been said.
   *  Throws RunError if it cannot be written. */
  bool
  write_page(const std::string &directory);

  /** Writes a JSON object with its members in their order and every digit;
   *  what is not finite becomes `null`. Throws WriteError. */
  void
  write_json(const std::string &filename, const nlohmann::ordered_json &json);

  /** The object in a file, for instance a summary.json; one without members if
   *  there is no such file, or something else in it. */
  nlohmann::ordered_json
  read_json(const std::string &filename);

  /** A number of a summary; NaN if there is none of this name. */
  double
  number_in(const nlohmann::ordered_json &summary, const std::string &name);
} // namespace Debond
