#ifndef debond_system_folded_tangent_h
#define debond_system_folded_tangent_h

#include <debond/system/coupled_tangent.h>
#include <debond/system/folded_unknowns.h>

#include <Eigen/Cholesky>

namespace Debond
{
  /** E^T B E of bodies that are condensed to dense matrices, and its factor;
   *  empty: not known yet. */
  struct FoldedBulk
  {
    Eigen::MatrixXd             stiffness;
    Eigen::LLT<Eigen::MatrixXd> factor;
  };



  /** E^T A E, and its parts. */
  class FoldedTangent : public SplitMatrix
  {
  public:
    /** Keeps references. @p bulk is made when it is needed first; it must be
     *  emptied when the bodies or the unknowns change. */
    FoldedTangent(const CoupledTangent &whole,
                  const FoldedUnknowns &unknowns,
                  FoldedBulk           &bulk)
      : whole(whole)
      , unknowns(unknowns)
      , bulk(bulk)
    {}

    Eigen::VectorXd
    product(const Eigen::VectorXd &y) const override;
    Eigen::VectorXd
    interface_product(const Eigen::VectorXd &y) const override;
    bool
    can_be_assembled() const override
    {
      return whole.can_be_assembled();
    }
    bool
    bulk_is_regular() const override
    {
      return whole.bulk_is_regular();
    }
    Eigen::VectorXd
    solve_bulk(const Eigen::VectorXd &b) const override;
    void
    assemble(Eigen::MatrixXd &matrix) const override;

  private:
    const FoldedBulk &
    known_bulk() const;

    const CoupledTangent &whole;
    const FoldedUnknowns &unknowns;
    FoldedBulk           &bulk;
  };
} // namespace Debond
#endif
