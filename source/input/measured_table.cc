#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/input/input_file.h>
#include <debond/input/measured_table.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <limits>
#include <locale>
#include <map>
#include <sstream>

namespace Debond
{
  namespace
  {
    using Items = std::vector<std::string>;

    struct Unit
    {
      Quantity quantity;
      double   factor; ///< to what Quantity is read in
    };

    /** Units by their names without blanks and dots. */
    const std::map<std::string, Unit> &
    units()
    {
      constexpr double degree = 180. / dealii::numbers::PI;
      static const std::map<std::string, Unit> known{
        {"deg", {Quantity::angle, 1.}},
        {"degree", {Quantity::angle, 1.}},
        {"degrees", {Quantity::angle, 1.}},
        {"°", {Quantity::angle, 1.}},
        {"º", {Quantity::angle, 1.}}, // masculine ordinal, on some keyboards
        {"rad", {Quantity::angle, degree}},
        {"mrad", {Quantity::angle, 1e-3 * degree}},
        {"uNm", {Quantity::moment, 1e-3}},
        {"cNm", {Quantity::moment, 10.}},
        {"Nmm", {Quantity::moment, 1.}},
        {"mNm", {Quantity::moment, 1.}},
        {"Ncm", {Quantity::moment, 10.}},
        {"Nm", {Quantity::moment, 1e3}},
        {"kNm", {Quantity::moment, 1e6}},
        {"mN", {Quantity::force, 1e-3}},
        {"N", {Quantity::force, 1.}},
        {"kN", {Quantity::force, 1e3}},
        {"um", {Quantity::length, 1e-3}},
        {"\u00b5m", {Quantity::length, 1e-3}},
        {"\u03bcm", {Quantity::length, 1e-3}}, // Greek, on some keyboards
        {"mm", {Quantity::length, 1.}},
        {"cm", {Quantity::length, 10.}},
        {"m", {Quantity::length, 1e3}},
        {"ms", {Quantity::time, 1e-3}},
        {"s", {Quantity::time, 1.}},
        {"min", {Quantity::time, 60.}},
        {"time", {Quantity::time, 1.}}}; // a name that is enough
      return known;
    }



    const char *
    units_of(const Quantity quantity)
    {
      return quantity == Quantity::angle  ? "deg, rad or mrad" :
             quantity == Quantity::moment ? "N mm, mN m, N cm, N m or kN m" :
             quantity == Quantity::force  ? "mN, N or kN" :
             quantity == Quantity::length ? "um, mm, cm or m" :
                                            "ms, s or min";
    }



    const Unit *
    find_unit(std::string text)
    {
      for (const char *const mark : {" ", ".", "*", "·", "-"})
        boost::erase_all(text, mark);
      // angles and times may be shouted; else M and m differ
      auto found =
        units().find(boost::to_lower_copy(text, std::locale::classic()));
      if (found == units().end() ||
          (found->second.quantity != Quantity::angle &&
           found->second.quantity != Quantity::time))
        found = units().find(text);
      return found == units().end() ? nullptr : &found->second;
    }



    /** The unit in a name: in brackets, behind the last slash or underscore,
     *  or all or the last words of it. Null if there is none, or a factor. */
    const Unit *
    unit_in(const std::string &name)
    {
      for (const char *const factor : {"10^", "x10", "x 10", "*10", "×"})
        if (name.find(factor) != std::string::npos)
          return nullptr;
      for (const char *const brackets : {"[]", "()"})
        if (const auto begin = name.rfind(brackets[0]),
            end              = name.rfind(brackets[1]);
            begin != std::string::npos && end != std::string::npos &&
            begin < end)
          return find_unit(name.substr(begin + 1, end - begin - 1));
      for (std::size_t at = 0; at < name.size(); ++at)
        if (at == 0 ||
            std::string("/_ ").find(name[at - 1]) != std::string::npos)
          if (const Unit *const unit = find_unit(name.substr(at)))
            return unit;
      return nullptr;
    }



    /** A name as it is compared: without its unit in brackets. */
    std::string
    plain_name(const std::string &name)
    {
      return dealii::Utilities::trim(name.substr(0, name.find_first_of("[(")));
    }



