#include <debond/bulk/body_mesh.h>
#include <debond/bulk/body_parameters.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/interface/bonding_source.h>
#include <debond/interface/random_field.h>
#include <debond/support/number_text.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace Debond
{
  BondingPattern::BondingPattern(const BondingParameters &parameters,
                                 const BodyParameters    &implant,
                                 const NurbsSurface      &surface,
                                 const unsigned int       n)
    : surface(surface)
    , n(n)
    , by_element(parameters.resolution == BondingResolution::element)
  {
    make_parts();
    fill(parameters, implant);
    for (Part &part : all_parts)
      {
        part.phi_0 *= parameters.initial_bonding;
        summary.area += part.area;
        summary.bonded_area += part.phi_0 * part.area;
      }
    summary.mean = summary.bonded_area / summary.area;
    count_patches();

    const dealii::QGauss<1> gauss(n);
    for (unsigned int q = 0; q < n; ++q)
      shares.push_back((q == 0 ? 0. : shares.back()) + gauss.weight(q));
  }



  void
  BondingPattern::make_parts()
  {
    const auto points = surface_quadrature(surface, n);
    all_parts.resize(part_of(points.size() - 1) + 1);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        Part &part = all_parts[part_of(q)];
        part.area += points[q].JxW;
        part.centre += points[q].JxW * points[q].X.head<2>();
      }
    for (Part &part : all_parts)
      part.centre /= part.area;
  }



  void
  BondingPattern::fill(const BondingParameters &parameters,
                       const BodyParameters    &implant)
  {
    std::vector<double> radius;
    for (const Part &part : all_parts)
      radius.push_back(part.centre.norm());
    const double equal = 1e-9 * *std::max_element(radius.begin(), radius.end());

    switch (parameters.pattern)
      {
        case BondingPatternKind::homogeneous:
          for (Part &part : all_parts)
            part.phi_0 = 1.;
          break;
        case BondingPatternKind::disk:
          bond_in_order(radius, equal, parameters.bonded_fraction);
          break;
        case BondingPatternKind::annulus:
          for (double &r : radius)
            r = -r;
          bond_in_order(radius, equal, parameters.bonded_fraction);
          break;
        case BondingPatternKind::random:
          bond_at_random(parameters);
          break;
        case BondingPatternKind::expression:
        case BondingPatternKind::image:
          {
            const auto values =
              values_by_place(parameters, implant, surface, n, summary.remark);
            for (unsigned int i = 0; i < all_parts.size(); ++i)
              all_parts[i].phi_0 = values[i];
          }
          break;
        case BondingPatternKind::file:
          {
            std::vector<Eigen::Vector2d> centres;
            for (const Part &part : all_parts)
              centres.push_back(part.centre);
            const auto values = values_from_file(parameters, surface, centres);
            for (unsigned int i = 0; i < all_parts.size(); ++i)
              all_parts[i].phi_0 = values[i];
          }
          break;
      }
  }



  void
  BondingPattern::bond_in_order(const std::vector<double> &rank,
                                const double               tolerance,
                                const double               bonded_fraction)
  {
    std::vector<unsigned int> order(all_parts.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const unsigned int a, const unsigned int b) {
                       return rank[a] < rank[b];
                     });
    double remaining = 0.;
    for (const Part &part : all_parts)
      remaining += bonded_fraction * part.area;
    for (unsigned int first = 0; first < order.size();)
      {
        unsigned int last = first;
        double       area = 0.;
        for (; last < order.size() &&
               rank[order[last]] - rank[order[first]] <= tolerance;
             ++last)
          area += all_parts[order[last]].area;
        const double share = std::clamp(remaining / area, 0., 1.);
        for (; first < last; ++first)
          all_parts[order[first]].phi_0 = share;
        remaining -= area;
      }
  }



  // Parts drawn one by one, or the highest places of a smooth random field.
  void
  BondingPattern::bond_at_random(const BondingParameters &parameters)
  {
    std::vector<double> rank(all_parts.size());
    if (parameters.correlation_length > 0.)
      {
        const RandomField field(parameters.seed, parameters.correlation_length);
        for (unsigned int i = 0; i < rank.size(); ++i)
          rank[i] = -field(all_parts[i].centre);
      }
    else
      {
        const auto order = random_order(all_parts.size(), parameters.seed);
        for (unsigned int i = 0; i < rank.size(); ++i)
          rank[order[i]] = i;
      }
    bond_in_order(rank, 0., parameters.bonded_fraction);
  }



  namespace
  {
    /** Numbers of the parts of a patch, which form a grid, that share a side
     *  with part @p i. */
    class PartGrid
    {
    public:
      /** @p n_elements per direction, each of @p n x @p n parts. */
      PartGrid(const std::array<unsigned int, 2> &n_elements,
               const unsigned int                 n)
        : n(n)
        , size{{n_elements[0] * n, n_elements[1] * n}}
      {}

      std::vector<unsigned int>
      neighbours(const unsigned int part) const
      {
        const unsigned int element = part / (n * n), local = part % (n * n);
        const unsigned int columns = size[0] / n;
        const int          i       = element % columns * n + local % n;
        const int          j       = element / columns * n + local / n;

        std::vector<unsigned int> result;
        for (const auto &[di, dj] : {std::pair(1, 0),
                                     std::pair(-1, 0),
                                     std::pair(0, 1),
                                     std::pair(0, -1)})
          if (i + di >= 0 && i + di < int(size[0]) && j + dj >= 0 &&
              j + dj < int(size[1]))
            result.push_back(number(i + di, j + dj));
        return result;
      }

    private:
      unsigned int
      number(const unsigned int i, const unsigned int j) const
      {
        return (j / n * (size[0] / n) + i / n) * n * n + j % n * n + i % n;
      }

      const unsigned int                n;
      const std::array<unsigned int, 2> size; ///< parts per direction
    };
  } // namespace



  // Connected sets of parts, side by side, that are bonded at least half as
  // well as the best: what is bonded less is the border of a patch, or its
  // blurred edge in a picture.
  void
  BondingPattern::count_patches()
  {
    double best = 0.;
    for (const Part &part : all_parts)
      best = std::max(best, part.phi_0);
    const PartGrid grid(surface.n_elements_per_direction(), by_element ? 1 : n);
    std::vector<bool> to_visit;
    for (const Part &part : all_parts)
      to_visit.push_back(best > 0. && part.phi_0 >= 0.5 * best);

    for (unsigned int seed = 0; seed < all_parts.size(); ++seed)
      {
        if (!to_visit[seed])
          continue;
        ++summary.patches;
        double                    area = 0.;
        std::vector<unsigned int> front{seed};
        to_visit[seed] = false;
        while (!front.empty())
          {
            const unsigned int part = front.back();
            front.pop_back();
            area += all_parts[part].area;
            for (const unsigned int neighbour : grid.neighbours(part))
              if (to_visit[neighbour])
                {
                  to_visit[neighbour] = false;
                  front.push_back(neighbour);
                }
          }
        summary.largest_patch = std::max(summary.largest_patch, area);
      }
  }



  double
  BondingPattern::at(const Eigen::Vector2d &xi) const
  {
    const unsigned int          element = surface.element_of(xi);
    const auto                  bounds  = surface.element_bounds(element);
    std::array<unsigned int, 2> index;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const double local =
          (xi[d] - bounds[0][d]) / (bounds[1][d] - bounds[0][d]);
        index[d] = std::min<unsigned int>(n - 1,
                                          std::lower_bound(shares.begin(),
                                                           shares.end(),
                                                           local) -
                                            shares.begin());
      }
    return at(element * n * n + index[1] * n + index[0]);
  }



  std::string
  BondingPattern::description() const
  {
    return "mean phi_0 " + to_text(summary.mean, 6) + ", bonded area " +
           to_text(summary.bonded_area, 6) + " of " + to_text(summary.area, 6) +
           " mm^2 in " + std::to_string(summary.patches) +
           (summary.patches == 1 ? " patch" : " connected patches") +
           (summary.patches > 1 ?
              ", the largest of " + to_text(summary.largest_patch, 6) +
                " mm^2" :
              "");
  }



  std::string
  BondingPattern::table() const
  {
    std::string text = std::string(by_element ? "element" : "point") +
                       ",x_mm,y_mm,area_mm2,phi_0\n";
    for (unsigned int i = 0; i < all_parts.size(); ++i)
      {
        text += std::to_string(i + 1);
        for (const double value : {all_parts[i].centre[0],
                                   all_parts[i].centre[1],
                                   all_parts[i].area,
                                   all_parts[i].phi_0})
          text += "," + to_text(value, 17);
        text += "\n";
      }
    return text;
  }



  void
  check_bonding_pattern(const BondingParameters &parameters,
                        const BodyParameters    &implant)
  {
    using Kind         = BondingPatternKind;
    const Kind pattern = parameters.pattern;
    if (pattern == Kind::expression || pattern == Kind::image ||
        pattern == Kind::file)
      BondingPattern(parameters, implant, make_contact_surface(implant), 3);
  }
} // namespace Debond
