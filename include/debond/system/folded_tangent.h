#ifndef debond_system_folded_tangent_h
#define debond_system_folded_tangent_h

#include <debond/geometry/cyclic_symmetry.h>
#include <debond/system/coupled_tangent.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <array>
#include <optional>

namespace Debond
{
  /** Of both contact surfaces. */
  using SectorsOfSurfaces = std::array<CyclicSymmetry, 2>;

  /**
   * The unknowns z of the coupled system where bodies, bond and load have a
   * cyclic symmetry: those of one sector, y, say all, z = E y. Unknowns of the
   * chuck and the time stay what they are.
   */
  class FoldedUnknowns
  {
  public:
    /** @p configuration: numbers of the unknowns, of which there are
     *  @p n_unknowns. */
    FoldedUnknowns(const SectorsOfSurfaces      &sectors,
                   const InterfaceConfiguration &configuration,
                   unsigned int                  n_unknowns);

    /** E y, and E^T b of the equations. */
    Eigen::VectorXd
    unfold(const Eigen::VectorXd &y) const
    {
      return E * y;
    }
    Eigen::VectorXd
    fold(const Eigen::VectorXd &b) const
    {
      return E.transpose() * b;
    }
    /** Number of images of each of y: E^T E is diagonal. */
    const Eigen::VectorXd &
    n_images() const
    {
      return images;
    }
    /** How many unknowns are left. */
    unsigned int
    size() const
    {
      return E.cols();
    }

    /** @p configuration with the numbers of y. */
    InterfaceConfiguration
    folded(const InterfaceConfiguration &configuration) const;

    Eigen::SparseMatrix<double> E;

  private:
    std::array<InterfaceConfiguration::Surface, 2> surfaces; ///< numbers only
    std::vector<std::pair<unsigned int, unsigned int>> chuck_unknowns;
    Eigen::VectorXd                                    images;
  };



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