    /** German Excel, for one, writes Latin-1 where it says CSV. */
    std::string
    utf8(const std::string &text)
    {
      const auto continues = [&](const std::size_t i) {
        return i < text.size() && (text[i] & 0xC0) == 0x80;
      };
      bool        is_utf8 = true;
      std::string from_latin_1;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const auto code = static_cast<unsigned char>(text[i]);
          is_utf8 =
            is_utf8 && (code < 0x80 || (code >= 0xC2 && continues(i + 1)) ||
                        (continues(i) && i > 0 && (text[i - 1] & 0x80)));
          if (code < 0x80)
            from_latin_1 += text[i];
          else
            {
              from_latin_1 += static_cast<char>(0xC0 | (code >> 6));
              from_latin_1 += static_cast<char>(0x80 | (code & 0x3F));
            }
        }
      return is_utf8 ? text : from_latin_1;
    }



    struct Line
    {
      unsigned int number;
      std::string  text;
    };

    Items
    split_line(const std::string &line, const char separator)
    {
      Items items;
      if (separator != ' ')
        items = split_csv_line(line, separator);
      else if (line.find('\t') == std::string::npos)
        boost::split(items,
                     boost::trim_copy(line),
                     boost::is_any_of(" "),
                     boost::token_compress_on);
      // spreadsheets end rows with separators
      while (!items.empty() && items.back().empty())
        items.pop_back();
      return items;
    }



    /** A number with a decimal point or, where commas do not separate, a comma;
     *  NaN for what is left empty or said to be none; nothing for other texts.
     */
    std::optional<double>
    read_value(std::string item, const char separator)
    {
      if (item.empty() || boost::iequals(item, "nan", std::locale::classic()))
        return std::numeric_limits<double>::quiet_NaN();
      if (separator != ',' && item.find('.') == std::string::npos &&
          std::count(item.begin(), item.end(), ',') == 1)
        boost::replace_all(item, ",", ".");
      return read_number(item);
    }



    /** Two numbers or more; nothing else if @p strictly. */
    bool
    is_row(const Items &items, const char separator, const bool strictly)
    {
      unsigned int n_numbers = 0, n_others = 0;
      for (const std::string &item : items)
        if (const auto value = read_value(item, separator))
          n_numbers += !std::isnan(*value);
        else
          ++n_others;
      return n_numbers >= 2 && (n_others == 0 || !strictly);
    }



    /** The lines of the file, split, and the names of their columns. */
    struct Table
    {
      char                                        separator = ';';
      std::vector<std::pair<unsigned int, Items>> rows;  ///< line, items
      Items                                       names; ///< empty: none
      std::string line_above; ///< with another number of items; empty: none

      Table(const std::vector<Line> &lines, const FileRefusal &refuse)
      {
        // times of day may stand beside numbers, but only if they do everywhere
        std::size_t first = find_rows(lines, true);
        if (first == lines.size())
          first = find_rows(lines, false);
        if (first == lines.size())
          refuse("this file holds no row of numbers; expected are two columns "
                 "or more, separated by commas, semicolons, tabs or blanks" +
                 (lines.empty() ? std::string() :
                                  ", and its first line is '" +
                                    shortened(lines[0].text) + "'"));
        for (std::size_t i = first; i < lines.size(); ++i)
          if (const Items items = split_line(lines[i].text, separator);
              !items.empty())
            rows.emplace_back(lines[i].number, items);
        refuse_thousands(refuse);
        // names, or names and units below
        for (std::size_t i = first; i > 0 && i + 2 > first; --i)
          {
            const Items above = split_line(lines[i - 1].text, separator);
            if (above.size() != rows[0].second.size())
              {
                if (names.empty())
                  line_above = lines[i - 1].text;
                break;
              }
            if (names.empty())
              names = above;
            else
              for (std::size_t k = 0; k < names.size(); ++k)
                names[k] = dealii::Utilities::trim(above[k] + " " + names[k]);
          }
      }

