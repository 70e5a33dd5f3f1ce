#include <debond/support/number_text.h>
#include <debond/system/chuck_path.h>


namespace Debond
{
  ChuckPath::Lengths
  ChuckPath::distances(const Place &from, const Place &to) const
  {
    // The distance between two places by component [mm, rad, N, N mm]: loads
    // and the rotation about z count alone, driven translations and driven
    // tilts as vectors, which may go round a curve.
    Lengths squares = Lengths::Zero();
    for (unsigned int k = 0; k <= interference; ++k)
      {
        const bool alone =
          k >= ChuckComponent::rotation_z || parameters.component[k].loaded;
        squares[alone          ? k :
                is_rotation(k) ? tilts :
                                 translations] += std::pow(to[k] - from[k], 2);
      }
    return squares.cwiseSqrt();
  }



  void
  ChuckPath::add(const Chuck        &chuck,
                 const double        from,
                 const double        to,
                 const TimeFunction &thickening)
  {
    // What a step has missed is the length of the way, as a chain of 32 chords,
    // less that of its own chord: nothing where each component goes one way.
    constexpr unsigned int n_parts  = 32;
    constexpr double       rounding = 1e-9;
    const auto             place_at = [&](const double time) {
      Place place;
      place << chuck.values(time), thickening ? thickening(time) : 0.;
      return place;
    };
    const Place start = place_at(from);
    Place       here = start, next = start;
    Lengths     length_now = Lengths::Zero();
    for (unsigned int i = 1; i <= n_parts; ++i, here = next)
      {
        next = place_at(i < n_parts ? from + i * (to - from) / n_parts : to);
        length_now += distances(here, next);
      }
    const Lengths missed_now = length_now - distances(start, next);
    // A share of all the way so far, but only of components that this step has
    // missed: a run is not blamed again for a step that is long past.
    length += length_now;
    missed += missed_now;
    missed_shares = (missed_now.array() >
                     largest_missed_share * length_now.array() + rounding)
                      .select(missed.cwiseQuotient(length), Lengths::Zero());
  }



  std::string
  ChuckPath::describe() const
  {
    Eigen::Index k;
    const double share = missed_shares.maxCoeff(&k);
    return to_text(100. * share, 3) + " % of the path of " +
           (k == interference ?
              "Interface / Interference" :
            k == translations ?
              "the translations of the chuck" :
            k == tilts ?
              "the tilts (Rotation x, y) of the chuck" :
              (parameters.component[k].loaded ? "the load of " : "") +
                std::string(ChuckParameters::names[k]) + " of the chuck");
  }
} // namespace Debond
