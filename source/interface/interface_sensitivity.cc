#include <debond/bulk/body_mesh.h>
#include <debond/interface/interface_sensitivity.h>
#include <debond/interface/local_motion.h>
#include <debond/interface/slip_problem.h>

#include <Eigen/Dense>

#include <algorithm>

// Direct differentiation of the interface. In a step a closed point makes of
// its history h_n, of w (contact_point_state.h) and of the data of its law a
// traction and a new history,
//
//   (t, h) = F(h_n, w, data).
//
// F is not solved again: its derivatives by w are there, those by the data are
// found in the state that the point has come to (differentiate_by_data), and
// the history enters through both. Everything here is linear; a column for each
// parameter.
namespace Debond
{
  using Eigen::Matrix;
  using Eigen::Vector2d;
  using Eigen::Vector3d;

  InterfaceSensitivity::InterfaceSensitivity(
    const ContactInterface                &interface,
    const std::vector<InterfaceVariation> &variations,
    std::vector<InterfaceMotion>           start)
    : interface(interface)
    , accepted(std::move(start))
    , histories(variations.size() * interface.points.size())
  {
    for (const InterfaceVariation &variation : variations)
      {
        const auto phi_0 = [&](const InterfaceParameters &varied) {
          return interface.initial_bonding(interface.bonding_pattern(varied));
        };
        parameters.push_back({{{variation.plus.law(), variation.minus.law()}},
                              {{phi_0(variation.plus), phi_0(variation.minus)}},
                              variation.width,
                              true});
        Parameter &parameter = parameters.back();
        // the law of a scene that leaves it alone is shared, or asked in vain
        parameter.changes_friction =
          parameter.law[0].friction != parameter.law[1].friction ||
          parameter.phi_0[0] != parameter.phi_0[1];
      }
  }



  namespace
  {
    /** How the tangents change as xi moves. */
    Matrix<double, 6, 2>
    tangents_by_xi(const SurfaceGeometry &y)
    {
      Matrix<double, 6, 2> result;
      result << y.a11, y.a12, y.a12, y.a22;
      return result;
    }

    Matrix<double, 3, 2>
    tangents(const SurfaceGeometry &y)
    {
      Matrix<double, 3, 2> result;
      result << y.a1, y.a2;
      return result;
    }



    /** How the closest point xi of a surface moves with the surface and with x:
     *  a_alpha . (x - y) = 0, on a border of the patch along it only. */
    Vector2d
    motion_of_projection(const Vector2d        &xi,
                         const SurfaceGeometry &y,
                         const Vector3d        &x,
                         const SurfaceGeometry &dy,
                         const Vector3d        &dx)
    {
      const Matrix<double, 3, 2> a   = tangents(y);
      const Vector3d             gap = x - y.y;
      Eigen::Matrix2d            by_xi;
      by_xi << gap.dot(y.a11), gap.dot(y.a12), gap.dot(y.a12), gap.dot(y.a22);
      by_xi -= a.transpose() * a;
      Vector2d h = tangents(dy).transpose() * gap + a.transpose() * (dx - dy.y);
      for (unsigned int d = 0; d < 2; ++d)
        if (xi[d] == 0. || xi[d] == 1.)
          {
            by_xi.row(d).setZero();
            by_xi(d, d) = 1.;
            h[d]        = 0.;
          }
      const Vector2d motion = -by_xi.inverse() * h;
      return motion.allFinite() ? motion : Vector2d(Vector2d::Zero());
    }
  } // namespace



  /** What a step asks of all points. */
  struct InterfaceSensitivity::Step
  {
    const InterfaceSensitivity         &of;
    const ContactInterface             &interface;
    const Side                          slave;
    const MasterSurface                 master, old_master;
    const InterfaceConfiguration       &configuration;
    const RigidMotion                   rigid;
    const std::vector<InterfaceMotion> &motions;
  };



