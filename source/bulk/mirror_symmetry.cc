#include <debond/bulk/mirror_symmetry.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

// Mirror symmetry of a body: blocks, coins and caps have it, as long as strains
// are small. The stiffness then falls into four parts of a quarter of the size,
// whose dense parts take a quarter of the memory together, and whose
// factorisations a tenth of the time. Whether a body has it is asked, never
// taken for granted.
namespace Debond
{
  namespace
  {
    /** More than rounding of positions, moduli and weights, relative to their
     *  size, and less than what changes a result. */
    constexpr double rounding = 1e-10;



    /** True if the knots are mirror images of each other in direction @p d; of
     *  several patches cells and the places of their nodes will tell. */
    bool
    has_mirrored_knots(const NurbsSurface &face, const unsigned int d)
    {
      const std::vector<double> &knots = face.knots(d).breakpoints();
      return std::equal(knots.begin(),
                        knots.end(),
                        knots.rbegin(),
                        [](const double own, const double other) {
                          return std::abs(own + other - 1.) <= rounding;
                        });
    }



    /** Images in both mirrors of some nodes, of which no two are at the same
     *  place, put into @p images. False if one of them has none. */
    bool
    find_images(const BulkSpace                          &space,
                const std::vector<unsigned int>          &nodes,
                std::array<std::vector<unsigned int>, 2> &images)
    {
      std::vector<dealii::Point<3>> places;
      double                        extent = 0.;
      for (const unsigned int node : nodes)
        {
          const Eigen::Vector3d &X = space.reference_position(node);
          places.emplace_back(X[0], X[1], X[2]);
          extent = std::max(extent, places.back().norm());
        }
      const auto                tree = dealii::pack_rtree_of_indices(places);
      std::vector<unsigned int> nearest;
      for (const unsigned int d : {0, 1})
        for (unsigned int k = 0; k < nodes.size(); ++k)
          {
            const unsigned int node = nodes[k];
            if (images[d][node] != dealii::numbers::invalid_unsigned_int)
              continue; // it is an image itself
            dealii::Point<3> mirrored = places[k];
            mirrored[d]               = -mirrored[d];
            nearest.clear();
            tree.query(boost::geometry::index::nearest(mirrored, 1),
                       std::back_inserter(nearest));
            const unsigned int image = nodes[nearest.front()];
            if (places[nearest.front()].distance(mirrored) > rounding * extent)
              return false;
            for (unsigned int c = 0; c < 3; ++c)
              if (space.is_fixed(node, c) != space.is_fixed(image, c))
                return false;
            images[d][node]  = image;
            images[d][image] = node;
          }
      return true;
    }



    /** The image of each cell in mirror d, by those of its nodes; none if a
     * cell has none, or one of another modulus. */
    std::vector<unsigned int>
    images_of_cells_in(const unsigned int               d,
                       const BulkSpace                 &space,
                       const EnrichedCells             &cells,
                       const std::vector<unsigned int> &image)
    {
      std::map<std::vector<unsigned int>, unsigned int> cell_of;
      const auto sorted = [](std::vector<unsigned int> nodes) {
        std::sort(nodes.begin(), nodes.end());
        return nodes;
      };
      for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
        cell_of.emplace(sorted(space.cells()[cell].nodes), cell);
      std::vector<unsigned int> result;
      for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
        {
          std::vector<unsigned int> nodes = space.cells()[cell].nodes;
          for (unsigned int &node : nodes)
            node = image[node];
          const auto found = cell_of.find(sorted(nodes));
          if (found == cell_of.end())
            return {};
          result.push_back(found->second);
          const Eigen::ArrayXd own   = cells.stiffness_factors(cell),
                               other = cells.stiffness_factors(found->second);
          const int n = cells.n_along(), stride = d == 0 ? 1 : n;
          for (int q = 0; q < own.size(); ++q)
            {
              const int image_of_q =
                q + (n - 1 - 2 * (q / stride % n)) * stride;
              if (std::abs(own[q] - other[image_of_q]) > rounding * own[q])
                return {};
            }
        }
      return result;
    }
  } // namespace



