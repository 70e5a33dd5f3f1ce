#include <debond/bulk/bulk_space.h>
#include <debond/interface/contact_interface.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

// What all points of the interface come to in a state: what a step is judged
// by, and what messages say.
namespace Debond
{
  // The way of a point over the master and the stretch of its spring are
  // vectors in the master's frame, so that a way back undoes the way there, and
  // the motion of the chuck as a whole is none. Bone grows in where faces move
  // by less than 28 um and does not where they move by more than 150 um
  // (Pilliar, Lee and Maniatopoulos 1986).
  RelativeMotion
  ContactInterface::relative_motion() const
  {
    std::vector<std::pair<double, double>> motions; // [um], area
    RelativeMotion                         result;
    double                                 area = 0.;
    for (const SlavePoint &point : points)
      if (point.faces_implant)
        {
          const double motion = 1e3 * motion_since_mark(point).norm();
          motions.emplace_back(motion, point.JxW);
          area += point.JxW;
          result.mean_um += point.JxW * motion;
          result.share_above_28_um += motion > 28. ? point.JxW : 0.;
          result.share_above_150_um += motion > 150. ? point.JxW : 0.;
        }
    for (double *const mean : {&result.mean_um,
                               &result.share_above_28_um,
                               &result.share_above_150_um})
      *mean /= area;
    std::sort(motions.begin(), motions.end());
    double below = 0.;
    for (const auto &[motion, own] : motions)
      {
        result.percentile_95_um = motion;
        if ((below += own) >= 0.95 * area)
          break;
      }
    return result;
  }



  void
  ContactInterface::mark_motion()
  {
    for (SlavePoint &point : points)
      point.marked += motion_since_mark(point);
  }



  // Open, stick or slip of all points in the trial state. Newton's method
  // compares them over its iterations: states of all points that have been
  // there before are a cycle between stick and slip.
  std::vector<PointStatus>
  ContactInterface::statuses() const
  {
    std::vector<PointStatus> result;
    for (const SlavePoint &point : points)
      result.push_back(point.trial.state.status);
    return result;
  }



  // What is held at its place sticks there, unless it is pulled; what rubs
  // beside it tells after that.
  PointStatus
  ContactInterface::status(const SlavePoint &point) const
  {
    const CohesiveShare *const share = held_share(point);
    if (!share || share->damage == 1.)
      return point.trial.state.status;
    return share->normal.dot(share->bears) > mode_now.touch_tolerance ?
             PointStatus::pulled :
             PointStatus::stick;
  }



  // Whether contact is incomplete. What lies beside closed points on the
  // surface of a linear body matters to open ones only
  // (doc/explanation/solution.md).
  bool
  ContactInterface::has_open_points() const
  {
    const auto all = statuses();
    return std::find(all.begin(), all.end(), PointStatus::open) != all.end();
  }



  double
  ContactInterface::smallest_gap() const
  {
    double smallest = std::numeric_limits<double>::infinity(); // [mm]
    for (const SlavePoint &point : points)
      if (point.accepted.has_partner)
        smallest = std::min(smallest, point.trial.normal_gap);
    return smallest;
  }



  bool
  ContactInterface::is_detached() const
  {
    constexpr double nothing = 1e-6; // of a bond
    return law.joint->pulls() &&
           std::none_of(
             points.begin(), points.end(), [this](const SlavePoint &point) {
               const ContactPointState &state = point.trial.state;
               return point.trial.pressure > 0. ||
                      (state.joined &&
                       point.friction(*law.joint, state).phi > nothing);
             });
  }



