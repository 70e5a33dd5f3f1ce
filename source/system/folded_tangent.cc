#include <debond/system/folded_tangent.h>

// The linear systems of a scene with a cyclic symmetry, see FoldedUnknowns.
namespace Debond
{
  // Small, and asked for in every iteration.
  const FoldedBulk &
  FoldedTangent::known_bulk() const
  {
    if (bulk.stiffness.size() == 0)
      {
        bulk.stiffness =
          unknowns.E.transpose() * (whole.bulk_stiffness() * unknowns.E);
        if (bulk_is_regular())
          bulk.factor.compute(bulk.stiffness);
      }
    return bulk;
  }



  Eigen::VectorXd
  FoldedTangent::interface_product(const Eigen::VectorXd &y) const
  {
    return unknowns.fold(whole.interface_product(unknowns.unfold(y)));
  }



  Eigen::VectorXd
  FoldedTangent::product(const Eigen::VectorXd &y) const
  {
    if (!can_be_assembled())
      return unknowns.fold(whole.product(unknowns.unfold(y)));
    return known_bulk().stiffness * y + interface_product(y);
  }



  // B leaves the symmetry as it is: forces spread evenly over the images of an
  // unknown move all of these alike.
  Eigen::VectorXd
  FoldedTangent::solve_bulk(const Eigen::VectorXd &b) const
  {
    if (can_be_assembled())
      return known_bulk().factor.solve(b);
    const Eigen::VectorXd &n = unknowns.n_images();
    return unknowns.fold(whole.solve_bulk(unknowns.unfold(b.cwiseQuotient(n))))
      .cwiseQuotient(n);
  }



  void
  FoldedTangent::assemble(Eigen::MatrixXd &matrix) const
  {
    matrix = known_bulk().stiffness;
    whole.add_all_but_bulk(unknowns, matrix);
  }
} // namespace Debond
