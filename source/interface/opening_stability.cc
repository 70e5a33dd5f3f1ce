#include <debond/bulk/chuck.h>
#include <debond/interface/contact_interface.h>

#include <algorithm>
#include <cmath>

// A bond that opens beyond its strength pulls less the wider it is open. While
// it falls more slowly than bodies and chuck let go, energy is convex in all
// motions that open it, and there is one state of equilibrium only.
namespace Debond
{
  bool
  ContactInterface::has_opened_beyond_strength(const SlavePoint &point) const
  {
    const InterfaceLaw &joint = *law.joint;
    if (joint.is_cohesive())
      return point.trial.state.damage > point.accepted.damage;
    return joint.pulls() && point.phi_0 > 0. &&
           point.trial.state.status != PointStatus::open &&
           joint.opened(point.trial.state) >
             std::max(joint.opened(point.accepted), joint.tension().gap);
  }



  Eigen::Matrix3d
  ContactInterface::what_opens(const SlavePoint             &point,
                               const InterfaceConfiguration &configuration,
                               SurfaceBasis                 &basis) const
  {
    const MasterSurface surface = master(configuration);
    SurfaceGeometry     geometry;
    surface.surface->evaluate(point.trial.state.xi, basis, false);
    if (law.joint->is_cohesive())
      return Eigen::Matrix3d::Identity();
    contract(basis, *surface.positions, false, geometry);
    const Eigen::Vector3d n = MasterNormal(geometry, surface.outward_sign).n;
    return n * n.transpose();
  }



  double
  ContactInterface::opening_by_chuck(
    const InterfaceConfiguration &configuration,
    const unsigned int            component) const
  {
    SurfaceBasis basis;
    double       sum = 0.;
    for (const SlavePoint &point : points)
      if (point.phi_0 > 0. && point.trial.state.has_partner)
        {
          const Eigen::Vector3d motion = configuration.chuck->velocity(
            component,
            interpolate(point.basis, configuration.side[slave].positions));
          sum +=
            point.JxW * point.phi_0 *
            (what_opens(point, configuration, basis) * motion).squaredNorm();
        }
    return sum;
  }



  // The softening of a point is that of a full bond times phi_0. So the state
  // is unique while this times the largest eigenvalue of phi_0 C is less than
  // 1, C being the compliance of the bodies: tractions to gaps, both normal to
  // the face. Power iteration finds it, as compliance falls with the wave
  // number. The bodies move along the face as they like: that no friction holds
  // them can but raise it. A share that is held softens in all directions, and
  // counts tractions and gaps in all of them.
  double
  ContactInterface::compliance_of_opening(
    const InterfaceConfiguration &configuration,
    const unsigned int            n_unknowns,
    const std::function<Eigen::VectorXd(const Eigen::VectorXd &)> &solve) const
  {
    struct Place
    {
      const SlavePoint *point;
      SurfaceBasis      basis;    ///< of the master
      Eigen::Matrix3d   opens;    ///< projection on what opens the bond
      Eigen::Vector3d   traction; ///< [MPa]
    };
    std::vector<Place> places;
    for (const SlavePoint &point : points)
      if (point.phi_0 > 0. && point.trial.state.has_partner)
        {
          Place place{&point, {}, {}, {}};
          place.opens = what_opens(point, configuration, place.basis);
          // not along a motion that is none of the bodies
          place.traction =
            point.phi_0 * place.opens * Eigen::Vector3d(0.4, 0.5, 1.);
          places.push_back(place);
        }
    constexpr unsigned int most_iterations = 100;
    constexpr double       accuracy        = 1e-3;
    double                 compliance      = 0.;
    for (unsigned int i = 0; i < most_iterations; ++i)
      {
        NodalSums forces  = zero_sums(configuration);
        double    squared = 0., gaps_squared = 0.;
        for (const Place &place : places)
          {
            const Eigen::Vector3d f = place.point->JxW * place.traction;
            spread(place.point->basis, f, forces[slave]);
            spread(place.basis, -f, forces[master_side()]);
            squared += place.point->JxW * place.traction.squaredNorm() /
                       place.point->phi_0;
          }
        Eigen::VectorXd loads = Eigen::VectorXd::Zero(n_unknowns);
        add_in_unknowns(forces, configuration, 1., loads);
        const NodalSums motion = nodal_motion(solve(loads), configuration);
        for (Place &place : places)
          {
            const Eigen::Vector3d gap =
              place.opens * (interpolate(place.point->basis, motion[slave]) -
                             interpolate(place.basis, motion[master_side()]));
            gaps_squared +=
              place.point->JxW * place.point->phi_0 * gap.squaredNorm();
            place.traction = place.point->phi_0 * gap;
          }
        const double before = compliance;
        compliance = squared > 0. ? std::sqrt(gaps_squared / squared) : 0.;
        if (std::abs(compliance - before) <= accuracy * compliance)
          break;
        for (Place &place : places)
          place.traction /= compliance;
      }
    return compliance;
  }
} // namespace Debond
