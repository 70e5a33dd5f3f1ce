#ifndef debond_output_body_points_h
#define debond_output_body_points_h

#include <Eigen/Dense>

#include <vector>

namespace Debond
{
  class Body;
  class Chuck;

  /** From a body's frame to space: the implant's turns and moves with the
   * chuck, the bone's stays. */
  class BodyFrame
  {
  public:
    BodyFrame(const Body &body, const Chuck &chuck);

    /** In space [mm], of a point X that has moved by @p v in the frame. */
    Eigen::Vector3d
    displacement(const Eigen::Vector3d &X, const Eigen::Vector3d &v) const;
    /** Cauchy stress in space [MPa]. */
    Eigen::Matrix3d
    stress(const Eigen::Matrix3d &in_frame) const;

  private:
    const Chuck *const chuck; ///< null: the frame is that of space
  };

  /** What a body shows at points of its reference configuration, in space and
   * in the trial state. */
  struct BodyPoints
  {
    /** @p points [mm], a column each. Not a number where the body is not.
     *  The stress is that of bulk.pvd: trilinear between the corners of cells.
     *  Collective. */
    BodyPoints(const Body             &body,
               const Chuck            &chuck,
               const Eigen::Matrix3Xd &points);

    Eigen::Matrix3Xd             displacement; ///< [mm]
    std::vector<Eigen::Matrix3d> stress;       ///< Cauchy [MPa]
  };
} // namespace Debond
#endif
