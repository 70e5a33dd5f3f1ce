#include <debond/bulk/chuck.h>
#include <debond/system/chuck_way.h>

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
      if (parameters.component[k].loaded || k == ChuckComponent::rotation_z)
        result[2 + k] = std::abs(change[k]);
      else
        {
          double &way = result[is_rotation(k) ? tilts : translations];
          way         = std::hypot(way, change[k]);
        }
    return result;
  }



  void
  ChuckWay::add(const Chuck &chuck, const double from, const double to)
  {
    constexpr unsigned int n_parts = 32;
    const Vector6          start   = chuck.values(from);
    Vector6                here = start, next = start;
    length_now.setZero();
    for (unsigned int i = 1; i <= n_parts; ++i, here = next)
      {
        next =
          chuck.values(i < n_parts ? from + i * (to - from) / n_parts : to);
        length_now += distances(here, next);
      }
    missed_now = length_now - distances(start, next);
    length += length_now;
    missed += missed_now;
  }



  ChuckWay::Ways
  ChuckWay::missed_shares() const
  {
    constexpr double rounding = 1e-9;
    return (missed_now.array() >
            largest_missed_share * length_now.array() + rounding)
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
    text.precision(3);
    text << 100. * share << " % of the way of ";
    if (way == translations)
      text << "the translations";
    else if (way == tilts)
      text << "the tilts (Rotation x, y)";
    else
      text << (parameters.component[way - 2].loaded ? "the load of " : "")
           << ChuckParameters::names[way - 2];
    text << " of the chuck";
    return text.str();
  }
} // namespace Debond
