#include <debond/bulk/bulk_space.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/interface/bonding_source.h>
#include <debond/shapes/body_parameters.h>
#include <debond/support/number_text.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <map>
#include <numeric>

// phi_0 of Eq. (13) on the contact face of the implant, in parts: its elements,
// or the places of its quadrature points. The bonded share of the area is met
// exactly, with a part at the border that is bonded in part, so that patterns
// of equal share can be compared on any mesh.
namespace Debond
{
  BondingPattern::BondingPattern(const BondingParameters     &parameters,
                                 const BodyParameters        &implant,
                                 const NurbsSurface          &surface,
                                 const dealii::Quadrature<1> &along)
    : surface(surface)
    , along(along)
    , n(along.size())
    , by_element(parameters.resolution == BondingResolution::element)
  {
    const auto points = surface_quadrature(surface, along);
    all_parts.resize(part_of(points.size() - 1) + 1);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        // Areas and centroids by quadrature weights, so that sums over points
        // during the run see the fraction that was asked for.
        Part &part = all_parts[part_of(q)];
        part.area += points[q].JxW;
        part.place += points[q].JxW * points[q].X;
      }
    for (Part &part : all_parts)
      {
        part.place /= part.area;
        part.centre = implant.geometry().on_face(part.place);
      }

    fill(parameters, implant);
    for (Part &part : all_parts)
      {
        part.phi_0 *= parameters.initial_bonding;
        summary.area += part.area;
        summary.bonded_area += part.phi_0 * part.area;
      }
    summary.mean = summary.bonded_area / summary.area;

