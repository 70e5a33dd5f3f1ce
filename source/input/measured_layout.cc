#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/input/measured_layout.h>
#include <debond/input/measured_units.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>
#include <regex>
#include <sstream>

namespace Debond
{
  std::size_t
  n_filled(const MeasuredLayout::Items &items)
  {
    std::size_t n = items.size();
    while (n > 0 && items[n - 1].empty())
      --n;
    return n;
  }



  std::optional<double>
  read_measured_value(std::string item)
  {
    const std::size_t comma = item.find(',');
    if (comma != item.npos && comma + 1 < item.size() &&
        std::isdigit(item[comma + 1], std::locale::classic()) &&
        item.find_first_of(".,", comma + 1) == item.npos &&
        item.find('.') == item.npos)
      item[comma] = '.';
    if (const std::size_t at = item.find_first_of("dD");
        at != item.npos && at > 0)
      item[at] = 'e';
    const auto value = read_number(item);
    // SCPI, the language of many instruments, has 9.9E37 for infinity, and
    // 9.91E37 for what is no number
    return value && std::abs(*value) < 9.9e37 ? value : std::nullopt;
  }



  namespace
  {
    using Items = MeasuredLayout::Items;
    using Line  = MeasuredLayout::Line;

    std::vector<Line>
    lines_of(const std::string &text)
    {
      std::vector<Line>           lines;
      Classic<std::istringstream> stream(text);
      std::string                 line;
      for (unsigned int number = 1; std::getline(stream, line); ++number)
        {
          boost::trim_right_if(line, boost::is_any_of(" "));
          const std::string trimmed = boost::trim_copy(line);
          if (!trimmed.empty())
            lines.push_back({number,
                             line,
                             trimmed[0] == '#' || trimmed[0] == '%' ||
                               boost::starts_with(trimmed, "//")});
        }
      return lines;
    }



    /** The items of a line; with what separates behind the last one there are
     *  empty ones. */
    Items
    split_line(const std::string &line, const char separator)
    {
      if (separator != ' ')
        return split_csv_line(line, separator);
      Items items;
      if (line.find('\t') == std::string::npos)
        boost::split(items,
                     boost::trim_copy(line),
                     boost::is_any_of(" "),
                     boost::token_compress_on);
      return items;
    }



    bool
    is_whole_number(const std::string &item)
    {
      static const std::regex whole("[-+]?[0-9]+");
      return std::regex_match(item, whole);
    }



    enum class Item
    {
      number,
      nothing, ///< what instruments and spreadsheets write for no value
      time,    ///< a date or a time of day
      text
    };

    Item
    kind_of(const std::string &item)
    {
      static const std::regex time("[0-9]{1,4}([-./])[0-9]{1,2}\\1[0-9]{1,4}.*|"
                                   "[0-9]{1,2}:[0-9]{2}.*"),
        nothing("[-*?]*|.*#.*|"
                "[-+]?[0-9]+[.,]?[0-9]*[ed][-+]?[0-9]+|" // too large
                "[-+]?(nan|inf|infinity|∞|n/?a|none|null|o\\.?l\\.?|"
                "ovld?|ovf|over|over-?(load|flow|range)|underflow|err|error|"
                "invalid)",
                std::regex::icase);
      return read_measured_value(item)       ? Item::number :
             std::regex_match(item, nothing) ? Item::nothing :
             std::regex_match(item, time)    ? Item::time :
                                               Item::text;
    }



    /** A letter for each item of a row, `t` for times and `x` for other texts;
     *  empty if it has less than two numbers, or something else without a
     *  letter, as what another separator would split. */
    std::string
    shape_of(const Items &items)
    {
      std::string  shape;
      unsigned int n_numbers = 0;
      for (std::size_t i = 0; i < n_filled(items); ++i)
        {
          const Item kind = kind_of(items[i]);
          if (kind == Item::text &&
              std::none_of(items[i].begin(), items[i].end(), [](const char c) {
                return std::isalpha(c, std::locale::classic()) || c < 0;
              }))
            return "";
          n_numbers += kind == Item::number;
          shape += kind == Item::time ? 't' : kind == Item::text ? 'x' : 'n';
        }
      return n_numbers >= 2 ? shape : "";
    }



    bool
    has_thousands(const std::string &item)
    {
      static const std::regex thousands(
        "[-+]?[0-9]{1,3}([ '.,][0-9]{3})+([.,][0-9]*)?");
      return std::regex_match(item, thousands);
    }



    bool
    has_unit(const std::string &item)
    {
      static const std::regex number_and_unit(
        "[-+]?[0-9.,]+ *([A-Za-z%]|[^\t -~]).*");
      return std::regex_match(item, number_and_unit);
    }
  } // namespace



  std::string
  remark_on_item(const std::string &item)
  {
    const Item kind = kind_of(item);
    return kind == Item::nothing ?
             ": remove this row" :
           kind == Item::time ?
             ": it is a date or a time of day; expected is a column with a "
             "number" :
           has_thousands(item) ? ": write thousands without a separator" :
           has_unit(item) ? ": write its unit into the name of the column" :
                            ": remove what is not part of the table";
  }



