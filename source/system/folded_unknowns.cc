#include <debond/system/folded_unknowns.h>

// A coin that is twisted on a block looks the same after a quarter of a turn, a
// pin in a sleeve after a turn by one cell. What one sector does the others do,
// turned: its points and its unknowns are enough. Equations are those of the
// whole in motions that have the symmetry, E^T A E y = -E^T r, and the solution
// is that of the whole but for rounding.
//
// A path that leaves the symmetry is not found: of a state that is symmetric
// but not unique the symmetric continuation is followed.
namespace Debond
{
  // Of a control point off the axis three numbers stand for those of all its
  // images, in frames that are turned; on the axis it moves along it.
  FoldedUnknowns::FoldedUnknowns(const SectorsOfSurfaces      &sectors,
                                 const InterfaceConfiguration &configuration,
                                 const unsigned int            n_unknowns)
  {
    std::vector<Eigen::Triplet<double>> entries;
    unsigned int                        n = 0;
    for (const Side side : both_sides)
      {
        const std::vector<int> &old     = configuration.side[side].unknown_of;
        const auto             &images  = sectors[side].control_points;
        auto                   &numbers = surfaces[side].unknown_of;
        numbers.assign(old.size(), -1);
        for (unsigned int A = 0; A < images.size(); ++A)
          {
            const bool            is_on_axis = images[A].n == 1;
            const Eigen::Matrix3d turn = sectors[side].turn[images[A].turns];
            surfaces[side].turns.push_back(turn);
            for (unsigned int c = is_on_axis ? 2 : 0; c < 3; ++c)
              if (old[3 * A + c] >= 0)
                {
                  int &number = numbers[3 * A + c];
                  number      = images[A].first == A ?
                                  n++ :
                                  numbers[3 * images[A].first + c];
                }
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                if (old[3 * A + c] >= 0 && numbers[3 * A + d] >= 0 &&
                    turn(c, d) != 0.)
                  entries.emplace_back(old[3 * A + c],
                                       numbers[3 * A + d],
                                       turn(c, d));
          }
      }
    for (const auto &[component, number] : configuration.chuck_unknowns)
      {
        chuck_unknowns.emplace_back(component, n);
        entries.emplace_back(number, n++, 1.);
      }
    const unsigned int first_beyond =
      configuration.chuck_unknowns.empty() ?
        n_unknowns :
        configuration.chuck_unknowns.back().second + 1;
    for (unsigned int number = first_beyond; number < n_unknowns; ++number)
      entries.emplace_back(number, n++, 1.); // the time
    E.resize(n_unknowns, n);
    E.setFromTriplets(entries.begin(), entries.end());
    images = E.cwiseProduct(E).transpose() * Eigen::VectorXd::Ones(n_unknowns);
  }



  InterfaceConfiguration
  FoldedUnknowns::folded(const InterfaceConfiguration &configuration) const
  {
    InterfaceConfiguration result = configuration;
    for (const Side side : both_sides)
      {
        result.side[side].unknown_of = surfaces[side].unknown_of;
        result.side[side].turns      = surfaces[side].turns;
      }
    result.chuck_unknowns = chuck_unknowns;
    return result;
  }
} // namespace Debond
