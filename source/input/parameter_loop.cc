#include <debond/input/parameter_loop.h>
#include <debond/support/input_error.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <map>
#include <regex>

namespace Debond
{
  using dealii::Utilities::trim;



  namespace
  {
    constexpr unsigned int most_variants = 100000;
    const char *const      too_many =
      "this makes a study of more than 100000 variants";



    std::vector<std::string>
    split_at(const std::string &text, const std::string &separator)
    {
      std::vector<std::string> items;
      boost::iter_split(items, text, boost::first_finder(separator));
      for (std::string &item : items)
        item = trim(item);
      return items;
    }



    [[noreturn]] void
    refuse(const SceneEntry &entry, const std::string &why)
    {
      throw EntryError(entry.full_name(), why, entry.value, entry.place);
    }



    /** The values of one varied entry. */
    struct Choice
    {
      std::vector<std::string> values;
      std::string              name;           ///< of {{name: ...}}, or empty
      std::string              axis;           ///< the name, or the entry
      bool                     by_run = false; ///< {{a||b}}
    };



    /** The whole numbers of FIRST..LAST; anything else as it is. */
    std::vector<std::string>
    expand_range(const SceneEntry &entry, const std::string &item)
    {
      // what was meant as a range; not the path ../table.csv
      const auto dots = item.find("..");
      if (dots == std::string::npos ||
          item.find_first_not_of("0123456789+-.eE \t") != std::string::npos)
        return {item};
      const std::string       ends[] = {trim(item.substr(0, dots)),
                                        trim(item.substr(dots + 2))};
      static const std::regex whole("[+-]?[0-9]{1,9}");
      for (const std::string &end : ends)
        if (end.size() > 10 || !std::regex_match(end, whole))
          refuse(entry,
                 "'" + shortened(item) +
                   "' is no range: expected FIRST..LAST with whole numbers of "
                   "at most nine digits");
      const int first = std::stoi(ends[0]), last = std::stoi(ends[1]);
      if (first > last)
        refuse(entry,
               "the range '" + item +
                 "' is empty: expected FIRST..LAST with FIRST <= LAST");
      if (unsigned(last - first) >= most_variants)
        refuse(entry, too_many);
      std::vector<std::string> numbers;
      for (int i = first; i <= last; ++i)
        numbers.push_back(std::to_string(i));
      return numbers;
    }



    /** The name in `name: a|b|c`, letters first; nothing if there is none. */
    std::string
    name_of_choice(const std::string &inside)
    {
      static const std::regex name("[A-Za-z][A-Za-z0-9_ -]*");
      const std::string       before = trim(inside.substr(0, inside.find(':')));
      // matching is recursive: long texts would overflow the stack
      return before.size() < 100 && inside.find(':') != std::string::npos &&
                 std::regex_match(before, name) ?
               before :
               "";
    }



    Choice
    read_choice(const SceneEntry &entry)
    {
      const std::string &value = entry.value;
      const auto         begin = value.find("{{"), end = value.find("}}");
      if (end == std::string::npos || end < begin ||
          value.find("{{", begin + 2) != std::string::npos ||
          value.find("}}", end + 2) != std::string::npos)
        refuse(entry,
               "the braces of several values do not match: expected "
               "{{a|b|c}}, {{a||b||c}} or {{name: a|b|c}}, once");
      const std::string prefix = value.substr(0, begin);
      const std::string suffix = value.substr(end + 2);
      std::string       inside = value.substr(begin + 2, end - begin - 2);

      Choice choice;
      choice.name = name_of_choice(inside);
      if (!choice.name.empty())
        inside.erase(0, inside.find(':') + 1);
      choice.axis   = choice.name.empty() ? entry.full_name() : choice.name;
      choice.by_run = inside.find("||") != std::string::npos;
      if (choice.by_run && !choice.name.empty())
        refuse(entry, "a named choice takes | between its values, not ||");
      for (const std::string &item :
           split_at(inside, choice.by_run ? "||" : "|"))
        {
          if (item.find('|') != std::string::npos)
            refuse(entry, "either | or || between all values");
          for (const std::string &one : expand_range(entry, item))
            choice.values.push_back(trim(prefix + one + suffix));
        }
      if (!choice.by_run && choice.name.empty())
        for (auto value = choice.values.begin(); value != choice.values.end();
             ++value)
          if (std::find(choice.values.begin(), value, *value) != value)
            refuse(entry, "'" + *value + "' is there twice");
      return choice;
    }



