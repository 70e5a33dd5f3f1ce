#include <debond/bulk/bulk.h>
#include <debond/bulk/condensation.h>
#include <debond/bulk/enriched_cells.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <utility>

// The bulk of a body that deforms: hexahedra with a NURBS face (Corbett and
// Sauer, Eqs. (33) to (35) of the paper), their stiffness K as a sparse matrix,
// and its condensation on the contact face.
//
// It is deal.II's system_setup and assemble_system for one body, with two
// differences. The cells have 13 nodes where they touch the contact face, so
// FEValues cannot describe them and EnrichedCells does. And K is assembled
// seldom: for a linear body once, unless contact spreads, and for a Neo-Hookean
// one also when the tangent at hand has become a poor one. What happens in
// every iteration is products and solves with what has been condensed, and for
// a Neo-Hookean body its internal forces.
//
// Three numberings of degrees of freedom meet here:
//
//   dof       3 node + component, control points after vertices;
//   free      those that no boundary condition fixes: rows of K;
//   unknown   those of control points that contact can reach: rows of S.
namespace Debond
{
  namespace
  {
    /**
     * NURBS-enriched hexahedra whose stiffness is factorised by sparse Cholesky
     * and condensed on the degrees of freedom that contact can reach. A linear
     * body uses it as a spring of many degrees of freedom, a Neo-Hookean one
     * as an approximate inverse beside its true internal forces.
     */
    class CondensedBulk : public Bulk
    {
    public:
      // Vertices of the contact face follow the control points, v_vertex =
      // sum_A N_A v_A, and belong to no cell, so that they have no row in K.
      // Fixed components have none either: supports are homogeneous in the
      // body's frame, and nothing has to be moved to the right-hand side as
      // AffineConstraints would.
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
        // The pattern of K, which is made once. Cells couple all their degrees
        // of freedom with each other; the lower triangle is stored, column by
        // column, as CHOLMOD wants it. Rows of the pattern are columns of K:
        // entry (j, i), i >= j, is put into row j.
        dealii::DynamicSparsityPattern pattern(free_dofs.size());
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            std::vector<dealii::types::global_dof_index> numbers;
            for (const auto &number : free_numbers(cell))
              numbers.push_back(number.first);
            for (auto i = numbers.begin(); i != numbers.end(); ++i)
              pattern.add_entries(*i, i, numbers.end(), true);
          }
        // The same as Eigen's matrix, with zeros that stay in the pattern, so
        // that linearise() finds all that it adds to.
        tangent.resize(free_dofs.size(), free_dofs.size());
        tangent.reserve(pattern.n_nonzero_elements());
        for (int column = 0; column < tangent.cols(); ++column)
          {
            tangent.startVec(column);
            for (unsigned int k = 0; k < pattern.row_length(column); ++k)
              tangent.insertBack(pattern.column_number(column, k), column) = 0.;
          }
        tangent.finalize();
      }

      // c: the free components of these control points. Their order here is the
      // order of the rows of S, and of the body's part in the vector of
      // unknowns. Components that a support holds on the edge of the face are
      // no unknowns.
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

