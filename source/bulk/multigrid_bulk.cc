#include <debond/bulk/body_partition.h>
#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/whole_bulk.h>
#include <debond/support/ranks.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Eigen/Geometry>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_MultiVector.h>
#include <ml_MultiLevelPreconditioner.h>

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <optional>

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
    const bool is_valid = BulkOfCells::internal_forces(v, force, energy);
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
    if (Ranks::number() == 1)
      return;
    Eigen::Matrix<double, 10, Eigen::Dynamic> sums =
      Eigen::Matrix<double, 10, Eigen::Dynamic>::Zero(
        10, mesh.n_vertices_of_whole());
    for (unsigned int k = 0; k < stress.size(); ++k)
      {
        auto column      = sums.col(mesh.vertex_in_whole(k));
        column.head<9>() = stress[k].reshaped();
        column[9]        = n_cells[k];
      }
    Ranks::add_up(sums);
    for (unsigned int k = 0; k < stress.size(); ++k)
      {
        const auto column = sums.col(mesh.vertex_in_whole(k));
        stress[k]         = column.head<9>().reshaped(3, 3);
        n_cells[k]        = column[9];
      }
  }



  namespace
  {
    /** Index lists of owned and of local degrees of freedom for Trilinos. */
    struct Maps
    {
      Epetra_MpiComm   comm;
      Epetra_Map       owned, at_nodes;
      Epetra_Import    import;
      dealii::IndexSet owned_set;

      /** @p numbers: of the degrees of freedom at nodes that have one. */
      Maps(const BodyPartition &partition, const std::vector<int> &numbers)
        : comm(Ranks::communicator())
        , owned(3 * int(partition.n_nodes()),
                3 * int(partition.n_owned()),
                0,
                comm)
        , at_nodes(-1, int(numbers.size()), numbers.data(), 0, comm)
        , import(at_nodes, owned)
        , owned_set(3 * partition.n_nodes())
      {
        owned_set.add_range(3 * partition.first_owned(),
                            3 *
                              (partition.first_owned() + partition.n_owned()));
      }
    };



    class MultigridBulk : public WholeBulk
    {
    public:
      MultigridBulk(const BulkSpace &mesh, const NeoHookean &material)
        : WholeBulk(mesh, material)
        , partition(mesh)
      {
        for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
          if (const int number = partition.number_of(node); number >= 0)
            for (unsigned int c = 0; c < 3; ++c)
              {
                dofs.push_back(3 * node + c);
                numbers.push_back(3 * number + c);
              }
        number_of_dof.assign(3 * mesh.n_nodes(), -1);
        for (unsigned int k = 0; k < dofs.size(); ++k)
          number_of_dof[dofs[k]] = numbers[k];
        dof_of_owned.resize(n_owned());
        for (unsigned int k = 0; k < dofs.size(); ++k)
          if (const int place = place_of(numbers[k]); place >= 0)
            dof_of_owned[place] = dofs[k];
      }

      /** To be called once by all ranks. */
      void
      make_maps()
      {
        maps = std::make_unique<Maps>(partition, numbers);
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
              if (const int place = place_of(number_of_dof[3 * node + c]);
                  place >= 0)
                owned_unknowns.emplace_back(unknowns.size(), place);
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
        return 3 * partition.n_owned();
      }

      Eigen::VectorXd
      assembled(const Eigen::VectorXd &nodes) const override
      {
        Eigen::VectorXd     parts = nodes(dofs), result = zero();
        const Epetra_Vector source(View, maps->at_nodes, parts.data());
        Epetra_Vector       target(View, maps->owned, result.data());
        target.Export(source, maps->import, Add);
        for (unsigned int k = 0; k < result.size(); ++k)
          if (is_fixed(dof_of_owned[k]))
            result[k] = 0.;
        return result;
      }

      Eigen::VectorXd
      at_nodes(const Eigen::VectorXd &owned) const override
      {
        Eigen::VectorXd     values(dofs.size()), copy = owned;
        const Epetra_Vector source(View, maps->owned, copy.data());
        Epetra_Vector       target(View, maps->at_nodes, values.data());
        target.Import(source, maps->import, Insert);
        Eigen::VectorXd result = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
        result(dofs)           = values;
        return result;
      }

      Eigen::VectorXd
      owned_of(const Eigen::VectorXd &nodes) const override
      {
        return nodes(dof_of_owned);
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
        apply(
          [&](const Epetra_MultiVector &in, Epetra_MultiVector &out) {
            K.trilinos_matrix().Multiply(false, in, out);
          },
          x,
          y);
      }

      void
      cycle(const double *const x, double *const y) const override
      {
        apply(
          [&](const Epetra_MultiVector &in, Epetra_MultiVector &out) {
            multigrid->ApplyInverse(in, out);
          },
          x,
          y);
      }

    private:
      /** Of a degree of freedom of the matrix, among those that this rank owns;
       *  -1: it does not. */
      int
      place_of(const int number) const
      {
        const int place = number - 3 * int(partition.first_owned());
        return place >= 0 && place < int(n_owned()) ? place : -1;
      }
      Eigen::VectorXd
      zero() const
      {
        return Eigen::VectorXd::Zero(n_owned());
      }
      bool
      is_fixed(const unsigned int dof) const
      {
        return mesh.is_fixed(dof / 3, dof % 3);
      }

      // Epetra's vectors are views on ours.
      template <typename Work>
      void
      apply(const Work &work, const double *const x, double *const y) const
      {
        const Epetra_Vector in(View, maps->owned, const_cast<double *>(x));
        Epetra_Vector       out(View, maps->owned, y);
        work(in, out);
      }

      /** Calls work(row numbers, which of them are fixed) for each cell. */
      template <typename Work>
      void
      for_each_cell(const Work &work) const
      {
        std::vector<dealii::types::global_dof_index> rows;
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          {
            rows.clear();
            for (unsigned int a = 0; a < cells.n_nodes(cell); ++a)
              for (unsigned int c = 0; c < 3; ++c)
                rows.push_back(number_of_dof[3 * cells.nodes(cell)[a] + c]);
            work(cell, rows);
          }
      }

      void
      make_pattern()
      {
        dealii::IndexSet rows_here(3 * partition.n_nodes());
        std::vector<dealii::types::global_dof_index> sorted(numbers.begin(),
                                                            numbers.end());
        std::sort(sorted.begin(), sorted.end());
        rows_here.add_indices(sorted.begin(), sorted.end());
        const unsigned int row_length = mesh.has_splines() ? 375 : 81;
        dealii::TrilinosWrappers::SparsityPattern pattern(maps->owned_set,
                                                          maps->owned_set,
                                                          rows_here,
                                                          maps->comm.Comm(),
                                                          row_length);
        for_each_cell([&](unsigned int, const auto &rows) {
          for (const auto row : rows)
            pattern.add_entries(row, rows.begin(), rows.end());
        });
        pattern.compress();
        K.reinit(pattern);
      }

      // Fixed degrees of freedom keep their own entry, so that ML meets nothing
      // unusual.
      void
      assemble(const Eigen::VectorXd &v)
      {
        if (K.m() == 0)
          make_pattern();
        K = 0.;
        Eigen::MatrixXd            tangent;
        dealii::FullMatrix<double> matrix;
        for_each_cell([&](const unsigned int cell, const auto &rows) {
          const unsigned int n = rows.size();
          cells.tangent(cell, v, tangent);
          matrix.reinit(n, n);
          const auto fixed = [&](const unsigned int i) {
            return mesh.is_fixed(cells.nodes(cell)[i / 3], i % 3);
          };
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              if (i == j || (!fixed(i) && !fixed(j)))
                matrix(i, j) = tangent(i, j);
          K.add(rows, matrix);
        });
        K.compress(dealii::VectorOperation::add);
      }

      // All that is cheap to know; GMRES finds out the rest.
      bool
      has_positive_diagonal() const
      {
        Epetra_Vector diagonal(maps->owned);
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
        Epetra_MultiVector  modes(maps->owned, 6);
        std::vector<double> coordinates[3];
        for (unsigned int k = 0; k < n; ++k)
          {
            const Eigen::Vector3d &X =
              mesh.reference_position(dof_of_owned[k] / 3);
            const unsigned int c = k % 3;
            modes[c][k]          = 1.;
            for (unsigned int r = 0; r < 3; ++r)
              modes[3 + r][k] = Eigen::Vector3d::Unit(r).cross(X)[c];
            if (c == 0)
              for (unsigned int d = 0; d < 3; ++d)
                coordinates[d].push_back(X[d]);
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

      const BodyPartition       partition;
      std::vector<unsigned int> dofs;          ///< at nodes, with a number
      std::vector<int>          numbers;       ///< of these in the matrix
      std::vector<int>          number_of_dof; ///< -1: none
      std::vector<unsigned int> dof_of_owned;
      std::unique_ptr<Maps>     maps;
      dealii::TrilinosWrappers::SparseMatrix               K;
      std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> multigrid;
      Eigen::VectorXd                                      linearised_at;
      /** Unknown, place among the owned. */
      std::vector<std::pair<unsigned int, unsigned int>> owned_unknowns;
    };
  } // namespace



  std::unique_ptr<WholeBulk>
  make_multigrid_bulk(const BulkSpace &mesh, const NeoHookean &material)
  {
    Ranks::communicator(); // begins with MPI, before anything of Trilinos
    // a modulus that makes no sense in the cells of one rank is told to all
    std::unique_ptr<MultigridBulk> bulk;
    Ranks::in_agreement(
      [&] { bulk = std::make_unique<MultigridBulk>(mesh, material); });
    bulk->make_maps();
    return bulk;
  }
} // namespace Debond
