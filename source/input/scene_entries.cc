#include <debond/input/allowed_values.h>
#include <debond/input/scene_entries.h>
#include <debond/input/special_characters.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

// property_tree still uses the placeholders of Bind that Boost warns about.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <numeric>
#include <sstream>

namespace Debond
{
  std::string
  DeclaredEntry::full_name() const
  {
    return full_entry_name(subsections, name);
  }



  namespace
  {
    using Tree = boost::property_tree::ptree;

    constexpr auto npos = std::string::npos;

    void
    collect_entries(const Tree                     &tree,
                    const std::vector<std::string> &subsections,
                    std::vector<DeclaredEntry>     &entries)
    {
      for (const auto &child : tree)
        if (child.second.get_optional<std::string>("default_value"))
          entries.push_back(
            {subsections,
             child.first,
             child.second.get<std::string>("documentation"),
             child.second.get<std::string>("pattern_description")});
      for (const auto &child : tree)
        if (!child.second.get_optional<std::string>("default_value"))
          {
            std::vector<std::string> inner = subsections;
            inner.push_back(child.first);
            collect_entries(child.second, inner, entries);
          }
    }
  } // namespace



  std::vector<DeclaredEntry>
  declared_entries(const dealii::ParameterHandler &prm)
  {
    // The handler shows its documentation and patterns only in what it prints.
    std::stringstream text;
    prm.print_parameters(text,
                         dealii::ParameterHandler::JSON |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    Tree tree;
    boost::property_tree::read_json(text, tree);

    std::vector<DeclaredEntry> entries;
    collect_entries(tree, {}, entries);
    return entries;
  }



  namespace
  {
    /** Number of letters to insert, delete or change to make one text of the
     *  other, capitals ignored. */
    unsigned int
    edit_distance(const std::string &a, const std::string &b)
    {
      const auto lower = [](const char c) {
        return (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
      };
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const unsigned int changed =
                diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
              diagonal   = row[j + 1];
              row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row.back();
    }



    /** Of all entries the one for which @p distance is smallest, or nothing if
     *  it is nowhere below @p limit. */
    template <typename Distance>
    std::string
    nearest_entry(const std::vector<DeclaredEntry> &declared,
                  const Distance                   &distance,
                  const unsigned int                limit)
    {
      std::string  nearest;
      unsigned int smallest = limit;
      for (const DeclaredEntry &candidate : declared)
        {
          const unsigned int candidate_distance = distance(candidate);
          if (candidate_distance < smallest)
            {
              nearest  = candidate.full_name();
              smallest = candidate_distance;
            }
        }
      return nearest;
    }



    /** What an unknown entry may have been meant to be, or nothing: a similar
     *  name in the same subsection, a similar full name, a longer name in the
     *  same subsection, the same name elsewhere. */
    std::string
    likely_name(const SceneEntry                 &entry,
                const std::vector<DeclaredEntry> &declared)
    {
      constexpr unsigned int far       = 1000000;
      const std::string      full_name = entry.full_name();
      std::string            likely    = nearest_entry(
        declared,
        [&](const DeclaredEntry &candidate) {
          return candidate.subsections == entry.subsections ?
                                 edit_distance(candidate.name, entry.name) :
                                 far;
        },
        std::max<std::size_t>(3, entry.name.size() / 3 + 1));
      if (likely.empty())
        likely = nearest_entry(
          declared,
          [&](const DeclaredEntry &candidate) {
            return edit_distance(candidate.full_name(), full_name);
          },
          std::max<std::size_t>(3, full_name.size() / 4 + 1));
      if (likely.empty() && entry.name.size() > 3)
        likely = nearest_entry(
          declared,
          [&](const DeclaredEntry &candidate) {
            return candidate.subsections == entry.subsections &&
                       candidate.name.find(entry.name) != std::string::npos ?
                     candidate.name.size() :
                     far;
          },
          far);
      if (likely.empty())
        likely = nearest_entry(
          declared,
          [&](const DeclaredEntry &candidate) {
            return edit_distance(candidate.name, entry.name);
          },
          1);
      return likely;
    }



    bool
    subsection_exists(const std::vector<std::string>   &path,
                      const std::vector<DeclaredEntry> &declared)
    {
      return std::any_of(declared.begin(),
                         declared.end(),
                         [&](const DeclaredEntry &entry) {
                           return entry.subsections.size() >= path.size() &&
                                  std::equal(path.begin(),
                                             path.end(),
                                             entry.subsections.begin());
                         });
    }



    [[noreturn]] void
    refuse_unknown(const SceneEntry                 &entry,
                   const std::vector<DeclaredEntry> &declared)
    {
      std::vector<std::string> path = entry.subsections;
      std::string              message =
        entry.place + ": " + shortened(entry.full_name()) + " is unknown";
      if (!subsection_exists(path, declared))
        {
          while (path.size() > 1 &&
                 !subsection_exists({path.begin(), path.end() - 1}, declared))
            path.pop_back();
          const std::string subsection = shortened(path.back());
          path.pop_back();
          message +=
            path.empty() ?
              ": there is no subsection '" + subsection + "'" :
              ": " +
                full_entry_name({path.begin(), path.end() - 1}, path.back()) +
                " has no subsection '" + subsection + "'";
        }
      const std::string special =
        remark_on_special_character(shortened(entry.full_name()));
      if (!special.empty())
        throw InputError(message + special);
      // to compare a very long text with all names takes very long
      const std::string likely =
        entry.full_name().size() < 200 ? likely_name(entry, declared) : "";
      throw InputError(message +
                       (likely.empty() ?
                          " (debond --print-parameters lists all entries)" :
                          "; did you mean " + likely + "?"));
    }



    /** Whether @p value is among what the words of @p allowed put off to a
     *  later version. */
    bool
    is_put_off(const std::string &value, const std::string &allowed)
    {
      const std::string            key   = "(not in this version: ";
      const std::string::size_type begin = allowed.find(key);
      if (begin == std::string::npos)
        return false;
      const std::string list =
        allowed.substr(begin + key.size(),
                       allowed.find(')', begin) - begin - key.size());
      if (list == "anything else")
        return true;
      const std::vector<std::string> choices =
        dealii::Utilities::split_string_list(list, '|');
      return std::find(choices.begin(), choices.end(), value) != choices.end();
    }



    /** The longest beginning of @p item that is made of the letters of a
     *  number, if it is one; else nothing. */
    std::string
    leading_number(const std::string &item)
    {
      const std::string beginning =
        item.substr(0, item.find_first_not_of("0123456789+-."));
      double number = 0;
      return read_number(beginning, number) ? beginning : "";
    }



    bool
    consists_of(const std::string &text, const std::string &letters)
    {
      return !text.empty() && text.find_first_not_of(letters) == npos;
    }



    /** `0.1 %` where a number is wanted. */
    std::string
    remark_on_percent(const std::string &item)
    {
      double number = 0;
      if (item.back() != '%' ||
          !read_number(item.substr(0, item.size() - 1), number))
        return "";
      return "; " + item + " is " + to_text(number / 100.) +
             ": write that number";
    }



    /** What may be wrong with something that is no number, or nothing. */
    std::string
    why_no_number(const std::string &item, const bool is_in_list)
    {
      const std::string begin = leading_number(item);
      const std::string rest  = item.substr(begin.size());
      if (item.empty())
        return "; a value is missing";
      if (consists_of(item, "0123456789+-.eE") && std::isdigit(item.back()))
        {
          char *end = nullptr;
          std::strtod(item.c_str(), &end);
          if (*end == '\0')
            return "; '" + item + "' is beyond the numbers of a computer";
        }
      if (begin == "0" && (rest[0] == 'x' || rest[0] == 'X'))
        return "; numbers are decimal";
      if (!begin.empty() && (rest[0] == 'd' || rest[0] == 'D') &&
          consists_of(rest.substr(1), "0123456789+-"))
        return "; exponents are written with e: " + begin + "e" +
               rest.substr(1);
      if (item.find_first_of("*/^()") != npos)
        return "; a formula cannot stand here";
      if (is_in_list &&
          (item.find(';') != npos || consists_of(item, "0123456789+-.eE \t") ||
           (!begin.empty() && consists_of(item, "0123456789+-.eExX \t"))))
        return "; values are separated by commas";
      const std::string percent = remark_on_percent(item);
      if (!percent.empty())
        return percent;
      if (!begin.empty())
        return "; give the number alone, without a unit";
      return "; '" + shortened(item) + "' is no number";
    }



    /** `0,3` where a single number is wanted. */
    std::string
    remark_on_comma(const std::vector<std::string> &items)
    {
      double     number          = 0;
      const bool is_one_by_comma = items.size() == 2 &&
                                   read_number(items[0], number) &&
                                   consists_of(items[1], "0123456789");
      if (!is_one_by_comma)
        return "";
      return items[1].size() == 3 ?
               "; decimals are written with a point, and nothing stands "
               "between thousands: " +
                 items[0] + "." + items[1] + " or " + items[0] + items[1] :
               "; decimals are written with a point: " + items[0] + "." +
                 items[1];
    }



    std::string
    remark_on_list(const std::vector<std::string> &items,
                   const std::string              &allowed)
    {
      double number = 0;
      for (const std::string &item : items)
        if (!read_number(item, number))
          return why_no_number(item, true);
      for (const std::string &item : items)
        if (allowed.find("whole") != npos && !consists_of(item, "+0123456789"))
          return "; '" + item + "' is no whole number >= 1";
        else if (allowed.find("whole") != npos && read_number(item, number) &&
                 number > 1e9)
          return "; '" + item + "' is more than a billion";
      const std::size_t wanted = std::strtoul(allowed.c_str(), nullptr, 10);
      const bool        is_fixed =
        allowed.find(" or more ") == npos && allowed.find(" to ") == npos;
      if (is_fixed && items.size() != wanted)
        return "; here are " + std::to_string(items.size()) +
               (items.size() > wanted ? " (decimals are written with a point)" :
                                        "");
      return "";
    }



    /** Why Allowed::directory() does not take a name. */
    std::string
    remark_on_directory(const std::string &name)
    {
      if (name.empty())
        return "";
      if (has_quotes(name))
        return "; it stands without quotes";
      if (name.find('\\') != npos)
        return "; directories are separated by /";
      if (name[0] == '~' || name[0] == '$')
        return std::string("; no shell replaces ") + name[0] +
               " here: write the directory that it stands for";
      return "; this is the root of all directories";
    }



    /** A remark on frequent mistakes, or nothing. */
    std::string
    hint_for(const std::string &value, const std::string &allowed)
    {
      const std::vector<std::string> items  = split_list(value);
      double                         number = 0;
      const bool is_list = allowed.find("separated by commas") != npos;
      if (allowed == Allowed::directory().description())
        return remark_on_directory(value);
      const std::string special = remark_on_special_character(value);
      if (!special.empty())
        return special + (is_list && value.find("\u00D7") != npos ?
                            "; values are separated by commas" :
                            "");
      if (items.empty() || (!is_list && allowed.find("number") == npos))
        return "";
      if (is_list)
        return remark_on_list(items, allowed);
      if (items.size() > 1)
        return remark_on_comma(items);
      return read_number(value, number) ? "" : why_no_number(value, false);
    }



    [[noreturn]] void
    refuse_value(const SceneEntry &entry, const DeclaredEntry &declared)
    {
      const std::string beginning = entry.place + ": " + entry.full_name() +
                                    " = '" + shortened(entry.value) + "' ";
      const std::string expected =
        declared.allowed.substr(0, declared.allowed.find(" (not in this"));
      if (is_put_off(entry.value, declared.allowed))
        throw InputError(beginning + "is not in this version: expected " +
                         (expected == "nothing" ? "no value" : expected));
      throw InputError(beginning + "is not allowed: expected " + expected +
                       hint_for(entry.value, declared.allowed));
    }



    void
    apply_entry(const SceneEntry         &entry,
                const DeclaredEntry      &declared,
                dealii::ParameterHandler &prm)
    {
      if (entry.value.find("{{") != std::string::npos)
        throw InputError(entry.place + ": " + entry.full_name() + " = '" +
                         shortened(entry.value) +
                         "' holds several values, which makes a study: "
                         "expected one value here");

      for (const std::string &subsection : entry.subsections)
        prm.enter_subsection(subsection);
      bool accepted = true;
      try
        {
          prm.set(entry.name, entry.value);
        }
      catch (const dealii::ParameterHandler::ExcValueDoesNotMatchPattern &)
        {
          accepted = false;
        }
      for (std::size_t i = 0; i < entry.subsections.size(); ++i)
        prm.leave_subsection();
      if (!accepted)
        refuse_value(entry, declared);
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



  void
  apply_entries(const std::vector<SceneEntry> &entries,
                dealii::ParameterHandler      &prm)
  {
    const std::vector<DeclaredEntry> declared = declared_entries(prm);
    for (const SceneEntry &entry : entries)
      {
        const auto position =
          std::find_if(declared.begin(),
                       declared.end(),
                       [&](const DeclaredEntry &candidate) {
                         return candidate.name == entry.name &&
                                candidate.subsections == entry.subsections;
                       });
        if (position == declared.end())
          refuse_unknown(entry, declared);
        apply_entry(entry, *position, prm);
      }
  }



  void
  print_entries(const dealii::ParameterHandler &prm, std::ostream &out)
  {
    std::vector<std::string> open;
    std::string              separator; // before all but the first in a block
    const auto               close = [&] {
      open.pop_back();
      out << std::string(2 * open.size(), ' ') << "end\n";
      separator = "\n";
    };

    for (const DeclaredEntry &entry : declared_entries(prm))
      {
        const std::vector<std::string> &path = entry.subsections;
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
        const std::string value = prm.get(path, entry.name);
        out << separator;
        print_comment(entry.documentation, indent, out);
        print_comment("Allowed: " + entry.allowed, indent, out);
        out << indent << "set " << entry.name << " ="
            << (value.empty() ? "" : " " + value) << '\n';
        separator = "\n";
      }
    while (!open.empty())
      close();
  }
} // namespace Debond
