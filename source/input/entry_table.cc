#include <debond/input/entry_table.h>
#include <debond/support/input_error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace Debond
{
  void
  EntryTable::enter_subsection(const std::string &name)
  {
    path.push_back(name);
    prm.enter_subsection(name);
  }



  void
  EntryTable::leave_subsection()
  {
    path.pop_back();
    prm.leave_subsection();
  }



  void
  EntryTable::add(const std::string                              &name,
                  const std::string                              &value,
                  const std::function<void(const std::string &)> &set,
                  const AllowedValues                            &allowed,
                  const std::string                              &documentation)
  {
    const std::string refusal = allowed.refusal(value);
    if (!refusal.empty())
      throw EntryError(full_entry_name(path, name), refusal, value);
    rows.push_back({path, name, allowed, documentation});
    prm.declare_entry(name, value, allowed, documentation);
    prm.add_action(name, set);
  }



  void
  EntryTable::reserve(const std::string &name,
                      const std::string &value,
                      const std::string &documentation)
  {
    add(
      name,
      value,
      [](const std::string &) {},
      Allowed::reserved(value),
      documentation);
  }



  void
  EntryTable::set(const SceneEntry &entry)
  {
    const auto refuse = [&entry](const std::string &why) {
      throw EntryError(entry.full_name(), why, entry.value, entry.place);
    };
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row &r) {
      return r.name == entry.name && r.subsections == entry.subsections;
    });
    if (row == rows.end())
      {
        const std::string special =
          remark_on_special_character(entry.full_name());
        const std::string likely = likely_name(entry);
        refuse(
          "there is no such entry" +
          (!special.empty() ? "; " + special :
           likely.empty()   ? " (debond --print-parameters lists all entries)" :
                              "; did you mean " + likely + "?"));
      }
    if (entry.value.find("{{") != std::string::npos)
      refuse("several values make a study: expected one value here");
    const std::string refusal = row->allowed.refusal(entry.value);
    if (!refusal.empty())
      refuse(refusal);

    for (const std::string &subsection : entry.subsections)
      prm.enter_subsection(subsection);
    prm.set(entry.name, entry.value);
    for (std::size_t i = 0; i < entry.subsections.size(); ++i)
      prm.leave_subsection();
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
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const bool is_same =
                std::tolower(static_cast<unsigned char>(a[i])) ==
                std::tolower(static_cast<unsigned char>(b[j]));
              const unsigned int changed = diagonal + (is_same ? 0 : 1);
              diagonal                   = row[j + 1];
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
        const bool contains =
          name.size() > 3 && row.name.find(name) != std::string::npos;
        const unsigned int distance =
          std::min(edit_distance(row.name, name), contains ? 1U : 1000U) +
          (row.subsections == entry.subsections ? 0 : 1);
        if (distance < smallest)
          {
            smallest = distance;
            likely   = full_entry_name(row.subsections, row.name);
          }
      }
    return likely;
  }



  std::string
  EntryTable::text() const
  {
    std::ostringstream out;
    prm.print_parameters(out,
                         dealii::ParameterHandler::ShortPRM |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    return out.str();
  }



  void
  EntryTable::print(std::ostream &out) const
  {
    std::vector<std::string> open;
    std::string              separator; // before all but the first in a block
    const auto               close = [&] {
      open.pop_back();
      out << std::string(2 * open.size(), ' ') << "end\n";
      separator = "\n";
    };

    for (const Row &row : rows)
      {
        const std::vector<std::string> &path = row.subsections;
        while (open.size() > path.size() ||
               !std::equal(open.begin(), open.end(), path.begin()))
          close();
        while (open.size() < path.size())
          {
            out << separator << std::string(2 * open.size(), ' ')
                << "subsection " << path[open.size()] << '\n';
            open.push_back(path[open.size()]);
            separator.clear();
          }
        const std::string indent(2 * open.size(), ' ');
        const std::string value = prm.get(path, row.name);
        out << separator;
        print_comment(row.documentation, indent, out);
        print_comment("Allowed: " + row.allowed.description(), indent, out);
        out << indent << "set " << row.name << " ="
            << (value.empty() ? "" : " " + value) << '\n';
        separator = "\n";
      }
    while (!open.empty())
      close();
  }
} // namespace Debond
