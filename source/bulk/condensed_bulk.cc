#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/condensation.h>
#include <debond/bulk/dof_classes.h>

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
//   number    of a motion of free ones in its block: rows of the blocks of K;
//   unknown   those of control points that contact can reach.
namespace Debond
{
  namespace
  {
    class CondensedBulk : public CondensingBulk
    {
    public:
      // Vertices of the contact face follow the control points, v_vertex =
      // sum_A N_A v_A, and belong to no cell, so that they have no row in K.
      // Fixed components have none either: supports are homogeneous in the
      // body's frame, and nothing has to be moved to the right-hand side as
      // AffineConstraints would.
      //
      // Where mesh and modulus of a body with small strains are their own
      // mirror images, K falls into blocks.
      CondensedBulk(const BodyMesh &mesh, const NeoHookean &material)
        : CondensingBulk(mesh, material)
        , is_symmetric(!mesh.parameters().has_large_strains() &&
                       cells.are_mirror_images())
      {
        if (is_symmetric)
          for (DofClass &dofs : mirror_classes_of(mesh))
            blocks.push_back({std::move(dofs), {}, {}, {}, {}, {}});
        else
          blocks.push_back({free_dofs_of(mesh), {}, {}, {}, {}, {}});
        for (Block &block : blocks)
          make_pattern(block);
      }

      // c: the free components of these control points, and of their images in
      // the mirrors. Their order here is the order of the body's part in the
      // vector of unknowns. Components that a support holds on the edge of the
      // face are no unknowns.
      std::vector<unsigned int>
      set_contact(const std::vector<bool> &control_points) override
      {
        const std::vector<bool> reached =
          is_symmetric ? with_mirror_images(mesh, control_points) :
                         control_points;
        unknowns.clear();
        for (unsigned int A = 0; A < reached.size(); ++A)
          for (unsigned int c = 0; c < 3; ++c)
            if (reached[A] && !mesh.is_fixed(mesh.control_point_node(A), c))
              unknowns.push_back(3 * mesh.control_point_node(A) + c);
        for (Block &block : blocks)
          block.condense_on(unknowns);
        return unknowns;
      }

      // Assembles K = dR/dv [N/mm] at the displacement v, block by block, from
      // the cells' tangents and condenses it. At v = 0 it is the stiffness of
      // linear elasticity with the G and Lambda of Eq. (2).
      //
      // The new factors are made in other objects: a K that is not positive
      // definite, as that of a Neo-Hookean body may be far from equilibrium,
      // leaves the old one as it is for the next attempt at the step. For the
      // moment both take memory.
      bool
      linearise(const Eigen::VectorXd &v) override
      {
        // The patterns stay, with the memory that they took: only values
        // change.
        for (Block &block : blocks)
          block.tangent.coeffs().setZero();
        Eigen::MatrixXd K;
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          if (const unsigned int n_images = n_images_of(cell))
            {
              cells.tangent(cell, v, K);
              for (Block &block : blocks)
                add_cell(cell, n_images, K, block);
            }
        // The unknowns are those of the last set_contact(): condensing is where
        // their choice takes effect.
        std::vector<Condensation> attempts(blocks.size());
        for (unsigned int k = 0; k < blocks.size(); ++k)
          if (!attempts[k].factorise(blocks[k].tangent, blocks[k].condensed))
            return false;
        for (unsigned int k = 0; k < blocks.size(); ++k)
          blocks[k].condensation = std::move(attempts[k]);
        return true;
      }

