#include <debond/bulk/chuck.h>
#include <debond/interface/interface_configuration.h>

namespace Debond
{
  NodalSums
  zero_sums(const InterfaceConfiguration &configuration)
  {
    NodalSums sums;
    for (const Side side : both_sides)
      sums[side].setZero(3, configuration.side[side].positions.cols());
    return sums;
  }



  namespace
  {
    /** The velocities of the implant's control points with a component of the
     *  chuck. */
    ControlNet
    velocities(const InterfaceConfiguration &configuration,
               const unsigned int            component)
    {
      ControlNet result = configuration.side[Side::implant].positions;
      for (auto x : result.colwise())
        x = configuration.chuck->velocity(component, x);
      return result;
    }
  } // namespace



  NodalSums
  nodal_motion(const Eigen::VectorXd        &unknowns,
               const InterfaceConfiguration &configuration)
  {
    NodalSums moved = zero_sums(configuration);
    for (const Side s : both_sides)
      {
        const auto &side = configuration.side[s];
        for (unsigned int i = 0; i < side.unknown_of.size(); ++i)
          if (side.unknown_of[i] >= 0)
            moved[s](i % 3, i / 3) = unknowns[side.unknown_of[i]];
        moved[s] = (side.frame * moved[s]).eval();
      }
    for (const auto &[component, number] : configuration.chuck_unknowns)
      moved[Side::implant] +=
        unknowns[number] * velocities(configuration, component);
    return moved;
  }



  void
  add_in_unknowns(const NodalSums              &sums,
                  const InterfaceConfiguration &configuration,
                  const double                  factor,
                  Eigen::VectorXd              &result)
  {
    for (const Side s : both_sides)
      {
        const auto      &side     = configuration.side[s];
        const ControlNet in_frame = side.frame.transpose() * sums[s];
        for (unsigned int i = 0; i < side.unknown_of.size(); ++i)
          if (side.unknown_of[i] >= 0)
            result[side.unknown_of[i]] += factor * in_frame(i % 3, i / 3);
      }
    for (const auto &[component, number] : configuration.chuck_unknowns)
      result[number] +=
        factor * sums[Side::implant]
                   .cwiseProduct(velocities(configuration, component))
                   .sum();
  }
} // namespace Debond
