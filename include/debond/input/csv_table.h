#pragma once

#include <string>
#include <vector>

namespace Debond
{
  /**
   * Reads columns of a CSV file whose first line names them. Others than
   * @p names are ignored, as are empty lines and lines that begin with `#`.
   * The result has a row for each row of the file, with the values in the order
   * of @p names.
   *
   * @p line_numbers: where the rows are in the file, if that is of interest.
   *
   * Throws InputError that names the @p entry of the scene which gave the file,
   * the file, the line and what was expected. Numbers are finite; with
   * @p nan_is_allowed `nan` is read as such.
   */
  std::vector<std::vector<double>>
  read_csv_columns(const std::string              &filename,
                   const std::string              &entry,
                   const std::vector<std::string> &names,
                   bool                            nan_is_allowed = false,
                   std::vector<unsigned int>      *line_numbers   = nullptr);

  /** The names of the columns, from the first line that is no comment; empty
   *  if there is none. Throws InputError if the file cannot be read. */
  std::vector<std::string>
  read_csv_header(const std::string &filename, const std::string &entry);

  /** A line of a CSV file. Texts are quoted if they have to be, numbers have
   *  twelve significant digits. */
  std::string
  csv_line(const std::vector<std::string> &texts);
  std::string
  csv_line(const std::vector<double> &numbers);
} // namespace Debond
