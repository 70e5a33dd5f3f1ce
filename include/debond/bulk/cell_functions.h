#ifndef debond_bulk_cell_functions_h
#define debond_bulk_cell_functions_h

#include <debond/bulk/bulk_space.h>

#include <deal.II/base/point.h>

#include <Eigen/Core>

#include <array>

namespace Debond
{
  /** The point of [0,1]^2 in the parameters of an element with these @p bounds,
   *  exact at both: neighbours must agree on their border. */
  Eigen::Vector2d
  parameters_at(const std::array<Eigen::Vector2d, 2> &bounds,
                const dealii::Point<2>               &point);

  /** Functions at a point of deal.II's unit cell, a row each: the value and the
   *  derivatives with respect to its three coordinates. */
  using ShapeValues = Eigen::Matrix<double, Eigen::Dynamic, 4, 0, 27, 4>;

  /** Of FE_Q. */
  ShapeValues
  shape_values(const dealii::FE_Q<3> &element, const dealii::Point<3> &point);

  /**
   * The functions of a cell, in the order of its nodes: those of FE_Q, or in
   * the contact layer (Corbett & Sauer 2014)
   *
   *   x = sum_A N_A(xi,eta) l_0(zeta) x_A + sum_a phi_a(xi,eta,zeta) x_a,
   *
   * N_A those of the NURBS by Bezier extraction (Eqs. 34, 35 of the paper),
   * phi_a those of FE_Q whose nodes are not on the contact face, l_0 that of
   * FE_Q across which is 1 there. Or, with splines M_k of the depth, in all
   * layers
   *
   *   x = sum_k M_k(zeta) sum_A N_A(xi,eta) x_kA.
   *
   * In a cell splines are polynomials of the degree of FE_Q(2), known by their
   * values at its support points: B_b = sum_a E_ab phi_a, and those of weight
   * w N_b = w_b B_b / sum_c w_c B_c.
   */
  class CellFunctions
  {
  public:
    CellFunctions(const BulkSpace &space, const BulkSpace::Cell &cell);

    ShapeValues
    at(const dealii::Point<3> &point) const;
    /** The same with the functions of FE_Q at the point, which many cells
     *  share. */
    ShapeValues
    at(const dealii::Point<3> &point, const ShapeValues &phi) const;

    /** Reference position of a point [mm]. */
    Eigen::Vector3d
    position(const dealii::Point<3> &point) const;

  private:
    SurfaceBasis
    functions_of_face(double xi, double eta) const;
    ShapeValues
    of_contact_layer(const dealii::Point<3> &point,
                     const ShapeValues      &phi) const;
    void
    extract_splines();
    ShapeValues
    splines(const ShapeValues &phi) const;

    const BulkSpace       &space;
    const BulkSpace::Cell &cell;
    Eigen::MatrixXd        E; ///< functions of FE_Q x splines
    Eigen::VectorXd        w; ///< of each spline; empty: all 1
  };
} // namespace Debond
#endif
