#ifndef debond_interface_nodal_sums_h
#define debond_interface_nodal_sums_h

#include <debond/interface/interface_configuration.h>
#include <debond/support/runtime.h>

#include <utility>

namespace Debond
{
  /** Vectors at the control points of bone and implant. */
  using NodalSums = std::array<ControlNet, 2>;

  /** Zero at all control points of both surfaces. */
  NodalSums
  zero_sums(const InterfaceConfiguration &configuration);

  /** Motion in space of the control points with the unknowns of the coupled
   *  system, those of the chuck included [mm]. */
  NodalSums
  nodal_motion(const Eigen::VectorXd        &unknowns,
               const InterfaceConfiguration &configuration);

  /** The transpose of nodal_motion(): adds @p factor times what @p sums, in
   *  space, amount to in each unknown. */
  void
  add_in_unknowns(const NodalSums              &sums,
                  const InterfaceConfiguration &configuration,
                  double                        factor,
                  Eigen::VectorXd              &result);

  /** What work(q, sums) adds up to over q in [0, n), formed in parts as
   *  for_each_chunk() says. */
  template <typename Work>
  NodalSums
  sum_in_chunks(const unsigned int            n,
                const InterfaceConfiguration &configuration,
                const Work                   &work)
  {
    std::array<NodalSums, n_chunks> sums;
    for_each_chunk(n,
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     sums[chunk] = zero_sums(configuration);
                     for (unsigned int q = first; q < end; ++q)
                       work(q, sums[chunk]);
                   });
    for (unsigned int chunk = 1; chunk < n_chunks; ++chunk)
      for (const Side side : both_sides)
        sums[0][side] += sums[chunk][side];
    return std::move(sums[0]);
  }
} // namespace Debond
#endif
