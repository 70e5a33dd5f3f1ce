#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/condensation.h>
#include <debond/bulk/mirror_symmetry.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <utility>

// The bulk of a body that deforms: hexahedra with a NURBS face (Corbett and
// Sauer, Eqs. (33) to (35) of the paper), their stiffness K as a sparse matrix,
// and its condensation on the contact face.
//
// It is deal.II's setup_system and assemble_system for one body, with two
// differences. Cells that touch the contact face have functions that FEValues
// does not know, so that EnrichedCells keeps all gradients. And K is assembled
// seldom: for a linear body once, unless contact spreads, and for a Neo-Hookean
// one also when the tangent at hand has become a poor one. What happens in
// every iteration is products and solves with what has been condensed, and for
// a Neo-Hookean body its internal forces.
//
// Three numberings of degrees of freedom meet here:
//
//   dof       3 node + component, control points after vertices;
//   number    of a motion of free ones in its block: rows of what is
//   factorised; unknown   those of control points that contact can reach.
namespace Debond
{
  namespace
  {
    class CondensedBulk : public CondensingBulk
    {
    public:
      // Nodes of FE_Q on the contact face follow the control points, and what
      // supports hold stays zero: the AffineConstraints of the space, so that
      // neither is an unknown. Where a body with small strains is its own
      // mirror image, more of them make images follow each other, in four
      // ways, and K falls into four blocks that know nothing of each other.
      CondensedBulk(const BulkSpace &mesh, EnrichedCells &&cells_of_mesh)
        : CondensingBulk(mesh, std::move(cells_of_mesh))
        , symmetry(mesh.parameters().has_large_strains() ?
                     std::nullopt :
                     MirrorSymmetry::of(mesh, cells))
      {
        if (!symmetry)
          add_block(mesh.constraints());
        else
          for (const double along_x : {1., -1.})
            for (const double along_y : {1., -1.})
              add_block(symmetry->constraints(mesh, {{along_x, along_y}}));
      }

      // c: the free components of these control points, and of their images in
      // the mirrors. Their order here is the order of the body's part in the
      // vector of unknowns. Components that a support holds on the edge of the
      // face are no unknowns.
      std::vector<unsigned int>
      set_contact(const std::vector<bool> &control_points) override
      {
        const std::vector<bool> reached =
          symmetry ? symmetry->with_images(mesh, control_points) :
                     control_points;
        unknowns.clear();
        for (unsigned int A = 0; A < reached.size(); ++A)
          for (unsigned int c = 0; c < 3; ++c)
            if (reached[A] && !mesh.is_fixed(mesh.control_point_node(A), c))
              unknowns.push_back(3 * mesh.control_point_node(A) + c);
        for (const auto &block : blocks)
          block->condense_on(unknowns);
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
        // The patterns stay; values are needed until CHOLMOD has them.
        for (const auto &block : blocks)
          block->K.reinit(block->pattern);
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          if (const unsigned int n_images = n_images_of(cell))
            {
              const auto dofs = dofs_of(cell);
              auto       K    = stiffness_of(cell, v);
              K *= n_images;
              for (const auto &block : blocks)
                block->constraints.distribute_local_to_global(K,
                                                              dofs,
                                                              block->K);
            }
        // The unknowns are those of the last set_contact(): condensing is where
        // their choice takes effect.
        std::vector<Condensation> attempts(blocks.size());
        for (unsigned int k = 0; k < blocks.size(); ++k)
          {
            const SymmetricSparseMatrix lower = blocks[k]->lower_triangle();
            blocks[k]->K.clear();
            if (!attempts[k].factorise(lower, blocks[k]->condensed))
              return false;
          }
        for (unsigned int k = 0; k < blocks.size(); ++k)
          blocks[k]->condensation = std::move(attempts[k]);
        return true;
      }

