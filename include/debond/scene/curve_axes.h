#pragma once

#include <debond/bulk/chuck.h>

#include <optional>
#include <string>

namespace Debond
{
  /** The curve that a scene is about, `Output / Curve`: a load of the chuck
   *  over one of its positions. */
  struct CurveAxes
  {
    unsigned int position = ChuckComponent::rotation_z,
                 load     = ChuckComponent::rotation_z;

    /** That of the paper, torque over angle, both about the implant's own axis.
     */
    bool
    is_torsion() const
    {
      return position == ChuckComponent::rotation_z && load == position;
    }
    /** The name of the file with the rows of a run: who pulls an implant out
     *  looks for no torque. */
    std::string
    rows_file() const
    {
      return is_torsion() ? "torque.csv" : "reactions.csv";
    }
    /** Columns of rows_file(). */
    std::string
    position_column() const;
    std::string
    load_column() const;
    /** "angle", "torque", "deg" and so on. */
    const char *
    position_word() const;
    const char *
    load_word() const;
    const char *
    position_unit() const;
    const char *
    load_unit() const;

    /** Of "Translation z, Force z"; none of other texts. */
    static std::optional<CurveAxes>
    read(const std::string &text);
    /** Of the names of columns. */
    static std::optional<CurveAxes>
    of_columns(const std::string &position, const std::string &load);
  };
} // namespace Debond
