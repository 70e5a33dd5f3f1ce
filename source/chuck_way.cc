#include <debond/chuck.h>
#include <debond/chuck_way.h>

#include <cmath>
#include <sstream>

namespace Debond
{
  ChuckWay::ChuckWay(const ChuckParameters &parameters)
    : parameters(parameters)
  {}



  ChuckWay::Ways
  ChuckWay::distances(const Vector6 &from, const Vector6 &to) const
  {
    const Vector6 change = to - from;
    Ways          result = Ways::Zero();
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      if (k < 3 && !parameters.component[k].loaded)
        result[translation] = std::hypot(result[translation], change[k]);
      else
        result[1 + k] = std::abs(change[k]);
    return result;
  }



  void
  ChuckWay::add(const Chuck &chuck, const double from, const double to)
  {
    constexpr unsigned int n_parts = 8;
    const Vector6          start   = chuck.values(from);
    Vector6                here = start, next = start;
    Ways                   way = Ways::Zero();
    for (unsigned int i = 1; i <= n_parts; ++i, here = next)
      {
        next =
          chuck.values(i < n_parts ? from + i * (to - from) / n_parts : to);
        way += distances(here, next);
      }
    missed_now = way - distances(start, next);
    length += way;
    missed += missed_now;
  }



  ChuckWay::Ways
  ChuckWay::missed_shares() const
  {
    // rounding is no way
    constexpr double nothing = 1e-9;
    return (missed_now.array() > nothing)
      .select(missed.cwiseQuotient(length), Ways::Zero());
  }



  double
  ChuckWay::missed_share() const
  {
    return missed_shares().maxCoeff();
  }



  std::string
  ChuckWay::describe() const
  {
    Eigen::Index       way;
    const double       share = missed_shares().maxCoeff(&way);
    std::ostringstream text;
    text.precision(2);
    text << 100. * share << " % of the way of ";
    if (way == translation)
      text << "the translations";
    else
      text << (parameters.component[way - 1].loaded ? "the load of " : "")
           << ChuckParameters::names[way - 1];
    text << " of the chuck";
    return text.str();
  }
} // namespace Debond