  /** A closed point in the step, as far as it is the same for all parameters.
   */
  struct InterfaceSensitivity::PointStep
  {
    const Step             &step;
    const unsigned int      q;
    const SlavePoint       &point;
    const bool              slips;
    const ContactPointState start;
    const Vector3d          old_x, x;
    ContactPointMode        mode;
    SurfaceGeometry         old_y;   ///< at xi_hat^n, where that is now
    SurfaceGeometry         y;       ///< at xi_hat
    SurfaceGeometry         start_y; ///< at xi_hat^n, where that was
    SurfaceBasis            start_basis;
    PointData               by_data;
    FrictionCoefficient     begin, end; ///< of the law

    PointStep(const Step &step, unsigned int q);
    History
    start_history(unsigned int j) const;
    double
    difference(unsigned int j, double distance) const;
    double
    distance() const
    {
      return mode.frictionless ? 0. : point.trial.state.slip - start.slip;
    }
  };



  InterfaceSensitivity::PointStep::PointStep(const Step        &step,
                                             const unsigned int q)
    : step(step)
    , q(q)
    , point(step.interface.points[q])
    , slips(point.trial.state.status == PointStatus::slip)
    , start(point.accepted.has_partner ?
              point.accepted :
              step.interface.entry(point, step.configuration))
    , old_x(
        interpolate(point.basis, step.interface.accepted_positions[step.slave]))
    , x(interpolate(point.basis, step.configuration.side[step.slave].positions))
    , mode(step.interface.mode_now)
  {
    if (step.interface.law.slip_direction == SlipDirection::integrated)
      mode.turn = step.rigid.turn_of_way(old_x, step.slave);
    const ContactPointLaw &law    = step.interface.law;
    const MasterSurface   &master = step.master;
    SurfaceBasis           basis;
    master.surface->evaluate(start.xi, start_basis, true);
    contract(start_basis, *master.positions, true, old_y);
    if (start.status == PointStatus::open)
      contract(start_basis, *step.old_master.positions, true, start_y);
    y = old_y;
    if (slips)
      {
        master.surface->evaluate(point.trial.state.xi, basis, true);
        contract(basis, *master.positions, true, y);
      }
    by_data = differentiate_by_data(
      law, start, point.phi_0, x, master, mode, point.trial);
    if (mode.frictionless)
      return;
    const FrictionState state =
      friction_state(start, point.phi_0, mode.duration);
    begin = law.friction->coefficient(state, 0.);
    end   = law.friction->coefficient(state, std::max(0., distance()));
  }



  // An open point has its xi_hat^n from its projection, and no other history
  // than its sliding distance.
  InterfaceSensitivity::History
  InterfaceSensitivity::PointStep::start_history(const unsigned int j) const
  {
    History history = step.of.histories[q * step.motions.size() + j];
    if (start.status != PointStatus::open)
      return history;
    const NodalSums &moved = step.of.accepted[j].surfaces;
    SurfaceGeometry  dy;
    contract(start_basis, moved[other(step.slave)], false, dy);
    history.xi =
      motion_of_projection(start.xi,
                           start_y,
                           old_x,
                           dy,
                           interpolate(point.basis, moved[step.slave]));
    history.pressure = 0.;
    history.gap.setZero();
    return history;
  }



  // dmu/dp after a given distance from a given state.
  double
  InterfaceSensitivity::PointStep::difference(const unsigned int j,
                                              const double       distance) const
  {
    const Parameter &parameter = step.of.parameters[j];
    const auto       mu        = [&](const unsigned int sign) {
      return parameter.law[sign]
        .friction
        ->coefficient(friction_state(start,
                                     parameter.phi_0[sign][q],
                                     mode.duration),
                      distance)
        .mu;
    };
    return parameter.changes_friction ? (mu(0) - mu(1)) / parameter.width : 0.;
  }



  /** What becomes of a point with a parameter: traction, xi_hat, and the rest
   *  of its history. */
  struct InterfaceSensitivity::PointChange
  {
    PointChange(const PointStep &at, unsigned int j);
    History
    history() const;

