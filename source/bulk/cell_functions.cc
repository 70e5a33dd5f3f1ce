#include <debond/bulk/bulk_space.h>
#include <debond/geometry/quadratic_simplex.h>

#include <array>
#include <cmath>

namespace Debond
{
  Eigen::Vector2d
  parameters_at(const std::array<Eigen::Vector2d, 2> &bounds,
                const dealii::Point<2>               &point)
  {
    const Eigen::Array2d t(point[0], point[1]);
    return (1. - t) * bounds[0].array() + t * bounds[1].array();
  }



  ShapeValues
  shape_values(const dealii::FE_Q<3> &element, const dealii::Point<3> &point)
  {
    ShapeValues phi(element.n_dofs_per_cell(), 4);
    for (unsigned int a = 0; a < phi.rows(); ++a)
      {
        const dealii::Tensor<1, 3> slope = element.shape_grad(a, point);
        phi.row(a) << element.shape_value(a, point), slope[0], slope[1],
          slope[2];
      }
    return phi;
  }



  CellFunctions::CellFunctions(const BulkSpace       &space,
                               const BulkSpace::Cell &cell)
    : space(space)
    , cell(cell)
  {
    if (space.has_splines())
      extract_splines();
    else if (space.has_tetrahedra())
      E = barycentric_corners<3>(cell.first_corner).transpose();
    else if (cell.enriched)
      for (unsigned int a = 0; a < space.element().n_dofs_per_cell(); ++a)
        on_face[a] = space.element().has_support_on_face(a, cell.face.number);
  }



  ShapeValues
  CellFunctions::at(const dealii::Point<3> &point) const
  {
    return at(point, shape_values(space.element(), point));
  }



  ShapeValues
  CellFunctions::at(const dealii::Point<3> &point, const ShapeValues &phi) const
  {
    if (space.has_splines())
      return splines(phi);
    if (space.has_tetrahedra())
      return quadratic_functions(
        Eigen::Matrix4d(E.transpose().lazyProduct(phi)));
    return cell.enriched ? of_contact_layer(point, phi) : phi;
  }



  // Of splines all points at once: a product of matrices.
  Eigen::MatrixXd
  CellFunctions::values_at(const std::vector<dealii::Point<3>> &points,
                           const std::vector<ShapeValues>      &phi) const
  {
    Eigen::MatrixXd N(cell.nodes.size(), points.size());
    if (!space.has_splines())
      {
        for (unsigned int q = 0; q < points.size(); ++q)
          N.col(q) = at(points[q], phi[q]).col(0);
        return N;
      }
    Eigen::MatrixXd polynomials(E.rows(), points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      polynomials.col(q) = phi[q].col(0);
    N.noalias() = E.transpose() * polynomials;
    if (w.size() > 0)
      {
        N                      = w.asDiagonal() * N;
        const Eigen::ArrayXd W = N.colwise().sum();
        N.array().rowwise() /= W.transpose();
      }
    return N;
  }



  Eigen::Vector3d
  CellFunctions::position(const dealii::Point<3> &point) const
  {
    const ShapeValues N = at(point);
    Eigen::Vector3d   X = Eigen::Vector3d::Zero();
    for (unsigned int a = 0; a < N.rows(); ++a)
      X += N(a, 0) * space.reference_position(cell.nodes[a]);
    return X;
  }



  SurfaceBasis
  CellFunctions::functions_of_face(const double xi, const double eta) const
  {
    SurfaceBasis basis;
    space.surface().evaluate_in_element(
      cell.surface_element,
      parameters_at(space.surface().element_bounds(cell.surface_element),
                    {xi, eta}),
      basis);
    return basis;
  }



  // The functions of all nodes on a face add up to l_0, which depends on the
  // coordinate across only.
  ShapeValues
  CellFunctions::of_contact_layer(const dealii::Point<3> &point,
                                  const ShapeValues      &phi) const
  {
    const auto        &axes   = cell.face.axes;
    const unsigned int across = cell.face.across();
    double             l = 0., dl = 0.;
    for (unsigned int a = 0; a < phi.rows(); ++a)
      if (on_face[a])
        {
          l += phi(a, 0);
          dl += phi(a, 1 + across);
        }
    const auto bounds = space.surface().element_bounds(cell.surface_element);
    const Eigen::Vector2d size = bounds[1] - bounds[0];
    const SurfaceBasis    basis =
      functions_of_face(point[axes[0]], point[axes[1]]);
    ShapeValues N(cell.nodes.size(), 4);
    for (unsigned int b = 0; b < basis.size; ++b)
      {
        N(b, 0)           = basis.N[b] * l;
        N(b, 1 + axes[0]) = basis.N_1[b] * size[0] * l;
        N(b, 1 + axes[1]) = basis.N_2[b] * size[1] * l;
        N(b, 1 + across)  = basis.N[b] * dl;
      }
    for (unsigned int a = 0, row = basis.size; a < phi.rows(); ++a)
      if (!on_face[a])
        N.row(row++) = phi.row(a);
    return N;
  }



  // FE_Q(2) has its support points in a lattice, whose columns share the
  // functions of the face, and its layers those of the depth.
  void
  CellFunctions::extract_splines()
  {
    const KnotVector &depth     = space.depth();
    const double      begin     = depth.breakpoints()[cell.layer],
                 end            = depth.breakpoints()[cell.layer + 1];
    const unsigned int n_levels = depth.degree() + 1,
                       n_face   = cell.nodes.size() / n_levels;
    const auto points =
      space.surface().element_control_points(cell.surface_element);
    Eigen::VectorXd weights(n_face);
    for (unsigned int b = 0; b < n_face; ++b)
      weights[b] = space.surface().weights()[points[b]];
    if ((weights.array() != 1.).any())
      w = weights.replicate(n_levels, 1);

    E.resize(space.element().n_dofs_per_cell(), cell.nodes.size());
    std::array<Eigen::VectorXd, 9> functions; // of the columns
    for (unsigned int a = 0; a < E.rows(); ++a)
      {
        const dealii::Point<3> &p = space.element().unit_support_point(a);
        // sum_b B_b = 1 makes polynomials of the rational functions
        Eigen::VectorXd &ratios = functions[std::lround(2. * p[0] + 6. * p[1])];
        if (ratios.size() == 0)
          {
            const SurfaceBasis N = functions_of_face(p[0], p[1]);
            ratios = Eigen::Map<const Eigen::VectorXd>(N.N.data(), n_face)
                       .cwiseQuotient(weights);
            ratios /= ratios.sum();
          }
        // zeta runs upwards, the depth from the contact face
        const double inwards = space.side() == Side::bone ? 1. - p[2] : p[2];
        const auto   M =
          depth.evaluate(cell.layer, (1. - inwards) * begin + inwards * end);
        for (unsigned int k = 0; k < n_levels; ++k)
          E.row(a).segment(k * n_face, n_face) = M.B[k] * ratios.transpose();
      }
  }



  ShapeValues
  CellFunctions::splines(const ShapeValues &phi) const
  {
    ShapeValues N = E.transpose().lazyProduct(phi);
    if (w.size() > 0) // the quotient rule
      {
        N                          = w.asDiagonal() * N;
        const Eigen::RowVector4d W = N.colwise().sum();
        N.col(0) /= W[0];
        for (unsigned int d = 1; d < 4; ++d)
          N.col(d) = (N.col(d) - N.col(0) * W[d]) / W[0];
      }
    return N;
  }
} // namespace Debond