      // S x and S^-1 b: nodal forces [N] at the face that displace it by x
      // [mm], and the displacement under forces b, with the interior in
      // equilibrium.
      Eigen::VectorXd
      product(const Eigen::VectorXd &x) const override
      {
        Eigen::VectorXd result = Eigen::VectorXd::Zero(x.size());
        for (const auto &block : blocks)
          block->unknowns.unfold(
            block->condensation.schur_product(block->unknowns.fold(x)), result);
        return result;
      }
      Eigen::VectorXd
      solve(const Eigen::VectorXd &b) const override
      {
        Eigen::VectorXd result = Eigen::VectorXd::Zero(b.size());
        for (const auto &block : blocks)
          block->unknowns.unfold(
            block->condensation.schur_solve(block->unknowns.fold(b)), result);
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
        for (const auto &block : blocks)
          {
            const Eigen::MatrixXd part = block->condensation.schur_complement();
            const auto &[n_parts, number, coefficient] = block->unknowns;
            for (unsigned int j = 0; j < n; ++j)
              for (unsigned int i = 0; i < n; ++i)
                if (number[i] >= 0 && number[j] >= 0)
                  S(i, j) += coefficient[i] * coefficient[j] *
                             part(number[i], number[j]);
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
        Bulk::Residual result;
        result.condensed.setZero(unknowns.size());
        std::vector<double> interior;
        for (const auto &block : blocks)
          {
            const Eigen::VectorXd folded = block->dofs.fold(r);
            const auto            parts  = block->condensation.forward(folded);
            block->unknowns.unfold(parts.condensed, result.condensed);
            interior.insert(interior.end(),
                            parts.interior.begin(),
                            parts.interior.end());
            result.norm_squared += folded.squaredNorm();
            result.interior_squared +=
              folded.squaredNorm() - folded(block->condensed).squaredNorm();
          }
        result.interior =
          Eigen::Map<Eigen::VectorXd>(interior.data(), interior.size());
        return result;
      }

      // The other half. backward() solves K_ii x_i = r_i - K_ic x_c; with x =
      // -dv this is what a correction is to fulfil, dv_i = -K_ii^-1 (r_i + K_ic
      // dv_c). Vertices that follow control points are left at zero here: no
      // cell asks for them (BulkSpace::distribute).
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv_c, const Residual &r) const override
      {
        Eigen::VectorXd dv    = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
        unsigned int    first = 0;
        for (const auto &block : blocks)
          {
            const unsigned int n = r.interior.size() == 0 ?
                                     0 :
                                     block->dofs.n - block->condensed.size();
            block->dofs.unfold(
              -block->condensation.backward(-block->unknowns.fold(dv_c),
                                            r.interior.segment(first, n)),
              dv);
            first += n;
          }
        dv(unknowns) = dv_c; // to the last bit
        if (mesh.cells_have_followers())
          mesh.distribute(dv);
        return dv;
      }

    private:
      /** A part of K that is coupled with no other. */
      struct Block
      {
        const dealii::AffineConstraints<double> constraints;
        const DofClass                          dofs; ///< what these leave
        dealii::SparsityPattern                 pattern;
        dealii::SparseMatrix<double>            K;
        std::vector<int> condensed; ///< numbers of those of the unknowns
        /** These motions over the unknowns instead of degrees of freedom. */
        DofClass     unknowns;
        Condensation condensation;

        Block(const BulkSpace                         &space,
              const dealii::AffineConstraints<double> &constraints)
          : constraints(constraints)
          , dofs(space, constraints)
        {}

        // K without the rows of what is constrained, and motions of norm 1:
        // what CHOLMOD wants. Numbers ascend with those of degrees of freedom,
        // and deal.II's rows do, but for the diagonal, which comes first.
        SymmetricSparseMatrix
        lower_triangle() const
        {
          SymmetricSparseMatrix result(dofs.n, dofs.n);
          result.reserve((K.n_nonzero_elements() + dofs.n) / 2);
          for (unsigned int j = 0; j < K.m(); ++j)
            if (!constraints.is_constrained(j))
              {
                const int column = dofs.number[j];
                result.startVec(column);
                for (auto entry = K.begin(j); entry != K.end(j); ++entry)
                  if (const unsigned int i = entry->column();
                      i >= j && !constraints.is_constrained(i))
                    result.insertBack(dofs.number[i], column) =
                      dofs.coefficient[i] * dofs.coefficient[j] *
                      entry->value();
              }
          result.finalize();
          return result;
        }

        void
        condense_on(const std::vector<unsigned int> &unknown_dofs)
        {
          condensed.clear();
          unknowns = DofClass();
          std::vector<int> place(dofs.n, -1); // among the condensed ones
          for (const unsigned int dof : unknown_dofs)
            {
              const int number = dofs.number[dof];
              if (number >= 0 && place[number] < 0)
                {
                  place[number] = condensed.size();
                  condensed.push_back(number);
                }
              unknowns.number.push_back(number >= 0 ? place[number] : -1);
              unknowns.coefficient.push_back(dofs.coefficient[dof]);
            }
          unknowns.n = condensed.size();
        }
      };

      unsigned int
      n_images_of(const unsigned int cell) const
      {
        return symmetry ? symmetry->n_images(cell) : 1;
      }

      // The pattern of K, which is made once.
      void
      add_block(const dealii::AffineConstraints<double> &constraints)
      {
        blocks.push_back(std::make_unique<Block>(mesh, constraints));
        Block                         &block = *blocks.back();
        dealii::DynamicSparsityPattern pattern(3 * mesh.n_nodes());
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          if (n_images_of(cell) > 0)
            constraints.add_entries_local_to_global(dofs_of(cell),
                                                    pattern,
                                                    false);
        block.pattern.copy_from(pattern);
      }

      const std::optional<MirrorSymmetry> symmetry; ///< of small strains
      std::vector<std::unique_ptr<Block>> blocks;
      std::vector<unsigned int>           unknowns; ///< degrees of freedom
    };
  } // namespace



  std::unique_ptr<CondensingBulk>
  make_condensed_bulk(const BulkSpace &mesh, EnrichedCells &&cells)
  {
    return std::make_unique<CondensedBulk>(mesh, std::move(cells));
  }
} // namespace Debond
