#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/input/input_file.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Debond
{
  namespace
  {
    /** Where in a file we are, for messages. */
    struct Line
    {
      const std::string &entry;
      const std::string &filename;
      unsigned int       number;

      [[noreturn]] void
      refuse(const std::string &message) const
      {
        throw EntryError(entry,
                         "line " + std::to_string(number) + ": " + message,
                         filename);
      }
    };



    /** Numbers of the columns called @p names; refuses the line if one is
     *  missing. */
    std::vector<unsigned int>
    columns_called(const std::vector<std::string> &names,
                   const std::vector<std::string> &header,
                   const Line                     &line)
    {
      std::vector<unsigned int> columns;
      for (const std::string &name : names)
        {
          const auto found = std::find(header.begin(), header.end(), name);
          if (found == header.end())
            line.refuse("the first line must name the columns, separated by "
                        "commas, " +
                        boost::join(names, ", ") +
                        " among them; there is no '" + name + "'");
          if (std::count(header.begin(), header.end(), name) > 1)
            line.refuse("there are two columns '" + name + "'");
          columns.push_back(found - header.begin());
        }
      return columns;
    }



    double
    number_in(const std::vector<std::string> &items,
              const unsigned int              column,
              const std::string              &name,
              const bool                      nan_is_allowed,
              const Line                     &line)
    {
      if (column >= items.size())
        line.refuse("no value for " + name);
      if (nan_is_allowed && items[column] == "nan")
        return std::numeric_limits<double>::quiet_NaN();
      double value = 0;
      if (!read_number(items[column], value))
        line.refuse("'" + items[column] + "' is no number (" + name + ")");
      return value;
    }



    std::istringstream
    open_table(const std::string &filename, const std::string &entry)
    {
      constexpr unsigned int largest_MB = 200;
      const auto             refuse     = [&](const std::string &why) {
        throw EntryError(entry, why, filename);
      };
      return std::istringstream(read_input_text(filename, refuse, largest_MB));
    }



    /** The items of the next line that is neither empty nor a comment; false at
     *  the end of the file. */
    bool
    next_items(std::istream             &file,
               unsigned int             &line_number,
               std::vector<std::string> &items)
    {
      std::string text;
      while (std::getline(file, text))
        {
          ++line_number;
          text = dealii::Utilities::trim(text);
          if (text.empty() || text[0] == '#')
            continue;
          items = split_list(text);
          return true;
        }
      return false;
    }
  } // namespace



  std::vector<std::string>
  read_csv_header(const std::string &filename, const std::string &entry)
  {
    std::istringstream       file        = open_table(filename, entry);
    unsigned int             line_number = 0;
    std::vector<std::string> items;
    next_items(file, line_number, items);
    return items;
  }



  std::vector<std::vector<double>>
  read_csv_columns(const std::string              &filename,
                   const std::string              &entry,
                   const std::vector<std::string> &names,
                   const bool                      nan_is_allowed,
                   std::vector<unsigned int>      *line_numbers)
  {
    std::istringstream file = open_table(filename, entry);

    std::vector<std::vector<double>> rows;
    std::vector<unsigned int>        columns;
    std::size_t                      n_columns = 0;
    Line                             line{entry, filename, 0};
    std::vector<std::string>         items;
    while (next_items(file, line.number, items))
      {
        if (columns.empty())
          {
            columns   = columns_called(names, items, line);
            n_columns = items.size();
            continue;
          }
        if (items.size() > n_columns)
          line.refuse(std::to_string(items.size()) + " values for " +
                      std::to_string(n_columns) +
                      " columns (decimals are written with a point)");
        if (line_numbers != nullptr)
          line_numbers->push_back(line.number);
        std::vector<double> row;
        for (std::size_t i = 0; i < names.size(); ++i)
          row.push_back(
            number_in(items, columns[i], names[i], nan_is_allowed, line));
        rows.push_back(std::move(row));
      }
    if (rows.empty())
      {
        throw EntryError(entry,
                         "this file holds no row of numbers; expected are a "
                         "line " +
                           boost::join(names, ",") + " and rows below",
                         filename);
      }
    return rows;
  }



  std::string
  csv_line(const std::vector<std::string> &texts)
  {
    std::vector<std::string> fields = texts;
    for (std::string &field : fields)
      if (field.find_first_of(",\"\n") != std::string::npos)
        field = '"' + boost::replace_all_copy(field, "\"", "\"\"") + '"';
    return boost::join(fields, ",") + "\n";
  }



  std::string
  csv_line(const std::vector<double> &numbers)
  {
    std::vector<std::string> texts;
    for (const double number : numbers)
      texts.push_back(to_text(number + 0.)); // no "-0"
    return csv_line(texts);
  }
} // namespace Debond
