#include <debond/bulk/bulk.h>
#include <debond/bulk/condensation.h>
#include <debond/bulk/enriched_cells.h>

#include <algorithm>
#include <utility>

namespace Debond
{
  namespace
  {
    /**
     * NURBS-enriched hexahedra whose stiffness is factorised by sparse Cholesky
     * and condensed on the degrees of freedom that contact can reach.
     */
    class CondensedBulk : public Bulk
    {
    public:
      // Vertices of the contact face follow the control points and belong to no
      // cell. Cells couple all their degrees of freedom with each other; the
      // lower triangle is stored, column by column.
      CondensedBulk(const BodyMesh &mesh, const NeoHookean &material)
        : mesh(mesh)
        , cells(mesh, material)
        , free_number(3 * mesh.n_nodes(), -1)
      {
        // the unknowns of K: what no boundary condition fixes
        for (unsigned int dof = 0; dof < free_number.size(); ++dof)
          if (!mesh.is_tied(dof / 3) && !mesh.is_fixed(dof / 3, dof % 3))
            {
              free_number[dof] = free_dofs.size();
              free_dofs.push_back(dof);
            }
        // the pattern of K, which is made once; a column of a quadratic
        // contact layer has some 100 entries
        tangent.resize(free_dofs.size(), free_dofs.size());
        tangent.reserve(Eigen::VectorXi::Constant(free_dofs.size(), 100));
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            const unsigned int n = 3 * cells.n_nodes(cell);
            add_to_tangent(cell, Eigen::MatrixXd::Zero(n, n));
          }
        tangent.makeCompressed();
      }

      // c: the free components of these control points. Three numberings meet
      // here: degrees of freedom 3 node + component, free ones, and unknowns.
      std::vector<unsigned int>
      set_contact(const std::vector<bool> &control_points) override
      {
        std::vector<unsigned int> dofs;
        contact.clear();
        for (unsigned int A = 0; A < control_points.size(); ++A)
          for (unsigned int c = 0; c < 3; ++c)
            {
              const unsigned int dof = 3 * mesh.control_point_node(A) + c;
              if (control_points[A] && free_number[dof] >= 0)
                {
                  dofs.push_back(dof);
                  contact.push_back(free_number[dof]);
                }
            }
        return dofs;
      }

      // Assembles the lower triangle of K from the cells' tangents and
      // condenses it, in another object: a K that is not positive definite
      // leaves the old one as it is.
      bool
      linearise(const Eigen::VectorXd &v) override
      {
        tangent.coeffs().setZero();
        Eigen::MatrixXd K;
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            cells.tangent(cell, v, K);
            add_to_tangent(cell, K);
          }
        Condensation attempt;
        if (!attempt.factorise(tangent, contact))
          return false;
        condensation = std::move(attempt);
        return true;
      }

      Eigen::VectorXd
      product(const Eigen::VectorXd &x) const override
      {
        return condensation.schur_product(x);
      }
      Eigen::VectorXd
      solve(const Eigen::VectorXd &b) const override
      {
        return condensation.schur_solve(b);
      }
      bool
      is_dense() const override
      {
        return true;
      }
      Eigen::MatrixXd
      dense_stiffness() const override
      {
        return condensation.schur_complement();
      }

      // r_c - K_ci K_ii^-1 r_i, the forward half of a solve with K.
      Bulk::Residual
      condense(const Eigen::VectorXd &r) const override
      {
        const Eigen::VectorXd free  = r(free_dofs);
        auto                  parts = condensation.forward(free);
        return {std::move(parts.condensed),
                std::move(parts.interior),
                free.squaredNorm(),
                free.squaredNorm() - free(contact).squaredNorm()};
      }

