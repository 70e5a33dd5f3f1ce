#include <debond/bulk/enriched_cells.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/runtime.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace Debond
{
  namespace
  {
    // Where all cells across are equal, all but those beside the ends of the
    // splines have the same functions.
    std::array<unsigned int, 3>
    place_of_kind(const BodyParameters  &body,
                  const unsigned int     number,
                  const BulkSpace::Cell &cell)
    {
      if (!body.has_equal_splines())
        return {{number, 0, 0}};
      std::array<unsigned int, 3> place{{cell.surface_element % body.cells[0],
                                         cell.surface_element / body.cells[0],
                                         cell.layer}};
      for (const unsigned int d : {0, 1})
        if (place[d] > 2 && place[d] + 2 < body.cells[d])
          place[d] = 2;
      return place;
    }
  } // namespace



  EnrichedCells::EnrichedCells(const BulkSpace            &mesh,
                               const HyperelasticMaterial &material)
    : mesh(mesh)
    , bulk_material(material)
    // nine control points of a patch that shares its border only have motions
    // that two points along an edge do not see
    , line((mesh.degree() == 2 && !mesh.has_splines()) ||
               (mesh.surface().degree() == 2 &&
                !mesh.surface().is_one_patch() && !mesh.has_tetrahedra()) ?
             3 :
             2)
    , quadrature(line.size())
  {
    const BodyParameters    &body = mesh.parameters();
    std::vector<ShapeValues> phi;
    for (const dealii::Point<3> &point : quadrature.get_points())
      phi.push_back(shape_values(mesh.element(), point));
    if (!body.has_equal_splines())
      {
        std::size_t n_functions = 0;
        for (const BulkSpace::Cell &cell : mesh.cells())
          n_functions += cell.nodes.size();
        gradient_list.reserve(3 * n_points() * n_functions);
        JxW.reserve(n_points() * n_cells());
      }
    std::map<std::array<unsigned int, 3>, unsigned int> kind_of_place;
    for (unsigned int cell = 0; cell < n_cells(); ++cell)
      {
        const BulkSpace::Cell &info = mesh.cells()[cell];
        const auto [found, is_new] =
          kind_of_place.emplace(place_of_kind(body, cell, info),
                                first_gradient.size());
        if (is_new)
          add_cell(info, phi);
        kinds.push_back(found->second);
      }
    if (body.modulus)
      find_factors();
  }



  // W and P are proportional to Young's modulus, so that one which varies is
  // nothing but other weights of the Gauss points. A point stands for a part of
  // the cell as long as its weight: a box, or what is in the box around it.
  void
  EnrichedCells::find_factors()
  {
    const BodyParameters &body = mesh.parameters();
    std::vector<double>   ends{0.};
    for (const double weight : line.get_weights())
      ends.push_back(ends.back() + weight);
    factors.reserve(n_points() * n_cells());
    // cells of one patch are boxes, edges along x, y and z
    const bool has_boxes = mesh.has_lattice() && mesh.surface().is_one_patch();
    for (const BulkSpace::Cell &cell : mesh.cells())
      {
        const CellFunctions   functions(mesh, cell);
        const Eigen::Vector3d corner = functions.position({0., 0., 0.}),
                              edges = functions.position({1., 1., 1.}) - corner;
        const auto at = [&](const Eigen::Vector3d &t) -> Eigen::Vector3d {
          return has_boxes ? corner + edges.cwiseProduct(t) :
                             functions.position({t[0], t[1], t[2]});
        };
        for (unsigned int q = 0; q < n_points(); ++q)
          {
            const unsigned int n = n_along(), i[]{q % n, q / n % n, q / n / n};
            Eigen::Vector3d    lower, upper, point;
            for (unsigned int d = 0; d < 3; ++d)
              {
                lower[d] = ends[i[d]];
                upper[d] = ends[i[d] + 1];
                point[d] = line.point(i[d])[0];
              }
            Eigen::Vector3d least = at(lower), most = at(upper);
            for (unsigned int v = 1; v < 7 && !has_boxes; ++v)
              {
                Eigen::Vector3d t = lower;
                for (unsigned int d = 0; d < 3; ++d)
                  if ((v >> d & 1) != 0)
                    t[d] = upper[d];
                least = least.cwiseMin(at(t));
                most  = most.cwiseMax(at(t));
              }
            factors.push_back(body.modulus->over_box(least, most, at(point)) /
                              body.young_modulus);
          }
      }
  }



  // The map is isoparametric, X(xi) = sum_a N_a X_a: with J = dX/dxi gradients
  // are J^-T dN_a/dxi, and a Gauss point stands for det J of the volume.
  // FEValues knows neither NURBS nor splines, and of FE_Q it comes to the same.
  void
  EnrichedCells::add_cell(const BulkSpace::Cell          &cell,
                          const std::vector<ShapeValues> &phi)
  {
    const unsigned int n = cell.nodes.size(), n_q = n_points();
    first_gradient.push_back(gradient_list.size());
    gradient_list.resize(first_gradient.back() + 3 * n_q * n);
    double *const       gradient = &gradient_list[first_gradient.back()];
    const CellFunctions functions(mesh, cell);
    ControlNet          X(3, n);
    for (unsigned int a = 0; a < n; ++a)
      X.col(a) = mesh.reference_position(cell.nodes[a]);
    for (unsigned int q = 0; q < n_q; ++q)
      {
        const ShapeValues     N = functions.at(quadrature.point(q), phi[q]);
        const Eigen::Matrix3d J = X.lazyProduct(N.rightCols<3>());
        JxW.push_back(J.determinant() * quadrature.weight(q));
        const Eigen::Matrix3d J_inverse = J.inverse();
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int d = 0; d < 3; ++d)
            gradient[(3 * a + d) * n_q + q] =
              N.row(a).tail<3>().dot(J_inverse.col(d));
      }
  }



  template <int n_q>
  void
  EnrichedCells::gradient_at_points(const unsigned int     cell,
                                    const Eigen::VectorXd &v,
                                    PointValues<n_q> (&H)[3][3]) const
  {
    for (auto &row : H)
      for (PointValues<n_q> &entry : row)
        entry.setZero();
    const double *G = gradients(cell);
    for (unsigned int a = 0; a < n_nodes(cell); ++a, G += 3 * n_q)
      {
        const double *v_a = &v[3 * nodes(cell)[a]];
        for (unsigned int d = 0; d < 3; ++d)
          {
            const Eigen::Map<const PointValues<n_q>> G_d(G + d * n_q);
            for (unsigned int i = 0; i < 3; ++i)
              H[i][d] += v_a[i] * G_d;
          }
      }
  }



  /** Sums over some of the cells. */
  struct EnrichedCells::Forces
  {
    Eigen::VectorXd force;
    double          energy = 0., smallest_j = 0.;
  };



  // R_a = sum_q P(H) dN_a/dX JxW
  template <int n_q>
  void
  EnrichedCells::add_forces(const unsigned int     cell,
                            const Eigen::VectorXd &v,
                            Forces                &sum) const
  {
    PointValues<n_q> H[3][3], P[3][3], W;
    gradient_at_points<n_q>(cell, v, H);
    bulk_material.stress(H, P, W);
    const PointValues<n_q> weight = weights<n_q>(cell);
    sum.energy += (W * weight).sum();
    sum.smallest_j = std::min(sum.smallest_j, volume_change(H).minCoeff());
    for (auto &row : P)
      for (PointValues<n_q> &entry : row)
        entry *= weight;
    const double *G = gradients(cell);
    for (unsigned int a = 0; a < n_nodes(cell); ++a, G += 3 * n_q)
      {
        const Eigen::Map<const PointValues<n_q>> G_0(G), G_1(G + n_q),
          G_2(G + 2 * n_q);
        for (unsigned int i = 0; i < 3; ++i)
          sum.force[3 * nodes(cell)[a] + i] +=
            (P[i][0] * G_0 + P[i][1] * G_1 + P[i][2] * G_2).sum();
      }
  }



  // Part by part in threads.
  bool
  EnrichedCells::internal_forces(const Eigen::VectorXd &v,
                                 Eigen::VectorXd       &force,
                                 double                &energy) const
  {
    std::array<Forces, n_chunks> parts;
    for_each_chunk(n_cells(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     parts[chunk].force.setZero(force.size());
                     with_points([&](const auto n_q) {
                       for (unsigned int cell = first; cell < end; ++cell)
                         add_forces<n_q()>(cell, v, parts[chunk]);
                     });
                   });
    energy            = 0.;
    double smallest_j = 0.;
    for (const Forces &part : parts)
      {
        force += part.force;
        energy += part.energy;
        smallest_j = std::min(smallest_j, part.smallest_j);
      }
    return smallest_j > -1. && std::isfinite(energy);
  }



  std::vector<Eigen::Matrix3d>
  EnrichedCells::stress(const unsigned int     cell,
                        const Eigen::VectorXd &v,
                        const bool             has_small_strains) const
  {
    return with_points([&](const auto n) {
      constexpr int    n_q = n();
      PointValues<n_q> H[3][3], P[3][3], W, C[3][3][3][3];
      gradient_at_points<n_q>(cell, v, H);
      if (has_small_strains)
        {
          const PointValues<n_q> zero = PointValues<n_q>::Zero();
          const PointValues<n_q> at_rest[3][3]{{zero, zero, zero},
                                               {zero, zero, zero},
                                               {zero, zero, zero}};
          bulk_material.tangent(at_rest, C);
        }
      else
        bulk_material.stress(H, P, W);
      const PointValues<n_q>       j      = volume_change(H);
      const Eigen::ArrayXd         factor = stiffness_factors(cell);
      std::vector<Eigen::Matrix3d> result(n_q, Eigen::Matrix3d::Zero());
      for (unsigned int q = 0; q < n_q; ++q)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int J = 0; J < 3; ++J)
            if (has_small_strains)
              for (unsigned int k = 0; k < 3; ++k)
                for (unsigned int L = 0; L < 3; ++L)
                  result[q](i, J) += factor[q] * C[i][J][k][L][q] * H[k][L][q];
            else
              for (unsigned int k = 0; k < 3; ++k)
                result[q](i, k) += factor[q] / (1. + j[q]) * P[i][J][q] *
                                   ((k == J ? 1. : 0.) + H[k][J][q]);
      return result;
    });
  }



  // With the gradients g_a of the functions in the reference configuration
  //
  //   K_ai,bk = sum_q g_aJ C_iJkL g_bL JxW,
  //
  // for each i and k a product of matrices with a row for each point and J.
  // K_ki is the transpose of K_ik.
  void
  EnrichedCells::tangent(const unsigned int     cell,
                         const Eigen::VectorXd &v,
                         Eigen::MatrixXd       &K) const
  {
    with_points([&](const auto n_q) { tangent_of<n_q()>(cell, v, K); });
  }



  template <int n_q>
  void
  EnrichedCells::tangent_of(const unsigned int     cell,
                            const Eigen::VectorXd &v,
                            Eigen::MatrixXd       &K) const
  {
    using Gradients      = Eigen::Matrix<double, 3 * n_q, Eigen::Dynamic>;
    using Stride         = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;
    const unsigned int n = n_nodes(cell);
    PointValues<n_q>   H[3][3], C[3][3][3][3];
    gradient_at_points<n_q>(cell, v, H);
    bulk_material.tangent(H, C);
    const PointValues<n_q>            weight = weights<n_q>(cell);
    const Eigen::Map<const Gradients> g(gradients(cell), 3 * n_q, n);
    Gradients                         C_g(3 * n_q, n);
    Eigen::MatrixXd                   K_ik(n, n);
    K.resize(3 * n, 3 * n);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = i; k < 3; ++k)
        {
          for (unsigned int J = 0; J < 3; ++J)
            {
              const PointValues<n_q> c[]{weight * C[i][J][k][0],
                                         weight * C[i][J][k][1],
                                         weight * C[i][J][k][2]};
              for (unsigned int b = 0; b < n; ++b)
                C_g.template block<n_q, 1>(J * n_q, b).array() =
                  c[0] * g.template block<n_q, 1>(0, b).array() +
                  c[1] * g.template block<n_q, 1>(n_q, b).array() +
                  c[2] * g.template block<n_q, 1>(2 * n_q, b).array();
            }
          K_ik.noalias() = g.transpose() * C_g;
          using Block    = Eigen::Map<Eigen::MatrixXd, 0, Stride>;
          const Stride stride(9 * n, 3);
          Block(&K(i, k), n, n, stride) = K_ik;
          if (k != i)
            Block(&K(k, i), n, n, stride) = K_ik.transpose();
        }
  }



  double
  EnrichedCells::volume() const
  {
    double result = 0.;
    for (const unsigned int kind : kinds)
      result +=
        Eigen::Map<const Eigen::ArrayXd>(&JxW[n_points() * kind], n_points())
          .sum();
    return result;
  }
} // namespace Debond
