#pragma once

#include <debond/bulk/bulk_space.h>
#include <debond/bulk/hyperelastic_material.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Core>

#include <type_traits>
#include <vector>

namespace Debond
{
  /**
   * The element kernel of the bulk: Gauss points, 2 x 2 x 2 in a cell or, of
   * quadratic elements, 3 x 3 x 3; reference gradients stored once for cells
   * that are alike, all points of a cell side by side so that the compiler
   * vectorises over them.
   */
  class EnrichedCells
  {
  public:
    /** @p mesh must outlive this object. @p material is that of the mesh's
     *  young_modulus. */
    EnrichedCells(const BulkSpace &mesh, const HyperelasticMaterial &material);

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
     *  mesh) at the displacement @p v [mm], and puts the strain energy [N mm]
     *  into @p energy. False if a cell is turned inside out (J <= 0) or a value
     *  is not finite; @p force and @p energy are then useless. */
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

    /** Volume that a Gauss point of a cell stands for [mm^3], and where it is
     *  in the unit cell. */
    double
    volume(const unsigned int cell, const unsigned int q) const
    {
      return JxW[quadrature.size() * kinds[cell] + q];
    }
    const dealii::Point<3> &
    point(const unsigned int q) const
    {
      return quadrature.point(q);
    }

    /** Cauchy stress at the Gauss points of a cell [MPa], P F^T / J or, with
     *  small strains, C(0) : H. */
    std::vector<Eigen::Matrix3d>
    stress(unsigned int           cell,
           const Eigen::VectorXd &v,
           bool                   has_small_strains) const;

    /** Reference volume [mm^3]. */
    double
    volume() const;

    /** Gauss points along an edge, and in a cell. */
    unsigned int
    n_along() const
    {
      return line.size();
    }
    unsigned int
    n_points() const
    {
      return quadrature.size();
    }
    /** Young's modulus at the Gauss points of a cell over that of material().
     */
    Eigen::ArrayXd
    stiffness_factors(const unsigned int cell) const
    {
      if (factors.empty())
        return Eigen::ArrayXd::Ones(n_points());
      return Eigen::Map<const Eigen::ArrayXd>(&factors[n_points() * cell],
                                              n_points());
    }

  private:
    /** Adds the gradients of a cell, and of all those that are alike, in the
     *  reference configuration, by the functions @p phi of FE_Q at the points.
     */
    void
    add_cell(const BulkSpace::Cell &cell, const std::vector<ShapeValues> &phi);
    /** Gradient of shape function a in direction d at point q:
     *  gradients(cell)[(3 a + d) n_points() + q]. */
    const double *
    gradients(const unsigned int cell) const
    {
      return &gradient_list[first_gradient[kinds[cell]]];
    }
    /** Calls work(n), n a constant: the number of points in a cell. */
    template <typename Work>
    auto
    with_points(const Work &work) const
    {
      return n_points() == 8 ? work(std::integral_constant<int, 8>()) :
                               work(std::integral_constant<int, 27>());
    }
    template <int n_q>
    void
    gradient_at_points(unsigned int           cell,
                       const Eigen::VectorXd &v,
                       PointValues<n_q> (&H)[3][3]) const;
    struct Forces;
    template <int n_q>
    void
    add_forces(unsigned int cell, const Eigen::VectorXd &v, Forces &) const;
    template <int n_q>
    void
    tangent_of(unsigned int           cell,
               const Eigen::VectorXd &v,
               Eigen::MatrixXd       &K) const;

    /** Volumes that the points stand for [mm^3], with the factors of Young's
     *  modulus in them. */
    template <int n_q>
    PointValues<n_q>
    weights(const unsigned int cell) const
    {
      using Values            = Eigen::Map<const PointValues<n_q>>;
      PointValues<n_q> result = Values(&JxW[n_q * kinds[cell]]);
      if (!factors.empty())
        result *= Values(&factors[n_q * cell]);
      return result;
    }
    void
    find_factors();

    const BulkSpace          &mesh;
    HyperelasticMaterial      bulk_material;
    const dealii::QGauss<1>   line;
    const dealii::QGauss<3>   quadrature;
    std::vector<unsigned int> kinds;          ///< of each cell
    std::vector<std::size_t>  first_gradient; ///< of each kind
    std::vector<double>       gradient_list;
    std::vector<double>       JxW;     ///< of the points of a kind [mm^3]
    std::vector<double>       factors; ///< of those of a cell; empty: all 1
  };
} // namespace Debond
