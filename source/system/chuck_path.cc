#include <debond/support/number_text.h>
#include <debond/system/chuck_path.h>

#include <sstream>

namespace Debond
{
  ChuckPath::Lengths
  ChuckPath::distances(const Chuck::Vector6 &from,
                       const Chuck::Vector6 &to) const
  {
    Lengths squares = Lengths::Zero();
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      {
        const bool alone =
          parameters.component[k].loaded || k == ChuckComponent::rotation_z;
        squares[alone          ? k :
                is_rotation(k) ? tilts :
                                 translations] += std::pow(to[k] - from[k], 2);
      }
    return squares.cwiseSqrt();
  }



  void
  ChuckPath::add(const Chuck &chuck, const double from, const double to)
  {
    constexpr unsigned int n_parts  = 32;
    constexpr double       rounding = 1e-9;
    const Chuck::Vector6   start    = chuck.values(from);
    Chuck::Vector6         here = start, next = start;
    Lengths                length_now = Lengths::Zero();
    for (unsigned int i = 1; i <= n_parts; ++i, here = next)
      {
        next =
          chuck.values(i < n_parts ? from + i * (to - from) / n_parts : to);
        length_now += distances(here, next);
      }
    const Lengths missed_now = length_now - distances(start, next);
    length += length_now;
    missed += missed_now;
    missed_shares = (missed_now.array() >
                     largest_missed_share * length_now.array() + rounding)
                      .select(missed.cwiseQuotient(length), Lengths::Zero());
  }



  std::string
  ChuckPath::describe() const
  {
    Eigen::Index                k;
    const double                share = missed_shares.maxCoeff(&k);
    Classic<std::ostringstream> text;
    text.precision(3);
    text << 100. * share << " % of the path of ";
    if (k >= translations)
      text << (k == tilts ? "the tilts (Rotation x, y)" : "the translations");
    else
      text << (parameters.component[k].loaded ? "the load of " : "")
           << ChuckParameters::names[k];
    text << " of the chuck";
    return text.str();
  }
} // namespace Debond
