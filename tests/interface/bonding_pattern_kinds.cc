// The bonding patterns `annulus' and `random' meet the bonded fraction of the
// area, by element and by quadrature point. The annulus is what the disk of the
// remaining fraction leaves; random patterns are bonded but for one part, which
// is partly, differ from seed to seed, favour no element, and form larger
// patches the longer their correlation.

#include <debond/interface/bonding_pattern.h>
#include <debond/shapes/body_parameters.h>

#include <algorithm>
#include <string>
#include <vector>

#include "checks.h"

using namespace Debond;

// of radius 2.5 mm
const BodyParameters coin;



BondingPattern
make_pattern(const NurbsSurface      &surface,
             const BondingPatternKind kind,
             const double             fraction,
             const BondingResolution  resolution  = BondingResolution::element,
             const std::uint64_t      seed        = 1,
             const double             correlation = 0)
{
  BondingParameters parameters;
  parameters.pattern            = kind;
  parameters.bonded_fraction    = fraction;
  parameters.resolution         = resolution;
  parameters.seed               = seed;
  parameters.correlation_length = correlation;
  return {parameters, coin, surface, dealii::QGauss<1>(3)};
}



/** Area mean, formed here again. */
double
mean(const BondingPattern &pattern)
{
  double bonded = 0., area = 0.;
  for (const auto &part : pattern.parts())
    {
      bonded += part.phi_0 * part.area;
      area += part.area;
    }
  return bonded / area;
}



void
check_fractions(const unsigned int n, const BondingResolution resolution)
{
  const NurbsSurface surface       = NurbsSurface::disk(2.5, n);
  double             annulus_error = 0., random_error = 0., complement = 0.;
  bool               one_is_partly_bonded = true;
  for (const double fraction : {0., 1e-3, 0.1, 1. / 3., 0.5, 0.55, 0.999, 1.})
    {
      const auto annulus = make_pattern(surface,
                                        BondingPatternKind::annulus,
                                        fraction,
                                        resolution);
      const auto disk    = make_pattern(surface,
                                     BondingPatternKind::disk,
                                     1. - fraction,
                                     resolution);
      grow(annulus_error, std::abs(mean(annulus) - fraction));
      for (unsigned int i = 0; i < annulus.parts().size(); ++i)
        grow(complement,
             std::abs(annulus.parts()[i].phi_0 + disk.parts()[i].phi_0 - 1.));
      for (const double correlation : {0., 0.8})
        {
          const auto random = make_pattern(surface,
                                           BondingPatternKind::random,
                                           fraction,
                                           resolution,
                                           17,
                                           correlation);
          grow(random_error, std::abs(mean(random) - fraction));
          grow(random_error, std::abs(random.report().mean - fraction));
          one_is_partly_bonded =
            one_is_partly_bonded &&
            std::count_if(random.parts().begin(),
                          random.parts().end(),
                          [](const BondingPattern::Part &part) {
                            return part.phi_0 > 1e-9 && part.phi_0 < 1. - 1e-9;
                          }) <= 1;
        }
    }
  std::cout << n << " x " << n << " elements, by "
            << (resolution == BondingResolution::element ? "element" :
                                                           "quadrature point")
            << std::endl;
  report("  annulus, deviation of the fraction", annulus_error, 1e-12);
  report("  random, deviation of the fraction", random_error, 1e-12);
  // a group of equal radius shares a remainder, which rounding may move
  report("  annulus and the disk inside, deviation from one", complement, 1e-9);
  report("  at most one part is partly bonded", one_is_partly_bonded);
}



bool
equal(const BondingPattern &a, const BondingPattern &b)
{
  for (unsigned int i = 0; i < a.parts().size(); ++i)
    if (a.parts()[i].phi_0 != b.parts()[i].phi_0)
      return false;
  return true;
}



void
check_seeds()
{
  const NurbsSurface surface = NurbsSurface::disk(2.5, 6);
  for (const double correlation : {0., 0.8})
    {
      const auto draw = [&](const std::uint64_t seed) {
        return make_pattern(surface,
                            BondingPatternKind::random,
                            0.55,
                            BondingResolution::element,
                            seed,
                            correlation);
      };
      report("the same seed gives the same pattern", equal(draw(3), draw(3)));
      bool all_differ = true;
      for (unsigned int i = 0; i < 10; ++i)
        for (unsigned int j = 0; j < i; ++j)
          all_differ = all_differ && !equal(draw(i), draw(j));
      report("other seeds give others", all_differ);

      // five standard deviations of a binomial distribution; the elements being
      // of unequal size, the remainder falls on large ones more often
      const unsigned int  samples = 2000;
      std::vector<double> sums(surface.n_elements());
      for (unsigned int seed = 0; seed < samples; ++seed)
        {
          const auto pattern = draw(seed);
          for (unsigned int i = 0; i < sums.size(); ++i)
            sums[i] += pattern.parts()[i].phi_0;
        }
      double largest = 0.;
      for (const double sum : sums)
        grow(largest, std::abs(sum / samples - 0.55));
      report("mean of an element over many seeds, deviation from the fraction",
             largest,
             5. * std::sqrt(0.55 * 0.45 / samples));
    }
}



void
check_patches()
{
  const NurbsSurface surface = NurbsSurface::disk(2.5, 20);
  double             before  = 1e9;
  bool               fewer   = true;
  for (const double correlation : {0., 0.5, 1., 4.})
    {
      double patches = 0.;
      for (unsigned int seed = 0; seed < 50; ++seed)
        patches += make_pattern(surface,
                                BondingPatternKind::random,
                                0.4,
                                BondingResolution::element,
                                seed,
                                correlation)
                     .report()
                     .patches;
      fewer  = fewer && patches < 0.7 * before;
      before = patches;
    }
  report("fewer patches the longer the correlation", fewer);

  const auto annulus = make_pattern(surface, BondingPatternKind::annulus, 0.55);
  report("an annulus is one patch", annulus.report().patches == 1);
  report("of its size, deviation",
         std::abs(annulus.report().largest_patch / annulus.report().area -
                  0.55),
         0.02); // the group that shares the remainder is in or out
  report("nothing bonded is no patch",
         make_pattern(surface, BondingPatternKind::disk, 0.).report().patches ==
           0);
}



int
main()
{
  for (const unsigned int n : {3, 6, 20})
    for (const BondingResolution resolution :
         {BondingResolution::element, BondingResolution::quadrature_point})
      check_fractions(n, resolution);
  check_seeds();
  check_patches();
}
