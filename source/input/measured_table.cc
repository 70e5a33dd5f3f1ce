#include <debond/input/allowed_values.h>
#include <debond/input/input_file.h>
#include <debond/input/measured_layout.h>
#include <debond/input/measured_table.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    using Items = std::vector<std::string>;

    /** A name as it is compared: without its unit in brackets. */
    std::string
    plain_name(const std::string &name)
    {
      return dealii::Utilities::trim(name.substr(0, name.find_first_of("[(")));
    }



    struct FoundColumn
    {
      std::size_t number;
      double      factor;
    };

    /** The column of @p table that is meant by @p item: a name or a number from
     *  1, with its unit in brackets, if that is given, behind a minus if values
     *  of the other sign are meant. */
    FoundColumn
    chosen_column(const MeasuredLayout &table,
                  const std::string    &item,
                  const Quantity        quantity,
                  const FileRefusal    &refuse)
    {
      const std::string name = plain_name(item);
      std::size_t       at   = table.names.size();
      for (std::size_t i = 0; i < table.names.size(); ++i)
        if (table.names[i] == name || plain_name(table.names[i]) == name)
          {
            if (at < table.names.size())
              refuse("there are two columns '" + name +
                     "': give the number of one");
            at = i;
          }
      if (const auto number = read_number(name);
          at == table.names.size() && number && *number >= 1. &&
          *number <= std::max(table.n_columns, table.names.size()) &&
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
        {
          const std::string why = why_ambiguous(
            has_unit || at >= table.names.size() ? item : table.names[at]);
          refuse("the column '" + name + "' needs a unit, " +
                 units_of(quantity) + ", in brackets behind its name" +
                 (why.empty() ? "" : " (" + why + ")"));
        }
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
    recognised_column(const MeasuredLayout &table,
                      const MeasuredColumn &column,
                      const std::string    &example,
                      const std::string    &choice_entry,
                      const FileRefusal    &refuse)
    {
      std::vector<FoundColumn> called, found;
      for (std::size_t i = 0; i < table.names.size(); ++i)
        {
          const Unit *const unit = unit_in(table.names[i]);
          if (table.names[i] == column.name)
            called.push_back({i, 1.});
          if (unit != nullptr && unit->quantity == column.quantity)
            found.push_back({i, unit->factor});
        }
      if (!called.empty())
        found = called;
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
                      const Items                       &choice_as_written,
                      const std::string                 &choice_entry,
                      std::string                       *read_from)
  {
    constexpr unsigned int largest_MB = 200;
    const auto             refuse     = [&](const std::string &why) {
      throw EntryError(entry, why, filename);
    };
    const std::string text =
      plain_table(read_input_bytes(filename, refuse, largest_MB), refuse);
    Items choice;
    for (const std::string &item : choice_as_written)
      choice.push_back(with_plain_marks(item));
    if (!choice.empty() && choice.size() != columns.size())
      throw EntryError(choice_entry,
                       "expected " + std::to_string(columns.size()) +
                         " columns, separated by commas",
                       boost::join(choice, ", "));
    const MeasuredLayout     table(text, refuse);
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
    const std::size_t n_columns = std::max(table.n_columns, table.names.size());
    for (const auto &[number, items] : table.rows)
      {
        const auto at = "line " + std::to_string(number) + ": ";
        if (n_filled(items) > n_columns)
          refuse(at + std::to_string(n_filled(items)) + " values for " +
                 std::to_string(n_columns) +
                 " columns: remove the line if it is not part of the table, or "
                 "separate with semicolons if a comma is that of a number");
        std::vector<double> &row = rows.emplace_back();
        for (const FoundColumn &column : found)
          {
            const std::string where = std::to_string(column.number + 1);
            if (column.number >= n_filled(items))
              refuse(at + "no value in column " + where);
            const std::string &item  = items[column.number];
            const auto         value = read_measured_value(item);
            if (!value)
              refuse(at +
                     (item.empty() ? "no value in column " + where :
                                     "'" + shortened(item) + "' in column " +
                                       where + " is no number") +
                     remark_on_item(item));
            row.push_back(column.factor * *value);
          }
      }
    return rows;
  }
} // namespace Debond
