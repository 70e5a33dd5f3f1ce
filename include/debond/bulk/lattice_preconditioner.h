#ifndef debond_bulk_lattice_preconditioner_h
#define debond_bulk_lattice_preconditioner_h

#include <debond/bulk/condensing_bulk.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <memory>
#include <vector>

class Epetra_CrsMatrix;

namespace Debond
{
  /**
   * An approximate inverse of the stiffness of a bone of equal splines in one
   * process, for Krylov's methods: the exact solver of the lattice, whose
   * modulus is the mean of each layer of cells. With e the modulus at a node
   * over that mean,
   *
   *   K^-1 ~ e^-1/2 K_lattice^-1 e^-1/2,
   *
   * which a modulus that varies smoothly makes nearly exact. The outermost
   * control points, which follow their neighbours on the lattice, are solved
   * for by themselves before.
   */
  class LatticePreconditioner
  {
  public:
    /** @p dofs: the degree of freedom of each row of the matrix. */
    LatticePreconditioner(const BodyMesh           &mesh,
                          const EnrichedCells      &cells,
                          std::vector<unsigned int> dofs);

    /** Whether it takes less time than multigrid (doc/scaling.md). */
    static bool
    pays(const BodyMesh &mesh, const EnrichedCells &cells);

    /** For another tangent. False: it is not positive definite. */
    bool
    set_up(const Epetra_CrsMatrix &K);

    /** y ~ K^-1 x. */
    void
    solve(const double *x, double *y) const;

  private:
    const unsigned int                    n_dofs; ///< at nodes
    const std::vector<unsigned int>       dofs;
    const std::unique_ptr<CondensingBulk> lattice;
    Eigen::VectorXd                       scale;    ///< e^-1/2 of each row
    std::vector<int>                      at_sides; ///< rows
    Eigen::SparseMatrix<double>           columns_of_sides; ///< of K
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> sides;
  };
} // namespace Debond
#endif
