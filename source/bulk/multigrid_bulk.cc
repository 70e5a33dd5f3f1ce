#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/whole_bulk.h>
#include <debond/support/ranks.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Eigen/Geometry>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>
#include <ml_MultiLevelPreconditioner.h>

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>

// A bulk of any size, of any modulus and on any number of ranks: step-40's
// matrix of Trilinos and its algebraic multigrid, ML, for elasticity.
//
// Smoothed aggregation needs to know what a stiffness leaves at rest: the six
// rigid motions, without which the number of iterations triples. Unknowns are
// interleaved node by node, and fixed ones stay as rows of their own, so that
// all nodes have three.
namespace Debond
{
  Bulk::Residual
  WholeBulk::whole_residual(Eigen::VectorXd owned) const
  {
    Residual        result;
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(unknowns.size() + 1);
    put_unknowns(owned.data(), sums.data());
    sums[unknowns.size()] = owned.squaredNorm();
    Ranks::add_up(sums);
    result.condensed    = sums.head(unknowns.size());
    result.norm_squared = sums[unknowns.size()];
    result.interior_squared =
      std::max(0., result.norm_squared - result.condensed.squaredNorm());
    result.interior = std::move(owned);
    return result;
  }



  bool
  WholeBulk::internal_forces(const Eigen::VectorXd &v,
                             Eigen::VectorXd       &force,
                             double                &energy) const
  {
    const bool is_valid = Bulk::internal_forces(v, force, energy);
    double     sums[]{is_valid ? energy : 0., is_valid ? 0. : 1.};
    Ranks::add_up(sums, 2);
    energy = sums[0];
    return sums[1] == 0.;
  }



  // For pictures: a vertex at the border of two parts has cells in both.
  void
  WholeBulk::add_up_at_vertices(std::vector<Eigen::Matrix3d> &stress,
                                std::vector<double>          &n_cells) const
  {
    Ranks::add_up(stress.front().data(), 9 * stress.size());
    Ranks::add_up(n_cells.data(), n_cells.size());
  }



  namespace
  {
    class MultigridBulk : public WholeBulk
    {
    public:
      MultigridBulk(const BulkSpace &mesh, EnrichedCells &&cells_of_mesh)
        : WholeBulk(mesh, std::move(cells_of_mesh))
        , rows(3 * mesh.n_nodes())
      {
        for (const auto node : mesh.owned_nodes())
          for (unsigned int c = 0; c < 3; ++c)
            owned_dofs.push_back(3 * node + c);
        rows.add_indices(owned_dofs.begin(), owned_dofs.end());
        rows.compress();
      }

      // Those that this rank owns are known to the others by their places in
      // the list, which is the same everywhere.
      std::vector<unsigned int>
      set_contact(const std::vector<bool> &control_points) override
      {
        unknowns.clear();
        owned_unknowns.clear();
        for (unsigned int A = 0; A < control_points.size(); ++A)
          for (unsigned int c = 0; c < 3; ++c)
            {
              const unsigned int node = mesh.control_point_node(A);
              if (!control_points[A] || mesh.is_fixed(node, c))
                continue;
              if (rows.is_element(3 * node + c))
                owned_unknowns.emplace_back(unknowns.size(),
                                            rows.index_within_set(3 * node +
                                                                  c));
              unknowns.push_back(3 * node + c);
            }
        return unknowns;
      }

      // K does not depend on what is in contact. Multigrid is set up anew with
      // it, which takes longer than K itself.
      bool
      linearise(const Eigen::VectorXd &v) override
      {
        const bool is_new =
          v.size() != linearised_at.size() || v != linearised_at;
        if (Ranks::sum(is_new) == 0.)
          return true;
        assemble(v);
        if (!has_positive_diagonal())
          {
            if (linearised_at.size() > 0)
              assemble(linearised_at);
            return false;
          }
        set_up_multigrid();
        linearised_at = v;
        return true;
      }

      unsigned int
      n_owned() const override
      {
        return owned_dofs.size();
      }

      Eigen::VectorXd
      assembled(Eigen::VectorXd nodes) const override
      {
        Ranks::add_up(nodes);
        return owned_of(nodes);
      }

      Eigen::VectorXd
      at_nodes(const Eigen::VectorXd &owned) const override
      {
        Eigen::VectorXd nodes = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
        nodes(owned_dofs)     = owned;
        Ranks::add_up(nodes);
        mesh.distribute(nodes);
        return nodes;
      }

      Eigen::VectorXd
      owned_of(const Eigen::VectorXd &nodes) const override
      {
        Eigen::VectorXd owned(n_owned());
        for (unsigned int k = 0; k < owned.size(); ++k)
          owned[k] = mesh.constraints().is_constrained(owned_dofs[k]) ?
                       0. :
                       nodes[owned_dofs[k]];
        return owned;
      }

      void
      put_unknowns(const double *const owned,
                   double *const       values) const override
      {
        for (const auto &[unknown, place] : owned_unknowns)
          values[unknown] = owned[place];
      }

      void
      add_unknowns(const double *const values,
                   double *const       owned) const override
      {
        for (const auto &[unknown, place] : owned_unknowns)
          owned[place] += values[unknown];
      }