    Vector3d traction;
    Vector2d xi;

  private:
    void
    find_data();

    const PointStep                        &at;
    const History                           start;
    LocalVector                             dw;
    Matrix<double, PointData::n_columns, 1> data;
    double                                  slip;
  };



  // The history moves xi_hat^n. While the point sticks that is where master
  // point and tangents are; once it slides it is where it came from, and what
  // it brings along of the gap.
  InterfaceSensitivity::PointChange::PointChange(const PointStep   &at,
                                                 const unsigned int j)
    : at(at)
    , start(at.start_history(j))
  {
    const Step            &step   = at.step;
    const InterfaceMotion &motion = step.motions[j], &old = step.of.accepted[j];
    const ContactPointResult  &trial = at.point.trial;
    const Matrix<double, 3, 2> a     = tangents(at.old_y);
    const Matrix<double, 6, 2> by_xi = tangents_by_xi(at.old_y);
    double                     turn  = 0.;
    if (at.slips &&
        step.interface.law.slip_direction == SlipDirection::integrated)
      turn = step.rigid.change_of_turn(at.old_x,
                                       interpolate(at.point.basis,
                                                   old.surfaces[step.slave]),
                                       step.slave,
                                       old.implant,
                                       motion.implant);
    dw = local_motion(at.point, step.slave, motion.surfaces, turn);
    const Matrix<double, 6, 1> turned = by_xi * start.xi;
    if (at.slips)
      {
        dw.segment<3>(12) += a * start.xi;
        dw.segment<3>(15) += a * start.gap +
                             at.start.gap[0] * turned.head<3>() +
                             at.start.gap[1] * turned.tail<3>();
      }
    else
      {
        dw.segment<3>(3) += a * start.xi;
        dw.segment<6>(6) += turned;
      }

    // What the law is at p + h and p - h, and what its limits make of the
    // history.
    const Parameter       &parameter = step.of.parameters[j];
    const ContactPointLaw &law       = step.interface.law;
    const auto             per_unit  = [&](const auto &value) {
      return (value(parameter.law[0]) - value(parameter.law[1])) /
             parameter.width;
    };
    data.setZero();
    data[PointData::pressure] = per_unit([&](const ContactPointLaw &varied) {
      return varied.normal->respond(trial.normal_gap, at.start).pressure;
    });
    data[PointData::eps_t]    = per_unit(
      [](const ContactPointLaw &varied) { return varied.tangential_penalty; });
    if (at.slips && !at.mode.frictionless)
      {
        const double old_p = at.start.pressure, eps_t = law.tangential_penalty;
        const double old_mu = at.difference(j, 0.) + at.begin.dmu * start.slip;
        data[PointData::old_mu] = old_mu;
        data[PointData::old_limit] =
          (old_mu * old_p + at.begin.mu * start.pressure -
           at.begin.mu * old_p / eps_t * data[PointData::eps_t]) /
          eps_t;
        data[PointData::mu] = at.difference(j, std::max(0., at.distance())) +
                              at.end.dmu * start.slip;
        data[PointData::viscous] = per_unit([&](const ContactPointLaw &varied) {
          return viscous_stiffness(varied, at.mode);
        });
      }
    traction = trial.dt * dw + at.by_data.dt * data;
    xi = at.slips ? Vector2d(trial.dxi * dw + at.by_data.dxi * data) : start.xi;
    slip = start.slip;
    if (at.slips && !at.mode.frictionless)
      slip += trial.dslip.dot(dw.transpose()) + at.by_data.dslip.dot(data);
  }



