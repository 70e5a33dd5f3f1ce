#include <debond/input/allowed_values.h>
#include <debond/input/input_file.h>
#include <debond/input/old_names.h>
#include <debond/input/scene_file.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <functional>
#include <locale>
#include <regex>
#include <sstream>
#include <utility>
#include <vector>

namespace Debond
{
  namespace
  {
    using boost::trim_copy;

    struct Change
    {
      /** Of the entry in version 1; `*` stands for any subsection. */
      const char *old_name;
      /** In version 2; empty: the same. */
      const char *new_name = "";
      /** A value of version 1 and that of version 2. A number is compared as
       *  one. */
      std::vector<std::pair<const char *, const char *>> values = {};
    };

    const std::vector<Change> changes{
      {"Model",
       "",
       {{"mathieu", "crack"}, {"analytical", "prescribed angles"}}},
      {"Bone / Bulk solver", "Bone / Solver"},
      {"Bone / Mesh file", "", {{"", "none"}}},
      {"Bone / Outer radius", "", {{"0", "none"}}},
      {"Bone / Height", "", {{"0", "auto"}}},
      {"Bone / Support radius", "", {{"0", "none"}}},
      {"Bone / Cells under implant", "", {{"0", "none"}}},
      {"Bone / Voxel file", "", {{"", "none"}}},
      {"Implant / Mesh file", "", {{"", "none"}}},
      {"Interface / Penalty stiffness", "Interface / Normal stiffness"},
      {"Interface / Tangential penalty stiffness",
       "Interface / Tangential stiffness",
       {{"0", "auto"}}},
      {"Interface / Sliding threshold",
       "Interface / Characteristic slip distance"},
      {"Interface / Friction table", "", {{"", "none"}}},
      {"Interface / Slip direction", "Expert / Slip direction"},
      {"Interface / Friction update", "Expert / Friction update"},
      {"Interface / Rate and state / Initial state", "", {{"0", "auto"}}},
      {"Interface / Bonding / Initial bonding",
       "Interface / Bonding / Bonding degree"},
      {"Interface / Bonding / File", "", {{"", "none"}}},
      {"Interface / Bonding / White level", "", {{"0", "auto"}}},
      {"Interface / Bonding / Threshold", "", {{"-1", "none"}}},
      {"Chuck / * / File", "", {{"", "none"}}},
      {"Chuck / * / File columns", "", {{"", "auto"}}},
      {"Chuck / * / Stiffness", "", {{"0", "none"}}},
      {"Load steps / Largest slip step", "", {{"0", "auto"}}},
      {"Load steps / Path ends at slip", "", {{"0", "auto"}}},
      {"Closed form / Pressure", "", {{"0", "auto"}}},
      {"Closed form / Normal stiffness", "", {{"0", "auto"}}},
      {"Closed form / Torsional stiffness", "", {{"0", "auto"}}},
      {"Closed form / Full sliding angle",
       "Closed form / Slip counts from angle"},
      {"Study / Reference variant", "", {{"0", "none"}}},
      {"Study / Factors varied at once", "", {{"0", "all"}}},
      {"Calibration / Curves", "", {{"", "auto"}}},
      {"Calibration / Over", "", {{"", "auto"}}},
      {"Calibration / Windows", "", {{"", "none"}}},
      {"Calibration / Noise", "", {{"0", "auto"}}},
      {"Calibration / Noise columns", "", {{"", "none"}}},
      {"Output / Fields every", "", {{"0", "none"}}},
      {"Output / Reference curve", "", {{"", "none"}}},
      {"Output / Reference columns", "", {{"", "auto"}}},
      {"Output / Reference profiles", "", {{"", "none"}}},
      {"Output / Curve at", "Output / Curve angles", {{"", "none"}}},
      {"Output / Full sliding angle",
       "Output / Friction energy from angle",
       {{"0", "auto"}}},
      {"Output / Observed bonding", "", {{"0", "auto"}}},
      {"Output / Profile angles", "", {{"", "none"}}},
      {"Output / Checkpoint every", "", {{"0", "none"}}},
      {"Output / Checkpoint minutes", "", {{"0", "none"}}},
      {"Output / Published values",
       "Output / Reference marks",
       {{"", "none"}}}};



    bool
    is_called(const std::string &full_name, const std::string &pattern)
    {
      const auto star = pattern.find('*');
      if (star == std::string::npos)
        return full_name == pattern;
      return boost::starts_with(full_name, pattern.substr(0, star)) &&
             boost::ends_with(full_name, pattern.substr(star + 1)) &&
             full_name.size() >= pattern.size();
    }
  } // namespace



  std::string
  new_name_of(const std::string &full_name)
  {
    for (const Change &change : changes)
      if (change.new_name[0] != '\0' && full_name == change.old_name)
        return change.new_name;
    return "";
  }



