#include <debond/interface/interface_configuration.h>
#include <debond/support/runtime.h>
#include <debond/system/coupled_system.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

// How the coupled system goes on from a solution, which adaptive steps are
// chosen by: exact derivatives by the time, and what halving the step would
// change.
namespace Debond
{
  InterfaceConfiguration
  CoupledSystem::with_whole_chuck() const
  {
    InterfaceConfiguration moving = configuration;
    const unsigned int     n_v = unknowns - configuration.chuck_unknowns.size();
    moving.chuck_unknowns.clear();
    for (unsigned int k = 0; k < 6; ++k)
      moving.chuck_unknowns.emplace_back(k, n_v + k);
    return moving;
  }



  // What follows from the tangent when the step ends a little later. The chuck
  // moves on, loads grow, and, where friction depends on the speed, the step
  // takes longer; equilibrium says how the unknowns z follow:
  //
  //   A dz/dt = - dr/dt at z fixed.
  //
  // It takes one more solution with the tangent that is there. All six
  // components of the chuck count as unknowns for the moment: their columns are
  // what the motion of a prescribed one does to the forces, and their rows what
  // all of it does to the forces of the chuck.
  CoupledSystem::Rates
  CoupledSystem::rates()
  {
    const InterfaceConfiguration moving = with_whole_chuck();
    const unsigned int n_v = unknowns - configuration.chuck_unknowns.size();
    interface.differentiate_turns(moving);
    const PathEquation   no_path; // and no spring: rows are forces of contact
    const CoupledTangent whole(body, interface, moving, no_path);

    const Chuck::Vector6 given =
      chuck.rates(trial_time, interface.mode().duration);
    const Eigen::VectorXd by_duration = rates_by_duration(moving);
    Eigen::VectorXd       motion      = Eigen::VectorXd::Zero(n_v + 6);
    // on a spring stiffer than the face the chuck goes along, but for little
    for (unsigned int k = 0; k < 6; ++k)
      if (chuck.is_prescribed(k) || path.row_scale[k] < 1.)
        motion[n_v + k] = given[k];
    const Eigen::VectorXd change =
      whole.interface_product(motion) + by_duration;
    Eigen::VectorXd right(unknowns);
    right.head(n_v) = change.head(n_v);
    for (const auto &[k, number] : configuration.chuck_unknowns)
      right[number] =
        path.row_scale[k] * (change[n_v + k] - chuck.machine_load_per_value(k) *
                                                 (given[k] - motion[n_v + k]));
    // What an iterative solver leaves differs from processor to processor, and
    // the sizes of steps, which depend on rates, must not.
    constexpr double tolerance = 1e-8;
    {
      const TimedSection    t(timer, "dense solve");
      const Eigen::VectorXd response =
        bone.whole() ? -solve_with_whole_bone(right, tolerance) :
                       -solver.solve(matrix, right, tolerance);
      motion.head(n_v) = response.head(n_v);
      for (const auto &[k, number] : configuration.chuck_unknowns)
        motion[n_v + k] += response[number];
    }

    Rates result;
    result.position = motion.tail<6>();
    result.surfaces = nodal_motion(motion, moving);
    result.forces   = (whole.interface_product(motion) + by_duration).tail<6>();
    // b_k . M = r_k, so that b_k . dM = dr_k - db_k . M.
    const Eigen::Vector3d moment = chuck_resultant().tail<3>();
    Eigen::Matrix3d       axes;
    Eigen::Vector3d       turned = result.forces.tail<3>();
    for (unsigned int k = 3; k < 6; ++k)
      {
        axes.row(k - 3) = chuck.axis(k);
        turned[k - 3] -= chuck.axis_rate(k, result.position).dot(moment);
      }
    result.reaction           = result.forces;
    result.reaction.tail<3>() = axes.inverse() * turned;
    return result;
  }



  // Where friction turns, points slide back or friction depends on the speed,
  // the state at the end depends on the way there, and one step knows it less
  // well than two. The bodies follow the surfaces at rest; that they would give
  // way a little is left out.
  Chuck::Vector6
  CoupledSystem::difference_of_halves(const double duration,
                                      const Rates *begin,
                                      const Rates &end) const
  {
    InterfaceConfiguration middle = configuration;
    Chuck                  chuck_in_middle(chuck);
    middle.chuck = &chuck_in_middle;
    {
      const Chuck::Vector6 last = duration * end.position;
      chuck_in_middle.place_in_middle(begin ? Chuck::Vector6(duration *
                                                             begin->position) :
                                              chuck.change() * 2. - last,
                                      last);
    }
    middle.side[Side::implant].frame = chuck_in_middle.rotation();
    for (const Side side : both_sides)
      {
        const ControlNet &start = interface.accepted_surface(side),
                         &stop  = configuration.side[side].positions;
        const ControlNet last   = duration * end.surfaces[side],
                         first =
                           begin ?
                             ControlNet(duration * begin->surfaces[side]) :
                             ControlNet(2. * (stop - start) - last);
        middle.side[side].positions = (start + stop) / 2. + (first - last) / 8.;
      }
    const InterfaceConfiguration moving = with_whole_chuck();
    Eigen::VectorXd              result =
      Eigen::VectorXd::Zero(moving.chuck_unknowns.back().second + 1);
    add_in_unknowns(interface.difference_of_halves(middle, configuration),
                    moving,
                    1.,
                    result);
    return result.tail<6>();
  }



  // Contact forces in the unknowns of @p configuration, by the duration of the
  // step alone. Friction that knows no speed does not change with it; else a
  // difference has to do. The state of the points is left as it was.
  Eigen::VectorXd
  CoupledSystem::rates_by_duration(const InterfaceConfiguration &moving)
  {
    Eigen::VectorXd result =
      Eigen::VectorXd::Zero(moving.chuck_unknowns.back().second + 1);
    const ContactPointMode mode = interface.mode();
    if (!interface.depends_on_rate() || !(mode.duration > 0.))
      return result;
    const double dt  = 1e-6 * mode.duration;
    const auto   add = [&](const double duration, const double factor) {
      ContactPointMode longer = mode;
      longer.duration         = duration;
      interface.evaluate(configuration, longer);
      add_in_unknowns({{interface.force(Side::bone),
                        interface.force(Side::implant)}},
                      moving,
                      factor / dt,
                      result);
    };
    add(mode.duration + dt, 1.);
    add(mode.duration, -1.);
    interface.differentiate_turns(moving);
    return result;
  }
} // namespace Debond
