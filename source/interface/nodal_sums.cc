#include <debond/bulk/chuck.h>
#include <debond/interface/nodal_sums.h>

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
    const auto &x = configuration.side[Side::implant].positions;
    for (const auto &[component, number] : configuration.chuck_unknowns)
      for (unsigned int A = 0; A < x.cols(); ++A)
        moved[Side::implant].col(A) +=
          unknowns[number] * configuration.chuck->velocity(component, x.col(A));
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
    const auto &x = configuration.side[Side::implant].positions;
    for (const auto &[component, number] : configuration.chuck_unknowns)
      for (unsigned int A = 0; A < x.cols(); ++A)
        result[number] +=
          factor * sums[Side::implant].col(A).dot(
                     configuration.chuck->velocity(component, x.col(A)));
  }
} // namespace Debond