      // S x and S^-1 b: nodal forces [N] at the face that displace it by x
      // [mm], and the displacement under forces b, with the interior in
      // equilibrium.
      Eigen::VectorXd
      product(const Eigen::VectorXd &x) const override
      {
        Eigen::MatrixXd result = Eigen::MatrixXd::Zero(x.size(), 1);
        for (const Block &block : blocks)
          block.unfold(block.condensation.schur_product(block.fold(x)), result);
        return result;
      }
      Eigen::VectorXd
      solve(const Eigen::VectorXd &b) const override
      {
        Eigen::MatrixXd result = Eigen::MatrixXd::Zero(b.size(), 1);
        for (const Block &block : blocks)
          block.unfold(block.condensation.schur_solve(block.fold(b)), result);
        return result;
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
        const unsigned int n = unknowns.size();
        Eigen::MatrixXd    S = Eigen::MatrixXd::Zero(n, n);
        for (const Block &block : blocks)
          {
            const Eigen::MatrixXd part = block.condensation.schur_complement();
            for (unsigned int j = 0; j < n; ++j)
              for (unsigned int i = 0; i < n; ++i)
                if (block.unknown_number[i] >= 0 &&
                    block.unknown_number[j] >= 0)
                  S(i, j) +=
                    block.unknown_coefficient[i] *
                    block.unknown_coefficient[j] *
                    part(block.unknown_number[i], block.unknown_number[j]);
          }
        return S;
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
        Bulk::Residual  result;
        Eigen::MatrixXd condensed = Eigen::MatrixXd::Zero(unknowns.size(), 1);
        std::vector<double> interior;
        for (const Block &block : blocks)
          {
            const Eigen::VectorXd folded = block.dofs.fold(r);
            const auto            parts  = block.condensation.forward(folded);
            block.unfold(parts.condensed, condensed);
            interior.insert(interior.end(),
                            parts.interior.begin(),
                            parts.interior.end());
            result.norm_squared += folded.squaredNorm();
            result.interior_squared +=
              folded.squaredNorm() - folded(block.condensed).squaredNorm();
          }
        result.condensed = condensed;
        result.interior =
          Eigen::Map<Eigen::VectorXd>(interior.data(), interior.size());
        return result;
      }

      // The other half. backward() solves K_ii x_i = r_i - K_ic x_c; with x =
      // -dv this is what a correction is to fulfil, dv_i = -K_ii^-1 (r_i + K_ic
      // dv_c). Vertices that follow control points are left at zero here: no
      // cell asks for them (BodyMesh::distribute).
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv_c, const Residual &r) const override
      {
        Eigen::VectorXd dv    = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
        unsigned int    first = 0;
        for (const Block &block : blocks)
          {
            const unsigned int n = r.interior.size() == 0 ?
                                     0 :
                                     block.dofs.n - block.condensed.size();
            block.dofs.unfold(
              -block.condensation.backward(-block.fold(dv_c),
                                           r.interior.segment(first, n)),
              dv);
            first += n;
          }
        dv(unknowns) = dv_c; // to the last bit
        return dv;
      }

    private:
      /** A part of K that is coupled with no other. */
      struct Block
      {
        DofClass              dofs; ///< rows of the part
        SymmetricSparseMatrix tangent;
        std::vector<int>      condensed; ///< numbers of those of the unknowns
        /** Of an unknown: the number of its motion among the condensed ones,
         *  -1: none, and its coefficient. */
        std::vector<int>    unknown_number;
        std::vector<double> unknown_coefficient;
        Condensation        condensation;

        void
        condense_on(const std::vector<unsigned int> &unknowns)
        {
          condensed.clear();
          unknown_number.clear();
          unknown_coefficient.clear();
          std::vector<int> place(dofs.n, -1); // among the condensed ones
          for (const unsigned int dof : unknowns)
            {
              const int number = dofs.number[dof];
              if (number >= 0 && place[number] < 0)
                {
                  place[number] = condensed.size();
                  condensed.push_back(number);
                }
              unknown_number.push_back(number >= 0 ? place[number] : -1);
              unknown_coefficient.push_back(dofs.coefficient[dof]);
            }
        }

        /** As DofClass, for columns over the unknowns. */
        Eigen::MatrixXd
        fold(const Eigen::MatrixXd &x) const
        {
          Eigen::MatrixXd y = Eigen::MatrixXd::Zero(condensed.size(), x.cols());
          for (unsigned int k = 0; k < unknown_number.size(); ++k)
            if (unknown_number[k] >= 0)
              y.row(unknown_number[k]) += unknown_coefficient[k] * x.row(k);
          return y;
        }
        void
        unfold(const Eigen::MatrixXd &y, Eigen::MatrixXd &x) const
        {
          for (unsigned int k = 0; k < unknown_number.size(); ++k)
            if (unknown_number[k] >= 0)
              x.row(k) += unknown_coefficient[k] * y.row(unknown_number[k]);
        }
      };