      // Assembles the lower triangle of K = dR/dv [N/mm] at the displacement v
      // from the cells' tangents and condenses it. At v = 0 it is the stiffness
      // of linear elasticity with the G and Lambda of Eq. (2).
      //
      // The new factor is made in another object: a K that is not positive
      // definite, as that of a Neo-Hookean body may be far from equilibrium,
      // leaves the old one as it is for the next attempt at the step. For the
      // moment both take memory.
      bool
      linearise(const Eigen::VectorXd &v) override
      {
        // The pattern stays, with the memory that it took: only values change.
        tangent.coeffs().setZero();
        Eigen::MatrixXd K;
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            // The cell's K is full and symmetric. Rows of fixed components are
            // left out, and of each pair of equal entries the one below the
            // diagonal of the whole matrix is taken.
            const auto numbers = free_numbers(cell);
            cells.tangent(cell, v, K);
            for (auto column = numbers.begin(); column != numbers.end();
                 ++column)
              {
                // rows of the column and of the cell ascend
                const int *row = tangent.innerIndexPtr() +
                                 tangent.outerIndexPtr()[column->first];
                for (auto i = column; i != numbers.end(); ++i)
                  {
                    while (*row < i->first)
                      ++row;
                    tangent.valuePtr()[row - tangent.innerIndexPtr()] +=
                      K(i->second, column->second);
                  }
              }
          }
        // The unknowns are those of the last set_contact(): condensing is where
        // their choice takes effect.
        Condensation attempt;
        if (!attempt.factorise(tangent, contact))
          return false;
        condensation = std::move(attempt);
        return true;
      }

      // S x and S^-1 b: nodal forces [N] at the face that displace it by x
      // [mm], and the displacement under forces b, with the interior in
      // equilibrium.
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
      Eigen::MatrixXd
      solve_all(const Eigen::MatrixXd &B) const override
      {
        return condensation.schur_solve_all(B);
      }
      // A condensed bulk couples every unknown with every other one. It has S
      // as a matrix, if at the price of n_c^3 work.
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

      // r_c - K_ci K_ii^-1 r_i, the forward half of a solve with K. r is a
      // vector over all nodes; what stands in its fixed components are
      // reactions of the supports, which are no residual. The norms are those
      // of the full vector and of its interior part [N^2], by which Newton's
      // method judges the state.
      Bulk::Residual
      condense(const Eigen::VectorXd &r) const override
      {
        // Tied vertices have no entry of their own: their forces have gone to
        // the control points, as cells know no other nodes on that face.
        const Eigen::VectorXd free  = r(free_dofs);
        auto                  parts = condensation.forward(free);
        return {std::move(parts.condensed),
                std::move(parts.interior),
                free.squaredNorm(),
                free.squaredNorm() - free(contact).squaredNorm()};
      }

      // The other half. backward() solves K_ii x_i = r_i - K_ic x_c; with x =
      // -dv this is what a correction is to fulfil, dv_i = -K_ii^-1 (r_i + K_ic
      // dv_c). Vertices that follow control points are left at zero here: no
      // cell asks for them (BodyMesh::distribute).
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv_c, const Residual &r) const override
      {
        Eigen::VectorXd dv = Eigen::VectorXd::Zero(free_number.size());
        dv(free_dofs)      = -condensation.backward(-dv_c, r.interior);
        return dv;
      }

      // R = int P : dF/dv dV by the true Neo-Hookean law, Eq. (1), cell by cell
      // and without K.
      bool
      internal_forces(const Eigen::VectorXd &v,
                      Eigen::VectorXd       &force,
                      double                &energy) const override
      {
        return cells.internal_forces(v, force, energy);
      }

      // K x cell by cell, with the rows of the supports, which the factorised K
      // does not have: from them a linear body has the reactions of its
      // supports. Cells that x leaves at rest, and that is most of them, are
      // passed over: x are rigid motions of the supported nodes only. A second
      // matrix with the rows of the supports would have to be kept for six
      // products.
      Eigen::MatrixXd
      product_at_rest(const Eigen::MatrixXd &x) const override
      {
        const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(x.rows());
        Eigen::MatrixXd       y = Eigen::MatrixXd::Zero(x.rows(), x.cols()), K;
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            // Gather, multiply, scatter, as in a matrix-free operator.
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

      // Cauchy stress [MPa] for pictures: from the Gauss points, where it is
      // most accurate, to the corners of each cell, and there the mean over the
      // cells. The trilinear extrapolation through the 2x2x2 points evaluates
      // no gradient at a corner, where the disk's parametrisation is singular.
      // It is not continuous from cell to cell; the mean hides that, so it is
      // no measure of the error.
      std::vector<Eigen::Matrix3d>
      vertex_stress(const Eigen::VectorXd &v,
                    const StressLaw        law) const override
      {
        std::vector<Eigen::Matrix3d> stress(mesh.n_vertices(),
                                            Eigen::Matrix3d::Zero());
        std::vector<unsigned int>    n_cells(mesh.n_vertices(), 0);
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            // H = dv/dX in the body's frame, and by the material's law the
            // stress.
            double H[EnrichedCells::n_q][3][3];
            cells.displacement_gradients(cell, v, H);
            std::array<Eigen::Matrix3d, EnrichedCells::n_q> at_points;
            for (unsigned int q = 0; q < EnrichedCells::n_q; ++q)
              at_points[q] = (cells.material().*law)(H[q]);
            for (unsigned int a = 0; a < n_corners; ++a)
              {
                // The weights are those of the trilinear polynomial through the
                // eight points, at corner a. Vertices of the contact face are
                // corners as any other here: pictures show the mesh, not the
                // control points.
                const unsigned int vertex = mesh.cells()[cell].vertices[a];
                const auto         weight = extrapolation_weights(a);
                for (unsigned int q = 0; q < EnrichedCells::n_q; ++q)
                  stress[vertex] += weight[q] * at_points[q];
                ++n_cells[vertex];
              }
          }
        // Every cell counts the same, whatever its volume; each vertex has at
        // least one.
        for (unsigned int vertex = 0; vertex < mesh.n_vertices(); ++vertex)
          stress[vertex] /= n_cells[vertex];
        return stress;
      }

    private:
      /** Those of a cell's degrees of freedom that are free, in ascending
       *  order: the number among all free ones and that in the cell. */
      std::vector<std::pair<int, int>>
      free_numbers(const unsigned int cell) const
      {
        std::vector<std::pair<int, int>> numbers;
        for (unsigned int i = 0; i < 3 * cells.n_nodes(cell); ++i)
          {
            const int number =
              free_number[3 * cells.nodes(cell)[i / 3] + i % 3];
            if (number >= 0)
              numbers.emplace_back(number, i);
          }
        std::sort(numbers.begin(), numbers.end());
        return numbers;
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



  // G and Lambda [MPa] from E and nu by Eq. (2). Other elements, or a solver
  // for bodies whose S would be too large to store, get their place here;
  // is_dense() tells the solver then that it has to do with products.
  std::unique_ptr<Bulk>
  make_bulk(const BodyMesh &mesh)
  {
    return std::make_unique<CondensedBulk>(
      mesh,
      NeoHookean::from_young(mesh.parameters().young_modulus,
                             mesh.parameters().poisson_ratio));
  }
} // namespace Debond
