#include <debond/campaigns/unknowns.h>
#include <debond/input/allowed_values.h>
#include <debond/input/expression_parser.h>
#include <debond/support/number_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <regex>

namespace Debond
{
  using dealii::Utilities::trim;

  double
  Unknown::to_search(const double value) const
  {
    return logarithmic ? std::log(value) : value;
  }



  double
  Unknown::from_search(const double searched) const
  {
    // rounding must not lead over a bound
    return std::clamp(logarithmic ? std::exp(searched) : searched,
                      lower,
                      upper);
  }



  bool
  has_unknown(const SceneEntry &entry)
  {
    return entry.value.find("<<") != std::string::npos;
  }



  namespace
  {
    const std::string what_is_expected =
      "expected <<START in LOWER..UPPER>>, <<START in LOWER..UPPER log>>, "
      "<<NAME: START in LOWER..UPPER>> or <<EXPRESSION>> in such names";

    /** `START in LOWER..UPPER` with `log` behind it or not. */
    Unknown
    read_unknown(const SceneEntry &entry, std::string text)
    {
      Unknown unknown;
      unknown.entry  = entry;
      const auto log = text.rfind(" log");
      if (log != std::string::npos && log + 4 == text.size())
        {
          unknown.logarithmic = true;
          text                = trim(text.substr(0, log));
        }
      const auto in = text.find(" in "), dots = text.find("..", in);
      const auto start = read_number(text.substr(0, in));
      if (!start || dots == std::string::npos)
        entry.refuse("'" + shortened(text) + "': " + what_is_expected);
      const auto lower = read_number(text.substr(in + 4, dots - in - 4)),
                 upper = read_number(text.substr(dots + 2));
      if (!lower || !upper)
        entry.refuse("the bounds '" + shortened(text.substr(in + 4)) +
                     "' are no numbers: " + what_is_expected);
      unknown.start = *start;
      unknown.lower = *lower;
      unknown.upper = *upper;
      if (!(*lower < *upper) || *start < *lower || *start > *upper)
        entry.refuse("'" + shortened(text) +
                     "': expected LOWER < UPPER and START between them");
      if (unknown.logarithmic && *lower <= 0.)
        entry.refuse("'" + shortened(text) +
                     "': a logarithm needs bounds above 0");
      return unknown;
    }
  } // namespace



  Unknowns::Unknowns(const std::vector<StudyVariant> &given)
    : experiments(given)
    , varied(given.size())
  {
    for (unsigned int i = 0; i < experiments.size(); ++i)
      for (std::size_t e = 0; e < experiments[i].entries.size(); ++e)
        {
          const SceneEntry &entry = experiments[i].entries[e];
          if (!has_unknown(entry))
            continue;
          const auto &own = experiments[i].varied;
          const bool  is_shared =
            std::find(own.begin(), own.end(), e) == own.end();
          Varied      item{entry, {}, {}, {}, {}};
          std::string rest = entry.value;
          for (auto begin = rest.find("<<"); begin != std::string::npos;
               begin      = rest.find("<<"))
            {
                   const auto end = rest.find(">>", begin);
                   if (end == std::string::npos)
                entry.refuse("the << is not closed by >>: " + what_is_expected);
              item.texts.push_back(rest.substr(0, begin));
                   read_mark(i,
                        is_shared,
                        trim(rest.substr(begin + 2, end - begin - 2)),
                        item);
                   rest.erase(0, end + 2);
            }
          item.texts.push_back(rest);
          varied[i].push_back(std::move(item));
        }
    read_expressions();
  }



  void
  Unknowns::read_mark(const unsigned int number,
                      const bool         is_shared,
                      const std::string &mark,
                      Varied            &item)
  {
    item.marks.push_back(mark);
    static const std::regex name("[A-Za-z][A-Za-z0-9_]*");
    const auto              colon = mark.find(':');
    const std::string       given =
      colon == std::string::npos ? "" : trim(mark.substr(0, colon));
    if (colon != std::string::npos &&
        (given.size() > 100 || !std::regex_match(given, name)))
      item.entry.refuse(
        "'" + shortened(given) +
        "' is no name of letters, digits and _: " + what_is_expected);
    if (colon == std::string::npos && mark.find(" in ") == std::string::npos)
      {
        item.unknowns.push_back(-1);
        return;
      }
    Unknown unknown =
      read_unknown(item.entry,
                   trim(colon == std::string::npos ? mark :
                                                     mark.substr(colon + 1)));
    unknown.name = given;
    if (given.empty())
      {
        unknown.name = item.entry.full_name();
        if (!is_shared && experiments.size() > 1)
          unknown.name += " (experiment " + std::to_string(number + 1) + ")";
        if (item.unknowns.size() > 0)
          unknown.name += " #" + std::to_string(item.unknowns.size() + 1);
      }
    item.unknowns.push_back(add(unknown, !given.empty()));
  }



