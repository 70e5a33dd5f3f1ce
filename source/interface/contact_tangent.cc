#include <debond/interface/contact_interface.h>
#include <debond/interface/point_tangent.h>

#include <tuple>

namespace Debond
{
  // The tangent of the nodal forces of Eq. (36). Where the update of a point
  // says how its traction changes with the place of slave point and master
  // (contact_point.cc, slip_problem.cc), this file carries that to the unknowns
  // of the whole: C = Q^T (df/dx) Q, which is added to the condensed stiffness
  // S of the bodies. It is exact, with the sliding of xi_hat, the softening of
  // the law and the turning of normal and slip direction, and so it is not
  // symmetric. Dropping any of that would cost iterations, not accuracy: the
  // residual decides what a solution is.
  using Eigen::Matrix;
  using Eigen::Vector3d;

  namespace
  {
    /** A change of w of a point, see ContactPointResult. */
    using LocalVector = Matrix<double, ContactPointResult::n_w, 1>;



    // The local unknowns of a point are w = (x, y, a_1, a_2, y_n, g_n, turn),
    // see ContactPointResult: six vectors, each of which is a sum over control
    // points with the factors N_A of the slave, N_B, N_B,1 and N_B,2 of the
    // master at xi_hat, and of the master at xi_hat^n N_B and, with the parts
    // of the old gap, g^alpha N_B,alpha; and an angle, which changes with the
    // chuck alone.
    //
    // Two forms of the tangent follow. Both go through w, so that they share
    // the derivatives of the update, 3 x 19 and 2 x 19 numbers for a point.
    //
    // The factors of g_n: the old gap has the parts g^alpha along a_alpha at
    // xi_hat^n, and moves with them.
    double
    along_old_gap(const SlavePoint &point, const unsigned int b)
    {
      const SurfaceBasis    &old = point.trial.old_basis;
      const Eigen::Vector2d &gap = point.accepted.gap;
      return gap[0] * old.N_1[b] + gap[1] * old.N_2[b];
    }



    // dw when the control points of both surfaces move. While a point sticks
    // its xi_hat stays, and y_n has no part. Parameters are held fixed here:
    // how xi_hat moves is in the derivatives dt/dw and dxi/dw already, by the
    // implicit function theorem.
    LocalVector
    local_motion(const SlavePoint &point,
                 const Side        slave,
                 const NodalSums  &moved,
                 const double      turn)
    {
      const NodalSums::value_type &master = moved[other(slave)];
      SurfaceGeometry              motion;
      // The same sums that give y and a_alpha from positions, Eqs. (23) and
      // (33), give their changes from motions, since the basis does not depend
      // on positions.
      contract(point.trial.basis, master, false, motion);
      LocalVector dw    = LocalVector::Zero();
      dw.segment<3>(0)  = interpolate(point.basis, moved[slave]);
      dw.segment<3>(3)  = motion.y;
      dw.segment<3>(6)  = motion.a1;
      dw.segment<3>(9)  = motion.a2;
      dw[dw.size() - 1] = turn;
      if (point.trial.state.status != PointStatus::slip)
        return dw;
      const SurfaceBasis &old = point.trial.old_basis;
      dw.segment<3>(12)       = interpolate(old, master);
      for (unsigned int b = 0; b < old.size; ++b)
        dw.segment<3>(15) +=
          along_old_gap(point, b) * master.col(old.control_point[b]);
      return dw;
    }



    // Forces on w; none acts at xi_hat^n, which the traction does not see.
    using LocalForce = Matrix<double, 12, 1>;

    // The transpose: what they amount to at the control points.
    //
    // That both use the same factors makes the tangent consistent with the
    // residual; it is also how the derivative of a function of w becomes one by
    // nodal positions, which mean_slip() needs.
    void
    spread_local(const SlavePoint &point,
                 const Side        slave,
                 const LocalForce &force,
                 NodalSums        &sums)
    {
      const SurfaceBasis &basis  = point.trial.basis;
      ControlNet         &master = sums[other(slave)];
      spread(point.basis, force.head<3>(), sums[slave]);
      // y, a_1 and a_2 are moved by the same control points of the master, with
      // N_B, N_B,1 and N_B,2: three parts of w in one loop.
      for (unsigned int b = 0; b < basis.size; ++b)
        master.col(basis.control_point[b]) +=
          basis.N[b] * force.segment<3>(3) +
          basis.N_1[b] * force.segment<3>(6) +
          basis.N_2[b] * force.segment<3>(9);
    }



