#include <debond/interface/bilinear_bond.h>
#include <debond/interface/contact_interface.h>
#include <debond/interface/point_tangent.h>

#include <array>
#include <limits>
#include <optional>
#include <vector>

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
    // The factors of g_n: the old gap has the parts g^alpha along a_alpha at
    // xi_hat^n, and moves with them.
    double
    along_old_gap(const SlavePoint &point, const unsigned int b)
    {
      const SurfaceBasis    &old = point.trial.old_basis;
      const Eigen::Vector2d &gap = point.accepted.gap;
      return gap[0] * old.N_1[b] + gap[1] * old.N_2[b];
    }



    using PaddedNets = std::array<PaddedNet, 2>;

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



    // How the unknowns of the coupled system move w of a point: a column dw for
    // each that does, components of the chuck, and control points of both
    // surfaces in the frames of their bodies: 9 of a biquadratic element, and 9
    // more of the master if xi_hat and xi_hat^n lie in different ones.
    class ColumnsOfPoint
    {
    public:
      /** Of the share that rubs; or, with its own xi and the first three of w,
       *  of one that is held. @p by_chuck: nodal_motion() of each unknown
       *  component. */
      ColumnsOfPoint(const SlavePoint             &point,
                     const CohesiveShare          *held,
                     const Side                    slave,
                     const InterfaceConfiguration &configuration,
                     const std::vector<NodalSums> &by_chuck)
        : configuration(configuration)
        , by_chuck(by_chuck)
      {
        for (const auto &[component, unknown] : configuration.chuck_unknowns)
          {
            dw.col(n).setZero();
            dw(W::turn, n) = point.trial.turn_by_chuck[component];
            number[n++]    = unknown;
          }
        for (unsigned int a = 0; a < point.basis.size; ++a)
          add(slave,
              point.basis.control_point[a],
              {point.basis.N[a], 0., 0., point.basis.N[a], 0.});
        const SurfaceBasis &now = held ? held->basis : point.trial.basis,
                           &old = point.trial.old_basis;
        const bool slips        = !held && slides(point.trial.state.status),
                   same         = slips && old.element == now.element;
        for (unsigned int b = 0; b < now.size; ++b)
          add(other(slave),
              now.control_point[b],
              {-now.N[b],
               now.N_1[b],
               now.N_2[b],
               same ? -old.N[b] : 0.,
               same ? along_old_gap(point, b) : 0.});
        for (unsigned int b = 0; slips && !same && b < old.size; ++b)
          add(other(slave),
              old.control_point[b],
              {0., 0., 0., -old.N[b], along_old_gap(point, b)});
      }

      // Of this share; and, as its damage changes the friction of the other
      // one, which moves xi_hat, of that.
      void
      add_tangent(const SlavePoint     &point,
                  const CohesiveShare  &share,
                  const ColumnsOfPoint *rubbing,
                  Eigen::MatrixXd      &matrix) const
      {
        const Vector3d       t = point.JxW * point.trial.traction;
        Matrix<double, 9, 1> by_damage;
        by_damage << point.JxW * point.trial.by_damage.traction,
          -t * point.trial.by_damage.xi[0], -t * point.trial.by_damage.xi[1];
        for (unsigned int j = 0; j < n; ++j)
          {
            const Matrix<double, 9, 1> column = dw.col(j).head<9>();
            const Vector3d             force  = point.JxW * share.dt * column;
            const Rows rows = dw.topLeftCorner(3, n).transpose() * force;
            for (unsigned int i = 0; i < n; ++i)
              matrix(number[i], number[j]) += rows[i];
            if (rubbing == nullptr)
              continue;
            const Rows other_rows =
              rubbing->dw.topLeftCorner(9, rubbing->n).transpose() * by_damage *
              share.ddamage.dot(column);
            for (unsigned int i = 0; i < rubbing->n; ++i)
              matrix(rubbing->number[i], number[j]) += other_rows[i];
          }
      }

      // A row is the force on g, a_1 and a_2 along their motion with the row's
      // unknown, a column its change with the column's unknown.
      void
      add_tangent(const SlavePoint &point, Eigen::MatrixXd &matrix) const
      {
        const Vector3d             t = point.JxW * point.trial.traction;
        Matrix<double, 9, W::size> force; // by w, as in add_product()
        force << point.JxW * point.trial.dt, -t * point.trial.dxi.row(0),
          -t * point.trial.dxi.row(1);
        const Matrix<double, 9, Eigen::Dynamic, 0, 9, max_unknowns> changes =
          force * dw.leftCols(n);
        // one product for all columns, as such small ones cost calls
        Matrix<double,
               Eigen::Dynamic,
               Eigen::Dynamic,
               0,
               max_unknowns,
               max_unknowns>
          block(n, n);
        block.noalias() = dw.topLeftCorner(9, n).transpose() * changes;
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            matrix(number[i], number[j]) += block(i, j);
      }

    private:
      /** A control point that moves the vectors of w with these factors. */
      void
      add(const Side                  s,
          const unsigned int          control_point,
          const Matrix<double, 1, 5> &factors)
      {
        for (unsigned int k = 0; k < by_chuck.size(); ++k)
          dw.col(k).head<W::turn>() +=
            (by_chuck[k][s].col(control_point) * factors).reshaped();
        const auto           &side  = configuration.side[s];
        const Eigen::Matrix3d frame = control_point >= side.turns.size() ?
                                        side.frame :
                                        side.frame * side.turns[control_point];
        for (unsigned int c = 0; c < 3; ++c)
          // A control point that is fixed, out of reach of contact or of a
          // rigid body has no number.
          if (const int unknown = side.unknown_of[3 * control_point + c];
              unknown >= 0)
            {
              dw.col(n) << (frame.col(c) * factors).reshaped(), 0.;
              number[n++] = unknown;
            }
      }

      static constexpr int max_unknowns = 3 * 27 + 6;
      using Rows = Matrix<double, Eigen::Dynamic, 1, 0, max_unknowns, 1>;

      const InterfaceConfiguration         &configuration;
      const std::vector<NodalSums>         &by_chuck;
      Matrix<double, W::size, max_unknowns> dw;
      std::array<int, max_unknowns>         number;
      unsigned int                          n = 0;
    };
  } // namespace



  // What a product takes of a point lies scattered among what the update has
  // left, and a solver makes several products with one tangent: so it is
  // gathered first. Each of the vectors of w is a sum over control points: x
  // with the factors N_A of the slave; y, a_1 and a_2 with N_B, N_B,1 and N_B,2
  // of the master at xi_hat; y_n with N_B at xi_hat^n, and g_n there. The angle
  // changes with the chuck alone.
  PointTangent::PointTangent(const SlavePoint &point)
    : on_slave(point.basis)
    , on_master(point.trial.basis)
    , on_old(point.trial.old_basis)
    , slips(slides(point.trial.state.status))
  {
    dt_dxi_1 << point.JxW * point.trial.dt, point.trial.dxi.row(0);
    dxi_2 << point.trial.dxi.row(1).head<W::turn>().reshaped(3, 5),
      Matrix<double, 1, 5>::Zero();
    dxi_2_by_turn = point.trial.dxi(1, W::turn);
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



  // The control points move w, by which traction and xi_hat change, and with
  // them the forces of the point, which go back the other way. It exerts N_A t
  // on the slave and -N_B(xi_hat) t on the master, Eq. (36), so they change in
  // two ways: t changes, and N_B becomes N_B + N_B,alpha dxi^alpha. The
  // reference area JxW [mm^2] does not change. While a point sticks its xi_hat
  // stays, and y_n has no part.
  //
  // Vectors of three have a zero as the fourth number: the processor adds and
  // multiplies four at once.
  void
  PointTangent::add_product(const PaddedNet            &slave,
                            const PaddedNet            &master,
                            const Matrix<double, 6, 1> &chuck,
                            PaddedNet                  &slave_force,
                            PaddedNet                  &master_force) const
  {
    using Eigen::Vector4d;
    Matrix<double, 4, 5> w = Matrix<double, 4, 5>::Zero();
    for (unsigned int a = 0; a < on_slave.size; ++a)
      w.col(0) += on_slave.N[a][0] * slave.col(on_slave.control_point[a]);
    w.col(3) = w.col(0);
    for (unsigned int b = 0; b < on_master.size; ++b)
      {
        const Vector4d p = master.col(on_master.control_point[b]);
        w.col(0) -= on_master.N[b][0] * p;
        w.col(1) += on_master.N[b][1] * p;
        w.col(2) += on_master.N[b][2] * p;
      }
    for (unsigned int b = 0; slips && b < on_old.size; ++b)
      {
        const Vector4d p = master.col(on_old.control_point[b]);
        w.col(3) -= on_old.N[b][0] * p;
        w.col(4) += on_old.N[b][1] * p;
      }
    const double turn   = chuck.dot(turn_by_chuck);
    Vector4d     change = turn * dt_dxi_1.col(W::turn); // JxW dt, dxi^1
    for (unsigned int k = 0; k < (slips ? 5 : 3); ++k)
      {
        const Vector4d part = w(0, k) * dt_dxi_1.col(3 * k) +
                              w(1, k) * dt_dxi_1.col(3 * k + 1) +
                              w(2, k) * dt_dxi_1.col(3 * k + 2);
        change += part;
      }
    const Vector4d by_1 = change[3] * t,
                   by_2 =
                     (dxi_2.cwiseProduct(w).sum() + turn * dxi_2_by_turn) * t;
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



  void
  ContactInterface::gather_tangent() const
  {
    if (tangent_is_gathered)
      return;
    for_each_chunk(points.size(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     tangent[chunk].clear();
                     tangent[chunk].reserve(end - first);
                     // an open point has no force and no tangent
                     for (unsigned int q = first; q < end; ++q)
                       if (points[q].trial.state.status != PointStatus::open)
                         tangent[chunk].emplace_back(points[q]);
                   });
    tangent_is_gathered = true;
  }



  // Those of shares that are held: few scenes have any, so that nothing is
  // gathered for them.
  void
  ContactInterface::add_products_of_shares(
    const unsigned int              chunk,
    const std::array<PaddedNet, 2> &moved,
    std::array<PaddedNet, 2>       &sums) const
  {
    const auto spread_to = [&](const SurfaceBasis         &basis,
                               const Eigen::Vector3d      &factors,
                               const Matrix<double, 3, 3> &forces,
                               const Side                  side) {
      for (unsigned int b = 0; b < basis.size; ++b)
        sums[side].col(basis.control_point[b]).head<3>() +=
          factors[0] * basis.N[b] * forces.col(0) +
          factors[1] * basis.N_1[b] * forces.col(1) +
          factors[2] * basis.N_2[b] * forces.col(2);
    };
    const Side        master = other(slave);
    const Vector3d    along_x(1., 0., 0.);
    const std::size_t n = shares.size();
    for (std::size_t q = n * chunk / n_chunks; q < n * (chunk + 1) / n_chunks;
         ++q)
      {
        const SlavePoint    &point = points[q];
        const CohesiveShare &share = shares[q];
        if (!share.holds)
          continue;
        Matrix<double, 9, 1> w = Matrix<double, 9, 1>::Zero();
        for (unsigned int a = 0; a < point.basis.size; ++a)
          w.head<3>() +=
            point.basis.N[a] *
            moved[slave].col(point.basis.control_point[a]).head<3>();
        for (unsigned int b = 0; b < share.basis.size; ++b)
          {
            const Vector3d y =
              moved[master].col(share.basis.control_point[b]).head<3>();
            w.head<3>() -= share.basis.N[b] * y;
            w.segment<3>(3) += share.basis.N_1[b] * y;
            w.segment<3>(6) += share.basis.N_2[b] * y;
          }
        Matrix<double, 3, 3> f = Matrix<double, 3, 3>::Zero();
        f.col(0)               = point.JxW * share.dt * w;
        spread_to(point.basis, along_x, f, slave);
        spread_to(share.basis, -along_x, f, master);
        if (point.trial.state.status == PointStatus::open)
          continue;
        // how the damage changes the friction of the other share
        const double   damage = share.ddamage.dot(w);
        const Vector3d t      = point.JxW * damage * point.trial.traction;
        f << point.JxW * damage * point.trial.by_damage.traction,
          t * point.trial.by_damage.xi[0], t * point.trial.by_damage.xi[1];
        spread_to(point.basis, along_x, f, slave);
        spread_to(point.trial.basis, Vector3d(-1., -1., -1.), f, master);
      }
  }



  // The tangent without a matrix, for iterative solvers: the unknowns move the
  // control points. GMRES needs no more than this product, where the matrix
  // would have to be summed first, point by point. Sums go as in evaluate():
  // threads change no digit.
  void
  ContactInterface::apply_tangent(const InterfaceConfiguration &configuration,
                                  const Eigen::VectorXd        &direction,
                                  Eigen::VectorXd              &result) const
  {
    gather_tangent();
    const PaddedNets     moved = padded(nodal_motion(direction, configuration));
    Matrix<double, 6, 1> chuck = Matrix<double, 6, 1>::Zero();
    for (const auto &[component, number] : configuration.chuck_unknowns)
      chuck[component] = direction[number];
    const auto sums =
      sum_in_chunks(n_chunks,
                    padded(zero_sums(configuration)),
                    [&](const unsigned int chunk, PaddedNets &forces) {
                      for (const PointTangent &point : tangent[chunk])
                        point.add_product(moved[slave],
                                          moved[other(slave)],
                                          chuck,
                                          forces[slave],
                                          forces[other(slave)]);
                      add_products_of_shares(chunk, moved, forces);
                    });
    NodalSums by_all{{sums[0].topRows<3>(), sums[1].topRows<3>()}};
    average(by_all);
    add_in_unknowns(by_all, configuration, 1., result);
  }



  // The same tangent as a matrix: a sum of dense blocks, as points are
  // independent. It is formed only where the system is assembled after all, as
  // a preconditioner: for a stiff interface, or an unknown chuck, which the
  // bulk does not resist (doc/explanation/solution.md). What rotation does to
  // frames and lever arms under forces that stay is not in it; CoupledTangent
  // adds that.
  void
  ContactInterface::add_tangent(const InterfaceConfiguration &configuration,
                                Eigen::MatrixXd              &matrix) const
  {
    std::vector<NodalSums> by_chuck;
    for (const auto &unknown : configuration.chuck_unknowns)
      by_chuck.push_back(
        nodal_motion(Eigen::VectorXd::Unit(matrix.cols(), unknown.second),
                     configuration));
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const SlavePoint             &point = points[q];
        std::optional<ColumnsOfPoint> rubbing;
        if (point.trial.state.status != PointStatus::open)
          {
            rubbing.emplace(point, nullptr, slave, configuration, by_chuck);
            rubbing->add_tangent(point, matrix);
          }
        if (!shares.empty() && shares[q].holds)
          ColumnsOfPoint(point, &shares[q], slave, configuration, by_chuck)
            .add_tangent(point,
                         shares[q],
                         rubbing ? &*rubbing : nullptr,
                         matrix);
      }
  }



  // The damage of a share that is held stands for its opening. How far the
  // share beside it slides does not count: that grows without any loss of bond,
  // and on the way back as well.
  void
  ContactInterface::add_path_of_share(const unsigned int q,
                                      NodalSums         &gradient) const
  {
    const SlavePoint          &point = points[q];
    const CohesiveShare       &share = shares[q];
    const Matrix<double, 9, 1> d     = point.JxW *
                                   law.joint->cohesion->length_of_damage() *
                                   share.ddamage.transpose();
    spread(point.basis, d.head<3>(), gradient[slave]);
    ControlNet &master = gradient[master_side()];
    for (unsigned int b = 0; b < share.basis.size; ++b)
      master.col(share.basis.control_point[b]) +=
        share.basis.N_1[b] * d.segment<3>(3) +
        share.basis.N_2[b] * d.segment<3>(6) - share.basis.N[b] * d.head<3>();
  }



  // How g_s and the opening of a point change its update has left, too, with
  // the motion of xi_hat in it.
  //
  // The mean over the area that faced the implant at the start [mm] is the
  // measure of a path of equilibrium: angle, force and torque may all turn back
  // where a brittle bond snaps back, but neither g_s nor the largest opening
  // ever falls. Newton's method is bordered with its derivative, which
  // therefore is as exact as that of the forces.
  PathLength
  ContactInterface::path_length(
    const InterfaceConfiguration &configuration) const
  {
    PathLength result;
    result.gradient = zero_sums(configuration);
    double area     = 0.;
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const SlavePoint         &point = points[q];
        const ContactPointResult &trial = point.trial;
        if (!point.faces_implant)
          continue;
        area += point.JxW;
        result.value +=
          point.JxW *
          (law.joint->cohesion ?
             law.joint->cohesion->length_of_damage() * trial.state.damage :
             trial.state.slip + law.joint->opened(trial.state));
        if (!shares.empty() && shares[q].holds)
          add_path_of_share(q, result.gradient);
        if (law.joint->cohesion || trial.state.status == PointStatus::open ||
            trial.dpath.isZero(0.))
          continue;
        const Matrix<double, W::size, 1> d =
          point.JxW * trial.dpath.transpose();
        const SurfaceBasis &now = trial.basis, &old = trial.old_basis;
        ControlNet         &master = result.gradient[master_side()];
        const Vector3d      by_gap = d.segment<3>(W::gap),
                       by_trial    = d.segment<3>(W::trial_gap);
        spread(point.basis, by_gap + by_trial, result.gradient[slave]);
        for (unsigned int b = 0; b < now.size; ++b)
          master.col(now.control_point[b]) += now.N_1[b] * d.segment<3>(W::a1) +
                                              now.N_2[b] * d.segment<3>(W::a2) -
                                              now.N[b] * by_gap;
        for (unsigned int b = 0; slides(trial.state.status) && b < old.size;
             ++b)
          master.col(old.control_point[b]) +=
            along_old_gap(point, b) * d.segment<3>(W::old_gap) -
            old.N[b] * by_trial;
        result.by_chuck += d[W::turn] * trial.turn_by_chuck;
      }
    // dimensionless gradient: mm per mm of a control point
    result.value /= area;
    average(result.gradient);
    for (ControlNet &gradient : result.gradient)
      gradient /= area;
    result.by_chuck /= area;
    return result;
  }



  double
  ContactInterface::path_left() const
  {
    if (!law.joint->cohesion)
      return std::numeric_limits<double>::infinity();
    double left = 0., area = 0.;
    for (const SlavePoint &point : points)
      if (point.faces_implant)
        {
          area += point.JxW;
          if (point.trial.state.joined && point.phi_0 > 0.)
            left += point.JxW * (1. - point.trial.state.damage);
        }
    return law.joint->cohesion->length_of_damage() * left / area;
  }
} // namespace Debond