  // p from g_n = n . (x - y), and the parts of the tangential gap G, which is
  // t_t / eps_t while the point slides and else x - y: with the tangents A, the
  // parts c solve A^T A c = A^T G.
  InterfaceSensitivity::History
  InterfaceSensitivity::PointChange::history() const
  {
    const ContactPointResult &trial = at.point.trial;
    const ContactPointLaw    &law   = at.step.interface.law;
    const MasterNormal        normal(at.y, at.step.master.outward_sign);
    const Vector3d            g  = at.x - at.y.y;
    Matrix<double, 6, 1>      da = dw.segment<6>(6);
    Vector3d                  dy = dw.segment<3>(3);
    if (at.slips)
      {
        da += tangents_by_xi(at.y) * xi;
        dy += tangents(at.y) * xi;
      }
    const Vector3d dn = normal.derivative() * da;
    const Vector3d dg = dw.head<3>() - dy;
    History        result;
    result.xi   = xi;
    result.slip = slip;
    result.pressure =
      data[PointData::pressure] -
      law.normal->respond(trial.normal_gap, at.start).stiffness *
        (normal.n.dot(dg) + g.dot(dn));
    Vector3d G = g, dG = dg;
    if (at.slips)
      {
        const double eps_t = law.tangential_penalty;
        G                  = trial.tangential_traction / eps_t;
        dG                 = (traction + result.pressure * normal.n +
              trial.state.pressure * dn - data[PointData::eps_t] * G) /
             eps_t;
      }
    const Matrix<double, 3, 2> A = tangents(at.y);
    Matrix<double, 3, 2>       dA;
    dA << da.head<3>(), da.tail<3>();
    const Vector2d &c = trial.state.gap;
    result.gap        = (A.transpose() * A).inverse() *
                 (dA.transpose() * (G - A * c) + A.transpose() * (dG - dA * c));
    return result;
  }



  // One pass over the points for all parameters, since most of the work at a
  // point is the same for each of them. Sums as in evaluate(): threads change
  // no digit. An open point keeps the derivative of its sliding distance.
  std::vector<NodalSums>
  InterfaceSensitivity::sum_changes(const InterfaceConfiguration &configuration,
                                    const std::vector<InterfaceMotion> &motions,
                                    std::vector<History> *advanced) const
  {
    MasterSurface old_master = interface.master(configuration);
    old_master.positions =
      &interface.accepted_positions[interface.master_side()];
    const Step                                   step{*this,
                    interface,
                    interface.slave,
                    interface.master(configuration),
                    old_master,
                    configuration,
                    RigidMotion({interface.accepted_frame,
                                                                   interface.accepted_centre},
                                Place::of_implant(configuration)),
                    motions};
    const unsigned int                           n = parameters.size();
    std::array<std::vector<NodalSums>, n_chunks> sums;
    for_each_chunk(interface.points.size(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int last) {
                     sums[chunk].assign(n, zero_sums(configuration));
                     for (unsigned int q = first; q < last; ++q)
                       if (interface.points[q].trial.state.status !=
                           PointStatus::open)
                         {
                           const PointStep at(step, q);
                           for (unsigned int j = 0; j < n; ++j)
                             {
                               const PointChange change(at, j);
                               spread_change(at.point,
                                             step.slave,
                                             at.point.JxW * change.traction,
                                             change.xi,
                                             sums[chunk][j]);
                               if (advanced)
                                 (*advanced)[q * n + j] = change.history();
                             }
                         }
                   });
    for (unsigned int chunk = 1; chunk < n_chunks; ++chunk)
      for (unsigned int j = 0; j < n; ++j)
        for (const Side side : both_sides)
          sums[0][j][side] += sums[chunk][j][side];
    return std::move(sums[0]);
  }



  std::vector<NodalSums>
  InterfaceSensitivity::forces(
    const InterfaceConfiguration       &configuration,
    const std::vector<InterfaceMotion> &motions) const
  {
    return sum_changes(configuration, motions, nullptr);
  }



  std::vector<NodalSums>
  InterfaceSensitivity::advance(const InterfaceConfiguration &configuration,
                                std::vector<InterfaceMotion>  motions)
  {
    std::vector<History>   advanced = histories;
    std::vector<NodalSums> result =
      sum_changes(configuration, motions, &advanced);
    histories = std::move(advanced);
    accepted  = std::move(motions);
    return result;
  }
} // namespace Debond
