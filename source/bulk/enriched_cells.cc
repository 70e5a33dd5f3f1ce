#include <debond/bulk/enriched_cells.h>
#include <debond/bulk/modulus_field.h>
#include <debond/support/runtime.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace Debond
{
  // Where all cells across are equal, all but those beside the ends of the
  // splines have the same functions.
  EnrichedCells::EnrichedCells(const BulkSpace  &mesh,
                               const NeoHookean &material)
    : mesh(mesh)
    , bulk_material(material)
    , quadrature(2)
  {
    const BodyParameters    &body = mesh.parameters();
    dealii::FEValues<3>      fe_values(mesh.mapping(),
                                  mesh.element(),
                                  quadrature,
                                  dealii::update_gradients |
                                    dealii::update_JxW_values);
    std::vector<ShapeValues> phi;
    for (const dealii::Point<3> &point : quadrature.get_points())
      phi.push_back(shape_values(mesh.element(), point));
    auto active_cell = mesh.dof_handler().begin_active();
    std::map<std::array<unsigned int, 3>, unsigned int> kind_of_place;
    for (unsigned int cell = 0; cell < n_cells(); ++cell)
      {
        const BulkSpace::Cell      &info = mesh.cells()[cell];
        std::array<unsigned int, 3> place{{cell, 0, 0}};
        if (body.has_equal_splines())
          {
            place = {{info.surface_element % body.cells[0],
                      info.surface_element / body.cells[0],
                      info.layer}};
            for (const unsigned int d : {0, 1})
              if (place[d] > 2 && place[d] + 2 < body.cells[d])
                place[d] = 2;
          }
        const auto [found, is_new] =
          kind_of_place.emplace(place, first_gradient.size());
        if (is_new && (info.enriched || mesh.has_splines()))
          add_cell(info, phi);
        else if (is_new)
          {
            fe_values.reinit(
              dealii::Triangulation<3>::active_cell_iterator(active_cell));
            add_cell(fe_values);
          }
        kinds.push_back(found->second);
        if (!mesh.has_splines())
          ++active_cell;
      }
    if (body.modulus)
      find_factors();
  }



  // W and P are proportional to Young's modulus, so that one which varies is
  // nothing but other weights of the Gauss points. A point stands for its
  // eighth of the cell, which is a box.
  void
  EnrichedCells::find_factors()
  {
    const BodyParameters &body = mesh.parameters();
    factors.reserve(n_q * n_cells());
    for (const BulkSpace::Cell &cell : mesh.cells())
      {
        const CellFunctions   functions(mesh, cell);
        const Eigen::Vector3d lower  = functions.position({0., 0., 0.}),
                              upper  = functions.position({1., 1., 1.}),
                              middle = 0.5 * (lower + upper);
        for (unsigned int q = 0; q < n_q; ++q)
          {
            // the corner next to the point
            Eigen::Vector3d corner, point;
            for (unsigned int d = 0; d < 3; ++d)
              {
                const double t = quadrature.point(q)[d];
                corner[d]      = t < 0.5 ? lower[d] : upper[d];
                point[d]       = (1. - t) * lower[d] + t * upper[d];
              }
            factors.push_back(body.modulus->over_box(middle.cwiseMin(corner),
                                                     middle.cwiseMax(corner),
                                                     point) /
                              body.young_modulus);
          }
      }
  }



  // Cells of FE_Q are what FEValues is for; of those with other functions it
  // takes the isoparametric map X(xi) = sum_a N_a X_a: with J = dX/dxi
  // gradients are J^-T dN_a/dxi, and a Gauss point stands for det J of the
  // volume.
  void
  EnrichedCells::add_cell(const dealii::FEValues<3> &fe_values)
  {
    double *gradient = new_kind(fe_values.dofs_per_cell);
    for (const unsigned int a : fe_values.dof_indices())
      for (unsigned int d = 0; d < 3; ++d)
        for (const unsigned int q : fe_values.quadrature_point_indices())
          *gradient++ = fe_values.shape_grad(a, q)[d];
    JxW.insert(JxW.end(),
               fe_values.get_JxW_values().begin(),
               fe_values.get_JxW_values().end());
  }



  void
  EnrichedCells::add_cell(const BulkSpace::Cell          &cell,
                          const std::vector<ShapeValues> &phi)
  {
    const unsigned int  n        = cell.nodes.size();
    double *const       gradient = new_kind(n);
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



  double *
  EnrichedCells::new_kind(const unsigned int n_functions)
  {
    const std::size_t offset = gradient_list.size();
    first_gradient.push_back(offset);
    gradient_list.resize(offset + 3 * n_q * n_functions);
    return &gradient_list[offset];
  }



  void
  EnrichedCells::gradient_at_points(const unsigned int     cell,
                                    const Eigen::VectorXd &v,
                                    PointValues (&H)[3][3]) const
  {
    for (auto &row : H)
      for (PointValues &entry : row)
        entry.setZero();
    const double *G = gradients(cell);
    for (unsigned int a = 0; a < n_nodes(cell); ++a, G += 3 * n_q)
      {
        const double *v_a = &v[3 * nodes(cell)[a]];
        for (unsigned int d = 0; d < 3; ++d)
          {
            const Eigen::Map<const PointValues> G_d(G + d * n_q);
            for (unsigned int i = 0; i < 3; ++i)
              H[i][d] += v_a[i] * G_d;
          }
      }
  }



  // R_a = sum_q P(H) dN_a/dX JxW, part by part in threads
  bool
  EnrichedCells::internal_forces(const Eigen::VectorXd &v,
                                 Eigen::VectorXd       &force,
                                 double                &energy) const
  {
    struct Part
    {
      Eigen::VectorXd force;
      double          energy = 0., smallest_j = 0.;
    };
    std::array<Part, n_chunks> parts;
    const auto                 add = [&](const unsigned int cell, Part &part) {
      PointValues H[3][3], P[3][3];
      gradient_at_points(cell, v, H);
      bulk_material.stress(H, P);
      const PointValues weight = weights(cell);
      part.energy += (bulk_material.energy(H) * weight).sum();
      part.smallest_j =
        std::min(part.smallest_j, NeoHookean::volume_change(H).minCoeff());
      for (auto &row : P)
        for (PointValues &entry : row)
          entry *= weight;
      const double *G = gradients(cell);
      for (unsigned int a = 0; a < n_nodes(cell); ++a, G += 3 * n_q)
        {
          const Eigen::Map<const PointValues> G_0(G), G_1(G + n_q),
            G_2(G + 2 * n_q);
          for (unsigned int i = 0; i < 3; ++i)
            part.force[3 * nodes(cell)[a] + i] +=
              (P[i][0] * G_0 + P[i][1] * G_1 + P[i][2] * G_2).sum();
        }
    };
    for_each_chunk(n_cells(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     parts[chunk].force.setZero(force.size());
                     for (unsigned int cell = first; cell < end; ++cell)
                       add(cell, parts[chunk]);
                   });
    energy            = 0.;
    double smallest_j = 0.;
    for (const Part &part : parts)
      {
        force += part.force;
        energy += part.energy;
        smallest_j = std::min(smallest_j, part.smallest_j);
      }
    return smallest_j > -1. && std::isfinite(energy);
  }



  void
  EnrichedCells::displacement_gradients(const unsigned int     cell,
                                        const Eigen::VectorXd &v,
                                        double (&H)[n_q][3][3]) const
  {
    PointValues side_by_side[3][3];
    gradient_at_points(cell, v, side_by_side);
    for (unsigned int q = 0; q < n_q; ++q)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int d = 0; d < 3; ++d)
          H[q][i][d] = side_by_side[i][d][q];
  }



  // dP_iJ/dF_kL = G (d_ik d_JL + A_iL A_kJ) + Lambda (A_iJ A_kL - ln J A_iL
  // A_kJ) with A = F^-T. With the gradients g_a of the functions in the
  // reference configuration, and h_a = A g_a in the deformed one,
  //
  //   K_ai,bk = sum_q (G d_ik g_a . g_b + (G - Lambda ln J) h_ak h_bi
  //                    + Lambda h_ai h_bk) JxW:
  //
  // three products of matrices with a row for each point.
  void
  EnrichedCells::tangent(const unsigned int     cell,
                         const Eigen::VectorXd &v,
                         Eigen::MatrixXd       &K) const
  {
    using Gradients      = Eigen::Matrix<double, n_q, Eigen::Dynamic>;
    const unsigned int n = n_nodes(cell);
    PointValues        H[3][3], A[3][3];
    gradient_at_points(cell, v, H);
    const PointValues j = NeoHookean::volume_change(H);
    NeoHookean::inverse_transpose(H, PointValues(1. + j), A);
    const Eigen::Map<const Gradients> g(gradients(cell), n_q, 3 * n);
    const PointValues                 weight = weights(cell);
    Gradients                         h(n_q, 3 * n);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int i = 0; i < 3; ++i)
        h.col(3 * a + i) = A[i][0] * g.col(3 * a).array() +
                           A[i][1] * g.col(3 * a + 1).array() +
                           A[i][2] * g.col(3 * a + 2).array();

    const PointValues across =
      weight * (bulk_material.G - bulk_material.Lambda * j.log1p());
    const Eigen::MatrixXd crossed =
      h.transpose() * (across.matrix().asDiagonal() * h);
    K = h.transpose() *
        ((bulk_material.Lambda * weight).matrix().asDiagonal() * h);
    // all 24 numbers of a node in a column
    const Eigen::Map<const Eigen::Matrix<double, 3 * n_q, Eigen::Dynamic>>
      g_of_node(gradients(cell), 3 * n_q, n);
    const Eigen::Array<double, 3 * n_q, 1> weights =
      bulk_material.G * weight.replicate<3, 1>();
    const Eigen::MatrixXd dots =
      g_of_node.transpose() * (weights.matrix().asDiagonal() * g_of_node);
    for (unsigned int b = 0; b < n; ++b)
      for (unsigned int a = 0; a < n; ++a)
        K.block<3, 3>(3 * a, 3 * b) +=
          crossed.block<3, 3>(3 * a, 3 * b).transpose() +
          dots(a, b) * Eigen::Matrix3d::Identity();
  }



  double
  EnrichedCells::volume() const
  {
    double result = 0.;
    for (unsigned int cell = 0; cell < n_cells(); ++cell)
      result += volumes(cell).sum();
    return result;
  }
} // namespace Debond
