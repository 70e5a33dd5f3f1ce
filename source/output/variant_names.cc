#include <debond/output/variant_names.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>

namespace Debond
{
  namespace
  {
    using Fields = std::vector<std::string>;

    /** The end of the name of an entry that no other one has: "Sliding
     *  threshold", but "Bone / Young modulus" if that of the implant varies,
     *  too. `Value` alone says nothing. */
    std::string
    short_name(const std::string &entry, const Fields &entries)
    {
      std::string end;
      for (auto slash = entry.rfind(" / "); slash != std::string::npos;
           slash      = entry.rfind(" / ", slash - 1))
        {
               end = entry.substr(slash + 3);
               const bool is_told_apart =
                 std::count_if(entries.begin(),
                          entries.end(),
                          [&](const std::string &other) {
                            return boost::ends_with(other, " / " + end);
                          }) < 2;
               if ((is_told_apart && end != "Value") || slash == 0)
            return end;
        }
      return entry;
    }
  } // namespace



  VariantNames::VariantNames(const Fields              &entries,
                             const std::vector<Fields> &values)
    : entries(entries)
    , values(values)
  {
    constexpr std::size_t many = 4;
    for (const std::string &entry : entries)
      short_entries.push_back(short_name(entry, entries));
    std::size_t most_changes = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        std::size_t n = 0;
        for (std::size_t e = 0; e < entries.size(); ++e)
          n += is_changed(i, e);
        most_changes = std::max(most_changes, n);
      }
    names_changes = most_changes > 0 &&
                    (entries.size() >= many || most_changes < entries.size());
  }



  bool
  VariantNames::is_changed(const std::size_t i, const std::size_t entry) const
  {
    return values[i][entry] != values[0][entry];
  }



  std::string
  VariantNames::name(const std::size_t  i,
                     const Fields      &names,
                     const std::string &separator) const
  {
    std::string text;
    for (std::size_t e = 0; e < names.size(); ++e)
      if (!names_changes || is_changed(i, e))
        text +=
          (text.empty() ? "" : separator) + names[e] + " = " + values[i][e];
    return text.empty() && !names.empty() ? "first values" : text;
  }



  std::string
  VariantNames::full(const std::size_t i) const
  {
    return name(i, entries, "; ");
  }



  std::string
  VariantNames::brief(const std::size_t i) const
  {
    return name(i, short_entries, ", ");
  }
} // namespace Debond
