#include <debond/body_mesh.h>
#include <debond/chuck.h>
#include <debond/chunks.h>
#include <debond/closest_point.h>
#include <debond/contact_interface.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <sstream>

namespace Debond
{
  ContactInterface::ContactInterface(const InterfaceParameters &parameters,
                                     const BodyMesh            &bone,
                                     const BodyMesh            &implant)
    : parameters(parameters)
    , slave(parameters.slave == SlaveSide::implant ? 1 : 0)
    , mesh{{&bone, &implant}}
  {
    law.normal_penalty      = parameters.normal_penalty;
    law.tangential_penalty  = parameters.tangential_penalty;
    law.friction            = parameters.friction;
    law.opening_breaks_bond = parameters.opening_breaks_bond;
    law.viscosity           = parameters.viscosity;
    law.explicit_friction   = parameters.explicit_friction;
    const auto quadrature =
      surface_quadrature(mesh[slave]->surface(), parameters.quadrature_points);
    points.reserve(quadrature.size());
    for (const auto &quadrature_point : quadrature)
      {
        Point point;
        point.element = quadrature_point.element;
        point.xi      = quadrature_point.xi;
        point.X       = quadrature_point.X;
        point.basis   = quadrature_point.basis;
        point.JxW     = quadrature_point.JxW;
        points.push_back(point);
      }
    for (unsigned int side = 0; side < 2; ++side)
      forces[side].setZero(3, mesh[side]->surface().n_control_points());
    for (const auto &quadrature_point :
         surface_quadrature(implant.surface(), parameters.quadrature_points))
      area_of_implant += quadrature_point.JxW;
  }



  namespace
  {
    Eigen::Vector3d
    interpolate(const SurfaceBasis &basis, const ControlNet &nodes)
    {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (unsigned int a = 0; a < basis.size; ++a)
        sum += basis.N[a] * nodes.col(basis.control_point[a]);
      return sum;
    }



    ContactInterface::NodalSums
    total(const std::array<ContactInterface::NodalSums, n_chunks> &sums)
    {
      ContactInterface::NodalSums result = sums[0];
      for (unsigned int chunk = 1; chunk < n_chunks; ++chunk)
        for (unsigned int side = 0; side < 2; ++side)
          result[side] += sums[chunk][side];
      return result;
    }
  } // namespace



  // phi_0 belongs to the implant: with the bone as slave a point takes that of
  // the implant point it faces at the start.
  void
  ContactInterface::assign_bonding()
  {
    pattern = std::make_unique<BondingPattern>(parameters.bonding,
                                               mesh[1]->parameters(),
                                               mesh[1]->surface(),
                                               parameters.quadrature_points);
    for (unsigned int q = 0; q < points.size(); ++q)
      if (slave == 1)
        points[q].phi_0 = pattern->at(q);
      else
        {
          // the master is the implant
          points[q].faces_implant = points[q].accepted.has_partner;
          points[q].phi_0 =
            points[q].faces_implant ? pattern->at(points[q].accepted.xi) : 0.;
        }
  }



  double
  ContactInterface::mean_seen_bonding() const
  {
    double sum = 0., area = 0.;
    for (const Point &point : points)
      if (point.faces_implant)
        {
          sum += point.phi_0 * point.JxW;
          area += point.JxW;
        }
    return area > 0. ? sum / area : 0.;
  }



  MasterSurface
  ContactInterface::master(const InterfaceConfiguration &configuration) const
  {
    return {&mesh[master_side()]->surface(),
            &configuration.side[master_side()].positions,
            mesh[master_side()]->outward_sign()};
  }



  void
  ContactInterface::project_accepted(
    Point                        &point,
    const MasterSurface          &master,
    const InterfaceConfiguration &configuration,
    const bool                    use_guess)
  {
    const Projection projection =
      project(master,
              interpolate(point.basis, configuration.side[slave].positions),
              use_guess ? &point.accepted.xi : nullptr);
    point.accepted.xi          = projection.xi;
    point.accepted.has_partner = projection.faces;
    point.clearance            = projection.clearance;
    // close to the singular corner of a disk, where there is no clearance, the
    // search may end early: no partner is to be found there anyway
    unprojected += !projection.converged && projection.clearance > 0.;
  }



