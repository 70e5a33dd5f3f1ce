#include <debond/input/input_file.h>
#include <debond/input/scene_file.h>
#include <debond/input/special_characters.h>
#include <debond/support/input_error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

namespace Debond
{
  using dealii::Utilities::trim;



  std::string
  full_entry_name(const std::vector<std::string> &subsections,
                  const std::string              &name)
  {
    std::string result;
    for (const std::string &subsection : subsections)
      result += subsection + " / ";
    return result + name;
  }



  std::string
  SceneEntry::full_name() const
  {
    return full_entry_name(subsections, name);
  }



  namespace
  {
    /** Makes one blank of every run of blanks, so that names may be aligned. */
    std::string
    single_blanks(const std::string &text)
    {
      std::istringstream words(text);
      std::string        result, word;
      while (words >> word)
        result += (result.empty() ? "" : " ") + word;
      return result;
    }



    std::string
    in_lower_case(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const char c) {
        return (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
      });
      return text;
    }



    std::string
    contents_of(const std::string &filename, const std::string &where)
    {
      constexpr unsigned int largest_MB = 10;
      return read_input_text(filename, where, largest_MB);
    }



    /** Reads a scene and the files that it includes. */
    class SceneReader
    {
    public:
      void
      read(const std::string &text, const std::string &name);

      std::vector<SceneEntry>
      entries() const;

    private:
      struct OpenSubsection
      {
        std::string name;
        std::string place;
      };

      void
      read_statement(const std::string &statement, const std::string &place);
      void
      read_set(const std::string &rest, const std::string &place);
      void
      read_include(const std::string &filename, const std::string &place);
      void
      open_subsection(const std::string &name, const std::string &place);
      void
      close_subsection(const std::string &rest, const std::string &place);
      void
      refuse_repetition(const SceneEntry &entry) const;

      std::vector<std::string>
      current_path() const;

      struct Found
      {
        SceneEntry entry;
        /** The file of the entry and those that include it, outermost first. */
        std::vector<std::string> files;
        unsigned int             number; ///< in the order of reading
      };

      std::vector<std::string>    files;
      std::vector<OpenSubsection> open_subsections;
      /** Number of subsections that were open when the current file began. */
      std::size_t                  outer_subsections = 0;
      std::map<std::string, Found> found;
      unsigned int                 n_found = 0, n_included = 0;
    };



    void
    SceneReader::read(const std::string &text, const std::string &name)
    {
      files.push_back(name);
      const std::size_t outer_subsections_before = outer_subsections;
      outer_subsections                          = open_subsections.size();

      std::istringstream lines(plain_text(text, name + ": "));
      std::string        line, statement, place;
      unsigned int       line_number = 0;
      while (std::getline(lines, line))
        {
          ++line_number;
          if (statement.empty())
            place = name + ":" + std::to_string(line_number);
          line                    = trim(line.substr(0, line.find('#')));
          const bool is_continued = !line.empty() && line.back() == '\\';
          if (is_continued)
            line.pop_back();
          statement += line;
          if (is_continued)
            continue;
          read_statement(trim(statement), place);
          statement.clear();
        }
      // A backslash at the very end continues nothing.
      read_statement(trim(statement), place);

      if (open_subsections.size() > outer_subsections)
        throw InputError(open_subsections.back().place + ": the subsection '" +
                         open_subsections.back().name +
                         "' that begins here is not closed by 'end'");
      outer_subsections = outer_subsections_before;
      files.pop_back();
    }



    std::vector<SceneEntry>
    SceneReader::entries() const
    {
      std::vector<const Found *> in_order;
      for (const auto &item : found)
        in_order.push_back(&item.second);
      std::sort(in_order.begin(),
                in_order.end(),
                [](const Found *a, const Found *b) {
                  return a->number < b->number;
                });
      std::vector<SceneEntry> result;
      for (const Found *const item : in_order)
        result.push_back(item->entry);
      return result;
    }



    void
    SceneReader::read_statement(const std::string &statement,
                                const std::string &place)
    {
      if (statement.empty())
        return;
      const std::string::size_type blank = statement.find_first_of(" \t");
      const std::string keyword = in_lower_case(statement.substr(0, blank));
      const std::string rest =
        blank == std::string::npos ? "" : trim(statement.substr(blank));

      if (keyword == "subsection" && !rest.empty())
        open_subsection(rest, place);
      else if (keyword == "end")
        close_subsection(rest, place);
      else if (keyword == "set")
        read_set(rest, place);
      else if (keyword == "include" && !rest.empty())
        read_include(rest, place);
      else
        throw InputError(place + ": cannot read '" + shortened(statement) +
                         "': expected 'subsection NAME', 'set NAME = VALUE', "
                         "'end' or 'include FILE'" +
                         remark_on_special_character(keyword));
    }



