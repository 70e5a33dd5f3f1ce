#include <debond/interface/point_motion.h>

namespace Debond
{
  using Eigen::Vector4d;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  PaddedNets
  padded(const NodalSums &sums)
  {
    PaddedNets result;
    for (const Side side : both_sides)
      {
        result[side].setZero(4, sums[side].cols());
        result[side].topRows<3>() = sums[side];
      }
    return result;
  }



  NodalSums
  without_padding(const PaddedNets &nets)
  {
    return {{nets[0].topRows<3>(), nets[1].topRows<3>()}};
  }



  PointMotion::PointMotion(const SlavePoint   &point,
                           const SurfaceBasis &held,
                           const Side          slave)
    : slides(false)
    , slave(slave)
    , n_slave(point.basis.size)
    , n_master(held.size)
    , of_slave(point.basis.control_point)
    , N(point.basis.N)
  {
    for (unsigned int b = 0; b < held.size; ++b)
      of_master[b] = {held.control_point[b],
                      {{-held.N[b], held.N_1[b], held.N_2[b], 0., 0.}}};
  }



  // A point that slides comes from where the master had other functions, of the
  // same control points if it stays in their element.
  PointMotion::PointMotion(const SlavePoint &point, const Side slave)
    : PointMotion(point, point.trial.basis, slave)
  {
    slides = Debond::slides(point.trial.state.status);
    if (!slides)
      return;
    const SurfaceBasis    &old = point.trial.old_basis;
    const Eigen::Vector2d &gap = point.accepted.gap;
    if (old.element != point.trial.basis.element)
      for (unsigned int b = 0; b < old.size; ++b)
        of_master[n_master++] = {old.control_point[b], {{0., 0., 0., 0., 0.}}};
    for (unsigned int b = 0; b < old.size; ++b)
      {
        auto &factor = of_master[n_master - old.size + b].factor;
        factor[3]    = -old.N[b];
        factor[4]    = gap[0] * old.N_1[b] + gap[1] * old.N_2[b];
      }
  }



  PointMotion::Vectors<5>
  PointMotion::gather(const PaddedNets &u) const
  {
    const PaddedNet &on_slave = u[slave], &on_master = u[other(slave)];
    const Vector4d   zero = Vector4d::Zero();
    // sums in registers, which those of a matrix would not be
    Vector4d x = zero;
    for (unsigned int a = 0; a < n_slave; ++a)
      x += N[a] * on_slave.col(of_slave[a]);
    Vector4d gap = x, a_1 = zero, a_2 = zero, trial_gap = zero, old_gap = zero;
    if (slides)
      trial_gap = x;
    for (unsigned int b = 0; b < n_master; ++b)
      {
        const auto    &factor = of_master[b].factor;
        const Vector4d p      = on_master.col(of_master[b].control_point);
        gap += factor[0] * p;
        a_1 += factor[1] * p;
        a_2 += factor[2] * p;
        if (!slides)
          continue;
        trial_gap += factor[3] * p;
        old_gap += factor[4] * p;
      }
    Vectors<5> w;
    w << gap, a_1, a_2, trial_gap, old_gap;
    return w;
  }



  // A control point that is fixed, out of reach of contact or of a rigid body
  // has no number.
  PointColumns::PointColumns(const PointMotion            &motion,
                             const Vector6                &turn_by_chuck,
                             const InterfaceConfiguration &configuration,
                             const std::vector<NodalSums> &by_chuck)
  {
    for (const auto &[component, unknown] : configuration.chuck_unknowns)
      {
        dw.col(n).setZero();
        dw(W::turn, n) = turn_by_chuck[component];
        number[n++]    = unknown;
      }
    motion.for_each_control_point([&](const Side         side,
                                      const unsigned int control_point,
                                      const auto        &factors) {
      for (unsigned int k = 0; k < by_chuck.size(); ++k)
        dw.col(k).head<W::turn>() +=
          (by_chuck[k][side].col(control_point) * factors).reshaped();
      const auto &surface = configuration.side[side];
      for (unsigned int c = 0; c < 3; ++c)
        if (const int unknown = surface.unknown_of[3 * control_point + c];
            unknown >= 0)
          {
            dw.col(n) << (surface.frame.col(c) * factors).reshaped(), 0.;
            number[n++] = unknown;
          }
    });
  }



  PointTangent::PointTangent(const SlavePoint &point, const Side slave)
    : motion(point, slave)
    , dxi_2_by_turn(point.trial.dxi(1, W::turn))
    , turn_by_chuck(point.trial.turn_by_chuck)
  {
    dt_dxi_1 << point.JxW * point.trial.dt, point.trial.dxi.row(0);
    dxi_2 << point.trial.dxi.row(1).head<W::turn>().reshaped(3, 5),
      Eigen::Matrix<double, 1, 5>::Zero();
    t << point.JxW * point.trial.traction, 0.;
  }



  // The control points move w, by which traction and xi_hat change, and with
  // them the forces of the point, which go back the other way. It exerts N_A t
  // on the slave and -N_B(xi_hat) t on the master, Eq. (36), so they change in
  // two ways: t changes, and N_B becomes N_B + N_B,alpha dxi^alpha. The
  // reference area JxW [mm^2] does not change.
  void
  PointTangent::add_product(const PaddedNets &u,
                            const Vector6    &chuck,
                            PaddedNets       &forces) const
  {
    const auto   w      = motion.gather(u);
    const double turn   = chuck.dot(turn_by_chuck);
    Vector4d     change = turn * dt_dxi_1.col(W::turn); // JxW dt, dxi^1
    for (unsigned int k = 0; k < (motion.slides ? 5 : 3); ++k)
      {
        const Vector4d part = w(0, k) * dt_dxi_1.col(3 * k) +
                              w(1, k) * dt_dxi_1.col(3 * k + 1) +
                              w(2, k) * dt_dxi_1.col(3 * k + 2);
        change += part;
      }
    PointMotion::Vectors<3> f;
    f << change, -change[3] * t,
      -(dxi_2.cwiseProduct(w).sum() + turn * dxi_2_by_turn) * t;
    f(3, 0) = 0.;
    motion.scatter(f, forces);
  }
} // namespace Debond
