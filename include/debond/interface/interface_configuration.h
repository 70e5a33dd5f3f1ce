#pragma once

#include <debond/interface/contact_point.h>
#include <debond/shapes/side.h>
#include <debond/support/runtime.h>

#include <array>
#include <utility>
#include <vector>

namespace Debond
{
  class Chuck;

  /** The two contact surfaces in space and how their control points are
   *  numbered in the coupled system. */
  struct InterfaceConfiguration
  {
    struct Surface
    {
      /** Of the control points [mm]; on a slave with gaps that are taken off,
       *  also of the origin and of three points of its frame. */
      ControlNet      positions;
      Eigen::Matrix3d frame = Eigen::Matrix3d::Identity(); ///< Q of the body
      /** For 3 (control point) + component (body frame): number in the coupled
       *  system, -1: none. */
      std::vector<int> unknown_of;

      /** Adds the origin of the frame and its ends, 1 mm away. */
      void
      add_frame(const Eigen::Vector3d &origin)
      {
        positions.conservativeResize(Eigen::NoChange, positions.cols() + 4);
        positions.rightCols<4>() << origin, frame.colwise() + origin;
      }
    };
    std::array<Surface, 2> side;
    /** Numbers of the chuck components that are unknowns. */
    std::vector<std::pair<unsigned int, unsigned int>> chuck_unknowns;
    const Chuck                                       *chuck = nullptr;
  };

  /** Vectors at the control points of bone and implant. */
  using NodalSums = std::array<ControlNet, 2>;

  /** Zero at all control points of both surfaces. */
  NodalSums
  zero_sums(const InterfaceConfiguration &configuration);

  /** Motion in space of the control points with the unknowns of the coupled
   *  system, those of the chuck included [mm]. */
  NodalSums
  nodal_motion(const Eigen::VectorXd        &unknowns,
               const InterfaceConfiguration &configuration);

  /** The transpose of nodal_motion(): adds @p factor times what @p sums, in
   *  space, amount to in each unknown. */
  void
  add_in_unknowns(const NodalSums              &sums,
                  const InterfaceConfiguration &configuration,
                  double                        factor,
                  Eigen::VectorXd              &result);

  /** Sums of what work(q, sums) adds over q in [0, n), from @p zero on, formed
   * in parts as for_each_chunk() says. */
  template <typename Sums, typename Work>
  Sums
  sum_in_chunks(const unsigned int n, const Sums &zero, const Work &work)
  {
    std::array<Sums, n_chunks> sums;
    for_each_chunk(n,
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     sums[chunk] = zero;
                     for (unsigned int q = first; q < end; ++q)
                       work(q, sums[chunk]);
                   });
    for (unsigned int chunk = 1; chunk < n_chunks; ++chunk)
      for (const Side side : both_sides)
        sums[0][side] += sums[chunk][side];
    return std::move(sums[0]);
  }



  /** @name Where contact may be, or is, on the bone
   *  Returned for every control point of its surface: whether it belongs to an
   *  element there. */
  //@{
  /** Elements of the @p bone under the contact face of the @p implant, its edge
   *  included, in this configuration. */
  std::vector<bool>
  bone_control_points_under_implant(
    const NurbsSurface           &bone,
    const NurbsSurface           &implant,
    const InterfaceConfiguration &configuration);

  /** Control points of the elements of the @p bone on which the @p points are
   *  closed in their trial states, or have been: a share of these may be held.
   */
  std::vector<bool>
  touched_bone_control_points(const NurbsSurface            &bone,
                              const std::vector<SlavePoint> &points,
                              Side                           slave);
  //@}
} // namespace Debond
