#ifndef debond_input_measured_units_h
#define debond_input_measured_units_h

#include <string>

namespace Debond
{
  /** What a column of a measured table holds, and what it is read in. */
  enum class Quantity
  {
    angle,  ///< [deg]
    moment, ///< [N mm]
    force,  ///< [N]
    length, ///< [mm]
    time    ///< [s]; a column called "time" needs no unit
  };

  struct Unit
  {
    Quantity quantity;
    double   factor; ///< to what Quantity is read in
  };

  /** The unit that a text is; null if it is none. Blanks and the signs of a
   *  product may stand where they like: "lbf in", "in·lbf", "IN-LB". */
  const Unit *
  find_unit(std::string text);

  /** The unit in the name of a column: in brackets, behind the last slash or
   *  underscore, or all or the last words of it. Null if there is none, or a
   *  factor. */
  const Unit *
  unit_in(const std::string &name);

  /** "deg, rad, ...", for messages. */
  const char *
  units_of(Quantity quantity);

  /** What else a text that find_unit() does not know could mean; empty if there
   *  are not several such meanings. */
  std::string
  why_ambiguous(const std::string &name);
} // namespace Debond
#endif
