#include <debond/input/parameter_loop.h>
#include <debond/support/input_error.h>

#include <deal.II/base/utilities.h>

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
      std::string::size_type   begin = 0;
      for (;;)
        {
          const auto end = text.find(separator, begin);
          items.push_back(trim(text.substr(begin, end - begin)));
          if (end == std::string::npos)
            return items;
          begin = end + separator.size();
        }
    }



    [[noreturn]] void
    refuse(const SceneEntry &entry, const std::string &why)
    {
      throw InputError(entry.place + ": " + entry.full_name() + " = '" +
                       shortened(entry.value) + "': " + why);
    }



    /** The values of one varied entry. */
    struct Choice
    {
      std::vector<std::string> values;
      std::string              name;           ///< of {{name: ...}}, or empty
      bool                     by_run = false; ///< {{a||b}}
    };



    /** The whole numbers of FIRST..LAST; anything else as it is. */
    std::vector<std::string>
    expand_range(const SceneEntry &entry, const std::string &item)
    {
      static const std::regex whole("([+-]?[0-9]{1,9})\\s*\\.\\.\\s*"
                                    "([+-]?[0-9]{1,9})");
      // what was meant as a range; not the path ../table.csv
      static const std::regex attempt(
        "[-+.0-9eE]*[0-9][-+.0-9eE]*\\s*\\.\\.\\s*"
        "[-+.0-9eE]*|"
        "\\.\\.\\s*[-+]?[0-9]+");
      // matching is recursive: long texts would overflow the stack
      constexpr std::size_t longest = 100;
      std::smatch           match;
      if (item.size() > longest || !std::regex_match(item, match, whole))
        {
          if (item.size() <= longest && std::regex_match(item, attempt))
            refuse(entry,
                   "'" + item +
                     "' is no range: expected FIRST..LAST with whole numbers "
                     "of at most nine digits");
          return {item};
        }
      const int first = std::stoi(match[1]), last = std::stoi(match[2]);
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
      const auto is_letter = [](const char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      };
      const auto is_part = [&is_letter](const char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == ' ' ||
               c == '-';
      };
      const auto colon = inside.find(':');
      if (colon == std::string::npos)
        return "";
      const std::string name    = trim(inside.substr(0, colon));
      const bool        is_name = !name.empty() && is_letter(name[0]) &&
                           std::all_of(name.begin(), name.end(), is_part);
      return is_name ? name : "";
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
          by_run.emplace_back(entry, n);
        else if (choice.name.empty() || strides.count(choice.name) == 0)
          {
            // an entry without a name is an axis of its own
            strides[choice.name.empty() ? entry.full_name() : choice.name] = {
              n_combinations, n};
            if (n > most_variants / n_combinations)
              refuse(entry, too_many);
            n_combinations *= n;
          }
        else if (strides.at(choice.name).second != n)
          refuse(entry,
                 std::to_string(n) + " values, but an entry before has " +
                   std::to_string(strides.at(choice.name).second) + " for '" +
                   choice.name + "'");
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
      index(const SceneEntry  &entry,
            const Choice      &choice,
            const unsigned int variant) const
      {
        if (choice.by_run)
          return variant;
        const auto [stride, n] =
          strides.at(choice.name.empty() ? entry.full_name() : choice.name);
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
                  choice->second.values[axes.index(entry, choice->second, i)];
                variant.values.push_back(entry.value);
              }
            variant.entries.push_back(entry);
          }
        variants.push_back(std::move(variant));
      }
    return variants;
  }
} // namespace Debond