  namespace
  {
    /** Of the first such item in a file without rows. */
    std::string
    remark_on_cells(const std::vector<Line> &lines)
    {
      for (const Line &line : lines)
        for (const char separator : {';', '\t', ',', ' '})
          for (const std::string &item : split_line(line.text, separator))
            if (!line.is_comment && (has_thousands(item) || has_unit(item)) &&
                kind_of(item) == Item::text)
              return "; '" + shortened(item) + "' in line " +
                     std::to_string(line.number) + remark_on_item(item);
      return "";
    }
  } // namespace



  MeasuredLayout::MeasuredLayout(const std::string &text,
                                 const FileRefusal &refuse)
  {
    const auto        lines = lines_of(text);
    const std::string shape = choose_separator(lines);
    if (shape.empty())
      refuse("this file holds no row of numbers; expected are two columns "
             "or more, separated by commas, semicolons, tabs or blanks" +
             (lines.empty() ?
                std::string() :
                ", and its first line is '" + shortened(lines[0].text) + "'") +
             remark_on_cells(lines));
    n_columns = shape.size();
    read_rows(lines, shape, refuse);
    refuse_decimal_commas(refuse);
    refuse_thousands(refuse);
  }



  /** Chooses the separator with which most of the first lines are rows of
   *  the same shape, and returns that. */
  std::string
  MeasuredLayout::choose_separator(const std::vector<Line> &lines)
  {
    constexpr std::size_t n_sampled = 1000;
    std::string           best;
    unsigned int          most = 0;
    for (const char candidate : {';', '\t', ',', ' '})
      {
        std::map<std::string, unsigned int> weights;
        for (std::size_t i = 0; i < std::min(lines.size(), n_sampled); ++i)
          if (!lines[i].is_comment)
            {
              const auto shape = shape_of(split_line(lines[i].text, candidate));
              // with a wrong separator there are numbers and texts, too
              weights[shape] += shape.find('x') == shape.npos ? 2 : 1;
            }
        weights.erase("");
        for (const auto &[shape, weight] : weights)
          if (weight > most)
            {
              most      = weight;
              best      = shape;
              separator = candidate;
            }
      }
    return best;
  }



  /** The first line from @p from on that is a row of this shape. */
  std::size_t
  MeasuredLayout::first_row(const std::vector<Line> &lines,
                            const std::string       &shape,
                            std::size_t              from) const
  {
    while (from < lines.size() &&
           (lines[from].is_comment ||
            shape_of(split_line(lines[from].text, separator)) != shape))
      ++from;
    return from;
  }



  /** Whether a line has no numbers, and as many items as rows. */
  bool
  MeasuredLayout::may_be_names(const Items &items, const Items &row) const
  {
    const std::size_t n = n_filled(items);
    return n >= n_columns && n <= std::max(n_columns, row.size()) &&
           std::none_of(items.begin(),
                        items.end(),
                        [](const std::string &item) {
                          return read_measured_value(item).has_value();
                        }) &&
           std::any_of(items.begin(), items.end(), [](const std::string &item) {
             return kind_of(item) == Item::text;
           });
  }



  bool
  MeasuredLayout::has_numbers_only(const Line &line) const
  {
    const Items  items     = split_line(line.text, separator);
    unsigned int n_numbers = 0, n_texts = 0;
    for (std::size_t k = 0; k < n_filled(items); ++k)
      {
        const Item kind = kind_of(items[k]);
        n_numbers += kind == Item::number;
        n_texts += kind == Item::text || kind == Item::time;
      }
    return !line.is_comment && n_numbers > 0 && n_texts == 0;
  }



  void
  MeasuredLayout::read_rows(const std::vector<Line> &lines,
                            const std::string       &shape,
                            const FileRefusal       &refuse)
  {
    std::size_t first = first_row(lines, shape, 0);
    // rows that lack a value, or have one too many
    for (std::size_t i = first; i-- > 0;)
      if (has_numbers_only(lines[i]))
        first = i;
      else if (!lines[i].is_comment)
        break;
    find_names(lines, first);
    for (std::size_t i = first; i < lines.size(); ++i)
      {
        const Items items = split_line(lines[i].text, separator);
        if (lines[i].is_comment || n_filled(items) == 0)
          continue;
        if (!rows.empty() && may_be_names(items, rows[0].second))
          {
            // numbers above the names are a date, say
            const std::size_t next = first_row(lines, shape, i);
            if (!names.empty() || next == lines.size())
              refuse("line " + std::to_string(lines[i].number) +
                     " has names in the place of numbers: keep one table "
                     "in the file, and remove what is not part of it");
            rows.clear();
            find_names(lines, next);
            i = next - 1;
            continue;
          }
        rows.emplace_back(lines[i].number, items);
      }
  }