    /** Number of variants, and which value an entry takes in one of them. */
    class Axes
    {
    public:
      void
      add(const SceneEntry &entry, const Choice &choice)
      {
        const unsigned int n = choice.values.size();
        if (n > most_variants)
          refuse(entry, too_many);
        if (choice.by_run)
          {
            by_run.emplace_back(entry, n);
            return;
          }
        const auto [axis, is_new] =
          strides.emplace(choice.axis, std::make_pair(n_combinations, n));
        if (!is_new && axis->second.second != n)
          refuse(entry,
                 std::to_string(n) + " values, but an entry before has " +
                   std::to_string(axis->second.second) + " for '" +
                   choice.name + "'");
        if (is_new && n > most_variants / n_combinations)
          refuse(entry, too_many);
        n_combinations *= is_new ? n : 1;
      }

      /** Variants of all; with entries {{a||b}} alone their number of values.
       */
      unsigned int
      n_variants() const
      {
        const unsigned int n = n_combinations == 1 && !by_run.empty() ?
                                 by_run.front().second :
                                 n_combinations;
        for (const auto &[entry, n_values] : by_run)
          if (n_values != n)
            refuse(entry,
                   std::to_string(n_values) + " values for " +
                     std::to_string(n) +
                     " variants: {{a||b}} needs one for each");
        return n;
      }

      unsigned int
      index(const Choice &choice, const unsigned int variant) const
      {
        if (choice.by_run)
          return variant;
        const auto [stride, n] = strides.at(choice.axis);
        return variant / stride % n;
      }

      /** Number of factors, that is entries or named groups of entries, that
       *  differ from their first value. */
      unsigned int
      n_changed(const unsigned int variant) const
      {
        return std::count_if(strides.begin(),
                             strides.end(),
                             [variant](const auto &axis) {
                               const auto [stride, n] = axis.second;
                               return variant / stride % n != 0;
                             });
      }

    private:
      unsigned int n_combinations = 1;
      /** Name of the axis -> {variants between two values, number of values}.
       */
      std::map<std::string, std::pair<unsigned int, unsigned int>> strides;
      std::vector<std::pair<SceneEntry, unsigned int>>             by_run;
    };
  } // namespace



  bool
  is_study(const std::vector<SceneEntry> &entries)
  {
    return !varied_entries(entries).empty();
  }



  std::vector<SceneEntry>
  varied_entries(const std::vector<SceneEntry> &entries)
  {
    std::vector<SceneEntry> result;
    for (const SceneEntry &entry : entries)
      if (entry.value.find("{{") != std::string::npos)
        result.push_back(entry);
    return result;
  }



  std::vector<StudyVariant>
  study_variants(const std::vector<SceneEntry> &entries,
                 const unsigned int             factors_at_once)
  {
    std::map<std::string, Choice> choices;
    Axes                          axes;
    for (const SceneEntry &entry : varied_entries(entries))
      {
        const Choice &choice = choices[entry.full_name()] = read_choice(entry);
        if (choice.by_run && factors_at_once > 0)
          refuse(entry,
                 "{{a||b}} has a value for every variant and cannot be one of "
                 "the factors of Study / Factors varied at once: expected "
                 "{{a|b|c}} or {{name: a|b|c}}");
        axes.add(entry, choice);
      }

    std::vector<StudyVariant> variants;
    const unsigned int        n_combinations = axes.n_variants();
    for (unsigned int i = 0; i < n_combinations; ++i)
      {
        if (factors_at_once > 0 && axes.n_changed(i) > factors_at_once)
          continue;
        StudyVariant variant;
        for (SceneEntry entry : entries)
          {
            const auto choice = choices.find(entry.full_name());
            if (choice != choices.end())
              {
                entry.value =
                  choice->second.values[axes.index(choice->second, i)];
                variant.values.push_back(entry.value);
              }
            variant.entries.push_back(entry);
          }
        variants.push_back(std::move(variant));
      }
    return variants;
  }
} // namespace Debond
