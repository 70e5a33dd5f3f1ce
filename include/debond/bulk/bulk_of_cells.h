#ifndef debond_bulk_bulk_of_cells_h
#define debond_bulk_bulk_of_cells_h

#include <debond/bulk/bulk.h>
#include <debond/bulk/enriched_cells.h>

#include <deal.II/lac/full_matrix.h>

namespace Debond
{
  /** What the cells of a bulk say by themselves, whatever solves for their
   *  stiffness. */
  class BulkOfCells : public Bulk
  {
  public:
    bool
    internal_forces(const Eigen::VectorXd &v,
                    Eigen::VectorXd       &force,
                    double                &energy) const override;
    Eigen::MatrixXd
    product_at_rest(Eigen::MatrixXd x) const override;
    std::vector<Eigen::Matrix3d>
    vertex_stress(const Eigen::VectorXd &v,
                  bool                   has_small_strains) const override;
    double
    young_modulus(const unsigned int cell) const override
    {
      return mesh.parameters().young_modulus *
             cells.stiffness_factors(cell).mean();
    }

  protected:
    BulkOfCells(const BulkSpace &mesh, EnrichedCells &&cells)
      : mesh(mesh)
      , cells(std::move(cells))
    {}

    /** Degrees of freedom of a cell, put into @p dofs. */
    void
    dofs_of(unsigned int                                  cell,
            std::vector<dealii::types::global_dof_index> &dofs) const;
    /** The same, and the stiffness K of the cell [N/mm] in state @p v, for
     *  distribute_local_to_global(). */
    void
    stiffness_of(unsigned int                                  cell,
                 const Eigen::VectorXd                        &v,
                 dealii::FullMatrix<double>                   &K,
                 std::vector<dealii::types::global_dof_index> &dofs) const;
    /** Adds to sums over the cells of this rank those of others, one entry for
     *  each vertex. */
    virtual void
    add_up_at_vertices(std::vector<Eigen::Matrix3d> & /*stress*/,
                       std::vector<double> & /*n_cells*/) const
    {}

    const BulkSpace    &mesh;
    const EnrichedCells cells;
  };
} // namespace Debond
#endif
