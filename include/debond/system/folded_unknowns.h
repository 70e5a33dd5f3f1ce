#ifndef debond_system_folded_unknowns_h
#define debond_system_folded_unknowns_h

#include <debond/geometry/cyclic_symmetry.h>
#include <debond/interface/interface_configuration.h>

#include <Eigen/SparseCore>

#include <array>
#include <utility>
#include <vector>

namespace Debond
{
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
} // namespace Debond
#endif