  // Every point of a surface is a convex combination of control points.
  double
  ContactInterface::motion(const InterfaceConfiguration &configuration) const
  {
    double sum = 0.;
    for (unsigned int side = 0; side < 2; ++side)
      sum += (configuration.side[side].positions - accepted_positions[side])
               .colwise()
               .norm()
               .maxCoeff();
    return sum;
  }



  void
  ContactInterface::initialise(const InterfaceConfiguration &configuration)
  {
    for (unsigned int side = 0; side < 2; ++side)
      accepted_positions[side] = configuration.side[side].positions;
    unprojected = 0;
    for (Point &point : points)
      project_accepted(point, master(configuration), configuration, false);
    assign_bonding();
  }



  bool
  ContactInterface::evaluate(const InterfaceConfiguration &configuration,
                             const ContactPointMode       &mode)
  {
    const MasterSurface surface = master(configuration);
    const double        moved   = motion(configuration);
    mode_now                    = mode;
    std::array<NodalSums, n_chunks> sums;
    std::array<int, n_chunks>       failed;
    for_each_chunk(points.size(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     failed[chunk] = -1;
                     for (unsigned int side = 0; side < 2; ++side)
                       sums[chunk][side].setZero(3, forces[side].cols());
                     for (unsigned int q = first; q < end; ++q)
                       {
                         update(points[q], configuration, surface, moved, mode);
                         if (points[q].trial.failed && failed[chunk] < 0)
                           failed[chunk] = q;
                         add_forces(points[q], sums[chunk]);
                       }
                   });
    forces       = total(sums);
    failed_point = -1;
    for (const int q : failed)
      if (failed_point < 0)
        failed_point = q;
    return failed_point < 0;
  }



  void
  ContactInterface::update(Point                        &point,
                           const InterfaceConfiguration &configuration,
                           const MasterSurface          &surface,
                           const double                  moved,
                           const ContactPointMode       &mode) const
  {
    if (point.accepted.has_partner || point.clearance <= moved)
      {
        ContactPointMode mode_here = mode;
        if (parameters.slip_along_previous_gap)
          mode_here.slip_direction =
            configuration.side[master_side()].frame * point.accepted_traction;
        update_contact_point(law,
                             point.accepted,
                             point.phi_0,
                             interpolate(point.basis,
                                         configuration.side[slave].positions),
                             surface,
                             mode_here,
                             point.trial);
        return;
      }
    // still beyond the edge: open
    point.trial.failed   = false;
    point.trial.state    = point.accepted;
    point.trial.pressure = point.trial.normal_gap = point.trial.softening = 0.;
    point.trial.traction           = point.trial.tangential_traction =
      point.trial.viscous_traction = point.trial.slip_increment =
        Eigen::Vector3d::Zero();
  }



  void
  ContactInterface::add_forces(const Point &point, NodalSums &sums) const
  {
    if (point.trial.state.status == PointStatus::open)
      return;
    const Eigen::Vector3d f = point.JxW * point.trial.traction;
    for (unsigned int a = 0; a < point.basis.size; ++a)
      sums[slave].col(point.basis.control_point[a]) += point.basis.N[a] * f;
    const SurfaceBasis &basis = point.trial.basis;
    for (unsigned int b = 0; b < basis.size; ++b)
      sums[master_side()].col(basis.control_point[b]) -= basis.N[b] * f;
  }



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

      PointTangent(const ContactInterface::Point &point,
                   const InterfaceConfiguration  &configuration,
                   const unsigned int             slave)
        : point(point)
        , configuration(configuration)
        , slave(slave)
      {
        D.topRows<3>()             = point.trial.dt;
        D.bottomRows<2>()          = point.trial.dxi;
        const Eigen::Matrix3d &Q_s = configuration.side[slave].frame;
        const Eigen::Matrix3d &Q_m = configuration.side[1 - slave].frame;
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
        if (slave == 1)
          dw.head<3>() = chuck.velocity(
            k, interpolate(point.basis, configuration.side[1].positions));
        else
          {
            SurfaceGeometry geometry;
            contract(point.trial.basis,
                     configuration.side[1].positions,
                     false,
                     geometry);
            dw.segment<3>(3) = chuck.velocity(k, geometry.y);
            dw.segment<3>(6) = chuck.velocity_of_direction(k, geometry.a1);
            dw.segment<3>(9) = chuck.velocity_of_direction(k, geometry.a2);
            if (point.trial.state.status == PointStatus::slip)
              dw.segment<3>(12) =
                chuck.velocity(k,
                               interpolate(point.trial.old_basis,
                                           configuration.side[1].positions));
          }
        return dw;
      }

