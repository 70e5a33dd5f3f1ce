#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/input/input_file.h>
#include <debond/input/measured_table.h>
#include <debond/support/input_error.h>
#include <debond/support/laboratory.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/join.hpp>

#include <optional>
#include <sstream>

namespace Debond
{
  namespace
  {
    using Rows = std::vector<std::vector<double>>;

    std::optional<Rows>
    read_plain(const std::string              &filename,
               const std::string              &entry,
               const std::vector<std::string> &names)
    {
      try
        {
          return read_csv_columns(filename, entry, names);
        }
      catch (const EntryError &)
        {
          return {};
        }
    }



    /** Rows below a line of names. */
    Rows
    rows_of(const std::string &text)
    {
      Classic<std::istringstream> lines(text);
      std::string                 line;
      Rows                        rows;
      std::getline(lines, line);
      while (std::getline(lines, line))
        {
          rows.emplace_back();
          for (const std::string &item : split_list(line))
            rows.back().push_back(read_number(item).value());
        }
      return rows;
    }
  } // namespace



  std::vector<std::vector<double>>
  read_measured_table(const std::string              &filename,
                      const std::string              &entry,
                      const std::vector<std::string> &names,
                      const std::vector<std::string> &choice,
                      const std::string              &choice_entry)
  {
    constexpr unsigned int largest_MB = 200;
    const auto             refuse     = [&](const std::string &why) {
      throw EntryError(entry, why, filename);
    };
    read_input_bytes(filename, refuse, largest_MB); // refuses what is no file
    if (choice.empty())
      if (const auto rows = read_plain(filename, entry, names))
        return *rows;
    std::string output;
    const int   code = Laboratory::run("measured",
                                     {filename,
                                        "--curves=" + boost::join(names, ","),
                                        "--columns=" + boost::join(choice, ","),
                                        "--entry=" + entry,
                                        "--columns-entry=" + choice_entry},
                                     &output);
    if (code == 0)
      return rows_of(output);
    // of a table that is refused: the entry, its value, and why
    Classic<std::istringstream> lines(output);
    std::string                 of_entry, value, why;
    if (code == 1 && std::getline(lines, of_entry) &&
        std::getline(lines, value) && std::getline(lines, why))
      throw EntryError(of_entry, why, value);
    refuse("this is no plain table, whose first line is " +
           boost::join(names, ",") + "; to read another one " +
           Laboratory::what_it_needs);
    return {};
  }
} // namespace Debond
