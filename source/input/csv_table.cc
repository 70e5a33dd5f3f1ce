#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/input/input_file.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/tokenizer.hpp>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Debond
{
  namespace
  {
    /** Calls work(line number, text) for the lines that are neither empty nor
     *  comments, without blanks at their ends. */
    template <typename Work>
    void
    for_each_line(const std::string &filename,
                  const std::string &entry,
                  const Work        &work)
    {
      constexpr unsigned int largest_MB = 200;
      const auto             refuse     = [&](const std::string &why) {
        throw EntryError(entry, why, filename);
      };
      Classic<std::istringstream> file(
        plain_text(read_input_bytes(filename, refuse, largest_MB), refuse));
      std::string text;
      for (unsigned int number = 1; std::getline(file, text); ++number)
        {
          text = dealii::Utilities::trim(text);
          if (!text.empty() && text[0] != '#')
            work(number, text);
        }
    }



    /** Fields of a line, without blanks around them; other programs put names
     *  and numbers into quotes, which may hold commas. */
    std::vector<std::string>
    fields_of(const std::string &line)
    {
      if (line.find('"') == std::string::npos)
        return split_list(line);
      using Separator = boost::escaped_list_separator<char>;
      // no character escapes another one
      const boost::tokenizer<Separator> fields(line, Separator("", ",", "\""));
      std::vector<std::string>          items(fields.begin(), fields.end());
      for (std::string &item : items)
        boost::trim(item);
      return items;
    }



    /** Numbers of the columns called @p names; refuses the line if one is
     *  missing. */
    std::vector<std::size_t>
    columns_called(const std::vector<std::string> &names,
                   const std::vector<std::string> &header,
                   const FileRefusal              &refuse)
    {
      std::vector<std::size_t> columns;
      for (const std::string &name : names)
        {
          const auto found = std::find(header.begin(), header.end(), name);
          if (found == header.end())
            refuse("the first line must name the columns, separated by "
                   "commas, " +
                   boost::join(names, ", ") + " among them; there is no '" +
                   name + "'");
          if (std::count(header.begin(), header.end(), name) > 1)
            refuse("there are two columns '" + name + "'");
          columns.push_back(found - header.begin());
        }
      return columns;
    }
  } // namespace



  std::vector<std::string>
  read_csv_header(const std::string &filename, const std::string &entry)
  {
    std::vector<std::string> header;
    for_each_line(filename, entry, [&](unsigned int, const auto &line) {
      if (header.empty())
        header = split_list(line);
    });
    return header;
  }



  std::vector<std::vector<double>>
  read_csv_columns(const std::string              &filename,
                   const std::string              &entry,
                   const std::vector<std::string> &names,
                   const bool                      nan_is_allowed,
                   std::vector<unsigned int>      *line_numbers)
  {
    std::vector<std::vector<double>> rows;
    std::vector<std::size_t>         columns;
    std::size_t                      n_columns = 0;
    for_each_line(
      filename, entry, [&](const unsigned int number, const std::string &line) {
        const auto items  = fields_of(line);
        const auto refuse = [&](const std::string &why) {
          throw EntryError(entry,
                           "line " + std::to_string(number) + ": " + why,
                           filename);
        };
        if (n_columns == 0)
          {
            columns   = columns_called(names, items, refuse);
            n_columns = items.size();
            return;
          }
        if (items.size() > n_columns)
          refuse(std::to_string(items.size()) + " values for " +
                 std::to_string(n_columns) +
                 " columns (decimals are written with a point)");
        if (line_numbers != nullptr)
          line_numbers->push_back(number);
        std::vector<double> &row = rows.emplace_back();
        for (std::size_t i = 0; i < names.size(); ++i)
          {
            if (columns[i] >= items.size())
              refuse("no value for " + names[i]);
            const std::string &item  = items[columns[i]];
            const auto         value = nan_is_allowed && item == "nan" ?
                                         std::numeric_limits<double>::quiet_NaN() :
                                         read_number(item);
            if (!value)
              refuse("'" + item + "' is no number (" + names[i] + ")" +
                     (item.find(',') == item.npos ?
                        "" :
                        ": decimals are written with a point"));
            row.push_back(*value);
          }
      });
    if (rows.empty())
      throw EntryError(entry,
                       "this file holds no row of numbers; expected are a "
                       "line " +
                         boost::join(names, ",") + " and rows below",
                       filename);
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