      /** Of decimal points and commas one may separate thousands. */
      void
      refuse_thousands(const FileRefusal &refuse) const
      {
        if (separator == ',')
          return; // no number has one
        unsigned int with_point = 0, with_comma = 0;
        for (const auto &[number, items] : rows)
          for (const std::string &item : items)
            if (const auto value = read_value(item, separator);
                value && !std::isnan(*value))
              {
                with_point = with_point > 0 || item.find('.') == item.npos ?
                               with_point :
                               number;
                with_comma = with_comma > 0 || item.find(',') == item.npos ?
                               with_comma :
                               number;
              }
        if (with_point > 0 && with_comma > 0)
          refuse("line " + std::to_string(with_point) +
                 " has a number with a point and line " +
                 std::to_string(with_comma) +
                 " one with a comma: write decimals in one way, and thousands "
                 "without a separator");
      }

      /** Chooses the separator with which most of the first lines are rows;
       *  returns the first of these. */
      std::size_t
      find_rows(const std::vector<Line> &lines, const bool strictly)
      {
        constexpr std::size_t n_sampled = 1000;
        std::size_t           most = 0, first = lines.size();
        for (const char candidate : {';', '\t', ',', ' '})
          {
            std::size_t n_rows = 0, first_row = lines.size();
            for (std::size_t i = 0; i < std::min(lines.size(), n_sampled); ++i)
              if (is_row(split_line(lines[i].text, candidate),
                         candidate,
                         strictly))
                {
                  ++n_rows;
                  first_row = std::min(first_row, i);
                }
            if (n_rows > most)
              {
                most      = n_rows;
                first     = first_row;
                separator = candidate;
              }
          }
        return first;
      }

      /** For messages. */
      std::string
      described() const
      {
        return names.empty() ?
                 "this file has " + std::to_string(rows[0].second.size()) +
                   " columns without names" +
                   (line_above.empty() ?
                      std::string() :
                      ", since the line above the numbers, '" +
                        shortened(line_above) +
                        "', has not as many (a decimal comma may be taken for "
                        "a separator)") :
                 "the columns of this file are '" + boost::join(names, "', '") +
                   "'";
      }
    };



    struct FoundColumn
    {
      std::size_t number;
      double      factor;
    };

    /** The column of @p table that is meant by @p item: a name or a number from
     *  1, with its unit in brackets, if that is given, behind a minus if values
     *  of the other sign are meant. */
    FoundColumn
    chosen_column(const Table       &table,
                  const std::string &item,
                  const Quantity     quantity,
                  const FileRefusal &refuse)
    {
      const std::string name = plain_name(item);
      std::size_t       at   = table.names.size();
      for (std::size_t i = table.names.size(); i > 0; --i)
        if (table.names[i - 1] == name ||
            plain_name(table.names[i - 1]) == name)
          at = i - 1;
      if (const auto number = read_number(name);
          at == table.names.size() && number && *number >= 1. &&
          *number <= table.rows[0].second.size() &&
          *number == std::floor(*number))
        at = *number - 1;
      else if (at == table.names.size())
        refuse("there is no column '" + name + "': " + table.described());
      const std::size_t bracket  = item.find_first_of("[(");
      const bool        has_unit = bracket != item.npos;
      const bool        is_negative =
        has_unit &&
        boost::starts_with(boost::trim_left_copy(item.substr(bracket + 1)),
                           "-");
      const Unit *const unit = has_unit ? unit_in(item) :
                               at < table.names.size() ?
                                          unit_in(table.names[at]) :
                                          nullptr;
      if (unit == nullptr || unit->quantity != quantity)
        refuse("the column '" + name + "' needs a unit, " + units_of(quantity) +
               ", in brackets behind its name");
      return {at, is_negative ? -unit->factor : unit->factor};
    }



    /** A choice of columns, for messages: "1 [deg], 2 [N m]". */
    std::string
    example_of(const std::vector<MeasuredColumn> &columns)
    {
      const char *const        unit[] = {"deg", "N m", "N", "mm", "s"};
      std::vector<std::string> items;
      for (const MeasuredColumn &column : columns)
        items.push_back(std::to_string(items.size() + 1) + " [" +
                        unit[static_cast<unsigned int>(column.quantity)] + "]");
      return boost::join(items, ", ");
    }