      void
      multiply(const double *const x, double *const y) const override
      {
        Epetra_Vector out = view(y);
        K.trilinos_matrix().Multiply(false, view(x), out);
      }

      void
      cycle(const double *const x, double *const y) const override
      {
        Epetra_Vector out = view(y);
        multigrid->ApplyInverse(view(x), out);
      }

    private:
      Epetra_Vector
      view(const double *const x) const
      {
        return Epetra_Vector(View,
                             K.trilinos_matrix().RowMap(),
                             const_cast<double *>(x));
      }

      // Nodes that follow others mostly have no cell, and a diagonal of their
      // own all the same.
      void
      make_pattern()
      {
        const dealii::types::global_dof_index n = 3 * mesh.n_nodes();
        dealii::DynamicSparsityPattern        pattern(n);
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          mesh.constraints().add_entries_local_to_global(dofs_of(cell),
                                                         pattern,
                                                         false);
        for (const auto dof : owned_dofs)
          pattern.add(dof, dof);
        dealii::SparsityTools::distribute_sparsity_pattern(
          pattern, rows, Ranks::communicator(), dealii::complete_index_set(n));
        K.reinit(rows, rows, pattern, Ranks::communicator());
      }

      // Constrained degrees of freedom keep an entry of their own, so that ML
      // meets nothing unusual.
      void
      assemble(const Eigen::VectorXd &v)
      {
        if (K.m() == 0)
          make_pattern();
        K = 0.;
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          mesh.constraints().distribute_local_to_global(stiffness_of(cell, v),
                                                        dofs_of(cell),
                                                        K);
        K.compress(dealii::VectorOperation::add);
        for (const auto dof : owned_dofs)
          if (mesh.is_tied(dof / 3) && K.diag_element(dof) == 0.)
            K.set(dof, dof, 1.);
        K.compress(dealii::VectorOperation::insert);
      }

      // All that is cheap to know; GMRES finds out the rest.
      bool
      has_positive_diagonal() const
      {
        Epetra_Vector diagonal(K.trilinos_matrix().RowMap());
        K.trilinos_matrix().ExtractDiagonalCopy(diagonal);
        double n_bad = 0.;
        for (unsigned int k = 0; k < n_owned(); ++k)
          n_bad += diagonal[k] > 0. && std::isfinite(diagonal[k]) ? 0. : 1.;
        return Ranks::sum(n_bad) == 0.;
      }

      void
      set_up_multigrid()
      {
        const unsigned int  n = n_owned();
        Epetra_MultiVector  modes(K.trilinos_matrix().RowMap(), 6);
        std::vector<double> coordinates[3];
        // To ML the nodes of other ranks are all in (0, 0, 0), and it says so
        // of one that is there itself.
        constexpr double origin = 1e3;
        for (unsigned int k = 0; k < n; ++k)
          {
            const Eigen::Vector3d &X =
              mesh.reference_position(owned_dofs[k] / 3);
            const unsigned int c = k % 3;
            modes[c][k]          = 1.;
            for (unsigned int r = 0; r < 3; ++r)
              modes[3 + r][k] = Eigen::Vector3d::Unit(r).cross(X)[c];
            if (c == 0)
              for (unsigned int d = 0; d < 3; ++d)
                coordinates[d].push_back(X[d] + origin);
          }
        Teuchos::ParameterList list;
        ML_Epetra::SetDefaults("SA", list);
        list.set("ML output", 0);
        list.set("PDE equations", 3);
        list.set("smoother: type", "Chebyshev");
        list.set("smoother: sweeps", mesh.has_splines() ? 4 : 2);
        list.set("aggregation: type", "Uncoupled");
        list.set("aggregation: threshold", 0.);
        list.set("coarse: type", "Amesos-KLU");
        list.set("coarse: max size", 2000);
        list.set("null space: type", "pre-computed");
        list.set("null space: dimension", 6);
        list.set("null space: vectors", modes.Values());
        list.set("null space: add default vectors", false);
        // Which nodes are close tells better than the entries of K which belong
        // together in flat cells. Splines have close nodes at their ends, which
        // it would leave alone.
        if (!mesh.has_splines())
          {
            list.set("aggregation: aux: enable", true);
            list.set("aggregation: aux: threshold", 0.01);
            list.set("x-coordinates", coordinates[0].data());
            list.set("y-coordinates", coordinates[1].data());
            list.set("z-coordinates", coordinates[2].data());
          }
        multigrid.reset();
        multigrid = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(
          K.trilinos_matrix(), list, true);
      }

      dealii::IndexSet                             rows;       ///< of this rank
      std::vector<dealii::types::global_dof_index> owned_dofs; ///< the same
      dealii::TrilinosWrappers::SparseMatrix       K;
      std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> multigrid;
      Eigen::VectorXd                                      linearised_at;
      /** Unknown, place among the owned. */
      std::vector<std::pair<unsigned int, unsigned int>> owned_unknowns;
    };
  } // namespace



  std::unique_ptr<WholeBulk>
  make_multigrid_bulk(const BulkSpace &mesh, EnrichedCells &&cells)
  {
    Ranks::communicator(); // begins with MPI, before anything of Trilinos
    return std::make_unique<MultigridBulk>(mesh, std::move(cells));
  }
} // namespace Debond
