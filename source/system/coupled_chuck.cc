#include <debond/system/coupled_system.h>

#include <algorithm>
#include <cmath>

// Forces of the chuck on the implant, and the equations of its components that
// are not prescribed.
namespace Debond
{
  ControlNet
  CoupledSystem::force_on_points(const Side side) const
  {
    return interface.force(side).leftCols(
      body[side]->surface().n_control_points());
  }



  namespace
  {
    /** Sum of forces [N] and of their moments at the given lever arms [N mm].
     */
    Chuck::Vector6
    resultant(const ControlNet &force, const ControlNet &arm)
    {
      const Eigen::Matrix3d M = arm * force.transpose(); // sum of r f^T
      Chuck::Vector6        result;
      result << force.rowwise().sum(), M(1, 2) - M(2, 1), M(2, 0) - M(0, 2),
        M(0, 1) - M(1, 0);
      return result;
    }
  } // namespace



  // Force [N] and moment about C + u [N mm] in space, with the lever arms of
  // the present state: the forces are those that enter the residual, so that
  // their sum is what the chuck exerts on the implant. The moment is positive
  // while it resists a positive rotation.
  Chuck::Vector6
  CoupledSystem::chuck_resultant() const
  {
    return resultant(interface.force(Side::implant), arms_of_chuck());
  }

  ControlNet
  CoupledSystem::arms_of_chuck() const
  {
    return configuration.side[Side::implant].positions.colwise() -
           chuck.centre();
  }



  // What does work on the components q_k [N, N mm]: r_k without the load. A
  // rotation about the axis b_k moves x by b_k x (x - C - u), and f . (b_k x r)
  // = b_k . (r x f).
  //
  // These are not the components of the resultant: the axes b_k of a rotation
  // vector are not e_x, e_y and e_z once the implant is tilted. Work is done by
  // these on the changes of q, not by the resultant.
  Chuck::Vector6
  CoupledSystem::chuck_forces() const
  {
    return in_components(chuck_resultant());
  }

  Chuck::Vector6
  CoupledSystem::let_go() const
  {
    return in_components(
      resultant(interface.let_go(configuration), arms_of_chuck()));
  }

  Chuck::Vector6
  CoupledSystem::in_components(const Chuck::Vector6 &total) const
  {
    Chuck::Vector6 result = total;
    // The first three, forces along fixed axes, are the same.
    for (unsigned int k = 3; k < 6; ++k)
      result[k] = chuck.axis(k).dot(total.tail<3>());
    return result;
  }



  // A check of the whole chain of contact forces, condensation and supports:
  // what the contact exerts on the implant must come out at its top. It is
  // computed there from K v, or from the internal forces, and not from the
  // contact forces. A step that is not in equilibrium shows here, and so does a
  // wrong factor of S. More than 1e-6 is a warning
  // (doc/explanation/solution.md, Threads, memory and checks).
  //
  // In the implant's frame. A linear body balances moments with reference lever
  // arms only: its equations are those of the undeformed shape. A Neo-Hookean
  // one balances them with X + v.
  double
  CoupledSystem::reaction_defect() const
  {
    // Moments become forces at the distance R, to be added up with forces.
    if (!implant.bulk())
      return 0.;
    const Eigen::Vector3d C = chuck.reference_centre();
    ControlNet arm          = implant.surface().control_points().colwise() - C;
    if (!implant.has_small_strains())
      arm += implant.contact_displacement();
    // what acts where the body is held does not pass through it
    ControlNet force =
      chuck.rotation().transpose() * force_on_points(Side::implant);
    for (unsigned int A = 0; A < force.cols(); ++A)
      for (unsigned int c = 0; c < 3; ++c)
        if (implant.mesh().is_fixed(implant.mesh().control_point_node(A), c))
          force(c, A) = 0.;
    Chuck::Vector6 contact    = resultant(force, arm);
    Chuck::Vector6 support    = support_reaction(Side::implant, C);
    Chuck::Vector6 difference = contact - support;
    for (Chuck::Vector6 *forces : {&contact, &support, &difference})
      forces->tail<3>() /= R;
    // Relative to the larger one; the floor keeps bodies that hardly touch from
    // dividing zero by zero.
    return difference.norm() /
           std::max({contact.norm(), support.norm(), force_floor});
  }



  // The rows of the chuck [N, N mm]: a loaded component is in equilibrium with
  // its load, one with a compliant machine with the force of the spring, k
  // (value - q) (machine_load), both scaled where that is stiffer than the
  // face. Then, along a path, the row of the time, see PathEquation. The row of
  // a component that follows the time stays 0, as correct() puts it where it
  // belongs.
  //
  // Moments count as forces at the distance R in the norm, so that the result
  // does not depend on the unit of length. Returns the square of that norm, and
  // raises the reference to the largest load: with a large load and little
  // contact yet it is the load that has to be met.
  double
  CoupledSystem::evaluate_chuck(Residual &residual)
  {
    double               norm_squared = 0.;
    const Chuck::Vector6 forces       = chuck_forces();
    for (const auto &[component, number] : configuration.chuck_unknowns)
      if (!chuck.is_prescribed(component)) // along a path it follows the time
        {
          const double load         = chuck.machine_load(component);
          const double scale        = path.row_scale[component];
          const double force        = scale * (forces[component] - load);
          residual.unknowns[number] = force;
          norm_squared += std::pow(force / scale_of(component), 2);
          residual.reference =
            std::max(residual.reference,
                     scale * std::abs(load) / scale_of(component));
        }
    if (path.follow)
      {
        const double excess            = path.evaluate(interface,
                                            configuration,
                                            trial_time,
                                            residual.reference);
        residual.unknowns[path.number] = excess;
        norm_squared += excess * excess;
      }
    return norm_squared;
  }
} // namespace Debond
