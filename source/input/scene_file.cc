#include <debond/input/allowed_values.h>
#include <debond/input/input_file.h>
#include <debond/input/scene_file.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <filesystem>
#include <locale>
#include <map>
#include <sstream>
#include <utility>

namespace Debond
{
  using boost::trim_fill_copy;
  using dealii::Utilities::trim;



  std::string
  SceneEntry::full_name() const
  {
    std::string result;
    for (const std::string &subsection : subsections)
      result += subsection + " / ";
    return result + name;
  }



  void
  SceneEntry::refuse(const std::string &why) const
  {
    throw EntryError(full_name(), why, value, place);
  }



  namespace
  {
    constexpr unsigned int largest_MB = 10;



    FileRefusal
    refusal_at(const std::string &where)
    {
      return [where](const std::string &why) {
        throw InputError(where + ": " + why);
      };
    }



    /** Reads a scene and the files that it includes. */
    class SceneReader
    {
    public:
      void
      read(const std::string &text, const std::string &name)
      {
        files.push_back(name);
        const std::size_t n_outer_before = std::exchange(n_outer, path.size());

        Classic<std::istringstream> lines(
          utf8(plain_text(text, refusal_at(name))));
        std::string line, statement;
        for (unsigned int number = 1; std::getline(lines, line); ++number)
          {
            if (statement.empty())
              place = name + ":" + std::to_string(number);
            line                    = trim(line.substr(0, line.find('#')));
            const bool is_continued = !line.empty() && line.back() == '\\';
            if (is_continued)
              line.pop_back();
            statement += line;
            if (is_continued)
              continue;
            read_statement(trim(statement));
            statement.clear();
          }
        // A backslash at the very end continues nothing.
        read_statement(trim(statement));

        if (path.size() > n_outer)
          throw InputError(path_places.back() + ": the subsection '" +
                           path.back() +
                           "' that begins here is not closed by 'end'");
        n_outer = n_outer_before;
        files.pop_back();
      }

      /** In the order of reading. */
      std::vector<SceneEntry> entries;

    private:
      void
      read_statement(const std::string &statement)
      {
        if (statement.empty())
          return;
        const auto        blank = statement.find_first_of(" \t");
        const std::string keyword =
          boost::to_lower_copy(statement.substr(0, blank),
                               std::locale::classic());
        const std::string rest =
          blank == std::string::npos ? "" : trim(statement.substr(blank));

        if (keyword == "subsection" && !rest.empty())
          open_subsection(rest);
        else if (keyword == "end")
          close_subsection(rest);
        else if (keyword == "set")
          read_set(rest);
        else if (keyword == "include" && !rest.empty())
          read_include(rest);
        else
          {
            const std::string remark = remark_on_special_character(keyword);
            refuse("cannot read '" + shortened(statement) +
                   "': expected 'subsection NAME', 'set NAME = VALUE', 'end' "
                   "or 'include FILE'" +
                   (remark.empty() ? "" : "; " + remark));
          }
      }

      void
      read_set(const std::string &rest)
      {
        const auto equal = rest.find('=');
        // one blank for every run of blanks: names may be aligned
        const std::string name = trim_fill_copy(rest.substr(0, equal), " ");
        if (equal == std::string::npos || name.empty())
          refuse("cannot read 'set " + shortened(rest) +
                 "': expected 'set NAME = VALUE'");
        const SceneEntry entry{path, name, trim(rest.substr(equal + 1)), place};
        const auto [position, is_new] =
          known.try_emplace(entry.full_name(), entries.size(), files);
        if (is_new)
          {
            entries.push_back(entry);
            return;
          }
        auto &[index, earlier] = position->second;
        const bool was_included =
          earlier.size() > files.size() &&
          std::equal(files.begin(), files.end(), earlier.begin());
        if (!was_included && !entries[index].value.empty())
          entry.refuse("it is set a second time (first in " +
                       entries[index].place + ")");
        entries[index] = entry;
        earlier        = files;
      }

      void
      read_include(const std::string &filename)
      {
        namespace fs           = std::filesystem;
        const auto refuse_file = refusal_at(place + ": '" + filename + "'");
        constexpr unsigned int most_files = 1000;
        if (++n_included > most_files)
          refuse_file("more than " + std::to_string(most_files) +
                      " files are included");
        std::error_code unknown;
        if (!fs::exists(filename, unknown))
          refuse_file("there is no such file (names of files stand without "
                      "quotes and are looked for in the working directory)");
        const std::string text =
          plain_text(read_input_bytes(filename, refuse_file, largest_MB),
                     refuse_file);
        for (const std::string &file : files)
          if (fs::equivalent(file, filename, unknown))
            refuse_file("this file includes itself, directly or through "
                        "others");
        read(text, filename);
      }

