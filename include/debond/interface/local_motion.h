#ifndef debond_interface_local_motion_h
#define debond_interface_local_motion_h

#include <debond/interface/interface_configuration.h>

namespace Debond
{
  /** A change of w of a point, see ContactPointResult. */
  using LocalVector = Eigen::Matrix<double, ContactPointResult::n_w, 1>;

  /** dw of a closed point when the control points of both surfaces move, and
   *  its way turns by @p turn more [rad]; parameters stay. */
  LocalVector
  local_motion(const SlavePoint &point,
               Side              slave,
               const NodalSums  &moved,
               double            turn);

  /** Adds what changes of traction, times JxW [N], and of xi_hat do to the
   *  nodal forces of a closed point. */
  void
  spread_change(const SlavePoint      &point,
                Side                   slave,
                const Eigen::Vector3d &dt,
                const Eigen::Vector2d &dxi,
                NodalSums             &sums);



  /** @name Several changes at once
   *  What a point costs is to fetch what belongs to it; to multiply several
   *  changes with that costs little more than one. A row for each change. */
  //@{
  constexpr unsigned int n_lanes = 8;
  template <int N>
  using Lanes = Eigen::Matrix<double, n_lanes, N>;

  /** Like NodalSums: a column is a Lanes<3>. */
  using LaneNet  = Eigen::Matrix<double, 3 * n_lanes, Eigen::Dynamic>;
  using LaneSums = std::array<LaneNet, 2>;

  LaneSums
  zero_lanes(const InterfaceConfiguration &configuration);
  void
  set_lane(LaneSums &lanes, unsigned int lane, const NodalSums &sums);
  NodalSums
  get_lane(const LaneSums &lanes, unsigned int lane);

  /** Of a point of a surface: its place, or that and the tangents. */
  Lanes<3>
  interpolate_place(const SurfaceBasis &basis, const LaneNet &moved);
  Lanes<9>
  interpolate_tangents(const SurfaceBasis &basis, const LaneNet &moved);

  Lanes<ContactPointResult::n_w>
  local_motion(const SlavePoint &point, Side slave, const LaneSums &moved);
  void
  spread_change(const SlavePoint &point,
                Side              slave,
                const Lanes<3>   &dt,
                const Lanes<2>   &dxi,
                LaneSums         &sums);
  //@}
} // namespace Debond
#endif