    // A point exerts the nodal forces N_A t on the slave and -N_B(xi_hat) t on
    // the master, Eq. (36). They change in two ways: t changes, and xi_hat
    // moves along the master, where N_B becomes N_B + N_B,alpha dxi^alpha. As
    // forces on w:
    LocalForce
    change_of_force(const SlavePoint &point, const LocalVector &dw)
    {
      // dt on x, -dt on y, and -t dxi^alpha on a_alpha: the force acts at the
      // old traction while its place moves. The reference area JxW [mm^2] does
      // not change.
      const Vector3d        dt  = point.JxW * (point.trial.dt * dw);
      const Vector3d        t   = point.JxW * point.trial.traction;
      const Eigen::Vector2d dxi = point.trial.dxi * dw;
      LocalForce            force;
      force.segment<3>(0) = dt;
      force.segment<3>(3) = -dt;
      force.segment<3>(6) = -dxi[0] * t;
      force.segment<3>(9) = -dxi[1] * t;
      return force;
    }



    // How the unknowns of the coupled system move w: a column dw for each that
    // does, control points of both surfaces in the frames of their bodies, and
    // components of the chuck.
    //
    // A point has 27 such unknowns on each side at most, 9 control points of a
    // biquadratic element times three, and 27 more if xi_hat and xi_hat^n lie
    // in different elements; 6 belong to the chuck.
    class UnknownMotions
    {
    public:
      UnknownMotions(const SlavePoint             &point,
                     const Side                    slave,
                     const InterfaceConfiguration &configuration)
      {
        // x depends on the slave's control points alone
        const auto &master = configuration.side[other(slave)];
        for (unsigned int a = 0; a < point.basis.size; ++a)
          add(configuration.side[slave],
              point.basis.control_point[a],
              {point.basis.N[a], 0., 0., 0., 0., 0.});
        // y_n depends on the same control points as y, unless the point slid
        // from one element of the master to another
        const SurfaceBasis &now = point.trial.basis,
                           &old = point.trial.old_basis;
        const bool slips        = point.trial.state.status == PointStatus::slip;
        const bool same         = slips && old.element == now.element;
        for (unsigned int b = 0; b < now.size; ++b)
          add(master,
              now.control_point[b],
              {0.,
               now.N[b],
               now.N_1[b],
               now.N_2[b],
               same ? old.N[b] : 0.,
               same ? along_old_gap(point, b) : 0.});
        for (unsigned int b = 0; slips && !same && b < old.size; ++b)
          add(master,
              old.control_point[b],
              {0., 0., 0., 0., old.N[b], along_old_gap(point, b)});
      }

      void
      add(const int unknown, const LocalVector &motion)
      {
        if (unknown < 0)
          return;
        // A control point that is fixed, out of reach of contact or of a rigid
        // body has no number.
        dw.col(n)   = motion;
        number[n++] = unknown;
      }

      // A row is the force on w along the motion with the row's unknown, a
      // column its change with the column's unknown, by the total derivatives
      // of traction and xi_hat that the update of the point has left.
      //
      // By pairs of unknowns: 54 squared numbers for a point of two biquadratic
      // faces, which is why iterative solvers take apply_tangent().
      void
      add_tangent(const SlavePoint &point, Eigen::MatrixXd &matrix) const
      {
        for (unsigned int j = 0; j < n; ++j)
          {
            const Rows rows = dw.topLeftCorner(12, n).transpose() *
                              change_of_force(point, dw.col(j));
            for (unsigned int i = 0; i < n; ++i)
              matrix(number[i], number[j]) += rows[i];
          }
      }

    private:
      void
      add(const InterfaceConfiguration::Surface &side,
          const unsigned int                     control_point,
          const Matrix<double, 1, 6>            &factors)
      {
        // Unknowns are displacements in the frame of their body: its axes are
        // turned into space by Q. Columns of Q are the three directions.
        for (unsigned int c = 0; c < 3; ++c)
          {
            LocalVector motion;
            motion << (side.frame.col(c) * factors).reshaped(), 0.;
            add(side.unknown_of[3 * control_point + c], motion);
          }
      }

      static constexpr int max_unknowns = 3 * 27 + 6;
      using Rows = Matrix<double, Eigen::Dynamic, 1, 0, max_unknowns, 1>;

      Matrix<double, ContactPointResult::n_w, max_unknowns> dw;
      std::array<int, max_unknowns>                         number;
      unsigned int                                          n = 0;
    };
  } // namespace



