#include <debond/shapes/cell_collector.h>

#include <cmath>

namespace Debond
{
  void
  CellCollector::add(const Place                             &first,
                     const std::function<Key(const Place &)> &key_of)
  {
    std::vector<unsigned int> nodes, places;
    for (const dealii::Point<3> &place : places_in_hexahedron())
      {
        places.push_back(places.size());
        Place at = first;
        for (unsigned int d = 0; d < 3; ++d)
          at[d] += std::lround(2. * place[d]);
        const Key  key   = key_of(at);
        const auto found = number.emplace(key, stored.nodes.size());
        if (found.second)
          stored.nodes.push_back(position(key));
        nodes.push_back(found.first->second);
      }
    stored.add_hexahedron(nodes, places);
  }



  void
  CellCollector::name(const std::string                 &group,
                      const std::array<unsigned int, 4> &corners)
  {
    if (group == "free")
      return;
    auto &face = stored.groups[group].emplace_back();
    for (unsigned int v = 0; v < 4; ++v)
      face[v] = stored.hexahedra.back()[corners[v]];
  }



  void
  CellCollector::add_arc(const unsigned int corner,
                         const unsigned int other,
                         const double       weight)
  {
    const auto &nodes = stored.hexahedra.back();
    stored.arcs.emplace_back(
      std::array<unsigned int, 2>{{nodes[corner], nodes[other]}}, weight);
  }



  double
  part_of_way(const unsigned int halves,
              const unsigned int n,
              const bool         to_first,
              const double       grading)
  {
    const auto end = [&](const unsigned int layer) {
      const double part = static_cast<double>(layer) / n;
      return to_first ? std::pow(part, grading) :
                        1. - std::pow(1. - part, grading);
    };
    return 0.5 * (end(halves / 2) + end((halves + 1) / 2));
  }
} // namespace Debond
