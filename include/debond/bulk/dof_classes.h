#ifndef debond_bulk_dof_classes_h
#define debond_bulk_dof_classes_h

#include <debond/bulk/body_mesh.h>

#include <Eigen/Core>

#include <vector>

namespace Debond
{
  /**
   * Motions of a body that belong together: sums of its degrees of freedom of
   * norm 1, orthogonal to each other. A degree of freedom (3 node + component)
   * has a part in one of them at most.
   */
  struct DofClass
  {
    unsigned int        n = 0;       ///< how many there are
    std::vector<int>    number;      ///< of a degree of freedom; -1: none
    std::vector<double> coefficient; ///< of the degree of freedom in it

    /** The parts of a vector over all degrees of freedom in this class. */
    Eigen::VectorXd
    fold(const Eigen::VectorXd &v) const;
    /** Adds the motions with the amplitudes @p y to @p v. */
    void
    unfold(const Eigen::VectorXd &y, Eigen::VectorXd &v) const;
  };

  /** Whether a mesh is its own mirror image in the planes x = 0 and y = 0, but
   *  for rounding: knots, weights, places and supports of nodes. The classes
   *  and images below are for such meshes. Cells follow the knots. */
  bool
  is_mirror_image(const BodyMesh &mesh);

  /** All degrees of freedom that nothing holds or ties, each a motion of its
   *  own. */
  DofClass
  free_dofs_of(const BodyMesh &mesh);

  /**
   * The same in four classes by what the mirrors x -> -x and y -> -y make of a
   * motion: itself or its opposite. A stiffness that both mirrors leave as it
   * is, as that at rest, couples no two classes.
   */
  std::vector<DofClass>
  mirror_classes_of(const BodyMesh &mesh);

  /** These control points of the contact surface and their mirror images. */
  std::vector<bool>
  with_mirror_images(const BodyMesh &mesh, std::vector<bool> control_points);

  /** How many cells there are of a cell's kind if mirror images are one kind;
   *  0 if another of its kind stands for it. */
  unsigned int
  n_mirror_images(const BodyMesh &mesh, const BodyMesh::Cell &cell);
} // namespace Debond
#endif
