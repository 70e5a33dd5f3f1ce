#include <debond/bulk/enriched_cells.h>
#include <debond/support/chunks.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace Debond
{
  namespace
  {
    // Values and derivatives of the four bilinear functions on [-1,1]^2 in
    // lexicographic order.
    void
    bilinear(const double xi,
             const double eta,
             double (&L)[4],
             double (&L_xi)[4],
             double (&L_eta)[4])
    {
      for (unsigned int a = 0; a < 4; ++a)
        {
          const double s = (a % 2 == 0 ? -1. : 1.), t = (a / 2 == 0 ? -1. : 1.);
          L[a]     = 0.25 * (1. + s * xi) * (1. + t * eta);
          L_xi[a]  = 0.25 * s * (1. + t * eta);
          L_eta[a] = 0.25 * t * (1. + s * xi);
        }
    }



    // Values and derivatives with respect to (xi, eta, zeta).
    void
    reference_shape(const BodyMesh               &mesh,
                    const BodyMesh::Cell         &cell,
                    const Eigen::Vector3d        &point,
                    std::vector<double>          &N,
                    std::vector<Eigen::Vector3d> &dN)
    {
      double L[4], L_xi[4], L_eta[4];
      bilinear(point[0], point[1], L, L_xi, L_eta);
      const double near = 0.5 * (1. - point[2]), far = 0.5 * (1. + point[2]);
      N.clear();
      dN.clear();
      if (cell.enriched)
        {
          const auto bounds =
            mesh.surface().element_bounds(cell.surface_element);
          const Eigen::Vector2d half = 0.5 * (bounds[1] - bounds[0]);
          const Eigen::Vector2d parameter =
            bounds[0] +
            half.cwiseProduct(point.head<2>() + Eigen::Vector2d::Ones());
          SurfaceBasis basis;
          mesh.surface().evaluate_in_element(cell.surface_element,
                                             parameter,
                                             basis,
                                             false);
          for (unsigned int a = 0; a < basis.size; ++a)
            {
              N.push_back(near * basis.N[a]);
              dN.emplace_back(near * basis.N_1[a] * half[0],
                              near * basis.N_2[a] * half[1],
                              -0.5 * basis.N[a]);
            }
          for (unsigned int a = 0; a < 4; ++a)
            {
              N.push_back(far * L[a]);
              dN.emplace_back(far * L_xi[a], far * L_eta[a], 0.5 * L[a]);
            }
        }
      else
        for (unsigned int v = 0; v < 8; ++v)
          {
            const unsigned int a = v % 4;
            const double       z = (v < 4 ? near : far);
            N.push_back(z * L[a]);
            dN.emplace_back(z * L_xi[a],
                            z * L_eta[a],
                            (v < 4 ? -0.5 : 0.5) * L[a]);
          }
    }
  } // namespace



  CellShape
  shape_functions(const BodyMesh        &mesh,
                  const BodyMesh::Cell  &cell,
                  const Eigen::Vector3d &point)
  {
    CellShape                    shape;
    std::vector<Eigen::Vector3d> dN;
    reference_shape(mesh, cell, point, shape.N, dN);

    shape.X           = Eigen::Vector3d::Zero();
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero(); // dX / d(xi, eta, zeta)
    for (unsigned int a = 0; a < dN.size(); ++a)
      {
        const Eigen::Vector3d &X_a = mesh.reference_position(cell.nodes[a]);
        shape.X += shape.N[a] * X_a;
        J += X_a * dN[a].transpose();
      }
    // On top of the bone zeta points downwards: the determinant is negative
    // there, which changes nothing but its sign.
    shape.determinant               = std::abs(J.determinant());
    const Eigen::Matrix3d J_inverse = J.inverse();
    for (const auto &derivative : dN)
      shape.gradient.push_back(J_inverse.transpose() * derivative);
    return shape;
  }



  EnrichedCells::EnrichedCells(const BodyMesh &mesh, const NeoHookean &material)
    : bulk_material(material)
  {
    const double gauss = 1. / std::sqrt(3.);
    for (const auto &cell : mesh.cells())
      {
        const unsigned int n = cell.nodes.size();
        n_cell_nodes.push_back(n);
        first_node.push_back(node_list.size());
        node_list.insert(node_list.end(), cell.nodes.begin(), cell.nodes.end());

        const std::size_t offset = gradient_list.size();
        gradient_list.resize(offset + 3 * n_q * n);
        for (unsigned int q = 0; q < n_q; ++q)
          {
            const CellShape shape =
              shape_functions(mesh,
                              cell,
                              gauss * Eigen::Vector3d(q & 1 ? 1 : -1,
                                                      q & 2 ? 1 : -1,
                                                      q & 4 ? 1 : -1));
            JxW.push_back(shape.determinant); // all Gauss weights are 1
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int d = 0; d < 3; ++d)
                gradient_list[offset + (3 * a + d) * n_q + q] =
                  shape.gradient[a][d];
          }
      }
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
    for (unsigned int a = 0; a < n_cell_nodes[cell]; ++a, G += 3 * n_q)
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



  bool
  EnrichedCells::internal_forces(const Eigen::VectorXd &v,
                                 Eigen::VectorXd       &force,
                                 double                &energy) const
  {
    std::array<Eigen::VectorXd, n_chunks> forces;
    std::array<double, n_chunks>          energies, smallest_j;
    for_each_chunk(n_cells(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     forces[chunk].setZero(force.size());
                     energies[chunk] = smallest_j[chunk] = 0.;
                     for (unsigned int cell = first; cell < end; ++cell)
                       add_internal_force(cell,
                                          v,
                                          forces[chunk],
                                          energies[chunk],
                                          smallest_j[chunk]);
                   });
    energy = 0.;
    for (unsigned int chunk = 0; chunk < n_chunks; ++chunk)
      {
        force += forces[chunk];
        energy += energies[chunk];
      }
    return *std::min_element(smallest_j.begin(), smallest_j.end()) > -1. &&
           std::isfinite(energy);
  }



  void
  EnrichedCells::add_internal_force(const unsigned int     cell,
                                    const Eigen::VectorXd &v,
                                    Eigen::VectorXd       &force,
                                    double                &energy,
                                    double                &smallest_j) const
  {
    PointValues H[3][3], P[3][3];
    gradient_at_points(cell, v, H);
    bulk_material.stress(H, P);
    const Eigen::Map<const PointValues> weight(&JxW[n_q * cell]);
    energy += (bulk_material.energy(H) * weight).sum();
    smallest_j = std::min(smallest_j, NeoHookean::volume_change(H).minCoeff());
    for (auto &row : P)
      for (PointValues &entry : row)
        entry *= weight;

    const double *G = gradients(cell);
    for (unsigned int a = 0; a < n_cell_nodes[cell]; ++a, G += 3 * n_q)
      {
        const Eigen::Map<const PointValues> G_0(G), G_1(G + n_q),
          G_2(G + 2 * n_q);
        for (unsigned int i = 0; i < 3; ++i)
          force[3 * nodes(cell)[a] + i] +=
            (P[i][0] * G_0 + P[i][1] * G_1 + P[i][2] * G_2).sum();
      }
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



  void
  EnrichedCells::tangent(const unsigned int     cell,
                         const Eigen::VectorXd &v,
                         Eigen::MatrixXd       &K) const
  {
    const unsigned int n = n_cell_nodes[cell];
    K.setZero(3 * n, 3 * n);
    double H[n_q][3][3];
    displacement_gradients(cell, v, H);
    // columns: dF_kL for a displacement of node b in direction k
    Eigen::MatrixXd B(9, 3 * n);
    for (unsigned int q = 0; q < n_q; ++q)
      {
        double C[9][9];
        bulk_material.tangent(H[q], C);
        B.setZero();
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int d = 0; d < 3; ++d)
            for (unsigned int i = 0; i < 3; ++i)
              B(3 * i + d, 3 * a + i) = gradients(cell)[(3 * a + d) * n_q + q];
        const Eigen::Map<Eigen::Matrix<double, 9, 9, Eigen::RowMajor>> C_map(
          &C[0][0]);
        K.noalias() += B.transpose() * (JxW[n_q * cell + q] * (C_map * B));
      }
  }



  double
  EnrichedCells::volume() const
  {
    double sum = 0.;
    for (const double weight : JxW)
      sum += weight;
    return sum;
  }
} // namespace Debond