  // Once all names are known.
  void
  Unknowns::read_expressions()
  {
    std::string names;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (named[i])
        names += (names.empty() ? "" : ", ") + list[i].name;
    for (auto &items : varied)
      for (Varied &item : items)
        for (std::size_t m = 0; m < item.marks.size(); ++m)
          {
            item.expressions.emplace_back();
            if (item.unknowns[m] >= 0)
              continue;
            if (read_number(item.marks[m]))
              item.entry.refuse("<<" + item.marks[m] +
                                ">> has no bounds: " + what_is_expected);
            try
              {
                item.expressions[m] = read_expression(names, item.marks[m], 0.);
              }
            catch (const InputError &error)
              {
                item.entry.refuse("<<" + shortened(item.marks[m]) + ">>: " +
                                  error.what() + "; " + what_is_expected);
              }
          }
  }



  int
  Unknowns::add(Unknown unknown, const bool has_name)
  {
    const auto same =
      std::find_if(list.begin(), list.end(), [&](const Unknown &other) {
        return other.name == unknown.name;
      });
    if (same == list.end())
      {
        list.push_back(std::move(unknown));
        named.push_back(has_name);
        return list.size() - 1;
      }
    if (same->start != unknown.start || same->lower != unknown.lower ||
        same->upper != unknown.upper ||
        same->logarithmic != unknown.logarithmic)
      unknown.entry.refuse(
        "the unknown '" + unknown.name + "' is described differently in " +
        same->entry.full_name() + " = '" + shortened(same->entry.value) + "'");
    return same - list.begin();
  }



  Eigen::VectorXd
  Unknowns::starts() const
  {
    Eigen::VectorXd values(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
      values[i] = list[i].start;
    return values;
  }



  std::vector<SceneEntry>
  Unknowns::varied_entries(const unsigned int     experiment,
                           const Eigen::VectorXd &values) const
  {
    // expressions share parsers with those of other threads
    const std::lock_guard<std::mutex> lock(parsers);
    std::vector<double>               of_names;
    std::string                       place;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (named[i])
        {
          of_names.push_back(values[i]);
          place += (place.empty() ? " at " : ", ") + list[i].name + " = " +
                   to_text(values[i], 6);
        }
    const auto value_of = [&](const Varied &item, const std::size_t mark) {
      const double result = item.expressions[mark](of_names);
      if (!std::isfinite(result))
        item.entry.refuse("<<" + item.marks[mark] + ">> has no finite value" +
                          place + remark_on_no_value);
      return result;
    };
    std::vector<SceneEntry> result;
    for (const Varied &item : varied[experiment])
      {
        SceneEntry entry = item.entry;
        entry.value      = item.texts.front();
        for (std::size_t m = 0; m < item.unknowns.size(); ++m)
          {
            const double number = item.unknowns[m] < 0 ?
                                    value_of(item, m) :
                                    values[item.unknowns[m]];
            // in an expression of the scene a minus may stand before it
            const bool alone = item.texts.size() == 2 &&
                               trim(item.texts[0]).empty() &&
                               trim(item.texts[1]).empty();
            entry.value += alone || number >= 0. ?
                             exact_text(number) :
                             "(" + exact_text(number) + ")";
            entry.value += item.texts[m + 1];
          }
        result.push_back(entry);
      }
    return result;
  }



  std::vector<SceneEntry>
  Unknowns::entries(const unsigned int     experiment,
                    const Eigen::VectorXd &values) const
  {
    std::vector<SceneEntry> result = experiments[experiment].entries;
    for (const SceneEntry &entry : varied_entries(experiment, values))
      std::find_if(result.begin(), result.end(), [&](const SceneEntry &other) {
        return other.full_name() == entry.full_name();
      })->value = entry.value;
    return result;
  }
} // namespace Debond