  // Points are independent, so the matrix is a sum of dense blocks. The chuck
  // moves all control points of the implant at once: what that does to w of a
  // point is found as for any other motion of the control points.
  //
  // It is formed only where the system is assembled after all, as a
  // preconditioner: for a stiff interface, or an unknown chuck, which the bulk
  // does not resist (doc/solution.md). What rotation does to frames and lever
  // arms under forces that stay is not in it; CoupledTangent adds that.
  void
  ContactInterface::add_tangent(const InterfaceConfiguration &configuration,
                                Eigen::MatrixXd              &matrix) const
  {
    std::vector<std::tuple<unsigned int, int, NodalSums>> chuck;
    for (const auto &[component, number] : configuration.chuck_unknowns)
      chuck.emplace_back(component,
                         number,
                         nodal_motion(Eigen::VectorXd::Unit(matrix.cols(),
                                                            number),
                                      configuration));
    for (const SlavePoint &point : points)
      // An open point has no force and no tangent.
      if (point.trial.state.status != PointStatus::open)
        {
          UnknownMotions motions(point, slave, configuration);
          for (const auto &[component, number, moved] : chuck)
            motions.add(number,
                        local_motion(point,
                                     slave,
                                     moved,
                                     point.trial.turn_by_chuck[component]));
          motions.add_tangent(point, matrix);
        }
  }



  // What a product takes of a point lies scattered among what the update has
  // left, and a solver makes several products with one tangent: so it is
  // gathered first.
  PointTangent::PointTangent(const SlavePoint &point)
    : on_slave(point.basis)
    , on_master(point.trial.basis)
    , on_old(point.trial.old_basis)
    , slips(point.trial.state.status == PointStatus::slip)
  {
    dt_dxi_1 << point.JxW * point.trial.dt, point.trial.dxi.row(0);
    dxi_2.setZero();
    for (unsigned int k = 0; k < 6; ++k)
      dxi_2.segment<3>(4 * k) =
        point.trial.dxi.row(1).segment<3>(3 * k).transpose();
    dxi_2_by_turn = point.trial.dxi(1, 18);
    t << point.JxW * point.trial.traction, 0.;
    turn_by_chuck = point.trial.turn_by_chuck;
    for (unsigned int a = 0; a < on_slave.size; ++a)
      on_slave.N[a] = {{point.basis.N[a], 0., 0.}};
    for (unsigned int b = 0; b < on_master.size; ++b)
      on_master.N[b] = {{point.trial.basis.N[b],
                         point.trial.basis.N_1[b],
                         point.trial.basis.N_2[b]}};
    for (unsigned int b = 0; slips && b < on_old.size; ++b)
      on_old.N[b] = {{point.trial.old_basis.N[b], along_old_gap(point, b), 0.}};
  }



  // The same tangent without a matrix, for iterative solvers: the unknowns move
  // the control points, these move w of every point, that changes its forces,
  // which go back the other way.
  //
  // GMRES needs no more than this product, where the matrix would have to be
  // summed first, point by point. Vectors of three have a zero as the fourth
  // number: the processor adds and multiplies four at once. Sums go as in
  // evaluate(): threads change no digit.
  void
  ContactInterface::apply_tangent(const InterfaceConfiguration &configuration,
                                  const Eigen::VectorXd        &direction,
                                  Eigen::VectorXd              &result) const
  {
    if (!tangent_is_gathered)
      gather_tangent();
    const NodalSums          motion = nodal_motion(direction, configuration);
    std::array<PaddedNet, 2> moved, zero;
    for (const Side side : both_sides)
      {
        zero[side].setZero(4, motion[side].cols());
        moved[side]              = zero[side];
        moved[side].topRows<3>() = motion[side];
      }
    Eigen::Matrix<double, 6, 1> chuck = Eigen::Matrix<double, 6, 1>::Zero();
    for (const auto &[component, number] : configuration.chuck_unknowns)
      chuck[component] = direction[number];
    const auto sums =
      sum_in_chunks(n_chunks,
                    zero,
                    [&](const unsigned int        chunk,
                        std::array<PaddedNet, 2> &forces) {
                      for (const PointTangent &point : tangent[chunk])
                        point.add_product(moved[slave],
                                          moved[other(slave)],
                                          chuck,
                                          forces[slave],
                                          forces[other(slave)]);
                    });
    add_in_unknowns({{sums[0].topRows<3>(), sums[1].topRows<3>()}},
                    configuration,
                    1.,
                    result);
  }