  std::string
  new_value_of(const std::string &full_name, const std::string &value)
  {
    const auto number = read_number(value);
    for (const Change &change : changes)
      if (is_called(full_name,
                    change.new_name[0] == '\0' ? change.old_name :
                                                 change.new_name))
        for (const auto &[before, now] : change.values)
          if (value == before || (number && read_number(before) == number))
            return now;
    return value;
  }



  namespace
  {
    /** {{name: a|b|c}}, or {{a||b}}, and what follows: the values are changed
     * by
     *  @p change. Nothing of what is none. */
    std::string
    with_each_value(
      const std::string                                     &text,
      const std::function<std::string(const std::string &)> &change)
    {
      static const std::regex several(
        "\\{\\{([A-Za-z0-9 _]+:)?([^{}]*)\\}\\}(.*)");
      std::smatch parts;
      if (!std::regex_match(text, parts, several))
        return "";
      const std::string items = parts[2],
                        bar   = items.find("||") == items.npos ? "|" : "||";
      std::string list;
      for (const std::string &item : split(items, bar))
        list += (list.empty() ? "" : bar) + change(item);
      return "{{" + (parts[1].matched ? parts[1].str() + " " : "") + list +
             "}}" + parts[3].str();
    }



    /** new_value_of() each value of a study. */
    std::string
    new_values_of(const std::string &full_name, const std::string &value)
    {
      const std::string of_study =
        with_each_value(value, [&](const std::string &item) {
          return new_value_of(full_name, item);
        });
      return of_study.empty() ? new_value_of(full_name, value) : of_study;
    }



    /** Whether an expression is one product that begins with a minus. */
    bool
    is_negative_product(const std::string &expression)
    {
      int depth = 0;
      for (std::size_t i = 1; i < expression.size(); ++i)
        {
          const char        c   = expression[i];
          const std::string two = expression.substr(i, 2);
          if (two == "<<" || two == ">>") // an unknown of a calibration
            {
              depth += two == "<<" ? 1 : -1;
              ++i;
              continue;
            }
          depth += (c == '(' || c == '{') - (c == ')' || c == '}');
          // the sign of an exponent is none of a sum
          const char before = expression[i - 1];
          const bool is_sum =
            (c == '+' || c == '-') && before != 'e' && before != 'E';
          if (depth == 0 &&
              (is_sum || std::string("<>=?&|").find(c) != std::string::npos))
            return false;
        }
      return !expression.empty() && expression[0] == '-';
    }



    /** An expression with the other sign: without its minus if that can be. */
    std::string
    opposite(const std::string &expression)
    {
      if (read_number(expression) == 0.)
        return expression;
      if (is_negative_product(expression))
        return trim_copy(expression.substr(1));
      bool              are_negative = true;
      const std::string of_study =
        with_each_value(expression, [&](const std::string &item) {
          are_negative = are_negative && is_negative_product(item);
          return trim_copy(item.substr(std::min<std::size_t>(1, item.size())));
        });
      const auto end = expression.find("}}");
      if (!of_study.empty() && are_negative &&
          is_negative_product("-1" + expression.substr(end + 2)))
        return of_study;
      return "-(" + expression + ")";
    }



    /** Rewrites a scene line by line. */
    class Converter
    {
    public:
      explicit Converter(const std::string &filename)
        : scene(read_scene_file(filename))
        , own(entries_of(filename))
      {}

      std::string
      operator()(const std::string &text)
      {
        Classic<std::istringstream> lines(text);
        std::string                 begun; // of a line that goes on
        for (std::string line; std::getline(lines, line);)
          {
            line             = begun + line;
            std::string code = line.substr(0, line.find('#'));
            boost::trim_right(code);
            if (!code.empty() && code.back() == '\\')
              {
                code.pop_back();
                begun = code;
                continue;
              }
            begun.clear();
            convert(trim_copy(code), line);
          }
        if (!moved.empty())
          result += "\nsubsection Expert\n" + moved + "end\n";
        return result;
      }

    private:
      static std::vector<SceneEntry>
      entries_of(const std::string &filename)
      {
        std::vector<SceneEntry> entries = read_scene_file(filename);
        entries.erase(std::remove_if(entries.begin(),
                                     entries.end(),
                                     [&](const SceneEntry &entry) {
                                       return !boost::starts_with(entry.place,
                                                                  filename +
                                                                    ":");
                                     }),
                      entries.end());
        return entries;
      }

      static std::string
      value_in(const std::vector<SceneEntry> &entries, const std::string &name)
      {
        for (const SceneEntry &entry : entries)
          if (entry.full_name() == name)
            return entry.value;
        return "";
      }

