#pragma once

#include <debond/bulk/bulk_space.h>

#include <Eigen/Dense>

#include <vector>

namespace Debond
{
  class Body;
  class Chuck;

  /** Displacement and stress within the cells of a body in the trial state, in
   *  its own frame and in space: the implant's frame turns and moves with the
   *  chuck, the bone's stays. Collective. */
  class BodyFields
  {
  public:
    BodyFields(const Body &body, const Chuck &chuck);

    /** A point of a cell. */
    struct Point
    {
      Eigen::Vector3d X = Eigen::Vector3d::Zero(); ///< reference position [mm]
      Eigen::Vector3d v = Eigen::Vector3d::Zero(); ///< its motion in the frame
      Eigen::Vector3d u;                           ///< in space [mm]
      Eigen::Matrix3d sigma = Eigen::Matrix3d::Zero(); ///< Cauchy stress [MPa]
      Eigen::Matrix3d stress;                          ///< the same in space
    };
    /** @p N: values of the functions of the cell at @p unit. The stress is
     *  trilinear between the corners. */
    Point
    at(const BulkSpace::Cell                   &cell,
       const dealii::Point<3>                  &unit,
       const Eigen::Ref<const Eigen::VectorXd> &N) const;

  private:
    const BulkSpace      &space;
    const Chuck *const    chuck; ///< null: the frame is in space
    const Eigen::VectorXd v;

  public:
    /** Cauchy stress at the vertices, in the frame [MPa]. */
    const std::vector<Eigen::Matrix3d> vertex_stress;
  };

  /** Displacement [mm] and Cauchy stress [MPa] of a body at @p points of its
   *  reference configuration [mm], in space and in the trial state: a column of
   *  3 and 9 values for each of them. Not a number where the body is not. The
   *  stress is that of bulk.pvd. Collective. */
  Eigen::MatrixXd
  values_at_points(const Body             &body,
                   const Chuck            &chuck,
                   const Eigen::Matrix3Xd &points);
} // namespace Debond
