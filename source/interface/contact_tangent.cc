#include <debond/bulk/chuck.h>
#include <debond/interface/contact_tangent.h>
#include <debond/interface/nodal_sums.h>

namespace Debond
{
  namespace
  {
    // The local tangent of one point. Columns: x (slave nodes), y, a_1, a_2
    // (master nodes at xi_hat), y_n (master nodes at xi_hat^n), chuck unknowns.
    // It is assembled for all of them at once: [dt; dxi] = D * column.
    class PointTangent
    {
    public:
      using Columns =
        Eigen::Matrix<double, 5, Eigen::Dynamic, 0, 5, 3 * 27 + 6>;

      PointTangent(const SlavePoint             &point,
                   const InterfaceConfiguration &configuration,
                   const Side                    slave)
        : point(point)
        , configuration(configuration)
        , slave(slave)
      {
        D.topRows<3>()             = point.trial.dt;
        D.bottomRows<2>()          = point.trial.dxi;
        const Eigen::Matrix3d &Q_s = configuration.side[slave].frame;
        const Eigen::Matrix3d &Q_m = configuration.side[other(slave)].frame;
        D_body.leftCols<3>()       = D.leftCols<3>() * Q_s;
        for (unsigned int block = 1; block < 5; ++block)
          D_body.middleCols<3>(3 * block) = D.middleCols<3>(3 * block) * Q_m;
        const bool slips = point.trial.state.status == PointStatus::slip;
        const bool same =
          slips && point.trial.old_basis.element == point.trial.basis.element;
        const unsigned int n_s = point.basis.size, n_m = point.trial.basis.size;
        const unsigned int n_o =
          slips && !same ? point.trial.old_basis.size : 0;
        const unsigned int n_k = configuration.chuck_unknowns.size();
        columns.resize(5, 3 * (n_s + n_m + n_o) + n_k);
        add_slave_columns(point.basis);
        add_master_columns(point.trial.basis,
                           slips && same ? &point.trial.old_basis : nullptr);
        if (n_o > 0)
          add_old_master_columns(point.trial.old_basis);
        for (const auto &[component, number] : configuration.chuck_unknowns)
          {
            columns.col(n_columns)        = D * chuck_direction(component);
            number_of_column[n_columns++] = number;
          }
      }

      // dw/dq_k: the implant's side of w moves with the chuck.
      Eigen::Matrix<double, 15, 1>
      chuck_direction(const unsigned int k) const
      {
        Eigen::Matrix<double, 15, 1> dw = Eigen::Matrix<double, 15, 1>::Zero();
        const Chuck                 &chuck = *configuration.chuck;
        if (slave == Side::implant)
          dw.head<3>() = chuck.velocity(
            k,
            interpolate(point.basis,
                        configuration.side[Side::implant].positions));
        else
          {
            SurfaceGeometry geometry;
            contract(point.trial.basis,
                     configuration.side[Side::implant].positions,
                     false,
                     geometry);
            dw.segment<3>(3) = chuck.velocity(k, geometry.y);
            dw.segment<3>(6) = chuck.velocity_of_direction(k, geometry.a1);
            dw.segment<3>(9) = chuck.velocity_of_direction(k, geometry.a2);
            if (point.trial.state.status == PointStatus::slip)
              dw.segment<3>(12) = chuck.velocity(
                k,
                interpolate(point.trial.old_basis,
                            configuration.side[Side::implant].positions));
          }
        return dw;
      }

      void
      add_to(Eigen::MatrixXd &matrix) const
      {
        const Eigen::Matrix3d &Q_s = configuration.side[slave].frame;
        const Eigen::Matrix3d &Q_m = configuration.side[other(slave)].frame;
        const auto             dt  = columns.topRows<3>().leftCols(n_columns);
        const auto dxi = columns.bottomRows<2>().leftCols(n_columns);
        using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3 * 27 + 6>;
        const Rows            slave_rows  = point.JxW * Q_s.transpose() * dt;
        const Rows            master_rows = -point.JxW * Q_m.transpose() * dt;
        const Eigen::Vector3d t_m =
          -point.JxW * Q_m.transpose() * point.trial.traction;

        const auto &slave_unknown = configuration.side[slave].unknown_of;
        const auto &master_unknown =
          configuration.side[other(slave)].unknown_of;
        const SurfaceBasis &basis = point.trial.basis;
        for (unsigned int j = 0; j < n_columns; ++j)
          {
            if (number_of_column[j] < 0)
              continue;
            double *column = &matrix(0, number_of_column[j]);
            for (unsigned int a = 0; a < point.basis.size; ++a)
              for (unsigned int c = 0; c < 3; ++c)
                {
                  const int row =
                    slave_unknown[3 * point.basis.control_point[a] + c];
                  if (row >= 0)
                    column[row] += point.basis.N[a] * slave_rows(c, j);
                }
            for (unsigned int b = 0; b < basis.size; ++b)
              {
                const double along =
                  basis.N_1[b] * dxi(0, j) + basis.N_2[b] * dxi(1, j);
                for (unsigned int c = 0; c < 3; ++c)
                  {
                    const int row =
                      master_unknown[3 * basis.control_point[b] + c];
                    if (row >= 0)
                      column[row] +=
                        basis.N[b] * master_rows(c, j) + along * t_m[c];
                  }
              }
            add_chuck_rows(j, column);
          }
      }

