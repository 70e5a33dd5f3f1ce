#pragma once

#include <debond/bulk/enriched_cells.h>

#include <deal.II/lac/affine_constraints.h>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace Debond
{
  /** Symmetry of a body that is its own image in the mirrors x -> -x and
   *  y -> -y. */
  class MirrorSymmetry
  {
  public:
    /** Nothing if it is not: places, supports, cells, functions and modulus are
     *  compared, but for rounding. */
    static std::optional<MirrorSymmetry>
    of(const BulkSpace &space, const EnrichedCells &cells);

    /** Number of cells of a cell's kind if mirror images are one kind;
     *  0 if another of its kind stands for it. */
    unsigned int
    n_images(const unsigned int cell) const
    {
      return images_of_cells[cell];
    }
    /** These control points of the contact surface and their images. */
    std::vector<bool>
    with_images(const BulkSpace &space, std::vector<bool> control_points) const;
    /** Ties, supports, and motions whose image in mirror d is, by parity[d],
     *  themselves (1) or their opposite (-1): what is an image follows the one
     *  of its images with the lowest number. A stiffness that both mirrors
     *  leave as it is, as that at rest, couples no two of the four classes. */
    dealii::AffineConstraints<double>
    constraints(const BulkSpace             &space,
                const std::array<double, 2> &parity) const;

  private:
    std::array<std::vector<unsigned int>, 2> image; ///< of a node, in a mirror
    std::vector<unsigned int>                images_of_cells;
  };



  /**
   * Motions of a body that belong together: sums of its degrees of freedom of
   * norm 1, orthogonal to each other. A degree of freedom (3 node + component)
   * has a part in one of them at most.
   */
  struct DofClass
  {
    DofClass() = default;
    /** Unknowns that @p constraints leave, which are those of the space and
     * maybe such that make a degree of freedom a multiple of another one. */
    DofClass(const BulkSpace                         &space,
             const dealii::AffineConstraints<double> &constraints);

    unsigned int        n = 0;       ///< number of unknowns
    std::vector<int>    number;      ///< of a degree of freedom; -1: none
    std::vector<double> coefficient; ///< of the degree of freedom in it

    /** The parts of a vector over all degrees of freedom in this class. */
    Eigen::VectorXd
    fold(const Eigen::VectorXd &v) const;
    /** Adds the motions with the amplitudes @p y to @p v. */
    void
    unfold(const Eigen::VectorXd &y, Eigen::VectorXd &v) const;
  };
} // namespace Debond