    void
    SceneReader::read_set(const std::string &rest, const std::string &place)
    {
      const std::string::size_type equal = rest.find('=');
      const std::string            name  = single_blanks(rest.substr(0, equal));
      if (equal == std::string::npos || name.empty())
        throw InputError(place + ": cannot read 'set " + shortened(rest) +
                         "': expected 'set NAME = VALUE'");
      const SceneEntry entry{current_path(),
                             name,
                             trim(rest.substr(equal + 1)),
                             place};
      refuse_repetition(entry);
      found[entry.full_name()] = Found{entry, files, n_found};
      ++n_found;
    }



    void
    SceneReader::refuse_repetition(const SceneEntry &entry) const
    {
      const auto position = found.find(entry.full_name());
      if (position == found.end())
        return;
      const std::vector<std::string> &earlier = position->second.files;
      const bool                      was_included =
        earlier.size() > files.size() &&
        std::equal(files.begin(), files.end(), earlier.begin());
      if (!was_included)
        throw InputError(entry.place + ": " + entry.full_name() +
                         " is set a second time (first in " +
                         position->second.entry.place + ")");
    }



    void
    SceneReader::read_include(const std::string &filename,
                              const std::string &place)
    {
      namespace fs                      = std::filesystem;
      const std::string      where      = place + ": '" + filename + "': ";
      constexpr unsigned int most_files = 1000;
      if (++n_included > most_files)
        throw InputError(where + "more than " + std::to_string(most_files) +
                         " files are included");
      std::error_code unknown;
      if (!fs::exists(filename, unknown))
        throw InputError(where +
                         "there is no such file (included files are "
                         "looked for in the working directory)" +
                         (has_quotes(filename) ?
                            "; names of files stand without quotes" :
                            ""));
      const std::string text    = contents_of(filename, where);
      const auto        is_open = [&](const std::string &file) {
        std::error_code error;
        return fs::equivalent(file, filename, error);
      };
      if (std::any_of(files.begin(), files.end(), is_open))
        throw InputError(place + ": the file '" + filename +
                         "' includes itself, directly or through others");
      read(text, filename);
    }



    void
    SceneReader::open_subsection(const std::string &name,
                                 const std::string &place)
    {
      constexpr std::size_t deepest = 20; // that of a scene is 2
      if (open_subsections.size() == deepest)
        throw InputError(place + ": more than " + std::to_string(deepest) +
                         " subsections are open: is an 'end' missing?");
      open_subsections.push_back({single_blanks(name), place});
    }



    void
    SceneReader::close_subsection(const std::string &rest,
                                  const std::string &place)
    {
      if (!rest.empty())
        throw InputError(place + ": cannot read 'end " + shortened(rest) +
                         "': 'end' stands alone in its line");
      if (open_subsections.size() <= outer_subsections)
        throw InputError(place +
                         ": this 'end' closes nothing: no subsection is open");
      open_subsections.pop_back();
    }



    std::vector<std::string>
    SceneReader::current_path() const
    {
      std::vector<std::string> path;
      for (const OpenSubsection &subsection : open_subsections)
        path.push_back(subsection.name);
      return path;
    }
  } // namespace



  std::vector<SceneEntry>
  read_scene_text(const std::string &text, const std::string &name)
  {
    SceneReader reader;
    reader.read(text, name);
    std::vector<SceneEntry> entries = reader.entries();
    if (entries.empty())
      throw InputError(name + ": this scene is empty: it sets no entry");
    return entries;
  }



  std::vector<SceneEntry>
  read_scene_file(const std::string &filename)
  {
    return read_scene_text(contents_of(filename, filename + ": "), filename);
  }



  void
  set_entry(std::vector<SceneEntry> &entries, const SceneEntry &entry)
  {
    for (SceneEntry &other : entries)
      if (other.full_name() == entry.full_name())
        {
          other = entry;
          return;
        }
    entries.push_back(entry);
  }



  std::vector<SceneEntry>
  with_overrides(std::vector<SceneEntry>         entries,
                 const std::vector<std::string> &overrides)
  {
    for (const std::string &text : overrides)
      set_entry(entries, read_override(text));
    return entries;
  }



  SceneEntry
  read_override(const std::string &text)
  {
    const std::string::size_type equal      = text.find('=');
    const std::string            entry_name = trim(text.substr(0, equal));
    if (equal == std::string::npos || entry_name.empty())
      throw InputError("--set: cannot read '" + text +
                       "': expected \"SUBSECTION/ENTRY=VALUE\"");
    const std::string value = trim(text.substr(equal + 1));
    // Such a value could not be written into a scene file again.
    if (value.find_first_of("#\n") != std::string::npos ||
        (!value.empty() && value.back() == '\\'))
      throw InputError("--set: cannot read '" + text +
                       "': a value holds no '#' and no line end, and does not "
                       "end in a backslash");

    SceneEntry         entry{{}, "", value, "--set"};
    std::istringstream parts(entry_name);
    std::string        part;
    while (std::getline(parts, part, '/'))
      {
        entry.subsections.push_back(single_blanks(part));
        if (entry.subsections.back().empty())
          throw InputError("--set: cannot read '" + text +
                           "': expected \"SUBSECTION/ENTRY=VALUE\"");
      }
    entry.name = entry.subsections.back();
    entry.subsections.pop_back();
    return entry;
  }
} // namespace Debond
