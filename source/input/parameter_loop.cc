#include <debond/input/allowed_values.h>
#include <debond/input/parameter_loop.h>
#include <debond/support/input_error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <string>
#include <utility>

namespace Debond
{
  using dealii::Utilities::trim;



  namespace
  {
    constexpr unsigned int most_variants = 100000;
    const char *const      too_many =
      "this makes a study of more than 100000 variants";



    bool
    is_varied(const SceneEntry &entry)
    {
      return entry.value.find("{{") != std::string::npos;
    }



    /** The values of one varied entry. */
    struct Choice
    {
      SceneEntry               entry;
      std::vector<std::string> values;
      std::string              name;           ///< of {{name: ...}}, or empty
      bool                     by_run = false; ///< {{a||b}}
      unsigned int             stride = 1;     ///< variants between two values
      /** Whether the entry is the first one with this name, or has none. */
      bool is_factor = true;

      /** Of the value that the entry takes in a variant. */
      std::size_t
      index(const unsigned int variant) const
      {
        return variant / stride % values.size();
      }
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
      static const std::regex range(
        "([+-]?[0-9]{1,9})[ \t]*\\.\\.[ \t]*([+-]?[0-9]{1,9})");
      std::smatch ends;
      // matching is recursive: long texts would overflow the stack
      if (item.size() > 100 || !std::regex_match(item, ends, range))
        entry.refuse("'" + shortened(item) +
                     "' is no range: expected FIRST..LAST with whole numbers "
                     "of at most nine digits");
      const int first = std::stoi(ends[1]), last = std::stoi(ends[2]);
      if (first > last)
        entry.refuse("the range '" + item +
                     "' is empty: expected FIRST..LAST with FIRST <= LAST");
      if (unsigned(last - first) >= most_variants)
        entry.refuse(too_many);
      std::vector<std::string> numbers;
      for (int i = first; i <= last; ++i)
        numbers.push_back(std::to_string(i));
      return numbers;
    }



    Choice
    read_choice(const SceneEntry &entry)
    {
      const std::string &value = entry.value;
      const auto         begin = value.find("{{"), end = value.find("}}");
      if (end == std::string::npos || end < begin ||
          value.find("{{", begin + 2) != std::string::npos ||
          value.find("}}", end + 2) != std::string::npos)
        entry.refuse("the braces of several values do not match: expected "
                     "{{a|b|c}}, {{a||b||c}} or {{name: a|b|c}}, once");
      const std::string prefix = value.substr(0, begin);
      const std::string suffix = value.substr(end + 2);
      std::string       inside = value.substr(begin + 2, end - begin - 2);

      Choice choice;
      choice.entry = entry;
      static const std::regex name("[A-Za-z][A-Za-z0-9_ -]*");
      const auto              colon  = inside.find(':');
      const std::string       before = trim(inside.substr(0, colon));
      if (colon != std::string::npos && before.size() < 100 &&
          std::regex_match(before, name))
        {
          choice.name = before;
          inside.erase(0, colon + 1);
        }
      choice.by_run = inside.find("||") != std::string::npos;
      if (choice.by_run && !choice.name.empty())
        entry.refuse("a named choice takes | between its values, not ||");
      for (const std::string &item : split(inside, choice.by_run ? "||" : "|"))
        {
          if (item.find('|') != std::string::npos)
            entry.refuse("either | or || between all values");
          for (const std::string &one : expand_range(entry, item))
            choice.values.push_back(trim(prefix + one + suffix));
        }
      if (!choice.by_run && choice.name.empty())
        for (auto value = choice.values.begin(); value != choice.values.end();
             ++value)
          if (std::find(choice.values.begin(), value, *value) != value)
            entry.refuse("'" + *value + "' is there twice");
      return choice;
    }



    /** Says which variants take which value of each choice, the first choice
     *  varying fastest; returns the number of variants. */
    unsigned int
    combine(std::vector<Choice> &choices)
    {
      unsigned int n_combinations = 1;
      for (auto choice = choices.begin(); choice != choices.end(); ++choice)
        {
          const std::size_t n = choice->values.size();
          const auto        same =
            std::find_if(choices.begin(), choice, [&](const Choice &other) {
              return !other.name.empty() && other.name == choice->name;
            });
          if (same != choice)
            {
              choice->stride    = same->stride;
              choice->is_factor = false;
              if (n != same->values.size())
                choice->entry.refuse(std::to_string(n) +
                                     " values, but an entry before has " +
                                     std::to_string(same->values.size()) +
                                     " for '" + choice->name + "'");
            }
          else if (n > most_variants / (choice->by_run ? 1 : n_combinations))
            choice->entry.refuse(too_many);
          else if (!choice->by_run)
            {
              choice->stride = n_combinations;
              n_combinations *= n;
            }
        }

      for (const Choice &choice : choices)
        if (choice.by_run)
          {
            // entries {{a||b}} alone set the number of variants
            const std::size_t n = choice.values.size();
            if (n_combinations == 1)
              n_combinations = n;
            if (n != n_combinations)
              choice.entry.refuse(std::to_string(n) + " values for " +
                                  std::to_string(n_combinations) +
                                  " variants: {{a||b}} needs one for each");
          }
      return n_combinations;
    }
  } // namespace



  std::vector<SceneEntry>
  varied_entries(const std::vector<SceneEntry> &entries)
  {
    std::vector<SceneEntry> result;
    std::copy_if(entries.begin(),
                 entries.end(),
                 std::back_inserter(result),
                 is_varied);
    return result;
  }



  std::vector<StudyVariant>
  study_variants(const std::vector<SceneEntry> &entries,
                 const unsigned int             factors_at_once)
  {
    std::vector<Choice> choices;
    for (const SceneEntry &entry : varied_entries(entries))
      {
        choices.push_back(read_choice(entry));
        if (choices.back().by_run && factors_at_once > 0)
          entry.refuse(
            "{{a||b}} has a value for every variant and cannot be one of "
            "the factors of Study / Factors varied at once: expected "
            "{{a|b|c}} or {{name: a|b|c}}");
      }

    std::vector<StudyVariant> variants;
    const unsigned int        n_combinations = combine(choices);
    for (unsigned int i = 0; i < n_combinations; ++i)
      {
        const auto is_changed = [i](const Choice &choice) {
          return choice.is_factor && choice.index(i) != 0;
        };
        if (factors_at_once > 0 &&
            std::count_if(choices.begin(), choices.end(), is_changed) >
              factors_at_once)
          continue;
        StudyVariant variant{entries, {}, {}};
        auto         choice = choices.begin();
        for (std::size_t e = 0; e < entries.size(); ++e)
          if (is_varied(entries[e]))
            {
              variant.entries[e].value = choice->values[choice->index(i)];
              variant.values.push_back(variant.entries[e].value);
              variant.varied.push_back(e);
              ++choice;
            }
        variants.push_back(std::move(variant));
      }
    return variants;
  }
} // namespace Debond
