#pragma once

#include <debond/input/allowed_values.h>
#include <debond/input/scene_file.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace Debond
{
  /**
   * The entries of a scene, one row each. A row ties an entry to the member of
   * a struct: the value of the member is the default, unless it has none (see
   * AllowedValues::without_default); what the entry is set to goes there. The
   * structs must live as long as the table.
   *
   * @code
   *   void
   *   BodyParameters::declare(EntryTable &table)
   *   {
   *     table.enter_subsection("Bone");
   *     table.add("Poisson ratio",
   *               poisson_ratio,
   *               Allowed::number_between(0, 0.49, ""),
   *               "Poisson's ratio nu, dimensionless.");
   *     table.leave_subsection();
   *   }
   * @endcode
   */
  class EntryTable
  {
  public:
    void
    enter_subsection(const std::string &name);
    void
    leave_subsection();

    /** A row. @p member: a number, a text, a list of numbers (vector or array);
     *  or a bool or an enumeration whose values are in the order of the choice.
     *  @p documentation is for users and states the unit. Throws EntryError if
     *  the member has a value that is not allowed. Laws may share an entry: it
     *  has one row, and goes to the members of all. With "Expert / " before
     *  its name it stands under `Expert`, in the subsections that are open. */
    template <typename T>
    void
    add(const std::string   &name,
        T                   &member,
        const AllowedValues &allowed,
        const std::string   &documentation);

    /** A row whose text is interpreted by @p set, or, without it, by Python
     *  alone. */
    void
    add(const std::string                              &name,
        const std::string                              &value,
        const std::function<void(const std::string &)> &set,
        const AllowedValues                            &allowed,
        const std::string                              &documentation);

    /** Sets an entry, and the member that belongs to it. Throws EntryError if
     *  it is unknown or its value not allowed. */
    void
    set(const SceneEntry &entry);

    /** The unit of the numbers of an entry with its subsections; empty if it
     *  has none, or there is no such entry. */
    std::string
    unit_of(const std::string &full_name) const;

    /** Whether an entry has the value that this table has. */
    bool
    has(const SceneEntry &entry) const;

    /** Whether a scene that reads an entry need not set it. */
    bool
    has_default(const std::string &full_name) const;

    /** Whether a @p text stands for the value of an entry, if by a word. */
    bool
    means(const SceneEntry &entry, const std::string &text) const;

    /** The full name of an entry; @p full_name need not have `Expert`. */
    std::string
    placed(const std::string &full_name) const;

    /** All entries with their values, those under `Expert` last. */
    std::vector<SceneEntry>
    entries() const;



    /** Entries with these @p values as the text of a scene, with what they mean
     *  and allow. */
    std::string
    explained(const std::vector<SceneEntry> &values) const;

  private:
    struct Row
    {
      SceneEntry    entry; ///< with its value
      AllowedValues allowed;
      std::string   documentation;
      /** What brings a value to the members. */
      std::vector<std::function<void(const std::string &)>> members;
    };

    /** The row of this name, or none. */
    const Row *
    row_of(const std::string &full_name) const;

    /** What an unknown entry may have been meant to be, or nothing. */
    std::string
    likely_name(const SceneEntry &entry) const;

    std::vector<std::string>           path; ///< the subsections that are open
    std::vector<Row>                   rows;
    std::map<std::string, std::size_t> numbers; ///< of rows, by full names
  };



  /** A value as a scene has it. @p names: of the values of an enumeration. */
  template <typename T>
  std::string
  entry_text(const T &value, const std::vector<std::string> &names = {})
  {
    if constexpr (std::is_same_v<T, std::string>)
      return value;
    else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>)
      return names.at(static_cast<unsigned int>(value));
    else if constexpr (std::is_floating_point_v<T>)
      return exact_text(value);
    else if constexpr (std::is_integral_v<T>)
      return std::to_string(value);
    else
      {
        std::string list;
        for (const auto &item : value)
          list += (list.empty() ? "" : ", ") + entry_text(item);
        return list;
      }
  }



  /** The opposite, for texts that are allowed. */
  template <typename T>
  void
  read_entry(const std::string              &text,
             T                              &value,
             const std::vector<std::string> &names = {})
  {
    if constexpr (std::is_same_v<T, std::string>)
      value = text;
    else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>)
      value = static_cast<T>(std::find(names.begin(), names.end(), text) -
                             names.begin());
    else if constexpr (std::is_arithmetic_v<T>)
      value = static_cast<T>(read_number(text).value());
    else
      {
        const std::vector<std::string> items = split_list(text);
        if constexpr (std::is_same_v<T, std::vector<typename T::value_type>>)
          value.resize(items.size());
        for (std::size_t i = 0; i < std::min(value.size(), items.size()); ++i)
          read_entry(items[i], value[i]);
      }
  }



  template <typename T>
  void
  EntryTable::add(const std::string   &name,
                  T                   &member,
                  const AllowedValues &allowed,
                  const std::string   &documentation)
  {
    add(
      name,
      allowed.in_words(entry_text(member, allowed.names)),
      [&member, allowed](const std::string &text) {
        read_entry(allowed.without_words(text), member, allowed.names);
      },
      allowed,
      documentation);
  }
} // namespace Debond