    /** The column called as in this program's tables, else the only one with a
     *  unit of its quantity. @p example: of a choice. */
    FoundColumn
    recognised_column(const Table          &table,
                      const MeasuredColumn &column,
                      const std::string    &example,
                      const std::string    &choice_entry,
                      const FileRefusal    &refuse)
    {
      std::vector<FoundColumn> found;
      for (std::size_t i = 0; i < table.names.size(); ++i)
        {
          const Unit *const unit = unit_in(table.names[i]);
          if (table.names[i] == column.name)
            return {i, 1.};
          if (unit != nullptr && unit->quantity == column.quantity)
            found.push_back({i, unit->factor});
        }
      if (found.size() != 1)
        refuse((found.empty() ? "no column" : "more than one column") +
               std::string(" has a unit that says ") +
               units_of(column.quantity) + ": " + table.described() +
               "; say which, as in " +
               (choice_entry.rfind("--", 0) == 0 ?
                  choice_entry + " \"" + example + "\"" :
                  "'set " + choice_entry.substr(choice_entry.rfind('/') + 2) +
                    " = " + example + "'"));
      return found[0];
    }
  } // namespace



  std::vector<std::vector<double>>
  read_measured_table(const std::string                 &filename,
                      const std::string                 &entry,
                      const std::vector<MeasuredColumn> &columns,
                      const Items                       &choice,
                      const std::string                 &choice_entry,
                      std::string                       *read_from)
  {
    constexpr unsigned int largest_MB = 200;
    const auto             refuse     = [&](const std::string &why) {
      throw EntryError(entry, why, filename);
    };
    Classic<std::istringstream> file(
      utf8(plain_text(read_input_bytes(filename, refuse, largest_MB), refuse)));
    std::vector<Line> lines;
    std::string       text;
    for (unsigned int number = 1; std::getline(file, text); ++number)
      if (boost::trim_copy(text) != "" && boost::trim_left_copy(text)[0] != '#')
        lines.push_back(
          {number, boost::trim_right_copy_if(text, boost::is_any_of(" "))});

    if (!choice.empty() && choice.size() != columns.size())
      throw EntryError(choice_entry,
                       "expected " + std::to_string(columns.size()) +
                         " columns, separated by commas",
                       boost::join(choice, ", "));
    const Table              table(lines, refuse);
    std::vector<FoundColumn> found;
    for (std::size_t i = 0; i < columns.size(); ++i)
      found.push_back(
        choice.empty() ?
          recognised_column(
            table, columns[i], example_of(columns), choice_entry, refuse) :
          chosen_column(
            table, choice[i], columns[i].quantity, [&](const std::string &why) {
              throw EntryError(choice_entry,
                               why + " (" + filename + ")",
                               boost::join(choice, ", "));
            }));

    if (read_from != nullptr)
      for (std::size_t i = 0; i < found.size(); ++i)
        {
          const std::size_t at = found[i].number;
          *read_from +=
            (read_from->empty() ? "column " : ", column ") +
            std::to_string(at + 1) +
            (table.names.empty() ? std::string() :
                                   " '" + table.names[at] + "'") +
            (choice.empty() ||
                 choice[i].find_first_of("[(") == std::string::npos ?
               std::string() :
               " as " + choice[i].substr(choice[i].find_first_of("[(")));
        }

    std::vector<std::vector<double>> rows;
    for (const auto &[number, items] : table.rows)
      {
        std::vector<double> &row = rows.emplace_back();
        for (const FoundColumn &column : found)
          {
            const auto at = "line " + std::to_string(number) + ": ";
            if (column.number >= items.size())
              refuse(at + "no value in column " +
                     std::to_string(column.number + 1));
            const auto value =
              read_value(items[column.number], table.separator);
            if (!value || std::isnan(*value))
              refuse(at + "'" + items[column.number] + "' in column " +
                     std::to_string(column.number + 1) + " is no number");
            row.push_back(column.factor * *value);
          }
        if (items.size() > table.rows[0].second.size())
          refuse("line " + std::to_string(number) + ": " +
                 std::to_string(items.size()) + " values for " +
                 std::to_string(table.rows[0].second.size()) +
                 " columns (is a comma in a number taken for a separator?)");
      }
    return rows;
  }
} // namespace Debond