  // Surfaces that are pressed together touch over a patch. Open points inside
  // of it tell that the faces of the elements cannot take the shape that a
  // stiff interface asks for: each touches in some places only, with too large
  // a pressure. Points lie in rows and columns over the whole surface, which
  // are curved on a disk: one alone may leave the patch and come back. Patches
  // of a bond that is pulled enclose nothing, and where points climb as they
  // slide only gaps count that the highest of them would leave as well.
  unsigned int
  ContactInterface::n_enclosed() const
  {
    const NurbsSurface &surface = mesh[slave]->surface();
    if (!surface.is_one_patch())
      return 0; // there are no rows
    // A point counts if closed ones lie on both sides of it in its row and in
    // its column. That is linear in the number of points, where patches would
    // have to be searched for neighbours.
    const auto         elements = surface.n_elements_per_direction();
    const unsigned int n        = along.size();
    // element by element, and in each of them, the first parameter fastest
    const auto number = [&](const unsigned int i, const unsigned int j) {
      return ((j / n * elements[0] + i / n) * n + j % n) * n + i % n;
    };
    double highest = 0.; // [mm]
    if (!law.joint->pulls())
      for (const SlavePoint &one : points)
        if (one.trial.pressure > 0.)
          highest =
            std::max(highest,
                     law.joint->reach(one.begin(*law.joint, mode_now), 0.));
    const auto is_pressed = [&](const unsigned int q) {
      return status(points[q]) != PointStatus::open &&
             points[q].trial.pressure > 0.;
    };
    const auto has_opened = [&](const unsigned int q) { // not beyond the edge
      return status(points[q]) == PointStatus::open &&
             points[q].accepted.has_partner &&
             points[q].trial.normal_gap > highest;
    };
    // in its row, its column, or both
    std::vector<unsigned int> times_enclosed(points.size(), 0);
    for (const bool is_row : {true, false})
      for (unsigned int line = 0; line < n * elements[is_row]; ++line)
        {
          std::vector<unsigned int> all;
          for (unsigned int k = 0; k < n * elements[!is_row]; ++k)
            all.push_back(is_row ? number(k, line) : number(line, k));
          auto       q = std::find_if(all.begin(), all.end(), is_pressed);
          const auto last =
            std::find_if(all.rbegin(), all.rend(), is_pressed).base();
          for (; q < last; ++q)
            times_enclosed[*q] += has_opened(*q);
        }
    return std::count(times_enclosed.begin(), times_enclosed.end(), 2u);
  }



  bool
  ContactInterface::has_opened_beyond_strength(const SlavePoint &point) const
  {
    // Only then can the pull fall: up to the strength it rises with the gap,
    // whatever the bond.
    const InterfaceLaw &joint = *law.joint;
    if (joint.cohesion)
      return point.trial.state.damage > point.accepted.damage;
    // opened() is kappa, the largest gap so far, and tension.gap that of the
    // strength
    return joint.pulls() && point.phi_0 > 0. &&
           point.trial.state.status != PointStatus::open &&
           joint.opened(point.trial.state) >
             std::max(joint.opened(point.accepted), joint.tension.gap);
  }


  // What a step is judged by. Areas count where the implant is faced, forces
  // and energies everywhere. The local problem of a sliding point has one
  // solution while |dmu/dg_s| p < eps_t + eta/dt: the slope is asked for where
  // it will be steepest, so that a step that ends beyond the steepest place is
  // not missed.
  //
  // There p is the pressure of the trial state [MPa], and eps_t + eta/dt the
  // resistance [MPa/mm] with which the elastic interface, and the viscosity,
  // hold against the fall of the law. A ratio of one or more means that the
  // bond would break in a jump of the traction, and that which of the solutions
  // Newton's method has met is chance.
  InterfaceSummary
  ContactInterface::summarise() const
  {
    InterfaceSummary summary;
    double           area = 0.;
    // open, stick, slip, pulled, shears: see PointStatus
    const std::array<double *, 5> share_of{{&summary.share_open,
                                            &summary.share_stick,
                                            &summary.share_slip,
                                            &summary.share_pulled,
                                            &summary.share_shears}};
    const double                  resistance =
      law.tangential_penalty + viscous_stiffness(law, mode_now);
    for (const SlavePoint &point : points)
      {
        const ContactPointResult &trial = point.trial;
        summary.n_beyond += !point.accepted.has_partner;
        summary.n_crossed += point.faces_implant != point.accepted.has_partner;
        if (const CohesiveShare *const share = held_share(point))
          summary.energy += point.JxW * share->energy;
        if (law.joint->pulls() && law.joint->tension.viscosity == 0. &&
            has_opened_beyond_strength(point))
          summary.opening_softening =
            std::max(summary.opening_softening,
                     point.phi_0 * law.joint->tension.softening);
        if (point.faces_implant)
          {
            // phi as reported() has it, of the trial state, and the share of
            // the area by its status; divided by the area below
            area += point.JxW;
            summary.phi_mean += point.JxW * friction(point).phi;
            summary.pressure += point.JxW * trial.pressure;
            const PointTraction carried = traction(point);
            summary.tangential += point.JxW * carried.tangential.norm();
            summary.squared_traction +=
              point.JxW * (std::pow(carried.pressure, 2) +
                           carried.tangential.squaredNorm());
            *share_of[static_cast<unsigned int>(status(point))] += point.JxW;
          }
        if (status(point) != PointStatus::open)
          ++summary.n_closed;
        if (trial.state.status == PointStatus::open)
          {
            // whether it was bonded: opening itself may have broken it
            if (!law.joint->pulls() && law.joint->friction->has_bond() &&
                point.accepted.status != PointStatus::open &&
                point.friction(*law.joint, point.accepted).phi > 0.)
              ++summary.bonded_opened;
            continue;
          }
        // Energy of the springs eps_n and eps_t [N mm], the potential that Eq.
        // (28) comes from; and the largest penetration -g_n [mm], which a
        // push-in in wrong units shows.
        summary.energy += point.JxW * trial.energy;
        summary.max_penetration =
          std::max(summary.max_penetration, -trial.normal_gap);
        summary.max_traction =
          std::max(summary.max_traction, trial.traction.norm());
        if (mode_now.frictionless)
          continue;
        find_steepest(point, resistance, summary);
      }
    find_side(summary);
    // means over the area that faced the implant at the start
    summary.phi_mean /= area;
    summary.pressure /= area;
    summary.tangential /= area;
    for (double *part : share_of)
      *part /= area;
    return summary;
  }



