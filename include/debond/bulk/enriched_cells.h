#ifndef debond_bulk_enriched_cells_h
#define debond_bulk_enriched_cells_h

#include <debond/bulk/cell_functions.h>
#include <debond/bulk/neo_hookean.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <Eigen/Core>

#include <vector>

namespace Debond
{
  /**
   * The element kernel of the bulk: 2x2x2 Gauss points, reference gradients
   * stored once for cells that are alike, all eight points of a cell side by
   * side so that the compiler vectorises over them.
   */
  class EnrichedCells
  {
  public:
    static constexpr unsigned int n_q = 8;

    /** @p mesh must outlive this object. @p material is that of the mesh's
     *  young_modulus. */
    EnrichedCells(const BulkSpace &mesh, const NeoHookean &material);

    unsigned int
    n_cells() const
    {
      return mesh.cells().size();
    }
    unsigned int
    n_nodes(const unsigned int cell) const
    {
      return mesh.cells()[cell].nodes.size();
    }
    /** Node numbers (degrees of freedom 3 node + component) of a cell. */
    const unsigned int *
    nodes(const unsigned int cell) const
    {
      return mesh.cells()[cell].nodes.data();
    }

    /** Adds the internal forces of all cells [N] to @p force (3 n_nodes of the
     *  mesh) at the displacement @p v [mm] and returns the strain energy
     *  [N mm]. False if a cell is turned inside out (J <= 0) or a value is not
     *  finite; @p force and @p energy are then useless. */
    bool
    internal_forces(const Eigen::VectorXd &v,
                    Eigen::VectorXd       &force,
                    double                &energy) const;

    /** Tangent stiffness of one cell [N/mm], 3 n x 3 n, at the displacement v.
     */
    void
    tangent(unsigned int           cell,
            const Eigen::VectorXd &v,
            Eigen::MatrixXd       &K) const;

    /** Displacement gradients H at the Gauss points of a cell. */
    void
    displacement_gradients(unsigned int           cell,
                           const Eigen::VectorXd &v,
                           double (&H)[n_q][3][3]) const;

    /** Reference volume [mm^3]. */
    double
    volume() const;

    /** Young's modulus at the Gauss points of a cell over that of material().
     */
    Eigen::Array<double, n_q, 1>
    stiffness_factors(const unsigned int cell) const
    {
      if (factors.empty())
        return Eigen::Array<double, n_q, 1>::Ones();
      return Eigen::Map<const Eigen::Array<double, n_q, 1>>(
        &factors[n_q * cell]);
    }
    const NeoHookean &
    material() const
    {
      return bulk_material;
    }

  private:
    /** Add the gradients of a cell, and of all those that are alike, in the
     *  reference configuration: of FE_Q, or by the functions @p phi of FE_Q at
     *  the points. */
    void
    add_cell(const dealii::FEValues<3> &fe_values);
    void
    add_cell(const BulkSpace::Cell &cell, const std::vector<ShapeValues> &phi);
    double *
    new_kind(unsigned int n_functions);
    /** Gradient of shape function a in direction d at point q:
     *  gradients(cell)[(3 a + d) n_q + q]. */
    const double *
    gradients(const unsigned int cell) const
    {
      return &gradient_list[first_gradient[kinds[cell]]];
    }
    /** One number for each Gauss point of a cell. */
    using PointValues = Eigen::Array<double, n_q, 1>;
    void
    gradient_at_points(unsigned int           cell,
                       const Eigen::VectorXd &v,
                       PointValues (&H)[3][3]) const;

    /** Volumes that the points stand for [mm^3]; those in the stiffness have
     *  the factors of Young's modulus in them. */
    Eigen::Map<const PointValues>
    volumes(const unsigned int cell) const
    {
      return Eigen::Map<const PointValues>(&JxW[n_q * kinds[cell]]);
    }
    PointValues
    weights(const unsigned int cell) const
    {
      return volumes(cell) * stiffness_factors(cell);
    }
    void
    find_factors();

    const BulkSpace          &mesh;
    const NeoHookean          bulk_material;
    const dealii::QGauss<3>   quadrature;
    std::vector<unsigned int> kinds;          ///< of each cell
    std::vector<std::size_t>  first_gradient; ///< of each kind
    std::vector<double>       gradient_list;
    std::vector<double>       JxW;     ///< n_q per kind [mm^3]
    std::vector<double>       factors; ///< n_q per cell; empty: all 1
  };
} // namespace Debond
#endif
