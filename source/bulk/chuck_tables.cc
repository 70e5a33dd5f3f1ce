#include <debond/bulk/chuck.h>
#include <debond/input/measured_table.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <iterator>
#include <regex>

// Values of the chuck from a CSV file. Over the angle they are those at the
// angle that the scene prescribes at a time, and so functions of time as all
// that the chuck is asked for: nothing has to be kept or taken back.
namespace Debond
{
  namespace
  {
    std::string
    abscissa_of(const ChuckComponentParameters &component)
    {
      return component.over_angle ? "angle_deg" : "time";
    }



    /** The rows of the file of component @p k: time, or else angle, and value.
     *  Sets which of them it is. */
    std::vector<std::vector<double>>
    read_rows(ChuckParameters &chuck, const unsigned int k)
    {
      ChuckComponentParameters &component = chuck.component[k];
      const auto                read      = [&](const bool over_angle) {
        component.over_angle = over_angle;
        return read_measured_table(component.file,
                                   chuck.entry_name(k, "File"),
                                   {abscissa_of(component),
                                    chuck.file_column(k)},
                                   component.columns,
                                   "Expert / " +
                                     chuck.entry_name(k, "File columns"));
      };
      try
        {
          return read(false);
        }
      catch (const EntryError &of_time)
        {
          try
            {
              return read(true);
            }
          catch (const EntryError &of_angle)
            {
              component.over_angle = false;
              // there is an angle, and the value is what is missing
              const bool has_angle =
                of_angle.why.find("says deg") == std::string::npos;
              throw has_angle ? of_angle : of_time;
            }
        }
    }



    std::shared_ptr<const MonotoneCurve>
    read_table(ChuckParameters &chuck, const unsigned int k)
    {
      const auto expect = [&](const bool is_right, const std::string &why) {
        if (!is_right)
          throw EntryError(chuck.entry_name(k, "File"),
                           why,
                           chuck.component[k].file);
      };
      std::vector<double> x, values;
      for (const std::vector<double> &row : read_rows(chuck, k))
        {
          // an instrument at rest
          if (!x.empty() && row[0] == x.back() && row[1] == values.back())
            continue;
          expect(x.empty() || row[0] > x.back(),
                 abscissa_of(chuck.component[k]) + " = " + to_text(row[0]) +
                   " after " + (x.empty() ? "" : to_text(x.back())) +
                   ": expected rows that ascend, or repeat the one before");
          x.push_back(row[0]);
          values.push_back(row[1]);
        }
      expect(x.size() >= 2, "expected at least two rows that differ");
      return std::make_shared<const MonotoneCurve>(x, values);
    }



    bool
    is_set(const ChuckComponentParameters &component)
    {
      return component.value != "0" || !component.file.empty() ||
             !component.columns.empty() || component.is_unknown();
    }
  } // namespace



  void
  ChuckParameters::take_press()
  {
    ChuckComponentParameters &z = component[ChuckComponent::translation_z];
    if (!is_set(press) && !z.into_bone)
      return;
    if (is_set(z) && !z.into_bone)
      throw EntryError("Chuck / Press / Value",
                       "Press and Translation z are one motion, with opposite "
                       "signs: expected one of them");
    z           = press;
    z.into_bone = true;
  }



  void
  ChuckParameters::read_tables()
  {
    take_press();
    for (unsigned int k = 0; k < n_components; ++k)
      component[k].table =
        component[k].file.empty() ? nullptr : read_table(*this, k);
    const ChuckComponentParameters &z =
      component[ChuckComponent::translation_z];
    if (z.into_bone)
      press = z; // with what has been read
  }



  TimeFunction
  ChuckParameters::abscissa_over_time(const unsigned int k,
                                      const double       radius) const
  {
    if (component[k].over_angle)
      return value_over_time(ChuckComponent::rotation_z, radius);
    return [](const double time) { return time; };
  }



  TimeFunction
  ChuckParameters::value_over_time(const unsigned int k,
                                   const double       radius) const
  {
    const ChuckComponentParameters &c     = component[k];
    TimeFunction                    value = c.function;
    if (!value && c.table)
      {
        value = [table = c.table, at = abscissa_over_time(k, radius)](
                  const double time) { return (*table)(at(time)); };
        if (c.value != "0")
          value = [value,
                   of_table = read_expression("t, table", c.value, radius)](
                    const double time) {
            return of_table({time, value(time)});
          };
      }
    value = read_time_function(c.value, radius, value);
    if (!c.into_bone)
      return value;
    return [value](const double time) { return -value(time); };
  }



  void
  ChuckParameters::check() const
  {
    constexpr auto twist = ChuckComponent::rotation_z;
    for (unsigned int k = 0; k < n_components; ++k)
      {
        const ChuckComponentParameters &c         = component[k];
        const auto                      refuse_if = [&](const bool         is_so,
                                   const std::string &entry,
                                   const std::string &why) {
          if (is_so)
            throw EntryError(entry_name(k, entry), why);
        };
        const bool has_file = !c.file.empty();
        const bool has_table =
          std::regex_search(c.value, std::regex("\\btable\\b"));
        refuse_if(!has_file && has_table,
                  "Value",
                  "table is the value of the table in File, and there is none");
        refuse_if(has_file && !has_table && c.value != "0",
                  "Value",
                  "with File expected an expression in t and table, as min(t, "
                  "1) * table, or 0 for table");
        refuse_if(!has_file && !c.columns.empty(),
                  "File columns",
                  "there is no File");
        refuse_if(c.over_angle && k == twist,
                  "File",
                  "its values are over the angle, which is that of Rotation z "
                  "itself: expected values over the time");
        refuse_if(c.over_angle && component[twist].loaded,
                  "File",
                  "its values are over the angle, and for Rotation z a moment "
                  "is prescribed: expected values over the time");
        refuse_if(has_file && !c.table, "File", "it has not been read");
      }
  }



  void
  ChuckParameters::check_tables(const std::vector<double> &times,
                                const double               radius) const
  {
    for (unsigned int k = 0; k < n_components; ++k)
      {
        const ChuckComponentParameters &c = component[k];
        if (!c.table)
          continue;
        const double first = c.table->first(), last = c.table->last(),
                     rounding = 1e-9 * (last - first);
        std::vector<double> asked;
        std::transform(times.begin(),
                       times.end(),
                       std::back_inserter(asked),
                       abscissa_over_time(k, radius));
        const auto [least, most] =
          std::minmax_element(asked.begin(), asked.end());
        if (*least < first - rounding || *most > last + rounding)
          throw EntryError(entry_name(k, "File"),
                           "the table goes from " + abscissa_of(c) + " = " +
                             to_text(first) + " to " + to_text(last) +
                             ", the scene from " + to_text(*least) + " to " +
                             to_text(*most),
                           c.file);
      }
  }
} // namespace Debond