      void
      add_to(Eigen::MatrixXd &matrix) const
      {
        const Eigen::Matrix3d &Q_s = configuration.side[slave].frame;
        const Eigen::Matrix3d &Q_m = configuration.side[1 - slave].frame;
        const auto             dt  = columns.topRows<3>().leftCols(n_columns);
        const auto dxi = columns.bottomRows<2>().leftCols(n_columns);
        using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3 * 27 + 6>;
        const Rows            slave_rows  = point.JxW * Q_s.transpose() * dt;
        const Rows            master_rows = -point.JxW * Q_m.transpose() * dt;
        const Eigen::Vector3d t_m =
          -point.JxW * Q_m.transpose() * point.trial.traction;

        const auto &slave_unknown  = configuration.side[slave].unknown_of;
        const auto &master_unknown = configuration.side[1 - slave].unknown_of;
        const SurfaceBasis &basis  = point.trial.basis;
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
                  const unsigned int                 side,
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
            add_columns(block, 1 - slave, basis.control_point[b]);
          }
      }

      void
      add_old_master_columns(const SurfaceBasis &basis)
      {
        for (unsigned int b = 0; b < basis.size; ++b)
          add_columns(basis.N[b] * D_body.middleCols<3>(12),
                      1 - slave,
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
            if (slave == 1)
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

      const ContactInterface::Point &point;
      const InterfaceConfiguration  &configuration;
      const unsigned int             slave;
      Eigen::Matrix<double, 5, 15>   D, D_body;
      Columns                        columns;
      std::array<int, 3 * 27 + 6>    number_of_column;
      unsigned int                   n_columns = 0;
    };
  } // namespace



  void
  ContactInterface::add_tangent(const InterfaceConfiguration &configuration,
                                Eigen::MatrixXd              &matrix) const
  {
    for (const Point &point : points)
      if (point.trial.state.status != PointStatus::open)
        PointTangent(point, configuration, slave).add_to(matrix);
  }



  void
  ContactInterface::apply_tangent(const InterfaceConfiguration &configuration,
                                  const Eigen::VectorXd        &direction,
                                  Eigen::VectorXd              &result) const
  {
    const Chuck &chuck = *configuration.chuck;
    NodalSums    moved;
    for (unsigned int s = 0; s < 2; ++s)
      {
        const auto &side = configuration.side[s];
        moved[s].setZero(3, side.positions.cols());
        for (unsigned int i = 0; i < side.unknown_of.size(); ++i)
          if (side.unknown_of[i] >= 0)
            moved[s](i % 3, i / 3) = direction[side.unknown_of[i]];
        moved[s] = (side.frame * moved[s]).eval();
        if (s == 1)
          for (const auto &[component, number] : configuration.chuck_unknowns)
            for (unsigned int A = 0; A < side.positions.cols(); ++A)
              moved[s].col(A) +=
                direction[number] *
                chuck.velocity(component, side.positions.col(A));
      }

    std::array<NodalSums, n_chunks> sums;
    for_each_chunk(points.size(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     for (unsigned int side = 0; side < 2; ++side)
                       sums[chunk][side].setZero(3, moved[side].cols());
                     for (unsigned int q = first; q < end; ++q)
                       add_change(points[q], moved, sums[chunk]);
                   });
    NodalSums change = total(sums);
    for (const auto &[component, number] : configuration.chuck_unknowns)
      for (unsigned int A = 0; A < change[1].cols(); ++A)
        result[number] += change[1].col(A).dot(
          chuck.velocity(component, configuration.side[1].positions.col(A)));
    for (unsigned int s = 0; s < 2; ++s)
      {
        const auto &side = configuration.side[s];
        change[s]        = (side.frame.transpose() * change[s]).eval();
        for (unsigned int i = 0; i < side.unknown_of.size(); ++i)
          if (side.unknown_of[i] >= 0)
            result[side.unknown_of[i]] += change[s](i % 3, i / 3);
      }
  }



  void
  ContactInterface::add_change(const Point     &point,
                               const NodalSums &moved,
                               NodalSums       &sums) const
  {
    if (point.trial.state.status == PointStatus::open)
      return;
    const SurfaceBasis          &basis = point.trial.basis;
    Eigen::Matrix<double, 15, 1> dw;
    SurfaceGeometry              master_change;
    contract(basis, moved[master_side()], false, master_change);
    dw << interpolate(point.basis, moved[slave]), master_change.y,
      master_change.a1, master_change.a2, Eigen::Vector3d::Zero();
    if (point.trial.state.status == PointStatus::slip)
      dw.tail<3>() = interpolate(point.trial.old_basis, moved[master_side()]);
    const Eigen::Vector3d dt  = point.JxW * (point.trial.dt * dw);
    const Eigen::Vector2d dxi = point.trial.dxi * dw;
    const Eigen::Vector3d t   = point.JxW * point.trial.traction;
    for (unsigned int a = 0; a < point.basis.size; ++a)
      sums[slave].col(point.basis.control_point[a]) += point.basis.N[a] * dt;
    for (unsigned int b = 0; b < basis.size; ++b)
      sums[master_side()].col(basis.control_point[b]) -=
        basis.N[b] * dt + (basis.N_1[b] * dxi[0] + basis.N_2[b] * dxi[1]) * t;
  }



  // g_s grows by |y(xi_hat) - y(xi_hat^n)|, whose change is that of the
  // difference along its direction; xi_hat moves as the equations of the slip
  // want it.
  ContactInterface::MeanSlip
  ContactInterface::mean_slip(const InterfaceConfiguration &configuration) const
  {
    MeanSlip result;
    for (unsigned int side = 0; side < 2; ++side)
      result.gradient[side].setZero(3, forces[side].cols());
    double area = 0.;
    for (const Point &point : points)
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
        const SurfaceBasis   &basis     = trial.basis;
        const Eigen::Vector3d direction = trial.slip_increment / distance;
        SurfaceGeometry       y;
        contract(basis, configuration.side[master_side()].positions, false, y);
        Eigen::Matrix<double, 15, 1> d =
          trial.dxi.transpose() *
          Eigen::Vector2d(direction.dot(y.a1), direction.dot(y.a2));
        d.segment<3>(3) += direction;
        d.segment<3>(12) -= direction;
        d *= point.JxW;
        NodalSums &sums = result.gradient;
        for (unsigned int a = 0; a < point.basis.size; ++a)
          sums[slave].col(point.basis.control_point[a]) +=
            point.basis.N[a] * d.segment<3>(0);
        for (unsigned int b = 0; b < basis.size; ++b)
          sums[master_side()].col(basis.control_point[b]) +=
            basis.N[b] * d.segment<3>(3) + basis.N_1[b] * d.segment<3>(6) +
            basis.N_2[b] * d.segment<3>(9);
        for (unsigned int b = 0; b < trial.old_basis.size; ++b)
          sums[master_side()].col(trial.old_basis.control_point[b]) +=
            trial.old_basis.N[b] * d.segment<3>(12);
      }
    result.value /= area;
    for (ControlNet &gradient : result.gradient)
      gradient /= area;
    return result;
  }



  FrictionCoefficient
  ContactInterface::friction(const Point &point) const
  {
    return friction(point, point.trial.state);
  }



  FrictionCoefficient
  ContactInterface::friction(const Point             &point,
                             const ContactPointState &state) const
  {
    return friction_coefficient(parameters.friction,
                                state.broken ? 0. : point.phi_0,
                                state.slip);
  }



  void
  ContactInterface::add_friction_work(const Point &point, const double viscous)
  {
    // the viscous traction is anything between its two ends
    accepted_friction_work += viscous;
    accepted_friction_work_bound += viscous;
    const ContactPointResult &trial = point.trial;
    const double              p     = point.accepted_pressure,
                 t                  = point.accepted_traction.norm();
    if (trial.state.status == PointStatus::open)
      {
        accepted_friction_work_bound +=
          0.5 * point.JxW *
          (p * p / law.normal_penalty + t * t / law.tangential_penalty);
        return;
      }
    if (mode_now.frictionless)
      return;
    const double per_pressure =
      point.JxW * friction_strength(parameters.friction,
                                    trial.state.broken ? 0. : point.phi_0,
                                    point.accepted.slip,
                                    trial.state.slip);
    accepted_friction_work += 0.5 * (p + trial.pressure) * per_pressure;
    accepted_friction_work_bound +=
      0.5 * std::abs(p - trial.pressure) * per_pressure;
  }



  void
  ContactInterface::commit(const InterfaceConfiguration &configuration)
  {
    const MasterSurface    surface = master(configuration);
    const Eigen::Matrix3d &Q       = configuration.side[master_side()].frame;
    const double           moved   = motion(configuration);
    for (unsigned int side = 0; side < 2; ++side)
      accepted_positions[side] = configuration.side[side].positions;
    unprojected               = 0;
    accepted_step_dissipation = 0.;
    for (Point &point : points)
      {
        if (!point.accepted.has_partner && point.clearance > moved)
          {
            point.clearance -= moved;
            continue;
          }
        const ContactPointResult &trial = point.trial;
        accepted_step_dissipation +=
          point.JxW * trial.tangential_traction.dot(trial.slip_increment);
        accepted_dissipation +=
          0.5 * point.JxW *
          (Q * point.accepted_traction + trial.tangential_traction)
            .dot(trial.slip_increment);
        const double viscous =
          0.5 * point.JxW *
          (Q * point.accepted_viscous_traction + trial.viscous_traction)
            .dot(trial.slip_increment);
        accepted_viscous_work += viscous;
        if (!mode_now.frictionless)
          accepted_adhesive_work +=
            point.JxW * 0.5 * (point.accepted_pressure + trial.pressure) *
            adhesive_strength(parameters.friction,
                              trial.state.broken ? 0. : point.phi_0,
                              point.accepted.slip,
                              trial.state.slip);
        add_friction_work(point, viscous);
        point.accepted          = trial.state;
        point.accepted_traction = Q.transpose() * trial.tangential_traction;
        point.accepted_viscous_traction =
          Q.transpose() * trial.viscous_traction;
        point.accepted_pressure = trial.pressure;
        if (point.accepted.status == PointStatus::open)
          project_accepted(point, surface, configuration, true);
      }
  }



  std::vector<PointStatus>
  ContactInterface::statuses() const
  {
    std::vector<PointStatus> result;
    result.reserve(points.size());
    for (const Point &point : points)
      result.push_back(point.trial.state.status);
    return result;
  }



  bool
  ContactInterface::has_open_points() const
  {
    return std::any_of(points.begin(), points.end(), [](const Point &point) {
      return point.trial.state.status == PointStatus::open;
    });
  }



  std::vector<bool>
  ContactInterface::touched_bone_elements() const
  {
    std::vector<bool> touched(mesh[0]->surface().n_elements(), false);
    for (const Point &point : points)
      if (point.trial.state.status != PointStatus::open)
        {
          touched[slave == 0 ? point.element : point.trial.basis.element] =
            true;
          if (slave == 1 && point.trial.state.status == PointStatus::slip)
            touched[point.trial.old_basis.element] = true;
        }
    return touched;
  }



  namespace
  {
    // Marks what lies between marked elements of a row or column: outlines of
    // implants are convex, but samples may miss cells that grading made small.
    void
    fill_gaps(std::vector<bool> &marked, const std::array<unsigned int, 2> &n)
    {
      const std::array<unsigned int, 2> stride{{1, n[0]}};
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int line = 0; line < n[1 - d]; ++line)
          {
            const auto element = [&](const unsigned int i) {
              return i * stride[d] + line * stride[1 - d];
            };
            unsigned int first = 0, end = n[d];
            while (first < end && !marked[element(first)])
              ++first;
            while (end > first && !marked[element(end - 1)])
              --end;
            for (unsigned int i = first; i < end; ++i)
              marked[element(i)] = true;
          }
    }
  } // namespace



  std::vector<bool>
  ContactInterface::bone_elements_under_implant(
    const InterfaceConfiguration &configuration) const
  {
    const NurbsSurface &bone    = mesh[0]->surface(),
                       &implant = mesh[1]->surface();
    std::vector<bool> under(bone.n_elements(), false);
    const auto        n = implant.n_elements_per_direction();
    // dense enough to meet every element of the bone that the edge crosses
    const unsigned int finest  = std::max({n[0],
                                           n[1],
                                           bone.n_elements_per_direction()[0],
                                           bone.n_elements_per_direction()[1]});
    const unsigned int samples = 4 * finest;
    SurfaceBasis       basis;
    Eigen::Vector2d    guess(0.5, 0.5);
    for (unsigned int j = 0; j <= samples; ++j)
      for (unsigned int i = 0; i <= samples; ++i)
        {
          implant.evaluate({double(i) / samples, double(j) / samples},
                           basis,
                           false);
          const ClosestPoint closest =
            closest_point(bone,
                          configuration.side[0].positions,
                          interpolate(basis, configuration.side[1].positions),
                          &guess);
          guess                              = closest.xi;
          under[bone.element_of(closest.xi)] = true;
        }
    fill_gaps(under, bone.n_elements_per_direction());
    return under;
  }



  void
  ContactInterface::add_steepest_softening(const Point &point,
                                           Summary     &summary) const
  {
    const ContactPointState &old = point.accepted;
    const double             slope =
      old.broken ? 0. :
                               steepest_fall(parameters.friction, point.phi_0, old.slip);
    const double softening =
      slope * point.trial.pressure /
      (parameters.tangential_penalty + viscous_stiffness(law, mode_now));
    if (softening > summary.steepest_softening)
      {
        summary.steepest_softening = softening;
        summary.softening_pressure = point.trial.pressure;
        summary.softening_slope    = slope;
      }
  }



  ContactInterface::Summary
  ContactInterface::summarise() const
  {
    Summary summary;
    double  area = 0.;
    for (const Point &point : points)
      {
        const ContactPointResult &trial = point.trial;
        summary.normal_force += point.JxW * trial.pressure;
        if (point.faces_implant)
          {
            area += point.JxW;
            summary.phi_mean += point.JxW * friction(point).phi;
            switch (trial.state.status)
              {
                case PointStatus::open:
                  summary.share_open += point.JxW;
                  break;
                case PointStatus::stick:
                  summary.share_stick += point.JxW;
                  break;
                case PointStatus::slip:
                  summary.share_slip += point.JxW;
                  break;
              }
          }
        if (trial.state.status == PointStatus::open)
          {
            // whether it was bonded: opening itself may have broken it
            if (parameters.friction.kind == FrictionLawKind::modified_coulomb &&
                point.accepted.status != PointStatus::open &&
                friction(point, point.accepted).phi > 0.)
              ++summary.bonded_opened;
            continue;
          }
        ++summary.n_closed;
        summary.energy +=
          0.5 * point.JxW *
          (trial.pressure * trial.pressure / parameters.normal_penalty +
           trial.tangential_traction.squaredNorm() /
             parameters.tangential_penalty);
        summary.max_softening =
          std::max(summary.max_softening, trial.softening);
        if (!parameters.explicit_friction && !mode_now.frictionless)
          add_steepest_softening(point, summary);
        summary.max_penetration =
          std::max(summary.max_penetration, -trial.normal_gap);
      }
    for (double *share : {&summary.phi_mean,
                          &summary.share_stick,
                          &summary.share_slip,
                          &summary.share_open})
      *share /= area;
    return summary;
  }



  std::string
  ContactInterface::describe_failure() const
  {
    if (failed_point < 0)
      return "";
    const Point       &point = points[failed_point];
    std::ostringstream text;
    text << "no solution of the friction law at the "
         << (slave == 1 ? "implant" : "bone")
         << "'s quadrature point at parameters (" << point.xi[0] << ", "
         << point.xi[1] << "), g_s = " << point.accepted.slip << " mm";
    return text.str();
  }
} // namespace Debond