      void
      convert(const std::string &code, const std::string &line)
      {
        static const std::regex set("(set)\\s+([^=]*[^=\\s])\\s*=\\s*(.*)",
                                    std::regex::icase),
          subsection("subsection\\s+(.*)", std::regex::icase);
        std::smatch parts;
        if (std::regex_match(code, parts, set))
          return convert_set(boost::trim_fill_copy(parts[2].str(), " "),
                             parts[3],
                             line);
        std::string new_line = line;
        if (std::regex_match(code, parts, subsection))
          {
            path.push_back(boost::trim_fill_copy(parts[1].str(), " "));
            if (path == std::vector<std::string>{"Chuck", "Translation z"} &&
                presses())
              new_line.replace(new_line.find(parts[1].str()),
                               parts[1].length(),
                               "Press");
          }
        else if (boost::iequals(code, "end", std::locale::classic()) &&
                 !path.empty())
          {
            // a table alone is its own value
            if (path.back() == "Translation z" && presses() &&
                !value_in(own, push + "File").empty() &&
                value_in(own, push + "Value").empty())
              add_line(line + "  set Value = -table");
            path.pop_back();
          }
        add_line(new_line);
      }

      void
      convert_set(const std::string &name,
                  const std::string &value,
                  const std::string &line)
      {
        const SceneEntry  entry{path, name, value, ""};
        const std::string full = entry.full_name(), renamed = new_name_of(full);
        std::string       new_name  = renamed.empty() ? full : renamed;
        std::string       new_value = new_values_of(new_name, value);
        if (full == "Interface / Friction coefficient broken" &&
            value_in(scene, friction_law) == "coulomb")
          new_name = "Interface / Friction coefficient";
        if (full == push + "Value" && presses())
          new_value = opposite(value);
        const std::string last = new_name.substr(
          new_name.rfind("/ ") == std::string::npos ? 0 :
                                                      new_name.rfind("/ ") + 2);
        if (name == "File over" && path.front() == "Chuck")
          {
            // the columns of the file say it, but one that has both
            if (value == "angle")
              add_line(std::string(line.find_first_not_of(" \t"), ' ') +
                       "# over the angle: if the file has a time, too, name "
                       "both columns in File columns");
            return;
          }
        if (boost::starts_with(new_name, "Expert / "))
          {
            moved += "  set " + last + " = " + new_value + "\n";
            return;
          }
        add_line(with(line, name, last, value, new_value));
        const std::string broken =
          value_in(scene, "Interface / Friction coefficient broken");
        const bool varies = full == friction_law &&
                            value.find("{{") != std::string::npos &&
                            value.find("coulomb") != std::string::npos;
        const bool inherits =
          value == "coulomb" &&
          value_in(own, "Interface / Friction coefficient broken").empty();
        if (full == friction_law && !broken.empty() && (varies || inherits))
          add_line(std::string(line.find_first_not_of(" \t"), ' ') +
                   "set Friction coefficient = " + broken);
      }

      /** A line with another name, and value, whose `=` stays where it is if
       *  there is room. */
      static std::string
      with(const std::string &line,
           const std::string &name,
           const std::string &new_name,
           const std::string &value,
           const std::string &new_value)
      {
        const std::size_t equal = line.find('=');
        const std::size_t first = line.find_first_not_of(" \t");
        std::string       head  = line.substr(0, equal);
        if (new_name != name)
          {
            head = line.substr(0, first) + "set " + new_name;
            head.resize(std::max(head.size() + 1, equal), ' ');
          }
        std::string tail = line.substr(equal + 1);
        if (new_value != value)
          tail = value.empty() ?
                   " " + new_value + tail :
                   tail.replace(tail.find(value), value.size(), new_value);
        return head + "=" + tail;
      }

      /** Whether this file says Press instead of Translation z: unless it pulls
       *  and does no more. */
      bool
      presses() const
      {
        static const std::regex minus("(^|[(,{|:?*/])\\s*-");
        const std::string       value = value_in(own, push + "Value");
        return own.size() != scene.size() || value.empty() ||
               std::regex_search(value, minus);
      }

      void
      add_line(const std::string &line)
      {
        result += line + "\n";
      }

      const std::string push         = "Chuck / Translation z / ",
                        friction_law = "Interface / Friction law";
      /** With what it includes, and without. */
      const std::vector<SceneEntry> scene, own;
      std::vector<std::string>      path; ///< subsections that are open
      std::string                   result, moved;
    };
  } // namespace



  std::string
  converted_scene(const std::string &filename)
  {
    constexpr unsigned int largest_MB = 10;
    const auto             refuse     = [&](const std::string &why) {
      throw InputError(filename + ": " + why);
    };
    return Converter(filename)(
      plain_text(read_input_bytes(filename, refuse, largest_MB), refuse));
  }
} // namespace Debond