      unsigned int
      n_images_of(const unsigned int cell) const
      {
        return is_symmetric ? n_mirror_images(mesh, mesh.cells()[cell]) : 1;
      }

      /** Numbers in a block, ascending, of a cell's degrees of freedom, with
       *  the number in the cell. */
      std::vector<std::pair<int, int>>
      numbers_in(const Block &block, const unsigned int cell) const
      {
        std::vector<std::pair<int, int>> numbers;
        for (unsigned int i = 0; i < 3 * cells.n_nodes(cell); ++i)
          {
            const int number =
              block.dofs.number[3 * cells.nodes(cell)[i / 3] + i % 3];
            if (number >= 0)
              numbers.emplace_back(number, i);
          }
        std::sort(numbers.begin(), numbers.end());
        return numbers;
      }

      // The pattern of K, which is made once. Cells couple all their degrees of
      // freedom with each other; the lower triangle is stored, column by
      // column, as CHOLMOD wants it. Rows of the pattern are columns of K:
      // entry (j, i), i >= j, is put into row j.
      void
      make_pattern(Block &block) const
      {
        dealii::DynamicSparsityPattern pattern(block.dofs.n);
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            if (n_images_of(cell) == 0)
              continue;
            std::vector<dealii::types::global_dof_index> numbers;
            for (const auto &number : numbers_in(block, cell))
              numbers.push_back(number.first);
            numbers.erase(std::unique(numbers.begin(), numbers.end()),
                          numbers.end());
            for (auto i = numbers.begin(); i != numbers.end(); ++i)
              pattern.add_entries(*i, i, numbers.end(), true);
          }
        // The same as Eigen's matrix, with zeros that stay in the pattern, so
        // that add_cell() finds all that it adds to.
        SymmetricSparseMatrix &K = block.tangent;
        K.resize(block.dofs.n, block.dofs.n);
        K.reserve(pattern.n_nonzero_elements());
        for (int column = 0; column < K.cols(); ++column)
          {
            K.startVec(column);
            for (unsigned int k = 0; k < pattern.row_length(column); ++k)
              K.insertBack(pattern.column_number(column, k), column) = 0.;
          }
        K.finalize();
      }

      // The cell's K is full and symmetric. Rows of fixed components are left
      // out, and of each pair of equal entries the one below the diagonal of
      // the block is taken. Beside a mirror two nodes of a cell may be images
      // of each other and have one number.
      void
      add_cell(const unsigned int     cell,
               const unsigned int     n_images,
               const Eigen::MatrixXd &K,
               Block                 &block) const
      {
        const auto numbers     = numbers_in(block, cell);
        const auto coefficient = [&](const int i) {
          return block.dofs.coefficient[3 * cells.nodes(cell)[i / 3] + i % 3];
        };
        const int *rows   = block.tangent.innerIndexPtr();
        double    *values = block.tangent.valuePtr();
        for (auto j = numbers.begin(); j != numbers.end(); ++j)
          {
            // rows of the column and of the cell ascend
            const double weight = n_images * coefficient(j->second);
            int          at     = block.tangent.outerIndexPtr()[j->first];
            for (auto i = j; i != numbers.end(); ++i)
              {
                while (rows[at] < i->first)
                  ++at;
                const bool twice = i != j && i->first == j->first;
                values[at] += (twice ? 2. : 1.) * weight *
                              coefficient(i->second) * K(i->second, j->second);
              }
          }
      }

      const bool                is_symmetric; ///< to both mirrors
      std::vector<Block>        blocks;
      std::vector<unsigned int> unknowns; ///< degrees of freedom
    };
  } // namespace



  std::unique_ptr<CondensingBulk>
  make_condensed_bulk(const BodyMesh &mesh, const NeoHookean &material)
  {
    return std::make_unique<CondensedBulk>(mesh, material);
  }
} // namespace Debond