      // The other half. backward() solves K_ii x_i = r_i - K_ic x_c; with x =
      // -dv this is what a correction is to fulfil.
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv_c, const Residual &r) const override
      {
        Eigen::VectorXd dv = Eigen::VectorXd::Zero(free_number.size());
        dv(free_dofs)      = -condensation.backward(-dv_c, r.interior);
        return dv;
      }

      bool
      internal_forces(const Eigen::VectorXd &v,
                      Eigen::VectorXd       &force,
                      double                &energy) const override
      {
        return cells.internal_forces(v, force, energy);
      }

      // K x cell by cell, with the rows of the supports, which the factorised K
      // does not have. Cells that x leaves at rest, and that is most of them,
      // are passed over.
      Eigen::MatrixXd
      product_at_rest(const Eigen::MatrixXd &x) const override
      {
        const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(x.rows());
        Eigen::MatrixXd       y = Eigen::MatrixXd::Zero(x.rows(), x.cols()), K;
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            const unsigned int n = cells.n_nodes(cell);
            Eigen::MatrixXd    x_cell(3 * n, x.cols());
            for (unsigned int a = 0; a < n; ++a)
              x_cell.middleRows<3>(3 * a) =
                x.middleRows<3>(3 * cells.nodes(cell)[a]);
            if (x_cell.isZero(0.))
              continue;
            cells.tangent(cell, at_rest, K);
            const Eigen::MatrixXd y_cell = K * x_cell;
            for (unsigned int a = 0; a < n; ++a)
              y.middleRows<3>(3 * cells.nodes(cell)[a]) +=
                y_cell.middleRows<3>(3 * a);
          }
        return y;
      }

      // From the Gauss points to the corners of each cell, and there the mean
      // over the cells.
      std::vector<Eigen::Matrix3d>
      vertex_stress(const Eigen::VectorXd &v,
                    const StressLaw        law) const override
      {
        std::vector<Eigen::Matrix3d> stress(mesh.n_vertices(),
                                            Eigen::Matrix3d::Zero());
        std::vector<unsigned int>    n_cells(mesh.n_vertices(), 0);
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            double H[EnrichedCells::n_q][3][3];
            cells.displacement_gradients(cell, v, H);
            std::array<Eigen::Matrix3d, EnrichedCells::n_q> at_points;
            for (unsigned int q = 0; q < EnrichedCells::n_q; ++q)
              at_points[q] = (cells.material().*law)(H[q]);
            for (unsigned int a = 0; a < n_corners; ++a)
              {
                const unsigned int vertex = mesh.cells()[cell].vertices[a];
                const auto         weight = extrapolation_weights(a);
                for (unsigned int q = 0; q < EnrichedCells::n_q; ++q)
                  stress[vertex] += weight[q] * at_points[q];
                ++n_cells[vertex];
              }
          }
        for (unsigned int vertex = 0; vertex < mesh.n_vertices(); ++vertex)
          stress[vertex] /= n_cells[vertex];
        return stress;
      }

    private:
      /** Adds the free part of what one cell contributes. */
      void
      add_to_tangent(const unsigned int cell, const Eigen::MatrixXd &K)
      {
        std::vector<int> numbers; // -1: fixed
        for (unsigned int a = 0; a < cells.n_nodes(cell); ++a)
          for (unsigned int c = 0; c < 3; ++c)
            numbers.push_back(free_number[3 * cells.nodes(cell)[a] + c]);
        for (unsigned int j = 0; j < numbers.size(); ++j)
          for (unsigned int i = 0; i < numbers.size(); ++i)
            if (numbers[j] >= 0 && numbers[i] >= numbers[j])
              tangent.coeffRef(numbers[i], numbers[j]) += K(i, j);
      }

      const BodyMesh           &mesh;
      const EnrichedCells       cells;
      std::vector<unsigned int> free_dofs;
      std::vector<int>          free_number; ///< -1: fixed, or follows others
      std::vector<int>          contact;     ///< free numbers of the unknowns
      SymmetricSparseMatrix     tangent;
      Condensation              condensation;
    };
  } // namespace



  std::unique_ptr<Bulk>
  make_bulk(const BodyMesh &mesh)
  {
    return std::make_unique<CondensedBulk>(
      mesh,
      NeoHookean::from_young(mesh.parameters().young_modulus,
                             mesh.parameters().poisson_ratio));
  }
} // namespace Debond
