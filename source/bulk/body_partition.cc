#include <debond/bulk/body_partition.h>
#include <debond/support/ranks.h>

#include <algorithm>

namespace Debond
{
  // In columns, as the interface sees all of the face but no cell: parts are
  // close to squares, so that they have few nodes in common.
  std::array<unsigned int, 2>
  parts_across(const std::array<unsigned int, 3> &cells, const unsigned int n)
  {
    std::array<unsigned int, 2> best{{0, 0}};
    double                      least = 0.;
    for (unsigned int n_x = 1; n_x <= n; ++n_x)
      if (n % n_x == 0 && n_x <= cells[0] && n / n_x <= cells[1])
        {
          const unsigned int n_y = n / n_x;
          const double       cut =
            double(n_x - 1) * cells[1] + double(n_y - 1) * cells[0];
          if (best[0] == 0 || cut < least)
            {
              best  = {{n_x, n_y}};
              least = cut;
            }
        }
    return best;
  }



  CellColumns
  columns_of_rank(const std::array<unsigned int, 3> &cells,
                  const unsigned int                 rank,
                  const unsigned int                 n_ranks)
  {
    const auto         n = parts_across(cells, n_ranks);
    const unsigned int part[]{rank % n[0], rank / n[0]};
    CellColumns        result;
    for (unsigned int d = 0; d < 2; ++d)
      {
        result.begin[d] = std::size_t(cells[d]) * part[d] / n[d];
        result.end[d]   = std::size_t(cells[d]) * (part[d] + 1) / n[d];
      }
    return result;
  }



  BodyPartition::BodyPartition(const BulkSpace &mesh)
    : mesh(mesh)
    , n_parts(parts_across(mesh.parameters().cells, Ranks::number()))
    , rank(Ranks::own())
    , n_levels(mesh.depth().n_basis_functions() - 1)
    , first_node{0}
  {
    for (unsigned int r = 0; r < Ranks::number(); ++r)
      {
        const unsigned int i = r % n_parts[0], j = r / n_parts[0];
        first_node.push_back(first_node.back() +
                             owned_range(0, i, false).size() *
                               owned_range(1, j, false).size() * n_levels +
                             owned_range(0, i, true).size() *
                               owned_range(1, j, true).size());
      }
  }



  // A function of splines belongs to the middle one of its three cells, that of
  // a vertex to the cell behind it; at the ends to the last one there is.
  BodyPartition::Range
  BodyPartition::owned_range(const unsigned int direction,
                             const unsigned int part,
                             const bool         on_face) const
  {
    const unsigned int n     = mesh.parameters().cells[direction];
    const unsigned int begin = std::size_t(n) * part / n_parts[direction],
                       end   = std::size_t(n) * (part + 1) / n_parts[direction];
    const bool is_spline =
      (on_face || mesh.has_splines()) && mesh.surface().degree() == 2;
    const unsigned int shift = is_spline ? 1 : 0;
    return {begin == 0 ? 0 : begin + shift,
            end == n ? n + 1 + shift : end + shift};
  }



  unsigned int
  BodyPartition::part_of_place(const unsigned int direction,
                               const unsigned int place,
                               const bool         on_face) const
  {
    unsigned int part = 0;
    while (place >= owned_range(direction, part, on_face).end)
      ++part;
    return part;
  }



  int
  BodyPartition::number_of(const unsigned int node) const
  {
    if (mesh.is_tied(node))
      return -1;
    const bool         on_face = node >= mesh.n_inner_nodes();
    const auto         place   = mesh.place_of(node).index;
    const unsigned int i       = part_of_place(0, place[0], on_face),
                       j       = part_of_place(1, place[1], on_face);
    const Range  x = owned_range(0, i, on_face), y = owned_range(1, j, on_face);
    unsigned int number = first_node[i + n_parts[0] * j];
    if (on_face) // after the inner ones
      number += owned_range(0, i, false).size() *
                owned_range(1, j, false).size() * n_levels;
    return number + place[0] - x.begin +
           x.size() *
             (place[1] - y.begin + y.size() * (on_face ? 0 : place[2] - 1));
  }
} // namespace Debond
