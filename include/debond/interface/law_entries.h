#ifndef debond_interface_law_entries_h
#define debond_interface_law_entries_h

#include <debond/input/allowed_values.h>

#include <map>
#include <string>
#include <vector>

namespace Debond
{
  /** An entry of a law: a row of a scene's subsection `Interface`, or of a
   *  subsection of its own in there. */
  struct LawEntry
  {
    std::string   subsection; ///< within `Interface`; may be empty
    std::string   name;
    std::string   value; ///< default
    AllowedValues allowed;
    std::string   documentation; ///< states the unit
  };

  /** What a scene says of a law: its name, and the texts of the entries of all
   *  laws of its kind by name, without their subsections. */
  struct LawChoice
  {
    std::string                        law;
    std::map<std::string, std::string> entries;

    double
    number(const std::string &entry) const;
    const std::string &
    text(const std::string &entry) const
    {
      return entries.at(entry);
    }
  };

  /** A law as scenes know it. */
  template <typename Create>
  struct LawPlugin
  {
    std::string name;        ///< its choice of the entry
    std::string description; ///< what that choice means
    /** Laws of a kind may share entries. */
    std::vector<LawEntry> entries;
    Create                create; ///< throws EntryError
  };
} // namespace Debond
#endif