  // The force acts on the implant at the slave point itself or, with the bone
  // as slave, at the interacting point, as in the nodal forces of Eq. (36).
  PointLoad
  ContactInterface::load(const unsigned int     q,
                         const Eigen::Vector3d &centre) const
  {
    const SlavePoint &point = points[q];
    const double      area  = point.JxW;
    PointLoad         load;
    const auto add = [&](const auto &part, const SurfaceBasis &of_master) {
      const bool            is_slave = slave == Side::implant;
      const Eigen::Vector3d f = (is_slave ? area : -area) * part.traction,
                            x = interpolate(is_slave ? point.basis : of_master,
                                            accepted_positions[Side::implant]);
      // about the given centre, with the lever arm of the accepted state
      load.force += f;
      load.moment += (x - centre).cross(f);
      load.energy += area * part.energy;
    };
    if (point.trial.state.status != PointStatus::open)
      add(point.trial, point.trial.basis);
    if (const CohesiveShare *const share = held_share(point))
      add(*share, share->basis);
    return load;
  }



  // -dL/dg_s where it is largest, from the accepted g_s on [MPa/mm]. The
  // steepest point is kept with its numbers, which the message of a run that
  // ends here has to give.
  void
  ContactInterface::find_steepest(const SlavePoint &point,
                                  const double      resistance,
                                  InterfaceSummary &summary) const
  {
    // a bound over the distance of this step and what is still to come, by the
    // law
    const PointStart start = point.begin(*law.joint, mode_now);
    const BoneLayer &bone  = law.joint->bone;
    // faces that hold more than the bone do not slide, and cannot soften
    if (bone.shears() && !bone.shear_wears_bond &&
        law.joint->respond(start, point.trial.normal_gap, 0.).limit >=
          bone.shear_strength)
      return;
    const double slope     = law.joint->softening_by_slip(start,
                                                      point.trial.pressure,
                                                      point.trial.state.slip -
                                                        point.accepted.slip);
    const double softening = slope / resistance;
    if (softening > summary.steepest_softening)
      {
        summary.steepest_softening = softening;
        summary.softening_pressure = std::max(0., point.trial.pressure);
        summary.softening_slope    = slope;
      }
  }



  // A body that comes from beside the other one, below its face, would run into
  // its side, which is no contact face. What has come to it from above, and
  // hangs over its edge, may well be pressed deeper while it slides in; other
  // points have faced the master then.
  void
  ContactInterface::find_side(InterfaceSummary &summary) const
  {
    if (summary.n_closed == 0 ||
        std::any_of(points.begin(), points.end(), [](const SlavePoint &point) {
          return point.accepted.has_partner;
        }))
      return;
    // Heights over the accepted master: a point that was more than half as deep
    // below it as it is now has come from the side.
    const MasterSurface before{&mesh[master_side()]->surface(),
                               &accepted_positions[master_side()],
                               mesh[master_side()]->outward_sign()};
    for (const SlavePoint &point : points)
      {
        const double depth = -point.trial.normal_gap;
        if (point.trial.state.status == PointStatus::open ||
            -project(before,
                     interpolate(point.basis, accepted_positions[slave]),
                     &point.trial.state.xi)
                .height < 0.5 * depth)
          continue;
        ++summary.n_from_side;
        summary.side_depth = std::max(summary.side_depth, depth);
      }
  }



  // Where the last evaluate() failed, in parameters of the slave's patch, which
  // say which element it is; and how far the point had slid, which says which
  // part of the law it was on.
  std::string
  ContactInterface::describe_failure() const
  {
    if (failed == nullptr)
      return "";
    return Text() << (failed->trial.negative_friction ?
                        "the friction law has a negative coefficient" :
                        "no solution of the friction law")
                  << " at the " << name_of(slave)
                  << "'s quadrature point at parameters (" << failed->xi[0]
                  << ", " << failed->xi[1]
                  << "), g_s = " << failed->accepted.slip << " mm";
  }
} // namespace Debond