      void
      open_subsection(const std::string &name)
      {
        path.push_back(trim_fill_copy(name, " "));
        path_places.push_back(place);
      }

      void
      close_subsection(const std::string &rest)
      {
        if (!rest.empty())
          refuse("cannot read 'end " + shortened(rest) +
                 "': 'end' stands alone in its line");
        if (path.size() <= n_outer)
          refuse("this 'end' closes nothing: no subsection is open");
        path.pop_back();
        path_places.pop_back();
      }

      [[noreturn]] void
      refuse(const std::string &why) const
      {
        throw InputError(place + ": " + why);
      }

      std::string              place; ///< of the statement that is read
      std::vector<std::string> files; ///< that are open, outermost first
      std::vector<std::string> path;  ///< subsections that are open
      std::vector<std::string> path_places;
      /** Number of subsections that were open when the current file began. */
      std::size_t  n_outer    = 0;
      unsigned int n_included = 0;
      /** Name of an entry -> its index, and its file with those that include
       *  it. */
      std::map<std::string, std::pair<std::size_t, std::vector<std::string>>>
        known;
    };
  } // namespace



  std::vector<SceneEntry>
  read_scene_text(const std::string &text, const std::string &name)
  {
    SceneReader reader;
    reader.read(text, name);
    if (reader.entries.empty())
      throw InputError(name + ": this scene is empty: it sets no entry");
    return reader.entries;
  }



  std::vector<SceneEntry>
  read_scene_file(const std::string &filename)
  {
    return read_scene_text(
      read_input_bytes(filename, refusal_at(filename), largest_MB), filename);
  }



  std::vector<SceneEntry>
  with_overrides(std::vector<SceneEntry>         entries,
                 const std::vector<std::string> &overrides)
  {
    for (const std::string &text : overrides)
      {
        const SceneEntry entry = read_override(text);
        // in the place of one with the same name if there is one
        const auto same =
          std::find_if(entries.begin(), entries.end(), [&](const auto &other) {
            return other.full_name() == entry.full_name();
          });
        entries.insert(same == entries.end() ? same : entries.erase(same),
                       entry);
      }
    return entries;
  }



  std::string
  scene_text(const std::vector<SceneEntry>  &entries,
             const std::vector<std::string> &documentation)
  {
    using dealii::ParameterHandler;
    ParameterHandler prm;
    for (std::size_t i = 0; i < entries.size(); ++i)
      {
        for (const std::string &subsection : entries[i].subsections)
          prm.enter_subsection(subsection);
        prm.declare_entry(entries[i].name,
                          entries[i].value,
                          dealii::Patterns::Anything(),
                          documentation.empty() ? "" : documentation[i]);
        for (std::size_t k = 0; k < entries[i].subsections.size(); ++k)
          prm.leave_subsection();
      }
    Classic<std::ostringstream> text;
    prm.print_parameters(text,
                         (documentation.empty() ? ParameterHandler::ShortPRM :
                                                  ParameterHandler::PRM) |
                           ParameterHandler::KeepDeclarationOrder);
    return text.str();
  }



  SceneEntry
  read_override(const std::string &text)
  {
    const auto refuse = [&text](const std::string &why) {
      throw InputError("--set: cannot read '" + text + "': " + why);
    };
    const auto        equal = text.find('=');
    const std::string value =
      equal == std::string::npos ? "" : trim(text.substr(equal + 1));
    // Such a value could not be written into a scene file again.
    if (value.find_first_of("#\n") != std::string::npos ||
        (!value.empty() && value.back() == '\\'))
      refuse("a value holds no '#' and no line end, and does not end in a "
             "backslash");

    SceneEntry entry{split(text.substr(0, equal), "/"), "", value, "--set"};
    for (std::string &name : entry.subsections)
      name = trim_fill_copy(name, " ");
    if (equal == std::string::npos ||
        std::count(entry.subsections.begin(), entry.subsections.end(), "") > 0)
      refuse("expected \"SUBSECTION/ENTRY=VALUE\"");
    entry.name = entry.subsections.back();
    entry.subsections.pop_back();
    return entry;
  }
} // namespace Debond
