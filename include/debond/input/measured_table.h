#pragma once

#include <string>
#include <vector>

namespace Debond
{
  /**
   * Reads columns of a table, a row for each of the file, in the units that
   * their names say: "angle_deg", "torque_Nmm", "chuck_Fz_N", "time". A plain
   * CSV file whose first line has these @p names is read here; any other table,
   * and all that instruments and spreadsheets write, by `debond.measured` of
   * Python.
   *
   * @p choice names the columns of the file in the same order, each by its name
   * there or its number from 1, with a unit in brackets where the file has
   * none: "Winkel", "3 [N m]"; a minus before the unit, "3 [-N m]", turns the
   * sign. Empty: the column called as the wanted one, else the only one with a
   * unit of its kind.
   *
   * Throws EntryError that names the @p entry of the scene which gave the file,
   * the file, and what was found and is needed; or the entry @p choice_entry.
   */
  std::vector<std::vector<double>>
  read_measured_table(const std::string              &filename,
                      const std::string              &entry,
                      const std::vector<std::string> &names,
                      const std::vector<std::string> &choice,
                      const std::string              &choice_entry);
} // namespace Debond