  std::optional<MirrorSymmetry>
  MirrorSymmetry::of(const BulkSpace &space, const EnrichedCells &cells)
  {
    // of several patches parameters run in all directions, and what varies from
    // point to point is not compared
    if (space.parameters().mesh ||
        (space.parameters().is_fitted() && space.parameters().modulus))
      return {};
    MirrorSymmetry result;
    // a node that follows others may be where one of them is
    std::array<std::vector<unsigned int>, 3> kinds;
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      kinds[node >= space.n_inner_nodes() ? 2 :
            space.is_tied(node)           ? 1 :
                                            0]
        .push_back(node);
    for (const unsigned int d : {0, 1})
      {
        result.image[d].assign(space.n_nodes(),
                               dealii::numbers::invalid_unsigned_int);
        if (!has_mirrored_knots(space.surface(), d))
          return {};
      }
    for (const auto &kind : kinds)
      if (!find_images(space, kind, result.image))
        return {};
    const unsigned int         first   = space.n_inner_nodes();
    const std::vector<double> &weights = space.surface().weights();
    for (const auto &images : result.image)
      for (unsigned int A = 0; A < weights.size(); ++A)
        if (std::abs(weights[A] - weights[images[first + A] - first]) >
            rounding * weights[A])
          return {};

    std::array<std::vector<unsigned int>, 2> image_of_cell;
    for (const unsigned int d : {0, 1})
      {
        image_of_cell[d] = images_of_cells_in(d, space, cells, result.image[d]);
        if (image_of_cell[d].empty())
          return {};
      }
    for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
      {
        const unsigned int x = image_of_cell[0][cell],
                           y = image_of_cell[1][cell];
        const bool is_first  = cell <= std::min({x, y, image_of_cell[1][x]});
        result.images_of_cells.push_back(
          is_first ? (x == cell ? 1 : 2) * (y == cell ? 1 : 2) : 0);
      }
    return result;
  }



  std::vector<bool>
  MirrorSymmetry::with_images(const BulkSpace  &space,
                              std::vector<bool> control_points) const
  {
    const unsigned int first = space.n_inner_nodes();
    for (const auto &images : image)
      for (unsigned int A = 0; A < control_points.size(); ++A)
        if (control_points[A])
          control_points[images[first + A] - first] = true;
    return control_points;
  }



  // A node on a mirror is its own image and can only move as its own sign says.
  // That of the component across the mirror is the opposite.
  dealii::AffineConstraints<double>
  MirrorSymmetry::constraints(const BulkSpace             &space,
                              const std::array<double, 2> &parity) const
  {
    dealii::AffineConstraints<double> result;
    result.merge(space.constraints()); // and stays open for more
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      {
        const unsigned int x = image[0][node], y = image[1][node],
                           first = std::min({node, x, y, image[1][x]});
        for (unsigned int c = 0; c < 3; ++c)
          {
            const unsigned int dof    = 3 * node + c;
            const double       sign[] = {c == 0 ? -parity[0] : parity[0],
                                   c == 1 ? -parity[1] : parity[1]};
            if (result.is_constrained(dof))
              continue;
            if ((x == node && sign[0] < 0.) || (y == node && sign[1] < 0.))
              result.add_line(dof);
            else if (first != node)
              {
                // by which mirrors the first one becomes this one
                const double product = first == x ? sign[0] :
                                       first == y ? sign[1] :
                                                    sign[0] * sign[1];
                result.add_line(dof);
                result.add_entry(dof, 3 * first + c, product);
              }
          }
      }
    result.close();
    return result;
  }



  DofClass::DofClass(const BulkSpace                         &space,
                     const dealii::AffineConstraints<double> &constraints)
    : number(3 * space.n_nodes(), -1)
    , coefficient(number.size(), 0.)
  {
    std::vector<unsigned int> n_images;
    for (unsigned int dof = 0; dof < number.size(); ++dof)
      if (!constraints.is_constrained(dof))
        {
          number[dof]      = n++;
          coefficient[dof] = 1.;
          n_images.push_back(1);
        }
    for (unsigned int dof = 0; dof < number.size(); ++dof)
      if (constraints.is_constrained(dof) &&
          !space.constraints().is_constrained(dof))
        for (const auto &[other, sign] :
             *constraints.get_constraint_entries(dof))
          {
            number[dof]      = number[other];
            coefficient[dof] = sign;
            ++n_images[number[dof]];
          }
    for (unsigned int dof = 0; dof < number.size(); ++dof)
      if (number[dof] >= 0)
        coefficient[dof] /= std::sqrt(n_images[number[dof]]);
  }



  Eigen::VectorXd
  DofClass::fold(const Eigen::VectorXd &v) const
  {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
    for (unsigned int dof = 0; dof < number.size(); ++dof)
      if (number[dof] >= 0)
        y[number[dof]] += coefficient[dof] * v[dof];
    return y;
  }



  void
  DofClass::unfold(const Eigen::VectorXd &y, Eigen::VectorXd &v) const
  {
    for (unsigned int dof = 0; dof < number.size(); ++dof)
      if (number[dof] >= 0)
        v[dof] += coefficient[dof] * y[number[dof]];
  }
} // namespace Debond
