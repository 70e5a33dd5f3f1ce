#include <debond/interface/contact_interface.h>

namespace Debond
{
  using Eigen::Matrix;
  using Eigen::Vector3d;

  namespace
  {
    // The local unknowns of a point are w = (x, y, a_1, a_2, y_n), see
    // ContactPointResult: five vectors, each of which is a sum over control
    // points with the factors N_A of the slave, N_B, N_B,1 and N_B,2 of the
    // master at xi_hat, and N_B of the master at xi_hat^n.
    using LocalVector = Matrix<double, 15, 1>;

    // dw when the control points of both surfaces move. While a point sticks
    // its xi_hat stays, and y_n has no part.
    LocalVector
    local_motion(const SlavePoint &point,
                 const Side        slave,
                 const NodalSums  &moved)
    {
      const NodalSums::value_type &master = moved[other(slave)];
      SurfaceGeometry              motion;
      contract(point.trial.basis, master, false, motion);
      LocalVector dw;
      dw << interpolate(point.basis, moved[slave]), motion.y, motion.a1,
        motion.a2, Vector3d::Zero();
      if (point.trial.state.status == PointStatus::slip)
        dw.tail<3>() = interpolate(point.trial.old_basis, master);
      return dw;
    }



    // The transpose: what forces on w amount to at the control points.
    void
    spread_local(const SlavePoint  &point,
                 const Side         slave,
                 const LocalVector &force,
                 NodalSums         &sums)
    {
      const SurfaceBasis &basis  = point.trial.basis;
      ControlNet         &master = sums[other(slave)];
      spread(point.basis, force.head<3>(), sums[slave]);
      for (unsigned int b = 0; b < basis.size; ++b)
        master.col(basis.control_point[b]) +=
          basis.N[b] * force.segment<3>(3) +
          basis.N_1[b] * force.segment<3>(6) +
          basis.N_2[b] * force.segment<3>(9);
      if (point.trial.state.status == PointStatus::slip)
        spread(point.trial.old_basis, force.tail<3>(), master);
    }



    // A point exerts the nodal forces N_A t on the slave and -N_B(xi_hat) t on
    // the master, Eq. (36). They change in two ways: t changes, and xi_hat
    // moves along the master, where N_B becomes N_B + N_B,alpha dxi^alpha. As
    // forces on w:
    LocalVector
    change_of_force(const SlavePoint      &point,
                    const Vector3d        &dt,
                    const Eigen::Vector2d &dxi)
    {
      const Vector3d &t = point.trial.traction;
      LocalVector     force;
      force << dt, -dt, -dxi[0] * t, -dxi[1] * t, Vector3d::Zero();
      return point.JxW * force;
    }



    // The dense tangent of one point: rows and columns are the unknowns that
    // move it. A column is d(t, xi_hat)/d(unknown) = [dt/dw; dxi/dw] dw, a row
    // the force on w along the motion dw with the row's unknown.
    class PointTangent
    {
    public:
      PointTangent(const SlavePoint             &point,
                   const InterfaceConfiguration &configuration,
                   const Side                    slave)
        : point(point)
        , slave_side(configuration.side[slave])
        , master_side(configuration.side[other(slave)])
      {
        D << point.trial.dt, point.trial.dxi;
        in_frames = D;
        in_frames.leftCols<3>() *= slave_side.frame;
        for (unsigned int block = 1; block < 5; ++block)
          in_frames.middleCols<3>(3 * block) *= master_side.frame;

        const SurfaceBasis &basis = point.trial.basis,
                           &old   = point.trial.old_basis;
        const bool slips = point.trial.state.status == PointStatus::slip;
        const bool same  = slips && old.element == basis.element;
        for (unsigned int a = 0; a < point.basis.size; ++a)
          add_columns(point.basis.N[a] * in_frames.leftCols<3>(),
                      slave_side,
                      point.basis.control_point[a]);
        for (unsigned int b = 0; b < basis.size; ++b)
          add_columns(basis.N[b] * in_frames.middleCols<3>(3) +
                        basis.N_1[b] * in_frames.middleCols<3>(6) +
                        basis.N_2[b] * in_frames.middleCols<3>(9) +
                        (same ? old.N[b] : 0.) * in_frames.rightCols<3>(),
                      master_side,
                      basis.control_point[b]);
        if (slips && !same)
          for (unsigned int b = 0; b < old.size; ++b)
            add_columns(old.N[b] * in_frames.rightCols<3>(),
                        master_side,
                        old.control_point[b]);
      }

      /** A component of the chuck, whose unit moves w by @p dw. */
      void
      add_chuck(const int number, const LocalVector &dw)
      {
        chuck_motion[n_chuck]   = dw;
        chuck_number[n_chuck++] = number;
        add_column(number, D * dw);
      }

