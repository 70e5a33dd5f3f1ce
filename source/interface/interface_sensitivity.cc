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
    , histories(accepted.size(),
                std::vector<History>(interface.points.size(), History::Zero()))
    , changes(accepted.size(), std::vector<Change>(interface.points.size()))
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
    Lanes<2>
    motion_of_projection(const Vector2d        &xi,
                         const SurfaceGeometry &y,
                         const Vector3d        &x,
                         const Lanes<9>        &dy,
                         const Lanes<3>        &dx)
    {
      const Matrix<double, 3, 2> a   = tangents(y);
      const Vector3d             gap = x - y.y;
      Eigen::Matrix2d            by_xi;
      by_xi << gap.dot(y.a11), gap.dot(y.a12), gap.dot(y.a12), gap.dot(y.a22);
      by_xi -= a.transpose() * a;
      Lanes<2> h = (dx - dy.leftCols<3>()) * a;
      h.col(0) += dy.middleCols<3>(3) * gap;
      h.col(1) += dy.rightCols<3>() * gap;
      for (unsigned int d = 0; d < 2; ++d)
        if (xi[d] == 0. || xi[d] == 1.)
          {
            by_xi.row(d).setZero();
            by_xi(d, d) = 1.;
            h.col(d).setZero();
          }
      const Lanes<2> motion = -h * by_xi.inverse().transpose();
      return motion.allFinite() ? motion : Lanes<2>(Lanes<2>::Zero());
    }
  } // namespace



  /** What a step asks of all points. */
  struct InterfaceSensitivity::Step
  {
    const ContactInterface       &interface;
    const InterfaceConfiguration &configuration;
    const Side                    slave;
    const MasterSurface           master;
    const RigidMotion             rigid;
    const bool                    turns; ///< the way of points that slide

    Step(const ContactInterface       &interface,
         const InterfaceConfiguration &configuration)
      : interface(interface)
      , configuration(configuration)
      , slave(interface.slave)
      , master(interface.master(configuration))
      , rigid({interface.accepted_frame, interface.accepted_centre},
              Place::of_implant(configuration))
      , turns(interface.law.slip_direction == SlipDirection::integrated)
    {}
  };



  /** A closed point in the step, as far as it is the same for all parameters.
   */
  struct InterfaceSensitivity::PointStep
  {
    const SlavePoint &point;
    const bool        slips;
    const Vector3d    x;
    SurfaceGeometry   y; ///< at xi_hat

    PointStep(const Step &step, const SlavePoint &point)
      : point(point)
      , slips(point.trial.state.status == PointStatus::slip)
      , x(interpolate(point.basis,
                      step.configuration.side[step.slave].positions))
    {
      SurfaceBasis basis;
      step.master.surface->evaluate(point.trial.state.xi, basis, true);
      contract(basis, *step.master.positions, true, y);
    }
  };



  /** The same, with what the step begins with. */
  struct InterfaceSensitivity::PointStart : InterfaceSensitivity::PointStep
  {
    const Step               &step;
    const ContactPointState   start;
    const Vector3d            old_x;
    ContactPointMode          mode;
    SurfaceBasis              old_basis;
    SurfaceGeometry           old_y; ///< at xi_hat^n, where that is now
    PointData                 by_data;
    FrictionCoefficient       begin, end; ///< of the law
    double                    distance = 0.;
    RigidMotion::TurnGradient by_turn;

    PointStart(const Step &step, const SlavePoint &point);
    History
    history(const History &accepted, const InterfaceMotion &moved) const;
    double
    difference(const Parameter &parameter,
               unsigned int     q,
               double           distance) const;
    Lanes<1>
    turn(const Block &block) const;
  };



  InterfaceSensitivity::PointStart::PointStart(const Step       &step,
                                               const SlavePoint &point)
    : PointStep(step, point)
    , step(step)
    , start(point.accepted.has_partner ?
              point.accepted :
              step.interface.entry(point, step.configuration))
    , old_x(
        interpolate(point.basis, step.interface.accepted_positions[step.slave]))
    , mode(step.interface.mode_now)
    , old_y(y)
  {
    const ContactPointLaw &law = step.interface.law;
    step.master.surface->evaluate(start.xi, old_basis, true);
    if (slips)
      contract(old_basis, *step.master.positions, true, old_y);
    if (step.turns)
      mode.turn = step.rigid.turn_of_way(old_x, step.slave);
    if (slips && step.turns)
      by_turn = step.rigid.gradient_of_turn(old_x, step.slave);
    by_data = differentiate_by_data(
      law, start, point.phi_0, x, step.master, mode, point.trial);
    if (mode.frictionless || !slips)
      return;
    const FrictionState state =
      friction_state(start, point.phi_0, mode.duration);
    distance = std::max(0., point.trial.state.slip - start.slip);
    begin    = law.friction->coefficient(state, 0.);
    end      = law.friction->coefficient(state, distance);
  }



  // An open point has its xi_hat^n from its projection, and no other history
  // than its sliding distance.
  InterfaceSensitivity::History
  InterfaceSensitivity::PointStart::history(const History         &accepted,
                                            const InterfaceMotion &moved) const
  {
    if (start.status != PointStatus::open)
      return accepted;
    SurfaceGeometry start_y;
    contract(old_basis,
             step.interface.accepted_positions[other(step.slave)],
             true,
             start_y);
    History result       = History::Zero();
    result.col(at_slip)  = accepted.col(at_slip);
    result.leftCols<2>() = motion_of_projection(
      start.xi,
      start_y,
      old_x,
      interpolate_tangents(old_basis, moved.surfaces[other(step.slave)]),
      interpolate_place(point.basis, moved.surfaces[step.slave]));
    return result;
  }



  // dmu/dp after a given distance from a given state.
  double
  InterfaceSensitivity::PointStart::difference(const Parameter   &parameter,
                                               const unsigned int q,
                                               const double distance) const
  {
    const auto mu = [&](const unsigned int sign) {
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



  /** n_lanes parameters: how they move both ends of the step. */
  struct InterfaceSensitivity::Block
  {
    const unsigned int     first_parameter;
    const InterfaceMotion &old, &given;
    bool                   is_at_rest; ///< by what is given
    Lanes<3>               axis, turn; ///< of RigidMotion

    Block(const unsigned int     number,
          const RigidMotion     &rigid,
          const InterfaceMotion &old,
          const InterfaceMotion &given)
      : first_parameter(number * n_lanes)
      , old(old)
      , given(given)
      , is_at_rest(given.surfaces[Side::implant].isZero(0.))
      , turn(given.spin - old.spin * rigid.turn.transpose())
    {
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        axis.row(lane) = rigid.change_of_axis(turn.row(lane).transpose());
    }
  };



  Lanes<1>
  InterfaceSensitivity::PointStart::turn(const Block &block) const
  {
    return interpolate_place(point.basis, block.old.surfaces[step.slave]) *
             by_turn.x +
           block.old.shift * by_turn.old_centre +
           block.given.shift * by_turn.centre + block.axis * by_turn.axis +
           block.turn * by_turn.turn + block.given.spin * by_turn.frame;
  }



  // What the law is at p + h and p - h, and what its limits make of the
  // history.
  void
  InterfaceSensitivity::set_data(const PointStart  &at,
                                 const unsigned int q,
                                 const unsigned int first_parameter,
                                 const History     &start,
                                 Change            &change) const
  {
    const bool   rubs  = at.slips && !at.mode.frictionless;
    const double eps_t = interface.law.tangential_penalty,
                 old_p = at.start.pressure;
    change.data.setZero();
    for (unsigned int lane = 0;
         lane < n_lanes && first_parameter + lane < parameters.size();
         ++lane)
      {
        const Parameter &parameter = parameters[first_parameter + lane];
        const auto       per_unit  = [&](const auto &value) {
          return (value(parameter.law[0]) - value(parameter.law[1])) /
                 parameter.width;
        };
        auto data                 = change.data.row(lane);
        data[PointData::pressure] = per_unit([&](const ContactPointLaw &law) {
          return law.normal->respond(at.point.trial.normal_gap, at.start)
            .pressure;
        });
        data[PointData::eps_t]    = per_unit(
          [](const ContactPointLaw &law) { return law.tangential_penalty; });
        if (!rubs)
          continue;
        const double slip = start(lane, at_slip);
        const double old_mu =
          at.difference(parameter, q, 0.) + at.begin.dmu * slip;
        data[PointData::old_mu] = old_mu;
        data[PointData::old_limit] =
          (old_mu * old_p + at.begin.mu * start(lane, at_pressure) -
           at.begin.mu * old_p / eps_t * data[PointData::eps_t]) /
          eps_t;
        data[PointData::mu] =
          at.difference(parameter, q, at.distance) + at.end.dmu * slip;
        data[PointData::viscous] = per_unit([&](const ContactPointLaw &law) {
          return viscous_stiffness(law, at.mode);
        });
      }
  }



  // The history moves xi_hat^n. While the point sticks that is where master
  // point and tangents are; once it slides it is where it came from, and what
  // it brings along of the gap.
  InterfaceSensitivity::Change
  InterfaceSensitivity::change_at_rest(const PointStart  &at,
                                       const unsigned int q,
                                       const Block       &block) const
  {
    const ContactPointResult  &trial = at.point.trial;
    const Matrix<double, 3, 2> a     = tangents(at.old_y);
    const History              start =
      at.history(histories[block.first_parameter / n_lanes][q], block.old);
    Change change;
    if (block.is_at_rest)
      change.dw.setZero();
    else
      change.dw = local_motion(at.point, interface.slave, block.given.surfaces);
    const Lanes<2> xi     = start.middleCols<2>(at_xi);
    const Lanes<3> moved  = xi * a.transpose();
    const Lanes<6> turned = xi * tangents_by_xi(at.old_y).transpose();
    if (at.slips)
      {
        change.dw.middleCols<3>(12) += moved;
        change.dw.middleCols<3>(15) +=
          start.middleCols<2>(at_gap) * a.transpose() +
          at.start.gap[0] * turned.leftCols<3>() +
          at.start.gap[1] * turned.rightCols<3>();
        if (at.step.turns)
          change.dw.col(18) += at.turn(block);
      }
    else
      {
        change.dw.middleCols<3>(3) += moved;
        change.dw.middleCols<6>(6) += turned;
      }
    set_data(at, q, block.first_parameter, start, change);
    change.traction = change.dw.lazyProduct(trial.dt.transpose()) +
                      change.data.lazyProduct(at.by_data.dt.transpose());
    change.xi = xi;
    if (at.slips)
      change.xi = change.dw.lazyProduct(trial.dxi.transpose()) +
                  change.data.lazyProduct(at.by_data.dxi.transpose());
    change.slip = start.col(at_slip);
    if (at.slips && !at.mode.frictionless)
      change.slip += change.dw * trial.dslip.transpose() +
                     change.data * at.by_data.dslip.transpose();
    return change;
  }



  // p from g_n = n . (x - y), and the parts of the tangential gap G, which is
  // t_t / eps_t while the point slides and else x - y: with the tangents A, the
  // parts c solve A^T A c = A^T G.
  InterfaceSensitivity::History
  InterfaceSensitivity::history(const PointStep &at, const Change &change) const
  {
    const ContactPointResult &trial = at.point.trial;
    const ContactPointLaw    &law   = interface.law;
    const SurfaceGeometry    &y     = at.y;
    const MasterNormal        normal(
      y, interface.mesh[interface.master_side()]->outward_sign());
    const Matrix<double, 3, 2> A  = tangents(y);
    const Vector3d             g  = at.x - y.y;
    Lanes<6>                   da = change.dw.middleCols<6>(6);
    Lanes<3> dg = change.dw.leftCols<3>() - change.dw.middleCols<3>(3);
    if (at.slips)
      {
        da += change.xi * tangents_by_xi(y).transpose();
        dg -= change.xi * A.transpose();
      }
    const Lanes<3> dn = da * normal.derivative().transpose();
    History        result;
    result.middleCols<2>(at_xi) = change.xi;
    result.col(at_slip)         = change.slip;
    result.col(at_pressure) =
      change.data.col(PointData::pressure) -
      law.normal->respond(trial.normal_gap, trial.state).stiffness *
        (dg * normal.n + dn * g);
    Vector3d G  = g;
    Lanes<3> dG = dg;
    if (at.slips)
      {
        const double eps_t = law.tangential_penalty;
        G                  = trial.tangential_traction / eps_t;
        dG = (change.traction + result.col(at_pressure) * normal.n.transpose() +
              trial.state.pressure * dn -
              change.data.col(PointData::eps_t) * G.transpose()) /
             eps_t;
      }
    const Eigen::Vector2d &c    = trial.state.gap;
    const Vector3d         rest = G - A * c;
    dG -= c[0] * da.leftCols<3>() + c[1] * da.rightCols<3>();
    Lanes<2> right = dG * A;
    right.col(0) += da.leftCols<3>() * rest;
    right.col(1) += da.rightCols<3>() * rest;
    result.middleCols<2>(at_gap) = right * (A.transpose() * A).inverse();
    return result;
  }



  // One pass over the points for all parameters, since most of the work at a
  // point is the same for each of them. Sums as in evaluate(): threads change
  // no digit.
  template <typename Work>
  std::vector<LaneSums>
  InterfaceSensitivity::sum_over_closed_points(
    const InterfaceConfiguration &configuration,
    const Work                   &work) const
  {
    const unsigned int                          n = accepted.size();
    std::array<std::vector<LaneSums>, n_chunks> sums;
    for_each_chunk(interface.points.size(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int last) {
                     sums[chunk].assign(n, zero_lanes(configuration));
                     for (unsigned int q = first; q < last; ++q)
                       if (interface.points[q].trial.state.status !=
                           PointStatus::open)
                         work(q, sums[chunk]);
                   });
    for (unsigned int chunk = 1; chunk < n_chunks; ++chunk)
      for (unsigned int b = 0; b < n; ++b)
        for (const Side side : both_sides)
          sums[0][b][side] += sums[chunk][b][side];
    return std::move(sums[0]);
  }



  std::vector<LaneSums>
  InterfaceSensitivity::forces(const InterfaceConfiguration &configuration,
                               std::vector<InterfaceMotion>  given_now)
  {
    given = std::move(given_now);
    const Step         step(interface, configuration);
    std::vector<Block> blocks;
    for (unsigned int b = 0; b < given.size(); ++b)
      blocks.emplace_back(b, step.rigid, accepted[b], given[b]);
    return sum_over_closed_points(
      configuration, [&](const unsigned int q, std::vector<LaneSums> &sums) {
        const PointStart at(step, interface.points[q]);
        for (unsigned int b = 0; b < blocks.size(); ++b)
          {
            Change &change = changes[b][q];
            change         = change_at_rest(at, q, blocks[b]);
            spread_change(at.point,
                          step.slave,
                          at.point.JxW * change.traction,
                          change.xi,
                          sums[b]);
          }
      });
  }



  // An open point keeps the derivative of its sliding distance; it has no other
  // history.
  std::vector<LaneSums>
  InterfaceSensitivity::advance(const InterfaceConfiguration &configuration,
                                const std::vector<InterfaceMotion> &response,
                                const std::vector<Lanes<6>>        &chuck)
  {
    const Step step(interface, configuration);
    const auto sums = sum_over_closed_points(
      configuration, [&](const unsigned int q, std::vector<LaneSums> &sums) {
        const PointStep           at(step, interface.points[q]);
        const ContactPointResult &trial = at.point.trial;
        for (unsigned int b = 0; b < response.size(); ++b)
          {
            Change &change = changes[b][q];
            auto dw = local_motion(at.point, step.slave, response[b].surfaces);
            dw.col(18) += chuck[b] * trial.turn_by_chuck;
            change.dw += dw;
            change.traction += dw.lazyProduct(trial.dt.transpose());
            change.xi += dw.lazyProduct(trial.dxi.transpose());
            if (at.slips && !interface.mode_now.frictionless)
              change.slip += dw * trial.dslip.transpose();
            spread_change(at.point,
                          step.slave,
                          at.point.JxW * change.traction,
                          change.xi,
                          sums[b]);
            histories[b][q] = history(at, change);
          }
      });
    for (unsigned int b = 0; b < response.size(); ++b)
      {
        for (const Side side : both_sides)
          accepted[b].surfaces[side] =
            given[b].surfaces[side] + response[b].surfaces[side];
        accepted[b].shift = given[b].shift + response[b].shift;
        accepted[b].spin  = given[b].spin + response[b].spin;
      }
    return sums;
  }
} // namespace Debond
