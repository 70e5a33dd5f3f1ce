#ifndef debond_input_measured_layout_h
#define debond_input_measured_layout_h

#include <debond/input/input_file.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  /** The table in a text of an instrument or a spreadsheet: where it begins,
   *  what separates its items, how its columns are called. See
   *  read_measured_table() for what is understood. */
  struct MeasuredLayout
  {
    using Items = std::vector<std::string>;
    /** A line of the file that is not empty. */
    struct Line
    {
      unsigned int number;
      std::string  text;
      bool         is_comment = false;
    };

    char                                        separator = ';';
    std::size_t                                 n_columns = 0; ///< of rows
    std::vector<std::pair<unsigned int, Items>> rows;          ///< line, items
    Items                                       names;         ///< empty: none
    Line line_above{0, ""}; ///< with another number of items; 0: none

    /** Calls @p refuse for what is no table or may be read in two ways. */
    MeasuredLayout(const std::string &text, const FileRefusal &refuse);

    /** The columns that there are, for messages. */
    std::string
    described() const;

  private:
    std::string
    choose_separator(const std::vector<Line> &lines);
    std::size_t
    first_row(const std::vector<Line> &lines,
              const std::string       &shape,
              std::size_t              from) const;
    bool
    may_be_names(const Items &items, const Items &row) const;
    bool
    has_numbers_only(const Line &line) const;
    void
    read_rows(const std::vector<Line> &lines,
              const std::string       &shape,
              const FileRefusal       &refuse);
    void
    find_names(const std::vector<Line> &lines, std::size_t first);
    void
    refuse_decimal_commas(const FileRefusal &refuse) const;
    void
    refuse_thousands(const FileRefusal &refuse) const;
  };

  /** The number of items without empty ones at the end. */
  std::size_t
  n_filled(const MeasuredLayout::Items &items);

  /** A number with a decimal point or comma, or an exponent of Fortran; an item
   *  that holds a comma where commas separate was in quotes. */
  std::optional<double>
  read_measured_value(std::string item);

  /** What to do with an item that is no number: ": remove this row". */
  std::string
  remark_on_item(const std::string &item);
} // namespace Debond
#endif
