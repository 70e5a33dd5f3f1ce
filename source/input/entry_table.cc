#include <debond/input/entry_table.h>

#include <boost/algorithm/string/compare.hpp>

#include <locale>
#include <numeric>

namespace Debond
{
  namespace
  {
    const std::string expert = "Expert / "; // before names



    /** Number of letters to insert, delete or change to make one text of the
     *  other, capitals ignored. */
    unsigned int
    edit_distance(const std::string &a, const std::string &b)
    {
      const boost::is_iequal    same(std::locale::classic());
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (const char letter : a)
        {
          unsigned int diagonal = row[0]++;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const unsigned int changed =
                diagonal + (same(letter, b[j]) ? 0 : 1);
              diagonal   = row[j + 1];
              row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row.back();
    }
  } // namespace



  void
  EntryTable::enter_subsection(const std::string &name)
  {
    path.push_back(name);
  }



  void
  EntryTable::leave_subsection()
  {
    path.pop_back();
  }



  void
  EntryTable::add(const std::string                              &name,
                  const std::string                              &value,
                  const std::function<void(const std::string &)> &set,
                  const AllowedValues                            &allowed,
                  const std::string                              &documentation)
  {
    SceneEntry entry{path, name, value, ""};
    if (name.rfind(expert, 0) == 0)
      {
        entry.name = name.substr(expert.size());
        entry.subsections.insert(entry.subsections.begin(), "Expert");
      }
    const std::string refusal = allowed.refusal(value);
    if (!refusal.empty())
      entry.refuse(refusal);
    const auto [number, is_new] =
      numbers.emplace(entry.full_name(), rows.size());
    if (is_new)
      rows.push_back({entry, allowed, documentation, {}});
    Row &row = rows[number->second];
    if (!set)
      return;
    set(row.entry.value);
    row.members.push_back(set);
  }



  void
  EntryTable::set(const SceneEntry &entry)
  {
    const auto number = numbers.find(entry.full_name());
    if (number == numbers.end())
      {
        const std::string special =
          remark_on_special_character(entry.full_name());
        const std::string likely = likely_name(entry);
        entry.refuse(
          "there is no such entry" +
          (!special.empty() ? "; " + special :
           likely.empty()   ? " (debond --print-parameters lists all entries)" :
                              "; did you mean " + likely + "?"));
      }
    if (entry.value.find("<<") != std::string::npos)
      entry.refuse("<<...>> stands for an unknown, which is for Task = "
                   "calibrate: expected a value here");
    if (entry.value.find("{{") != std::string::npos)
      entry.refuse("several values make a study: expected one value here");
    Row              &row     = rows[number->second];
    const std::string refusal = row.allowed.refusal(entry.value);
    if (!refusal.empty())
      entry.refuse(refusal + (entry.value.find('{') == std::string::npos ?
                                "" :
                                "; several values, a study, are written "
                                "{{a|b}}"));
    row.entry.value = entry.value;
    for (const auto &set_member : row.members)
      set_member(entry.value);
  }



  // A similar name in the same subsection, `Expert' left aside, the same name
  // or a similar one elsewhere, there in a subsection with a similar name, or a
  // longer name that contains this one.
  std::string
  EntryTable::likely_name(const SceneEntry &entry) const
  {
    const std::string &name = entry.name;
    // to compare a very long text with all names takes very long
    if (entry.full_name().size() > 200)
      return "";
    std::string section =
      entry.full_name().substr(0, entry.full_name().size() - name.size());
    if (section.rfind(expert, 0) == 0)
      section.erase(0, expert.size());
    std::string likely;
    double      smallest = std::max<std::size_t>(3, name.size() / 3 + 1);
    for (const Row &row : rows)
      {
        const SceneEntry &other = row.entry;
        const bool        contains =
          name.size() > 3 && other.name.find(name) != std::string::npos;
        const unsigned int elsewhere =
          edit_distance(other.full_name(), placed(section + other.name));
        const double distance =
          std::min(edit_distance(other.name, name), contains ? 1U : 1000U) +
          (elsewhere > 0 ? 1. + 1e-3 * elsewhere : 0.);
        if (distance < smallest)
          {
            smallest = distance;
            likely   = other.full_name();
          }
      }
    return likely;
  }



  const EntryTable::Row *
  EntryTable::row_of(const std::string &full_name) const
  {
    const auto number = numbers.find(full_name);
    return number == numbers.end() ? nullptr : &rows[number->second];
  }



  // Words of what is allowed have it in brackets: "a number > 0 [mm]".
  std::string
  EntryTable::unit_of(const std::string &full_name) const
  {
    const Row *const row = row_of(full_name);
    if (row == nullptr)
      return "";
    const std::string &words = row->allowed.description;
    const auto         begin = words.find('['), end = words.find(']', begin);
    return end == std::string::npos ? "" :
                                      words.substr(begin + 1, end - begin - 1);
  }



  bool
  EntryTable::has(const SceneEntry &entry) const
  {
    const Row *const row = row_of(entry.full_name());
    if (row == nullptr)
      return false;
    const auto own = read_number(row->entry.value); // 0.40 is 0.4
    return own ? own == read_number(entry.value) :
                 row->entry.value == entry.value;
  }



  bool
  EntryTable::has_default(const std::string &full_name) const
  {
    const Row *const row = row_of(full_name);
    return row == nullptr || row->allowed.has_default;
  }



  bool
  EntryTable::means(const SceneEntry &entry, const std::string &text) const
  {
    const Row *const row = row_of(entry.full_name());
    return row != nullptr && row->allowed.without_words(entry.value) ==
                               row->allowed.without_words(text);
  }



  std::string
  EntryTable::placed(const std::string &full_name) const
  {
    return row_of(expert + full_name) ? expert + full_name : full_name;
  }



  std::vector<SceneEntry>
  EntryTable::entries() const
  {
    std::vector<SceneEntry> result;
    for (const Row &row : rows)
      result.push_back(row.entry);
    std::stable_partition(result.begin(), result.end(), [](const auto &entry) {
      return entry.full_name().rfind(expert, 0) != 0;
    });
    return result;
  }



  std::string
  EntryTable::explained(const std::vector<SceneEntry> &values) const
  {
    std::vector<std::string> documentation;
    for (const SceneEntry &entry : values)
      {
        const Row &row = *row_of(entry.full_name());
        documentation.push_back(
          row.documentation + (row.allowed.has_default ? "" : "\nNo default.") +
          "\nAllowed: " + row.allowed.description);
      }
    return scene_text(values, documentation);
  }
} // namespace Debond