    private:
      void
      add_columns(const Eigen::Matrix<double, 5, 3> &block,
                  const Side                         side,
                  const unsigned int                 control_point)
      {
        for (unsigned int c = 0; c < 3; ++c)
          {
            columns.col(n_columns) = block.col(c);
            number_of_column[n_columns++] =
              configuration.side[side].unknown_of[3 * control_point + c];
          }
      }

      void
      add_slave_columns(const SurfaceBasis &basis)
      {
        for (unsigned int a = 0; a < basis.size; ++a)
          add_columns(basis.N[a] * D_body.leftCols<3>(),
                      slave,
                      basis.control_point[a]);
      }

      void
      add_master_columns(const SurfaceBasis &basis, const SurfaceBasis *old)
      {
        for (unsigned int b = 0; b < basis.size; ++b)
          {
            Eigen::Matrix<double, 5, 3> block =
              basis.N[b] * D_body.middleCols<3>(3) +
              basis.N_1[b] * D_body.middleCols<3>(6) +
              basis.N_2[b] * D_body.middleCols<3>(9);
            if (old != nullptr)
              block += old->N[b] * D_body.middleCols<3>(12);
            add_columns(block, other(slave), basis.control_point[b]);
          }
      }

      void
      add_old_master_columns(const SurfaceBasis &basis)
      {
        for (unsigned int b = 0; b < basis.size; ++b)
          add_columns(basis.N[b] * D_body.middleCols<3>(12),
                      other(slave),
                      basis.control_point[b]);
      }

      // r_k = sum over points of f . dx/dq_k, f acting on the implant
      void
      add_chuck_rows(const unsigned int j, double *column) const
      {
        for (const auto &[component, number] : configuration.chuck_unknowns)
          {
            const Eigen::Matrix<double, 15, 1> velocity =
              chuck_direction(component);
            if (slave == Side::implant)
              column[number] +=
                point.JxW * velocity.head<3>().dot(columns.col(j).head<3>());
            else
              column[number] -=
                point.JxW *
                (velocity.segment<3>(3).dot(columns.col(j).head<3>()) +
                 point.trial.traction.dot(
                   velocity.segment<3>(6) * columns(3, j) +
                   velocity.segment<3>(9) * columns(4, j)));
          }
      }

      const SlavePoint             &point;
      const InterfaceConfiguration &configuration;
      const Side                    slave;
      Eigen::Matrix<double, 5, 15>  D, D_body;
      Columns                       columns;
      std::array<int, 3 * 27 + 6>   number_of_column;
      unsigned int                  n_columns = 0;
    };



    // The forces of one point that change as the control points move.
    void
    add_change(const SlavePoint &point,
               const Side        slave,
               const NodalSums  &moved,
               NodalSums        &sums)
    {
      if (point.trial.state.status == PointStatus::open)
        return;
      const Side                   master = other(slave);
      const SurfaceBasis          &basis  = point.trial.basis;
      Eigen::Matrix<double, 15, 1> dw;
      SurfaceGeometry              master_change;
      contract(basis, moved[master], false, master_change);
      dw << interpolate(point.basis, moved[slave]), master_change.y,
        master_change.a1, master_change.a2, Eigen::Vector3d::Zero();
      if (point.trial.state.status == PointStatus::slip)
        dw.tail<3>() = interpolate(point.trial.old_basis, moved[master]);
      const Eigen::Vector3d dt  = point.JxW * (point.trial.dt * dw);
      const Eigen::Vector2d dxi = point.trial.dxi * dw;
      const Eigen::Vector3d t   = point.JxW * point.trial.traction;
      spread(point.basis, dt, sums[slave]);
      for (unsigned int b = 0; b < basis.size; ++b)
        sums[master].col(basis.control_point[b]) -=
          basis.N[b] * dt + (basis.N_1[b] * dxi[0] + basis.N_2[b] * dxi[1]) * t;
    }
  } // namespace



  void
  add_contact_tangent(const std::vector<SlavePoint> &points,
                      const Side                     slave,
                      const InterfaceConfiguration  &configuration,
                      Eigen::MatrixXd               &matrix)
  {
    for (const SlavePoint &point : points)
      if (point.trial.state.status != PointStatus::open)
        PointTangent(point, configuration, slave).add_to(matrix);
  }



  void
  apply_contact_tangent(const std::vector<SlavePoint> &points,
                        const Side                     slave,
                        const InterfaceConfiguration  &configuration,
                        const Eigen::VectorXd         &direction,
                        Eigen::VectorXd               &result)
  {
    const NodalSums moved = nodal_motion(direction, configuration);
    const NodalSums change =
      sum_in_chunks(points.size(),
                    configuration,
                    [&](const unsigned int q, NodalSums &sums) {
                      add_change(points[q], slave, moved, sums);
                    });
    add_in_unknowns(change, configuration, 1., result);
  }
} // namespace Debond