      void
      add_to(Eigen::MatrixXd &matrix) const
      {
        const SurfaceBasis &basis = point.trial.basis;
        for (unsigned int j = 0; j < n_columns; ++j)
          {
            double           *column = &matrix(0, number_of_column[j]);
            const LocalVector force  = change_of_force(point,
                                                      columns.col(j).head<3>(),
                                                      columns.col(j).tail<2>());
            const Vector3d f = slave_side.frame.transpose() * force.head<3>();
            for (unsigned int a = 0; a < point.basis.size; ++a)
              add_rows(point.basis.N[a] * f,
                       slave_side,
                       point.basis.control_point[a],
                       column);
            const Eigen::Matrix3d m =
              master_side.frame.transpose() *
              Eigen::Map<const Eigen::Matrix3d>(force.data() + 3);
            for (unsigned int b = 0; b < basis.size; ++b)
              add_rows(basis.N[b] * m.col(0) + basis.N_1[b] * m.col(1) +
                         basis.N_2[b] * m.col(2),
                       master_side,
                       basis.control_point[b],
                       column);
            for (unsigned int k = 0; k < n_chuck; ++k)
              column[chuck_number[k]] += chuck_motion[k].dot(force);
          }
      }

    private:
      using Surface                    = InterfaceConfiguration::Surface;
      static constexpr int max_columns = 3 * 27 + 6;

      void
      add_column(const int number, const Matrix<double, 5, 1> &column)
      {
        if (number < 0)
          return;
        columns.col(n_columns)        = column;
        number_of_column[n_columns++] = number;
      }

      void
      add_columns(const Matrix<double, 5, 3> &block,
                  const Surface              &side,
                  const unsigned int          control_point)
      {
        for (unsigned int c = 0; c < 3; ++c)
          add_column(side.unknown_of[3 * control_point + c], block.col(c));
      }

      static void
      add_rows(const Vector3d    &f,
               const Surface     &side,
               const unsigned int control_point,
               double            *column)
      {
        for (unsigned int c = 0; c < 3; ++c)
          {
            const int row = side.unknown_of[3 * control_point + c];
            if (row >= 0)
              column[row] += f[c];
          }
      }

      const SlavePoint              &point;
      const Surface                 &slave_side, &master_side;
      Matrix<double, 5, 15>          D, in_frames;
      Matrix<double, 5, max_columns> columns;
      std::array<int, max_columns>   number_of_column;
      std::array<LocalVector, 6>     chuck_motion;
      std::array<int, 6>             chuck_number;
      unsigned int                   n_columns = 0, n_chuck = 0;
    };
  } // namespace



  void
  ContactInterface::add_tangent(const InterfaceConfiguration &configuration,
                                Eigen::MatrixXd              &matrix) const
  {
    std::vector<std::pair<int, NodalSums>> chuck;
    for (const auto &[component, number] : configuration.chuck_unknowns)
      chuck.emplace_back(number,
                         nodal_motion(Eigen::VectorXd::Unit(matrix.cols(),
                                                            number),
                                      configuration));
    for (const SlavePoint &point : points)
      if (point.trial.state.status != PointStatus::open)
        {
          PointTangent tangent(point, configuration, slave);
          for (const auto &[number, moved] : chuck)
            tangent.add_chuck(number, local_motion(point, slave, moved));
          tangent.add_to(matrix);
        }
  }



  void
  ContactInterface::apply_tangent(const InterfaceConfiguration &configuration,
                                  const Eigen::VectorXd        &direction,
                                  Eigen::VectorXd              &result) const
  {
    const NodalSums moved = nodal_motion(direction, configuration);
    const NodalSums change =
      sum_in_chunks(points.size(),
                    configuration,
                    [&](const unsigned int q, NodalSums &sums) {
                      const SlavePoint &point = points[q];
                      if (point.trial.state.status == PointStatus::open)
                        return;
                      const auto dw = local_motion(point, slave, moved);
                      spread_local(point,
                                   slave,
                                   change_of_force(point,
                                                   point.trial.dt * dw,
                                                   point.trial.dxi * dw),
                                   sums);
                    });
    add_in_unknowns(change, configuration, 1., result);
  }



  // g_s grows by |y(xi_hat) - y(xi_hat^n)|, Eq. (32), whose change is that of
  // the difference along its direction; xi_hat moves as the equations of the
  // slip want it.
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
        const double distance = trial.slip_increment.norm();
        if (trial.state.status != PointStatus::slip || mode_now.frictionless ||
            distance == 0.)
          continue;
        const Vector3d  direction = trial.slip_increment / distance;
        SurfaceGeometry y;
        contract(trial.basis,
                 configuration.side[master_side()].positions,
                 false,
                 y);
        LocalVector d =
          trial.dxi.transpose() *
          Eigen::Vector2d(direction.dot(y.a1), direction.dot(y.a2));
        d.segment<3>(3) += direction;
        d.segment<3>(12) -= direction;
        spread_local(point, slave, point.JxW * d, result.gradient);
      }
    result.value /= area;
    for (ControlNet &gradient : result.gradient)
      gradient /= area;
    return result;
  }
} // namespace Debond