    // Around each quadrature point the piece of the element that its weight
    // makes up, for places in between.
    shares.resize(n);
    std::partial_sum(along.get_weights().begin(),
                     along.get_weights().end(),
                     shares.begin());
    count_patches();
  }



  namespace
  {
    /** Bonds the parts of smallest rank; ranks that differ by at most
     *  @p tolerance are equal. */
    //
    // Equal ranks share what is left: of a ring of elements that lie equally
    // far out each is bonded in part, and the pattern stays symmetric.
    void
    bond_in_order(const std::vector<double>         &rank,
                  const double                       tolerance,
                  const double                       bonded_fraction,
                  std::vector<BondingPattern::Part> &parts)
    {
      std::vector<unsigned int> order(parts.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](const unsigned int a, const unsigned int b) {
                         return rank[a] < rank[b];
                       });
      // area that is left to bond [mm^2]; the group that crosses the border
      // gets what is left of it, and those behind nothing
      double remaining = 0.;
      for (const BondingPattern::Part &part : parts)
        remaining += bonded_fraction * part.area;
      for (unsigned int first = 0; first < order.size();)
        {
          unsigned int last = first;
          double       area = 0.;
          for (; last < order.size() &&
                 rank[order[last]] - rank[order[first]] <= tolerance;
               ++last)
            area += parts[order[last]].area;
          const double share = std::clamp(remaining / area, 0., 1.);
          for (; first < last; ++first)
            parts[order[first]].phi_0 = share;
          remaining -= area;
        }
    }
  } // namespace



  // Disks and annuli go by the radius; random patterns draw parts one by one,
  // or take the highest places of a smooth random field.
  void
  BondingPattern::fill(const BondingParameters &parameters,
                       const BodyParameters    &implant)
  {
    using Kind                           = BondingPatternKind;
    const Kind                   pattern = parameters.pattern;
    std::vector<double>          values(all_parts.size(), 1.), rank(values);
    std::vector<Eigen::Vector2d> centres;
    for (const Part &part : all_parts)
      centres.push_back(part.centre);

    double tolerance = 0.;
    if (pattern == Kind::disk || pattern == Kind::annulus)
      for (unsigned int i = 0; i < rank.size(); ++i)
        {
          const double radius = centres[i].norm();
          rank[i]             = pattern == Kind::disk ? radius : -radius;
          tolerance           = std::max(tolerance, 1e-9 * radius);
        }
    else if (pattern == Kind::random && parameters.correlation_length > 0.)
      {
        // The highest places of a Gaussian field form connected patches of
        // about the correlation length, of whatever share is asked for.
        const RandomField field(parameters.seed, parameters.correlation_length);
        for (unsigned int i = 0; i < rank.size(); ++i)
          rank[i] = -field(all_parts[i].place);
      }
    else if (pattern == Kind::random)
      {
        const auto order = random_order(rank.size(), parameters.seed);
        for (unsigned int i = 0; i < rank.size(); ++i)
          rank[order[i]] = i;
      }
    else
      {
        if (pattern != Kind::homogeneous)
          // expression, image and file say phi_0 itself, of any share of the
          // area
          values = bonding_from_source(
            parameters, implant, surface, along, centres, summary.remark);
        for (unsigned int i = 0; i < values.size(); ++i)
          all_parts[i].phi_0 = values[i];
        return;
      }
    bond_in_order(rank, tolerance, parameters.bonded_fraction, all_parts);
  }



  // Connected sets of parts, side by side, that are bonded at least half as
  // well as the best: what is bonded less is the border of a patch, or its
  // blurred edge in a picture.
  void
  BondingPattern::count_patches()
  {
    // A search through the neighbours, from part to part: each is visited once.
    double best = 0.;
    for (const Part &part : all_parts)
      best = std::max(best, part.phi_0);
    const auto is_bonded = [&](const unsigned int part) {
      return best > 0. && all_parts[part].phi_0 >= 0.5 * best;
    };
    boost::disjoint_sets_with_storage<> patches(all_parts.size());
    for (unsigned int p = 0; p < all_parts.size(); ++p)
      for (const unsigned int beside : parts_beside(p))
        if (is_bonded(p) && is_bonded(beside))
          patches.union_set(p, beside);
    std::map<std::size_t, double> areas;
    for (unsigned int p = 0; p < all_parts.size(); ++p)
      if (is_bonded(p))
        areas[patches.find_set(p)] += all_parts[p].phi_0 * all_parts[p].area;
    summary.patches = areas.size();
    for (const auto &[patch, area] : areas)
      summary.largest_patch = std::max(summary.largest_patch, area);
  }



  // Across the sides of its element a part has that neighbour that its middle
  // touches.
  std::vector<unsigned int>
  BondingPattern::parts_beside(const unsigned int part) const
  {
    // Inside of an element neighbours are known by their numbers; beyond its
    // sides the surface knows which element lies there, also from patch to
    // patch.
    const unsigned int m       = by_element ? 1 : n; // parts along an element
    const unsigned int element = part / (m * m), local = part % (m * m);
    const std::array<unsigned int, 2> index{{local % m, local / m}};
    const auto                        box = surface.element_bounds(element);
    std::vector<unsigned int>         result;
    for (unsigned int d = 0; d < 2; ++d)
      for (const bool upwards : {false, true})
        {
          if (upwards ? index[d] + 1 < m : index[d] > 0)
            {
              const unsigned int stride = d == 0 ? 1 : m;
              result.push_back(upwards ? part + stride : part - stride);
              continue;
            }
          dealii::Point<2> middle_of_side;
          middle_of_side[d] = upwards;
          middle_of_side[1 - d] =
            by_element ? 0.5 : along.point(index[1 - d])[0];
          for (const auto &place :
               surface.places_beside(element,
                                     parameters_at(box, middle_of_side)))
            result.push_back(part_of(point_at(place.element, place.xi)));
        }
    return result;
  }



  // Elements are numbered as the surface numbers them, points in them with the
  // first parameter fastest, as quadratures of tensor products have it.
  unsigned int
  BondingPattern::point_at(const unsigned int     element,
                           const Eigen::Vector2d &xi) const
  {
    // Where xi lies in its element, in parts of its width in both directions,
    // and in the share of which point that is.
    const auto bounds = surface.element_bounds(element);
    const auto index  = [&](const unsigned int d) -> unsigned int {
      const double local =
        (xi[d] - bounds[0][d]) / (bounds[1][d] - bounds[0][d]);
      // the last share is what the others leave
      return std::lower_bound(shares.begin(), shares.end() - 1, local) -
             shares.begin();
    };
    return element * n * n + index(1) * n + index(0);
  }



  double
  BondingPattern::at(const Eigen::Vector2d &xi) const
  {
    return at(point_at(surface.element_of(xi), xi));
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



  // As the pattern `file' reads it: a pattern that was drawn can be looked at,
  // changed by hand, and used again.
  std::string
  BondingPattern::table() const
  {
    std::string text = std::string(by_element ? "element" : "point") +
                       ",x_mm,y_mm,area_mm2,phi_0\n";
    unsigned int number = 0;
    for (const Part &part : all_parts)
      {
        text += std::to_string(++number);
        for (const double value :
             {part.centre[0], part.centre[1], part.area, part.phi_0})
          text += "," + to_text(value, 17);
        text += "\n";
      }
    return text;
  }



  // Only what the user has written can be wrong, and is worth making a pattern
  // for before a run begins.
  void
  check_bonding_pattern(const BondingParameters     &parameters,
                        const BodyParameters        &implant,
                        const dealii::Quadrature<1> &along)
  {
    using Kind         = BondingPatternKind;
    const Kind pattern = parameters.pattern;
    if (pattern == Kind::expression || pattern == Kind::image ||
        pattern == Kind::file)
      BondingPattern(parameters, implant, make_contact_surface(implant), along);
  }
} // namespace Debond