  /** Names, or names and units below, right above the @p first row; else
   *  those in a comment there. */
  void
  MeasuredLayout::find_names(const std::vector<Line> &lines,
                             const std::size_t        first)
  {
    const Items row = split_line(lines[first].text, separator);
    line_above      = {0, ""};
    bool are_units  = false;
    for (std::size_t i = first; i-- > 0 && (names.empty() || are_units);)
      {
        if (lines[i].is_comment)
          continue;
        Items above = split_line(lines[i].text, separator);
        if (!may_be_names(above, row))
          {
            if (names.empty())
              line_above = lines[i];
            break;
          }
        above.resize(n_filled(above));
        if (are_units)
          {
            above.resize(names.size());
            for (std::size_t k = 0; k < names.size(); ++k)
              names[k] =
                boost::trim_copy(above[k] + (find_unit(names[k]) == nullptr ?
                                               " " + names[k] :
                                               " [" + names[k] + "]"));
            return;
          }
        names = above;
        are_units =
          std::any_of(names.begin(), names.end(), [](const std::string &name) {
            return find_unit(name) != nullptr ||
                   find_unit(
                     boost::trim_copy_if(name, boost::is_any_of("[]()"))) !=
                     nullptr;
          });
      }
    if (names.empty() && first > 0 && lines[first - 1].is_comment)
      {
        const Items items =
          split_line(boost::trim_left_copy_if(lines[first - 1].text,
                                              boost::is_any_of("#%/ ")),
                     separator);
        if (may_be_names(items, row))
          names = items;
      }
  }



  /** Of `0,5,12,3` nobody knows whether these are two numbers or four,
   *  unless there are as many names. */
  void
  MeasuredLayout::refuse_decimal_commas(const FileRefusal &refuse) const
  {
    if (separator == ' ')
      return;
    const std::string what_to_do =
      separator == ',' ? ": if decimals have commas, separate the columns "
                         "with semicolons" :
                         ": expected as many";
    const Items       above = split_line(line_above.text, separator);
    const std::string first = "line " + std::to_string(rows[0].first);
    if (names.empty() && above.size() > 1 &&
        std::any_of(above.begin(), above.end(), unit_in))
      {
        const auto number =
          std::find_if(above.begin(), above.end(), read_measured_value);
        if (number != above.end() &&
            n_filled(above) == n_filled(rows[0].second))
          refuse("line " + std::to_string(line_above.number) + " has '" +
                 *number +
                 "' among the names or units of columns: expected names or "
                 "units only");
        refuse("line " + std::to_string(line_above.number) + " names " +
               std::to_string(n_filled(above)) + " columns, " + first +
               " has " + std::to_string(n_filled(rows[0].second)) + " values" +
               what_to_do);
      }
    if (separator != ',')
      return;
    bool is_whole = n_columns > 2;
    for (const auto &[number, items] : rows)
      {
        if (items.size() < n_columns)
          refuse("line " + std::to_string(number) + " has " +
                 std::to_string(items.size()) + " values, other lines " +
                 std::to_string(n_columns) + what_to_do);
        is_whole = is_whole && std::all_of(items.begin(),
                                           items.begin() + n_filled(items),
                                           is_whole_number);
      }
    if (names.empty() && is_whole)
      refuse(first + " and all others hold whole numbers only" + what_to_do +
             ", else write the names of the columns above");
  }



  /** Of decimal points and commas one may separate thousands. */
  void
  MeasuredLayout::refuse_thousands(const FileRefusal &refuse) const
  {
    static const std::regex thousands("[-+]?[1-9][0-9]{0,2},[0-9]{3}");
    unsigned int            with_point = 0, with_comma = 0;
    bool may_be_thousands = separator != ';'; // which goes with commas
    for (const auto &[number, items] : rows)
      for (const std::string &item : items)
        if (read_measured_value(item))
          {
            if (with_point == 0 && item.find('.') != item.npos)
              with_point = number;
            if (item.find(',') == item.npos)
              continue;
            if (with_comma == 0)
              with_comma = number;
            may_be_thousands =
              may_be_thousands && std::regex_match(item, thousands);
          }
    if (with_comma == 0)
      return;
    const std::string what_to_do =
      ": write decimals in one way, and thousands without a separator";
    if (with_point > 0)
      refuse("line " + std::to_string(with_point) +
             " has a number with a point and line " +
             std::to_string(with_comma) + " one with a comma" + what_to_do);
    if (may_be_thousands)
      refuse("the comma in numbers, as in line " + std::to_string(with_comma) +
             ", may be that of decimals or of thousands" + what_to_do +
             "; semicolons between the columns go with decimal commas");
  }



  /** For messages. */
  std::string
  MeasuredLayout::described() const
  {
    if (names.empty())
      return "this file has " + std::to_string(n_columns) +
             " columns without names" +
             (line_above.number == 0 ?
                std::string() :
                ", since the line above the numbers, '" +
                  shortened(line_above.text) +
                  "', does not name as many (blanks in names are taken for "
                  "separators where blanks separate)");
    std::string text =
      "the columns of this file are '" + boost::join(names, "', '") + "'";
    for (const std::string &name : names)
      if (const std::string why = why_ambiguous(name); !why.empty())
        return text + " (" + why + ")";
    return text;
  }
} // namespace Debond
