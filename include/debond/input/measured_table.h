#ifndef debond_input_measured_table_h
#define debond_input_measured_table_h

#include <debond/input/measured_units.h>

#include <string>
#include <vector>

namespace Debond
{
  /** A column that is asked for. */
  struct MeasuredColumn
  {
    std::string name; ///< in tables of this program: "angle_deg"
    Quantity    quantity;
  };

  /**
   * Reads columns of a table as instruments, spreadsheets and this program
   * write them, in the units of Quantity, with a row for each of the file.
   *
   * Items are separated by semicolons, tabs, commas or blanks, in the way that
   * makes most lines rows of numbers; these have a point or a comma, where
   * commas separate in quotes. The first such line begins the table. The one or
   * two lines above, if they have as many items and no numbers, or else a
   * comment right above, name the columns and their units; what stands before
   * them is not read, nor are comments: lines that begin with `#`, `%` or `//`.
   * What may be read in two ways is refused.
   *
   * @p choice names the columns in the order of @p columns, each by its name in
   * the file or its number from 1, with a unit in brackets where the file has
   * none: "Winkel", "3 [N m]"; a minus before the unit, "3 [-N m]", turns the
   * sign. Empty: the column called as MeasuredColumn::name, else the only one
   * with a unit of that quantity.
   *
   * @p read_from: the columns that were read, for people.
   *
   * Throws EntryError that names the @p entry of the scene which gave the file,
   * the file, and what was found and is needed; or the entry @p choice_entry.
   */
  std::vector<std::vector<double>>
  read_measured_table(const std::string                 &filename,
                      const std::string                 &entry,
                      const std::vector<MeasuredColumn> &columns,
                      const std::vector<std::string>    &choice,
                      const std::string                 &choice_entry,
                      std::string                       *read_from = nullptr);
} // namespace Debond
#endif
