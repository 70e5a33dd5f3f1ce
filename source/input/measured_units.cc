#include <debond/input/measured_units.h>

#include <deal.II/base/numbers.h>

#include <boost/algorithm/string.hpp>

#include <locale>
#include <map>
#include <regex>
#include <utility>
#include <vector>

namespace Debond
{
  namespace
  {
    using Units   = std::map<std::string, Unit>;
    using Factors = std::vector<std::pair<const char *, double>>;

    // exact, by definition
    constexpr double inch = 25.4;                       // [mm]
    constexpr double lbf  = 0.45359237 * 9.80665;       // [N]
    constexpr double kgf  = 9.80665;                    // [N]
    constexpr double rad  = 180. / dealii::numbers::PI; // [deg]



    /** Forces, and moments with @p lengths. */
    void
    add_products(Units         &units,
                 const Factors &forces,
                 const Factors &lengths,
                 const bool     in_any_order)
    {
      for (const auto &[force, newtons] : forces)
        for (const auto &[length, mm] : lengths)
          {
            const Unit moment{Quantity::moment, newtons * mm};
            units[std::string(force) + length] = moment;
            if (in_any_order)
              units[std::string(length) + force] = moment;
          }
    }



    void
    add(Units &units, const Quantity quantity, const Factors &factors)
    {
      for (const auto &[name, factor] : factors)
        units[name] = {quantity, factor};
    }



    /** Units in which M and m differ, without blanks and signs of a product. */
    const Units &
    metric_units()
    {
      static const Units units = [] {
        const Factors forces{{"uN", 1e-6},
                             {"µN", 1e-6},
                             {"mN", 1e-3},
                             {"cN", 1e-2},
                             {"dN", 0.1},
                             {"N", 1.},
                             {"daN", 10.},
                             {"kN", 1e3}};
        const Factors of_weight{{"gf", 1e-3 * kgf}, {"kgf", kgf}, {"kp", kgf}};
        const Factors lengths{
          {"um", 1e-3}, {"µm", 1e-3}, {"mm", 1.}, {"cm", 10.}, {"m", 1e3}};
        const Factors arms{{"mm", 1.}, {"cm", 10.}, {"m", 1e3}};
        Units         result;
        add(result, Quantity::force, forces);
        add(result, Quantity::force, of_weight);
        add(result, Quantity::length, lengths);
        add_products(result, forces, arms, false);
        add_products(result, of_weight, arms, false);
        // masses that are meant as weights, as torque meters say them
        add_products(result, {{"kg", kgf}}, arms, false);
        add_products(result, {{"g", 1e-3 * kgf}}, {{"cm", 10.}}, false);
        // shouted: M for mega has no meaning here
        add(result,
            Quantity::moment,
            {{"NM", 1e3}, {"NCM", 10.}, {"NMM", 1.}, {"KNM", 1e6}});
        return result;
      }();
      return units;
    }



    /** Units that may be shouted. */
    const Units &
    other_units()
    {
      static const Units units = [] {
        const Factors pounds{{"lb", lbf},
                             {"lbs", lbf},
                             {"lbf", lbf},
                             {"pound", lbf},
                             {"pounds", lbf},
                             {"oz", lbf / 16.},
                             {"ozf", lbf / 16.},
                             {"ounce", lbf / 16.},
                             {"ounces", lbf / 16.}};
        const Factors arms{{"in", inch},
                           {"inch", inch},
                           {"inches", inch},
                           {"ft", 12. * inch},
                           {"foot", 12. * inch},
                           {"feet", 12. * inch}};
        Units         result;
        add_products(result, pounds, arms, true);
        add_products(
          result,
          {{"newton", 1.}},
          {{"metre", 1e3}, {"metres", 1e3}, {"meter", 1e3}, {"meters", 1e3}},
          false);
        // alone, pounds and ounces may be masses
        add(result, Quantity::force, {{"lbf", lbf}, {"ozf", lbf / 16.}});
        add(result,
            Quantity::length,
            {{"in", inch}, {"inch", inch}, {"inches", inch}});
        add(result,
            Quantity::angle,
            {{"deg", 1.},          {"degree", 1.},
             {"degrees", 1.},      {"°", 1.},
             {"mdeg", 1e-3},       {"arcmin", 1. / 60.},
             {"rad", rad},         {"radian", rad},
             {"radians", rad},     {"mrad", 1e-3 * rad},
             {"urad", 1e-6 * rad}, {"µrad", 1e-6 * rad},
             {"gon", 0.9},         {"mgon", 0.9e-3},
             {"rev", 360.},        {"revolution", 360.},
             {"revs", 360.},       {"revolutions", 360.},
             {"turn", 360.},       {"turns", 360.}});
        add(result,
            Quantity::time,
            {{"us", 1e-6},
             {"µs", 1e-6},
             {"ms", 1e-3},
             {"s", 1.},
             {"sec", 1.},
             {"second", 1.},
             {"seconds", 1.},
             {"min", 60.},
             {"minutes", 60.},
             {"h", 3600.},
             {"hours", 3600.},
             {"time", 1.}}); // a name that is enough
        return result;
      }();
      return units;
    }
  } // namespace



  const Unit *
  find_unit(std::string text)
  {
    for (const char *const mark : {" ", ".", "*", "·", "-", "_"})
      boost::erase_all(text, mark);
    for (const auto &[units, name] :
         {std::make_pair(&metric_units(), text),
          std::make_pair(&other_units(),
                         boost::to_lower_copy(text, std::locale::classic()))})
      if (const auto found = units->find(name); found != units->end())
        return &found->second;
    return nullptr;
  }



  const Unit *
  unit_in(const std::string &name)
  {
    static const std::regex factor(
      ".*(10\\^|[x*] ?10|×|[\\])] *(x|\\*|/|·)).*");
    if (std::regex_match(name, factor))
      return nullptr;
    for (const char *const brackets : {"[]", "()"})
      if (const auto begin = name.rfind(brackets[0]),
          end              = name.rfind(brackets[1]);
          begin != std::string::npos && end != std::string::npos && begin < end)
        return find_unit(name.substr(begin + 1, end - begin - 1));
    for (std::size_t at = 0; at < name.size(); ++at)
      {
        // "Force in lbf" is no moment
        const std::string rest = name.substr(at);
        const bool        begins_with_in =
          boost::istarts_with(rest, "in ", std::locale::classic()) ||
          boost::istarts_with(rest, "in_", std::locale::classic());
        if (at == 0 ||
            (std::string("/_ ,").find(name[at - 1]) != std::string::npos &&
             !begins_with_in))
          if (const Unit *const unit = find_unit(rest))
            return unit;
      }
    return nullptr;
  }



  const char *
  units_of(const Quantity quantity)
  {
    return quantity == Quantity::angle  ? "deg, rad, mrad, gon or rev" :
           quantity == Quantity::moment ? "N mm, mN m, N cm, N m, kN m, lbf "
                                          "in, ozf in, kgf cm or the like" :
           quantity == Quantity::force  ? "mN, N, kN, lbf or kgf" :
           quantity == Quantity::length ? "um, mm, cm, m or in" :
                                          "ms, s, min or h";
  }



  std::string
  why_ambiguous(const std::string &name)
  {
    static const std::regex grad(".*\\bgrads?\\b.*", std::regex::icase),
      nm(".*\\bnm\\b.*");
    return std::regex_match(name, grad) ?
             "grad may be degrees, deg, or gon, of which a turn has 400" :
           std::regex_match(name, nm) ? "nm may be N m or nanometres" :
                                        "";
  }
} // namespace Debond
