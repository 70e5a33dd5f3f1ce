#include <debond/input/entry_table.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/compare.hpp>

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <sstream>

namespace Debond
{
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
    const SceneEntry  entry{path, name, value, ""};
    const std::string refusal = allowed.refusal(value);
    if (!refusal.empty())
      entry.refuse(refusal);
    const auto last =
      std::find_if(rows.rbegin(), rows.rend(), [this](const Row &row) {
        return row.entry.subsections == path;
      });
    rows.insert(last == rows.rend() ? rows.end() : last.base(),
                {entry, set, allowed, documentation});
  }



  void
  EntryTable::set(const SceneEntry &entry)
  {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row &r) {
      return r.entry.full_name() == entry.full_name();
    });
    if (row == rows.end())
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
    if (entry.value.find("{{") != std::string::npos)
      entry.refuse("several values make a study: expected one value here");
    const std::string refusal = row->allowed.refusal(entry.value);
    if (!refusal.empty())
      entry.refuse(refusal);
    row->entry.value = entry.value;
    if (row->set)
      row->set(entry.value);
  }



  namespace
  {
    /** Number of letters to insert, delete or change to make one text of the
     *  other, capitals ignored. */
    unsigned int
    edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (const char letter : a)
        {
          unsigned int diagonal = row[0]++;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const unsigned int changed =
                diagonal + (boost::is_iequal()(letter, b[j]) ? 0 : 1);
              diagonal   = row[j + 1];
              row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row.back();
    }



    /** Writes @p text as comment lines of at most 80 characters. */
    void
    print_comment(const std::string &text,
                  const std::string &indent,
                  std::ostream      &out)
    {
      for (const std::string &line : dealii::Utilities::break_text_into_lines(
             text, 78 - static_cast<int>(indent.size())))
        out << indent << "# " << line << '\n';
    }
  } // namespace



  // A similar name in the same subsection, the same name or a similar one
  // elsewhere, or a longer name that contains this one.
  std::string
  EntryTable::likely_name(const SceneEntry &entry) const
  {
    const std::string &name = entry.name;
    // to compare a very long text with all names takes very long
    if (entry.full_name().size() > 200)
      return "";
    std::string  likely;
    unsigned int smallest = std::max<std::size_t>(3, name.size() / 3 + 1);
    for (const Row &row : rows)
      {
        const SceneEntry &other = row.entry;
        const bool        contains =
          name.size() > 3 && other.name.find(name) != std::string::npos;
        const unsigned int distance =
          std::min(edit_distance(other.name, name), contains ? 1U : 1000U) +
          (other.subsections == entry.subsections ? 0 : 1);
        if (distance < smallest)
          {
            smallest = distance;
            likely   = other.full_name();
          }
      }
    return likely;
  }



  std::string
  EntryTable::text() const
  {
    std::ostringstream out;
    print(out, false);
    return out.str();
  }



  void
  EntryTable::print(std::ostream &out, const bool documented) const
  {
    const std::string        between_entries = documented ? "\n" : "";
    std::vector<std::string> open;
    std::string              separator; // before all but the first in a block
    const auto               close = [&] {
      open.pop_back();
      out << std::string(2 * open.size(), ' ') << "end\n";
      separator = between_entries;
    };

    for (const auto &[entry, set, allowed, documentation] : rows)
      {
        const std::vector<std::string> &path = entry.subsections;
        while (open.size() > path.size() ||
               !std::equal(open.begin(), open.end(), path.begin()))
          close();
        for (; open.size() < path.size(); separator.clear())
          {
            out << separator << std::string(2 * open.size(), ' ')
                << "subsection " << path[open.size()] << '\n';
            open.push_back(path[open.size()]);
          }
        const std::string indent(2 * open.size(), ' ');
        std::size_t width = 0; // the values of a subsection stand in a column
        if (documented)
          {
            out << separator;
            print_comment(documentation, indent, out);
            print_comment("Allowed: " + allowed.description, indent, out);
          }
        else
          for (const Row &row : rows)
            if (row.entry.subsections == path)
              width = std::max(width, row.entry.name.size());
        out << indent << "set " << std::left << std::setw(width) << entry.name
            << " ="
            << (entry.value.empty() && documented ? "" : " " + entry.value)
            << '\n';
        separator = between_entries;
      }
    while (!open.empty())
      close();
  }
} // namespace Debond