  void
  ContactInterface::gather_tangent() const
  {
    for_each_chunk(points.size(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     tangent[chunk].clear();
                     tangent[chunk].reserve(end - first);
                     for (unsigned int q = first; q < end; ++q)
                       if (points[q].trial.state.status != PointStatus::open)
                         tangent[chunk].emplace_back(points[q]);
                   });
    tangent_is_gathered = true;
  }



  void
  PointTangent::add_product(const PaddedNet                   &slave,
                            const PaddedNet                   &master,
                            const Eigen::Matrix<double, 6, 1> &chuck,
                            PaddedNet                         &slave_force,
                            PaddedNet &master_force) const
  {
    using Eigen::Vector4d;
    Eigen::Matrix<double, 4, 6> w = Eigen::Matrix<double, 4, 6>::Zero();
    for (unsigned int a = 0; a < on_slave.size; ++a)
      w.col(0) += on_slave.N[a][0] * slave.col(on_slave.control_point[a]);
    for (unsigned int b = 0; b < on_master.size; ++b)
      {
        const Vector4d p = master.col(on_master.control_point[b]);
        for (unsigned int k = 0; k < 3; ++k)
          w.col(1 + k) += on_master.N[b][k] * p;
      }
    for (unsigned int b = 0; slips && b < on_old.size; ++b)
      {
        const Vector4d p = master.col(on_old.control_point[b]);
        for (unsigned int k = 0; k < 2; ++k)
          w.col(4 + k) += on_old.N[b][k] * p;
      }
    const double turn   = chuck.dot(turn_by_chuck);
    Vector4d     change = turn * dt_dxi_1.col(18); // JxW dt, dxi^1
    for (unsigned int k = 0; k < (slips ? 6 : 4); ++k)
      {
        const Vector4d part = w(0, k) * dt_dxi_1.col(3 * k) +
                              w(1, k) * dt_dxi_1.col(3 * k + 1) +
                              w(2, k) * dt_dxi_1.col(3 * k + 2);
        change += part;
      }
    const double dxi_2_now = dxi_2.dot(w.reshaped()) + turn * dxi_2_by_turn;

    // as in change_of_force()
    const Vector4d by_1 = change[3] * t, by_2 = dxi_2_now * t;
    change[3] = 0.;
    for (unsigned int a = 0; a < on_slave.size; ++a)
      slave_force.col(on_slave.control_point[a]) += on_slave.N[a][0] * change;
    for (unsigned int b = 0; b < on_master.size; ++b)
      {
        const auto &N = on_master.N[b];
        master_force.col(on_master.control_point[b]) -=
          N[0] * change + N[1] * by_1 + N[2] * by_2;
      }
  }



  // How g_s changes the update of the point has left, too, with the motion of
  // xi_hat in it.
  //
  // The mean over the area that faced the implant at the start [mm] is the
  // measure of a path of equilibrium: angle and torque may both turn back where
  // a brittle bond snaps back, but g_s never falls. Newton's method is bordered
  // with its derivative, which therefore is as exact as that of the forces.
  MeanSlip
  ContactInterface::mean_slip(const InterfaceConfiguration &configuration) const
  {
    MeanSlip result;
    result.gradient = zero_sums(configuration);
    double area     = 0.;
    for (const SlavePoint &point : points)
      {
        const ContactPointResult &trial = point.trial;
        if (!point.faces_implant)
          continue;
        area += point.JxW;
        result.value += point.JxW * trial.state.slip;
        // Only a sliding point changes it. Where it has not moved the length
        // has no derivative; the gradient leaves it out.
        if (trial.state.status != PointStatus::slip || mode_now.frictionless ||
            trial.state.slip == point.accepted.slip)
          continue;
        const LocalVector   d   = point.JxW * trial.dslip.transpose();
        const SurfaceBasis &old = trial.old_basis;
        spread_local(point, slave, d.head<12>(), result.gradient);
        for (unsigned int b = 0; b < old.size; ++b)
          result.gradient[master_side()].col(old.control_point[b]) +=
            old.N[b] * d.segment<3>(12) +
            along_old_gap(point, b) * d.segment<3>(15);
        for (const auto &unknown : configuration.chuck_unknowns)
          result.by_chuck[unknown.first] +=
            d[18] * trial.turn_by_chuck[unknown.first];
      }
    // dimensionless gradient: mm of mean slip per mm of a control point
    result.value /= area;
    for (ControlNet &gradient : result.gradient)
      gradient /= area;
    result.by_chuck /= area;
    return result;
  }
} // namespace Debond
