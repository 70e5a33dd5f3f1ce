#include <debond/bulk/bulk_space.h>
#include <debond/bulk/chuck.h>
#include <debond/interface/interface_configuration.h>

#include <algorithm>

// From unknowns to motions of control points, and back from forces at them to
// residuals: the matrix Q of walk.md, and its transpose. Displacements of a
// body are counted in its own frame, which the chuck turns, so that a large
// rotation leaves the stiffness of the body as it is. A component of the chuck
// moves all control points of the implant at once.
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
      // dx_A/dq_k, by the lever arm of the control point where it is now [1,
      // mm/rad]: of components 0 to 2 along the axes, of 3 to 5 about those of
      // the chuck
      for (auto x : result.colwise())
        x = configuration.chuck->velocity(component, x);
      return result;
    }



    // The control points that belong to the marked elements.
    std::vector<bool>
    control_points_of(const NurbsSurface      &surface,
                      const std::vector<bool> &elements)
    {
      std::vector<bool>  result(surface.n_control_points(), false);
      const unsigned int n = surface.n_control_points_of_element();
      for (unsigned int element = 0; element < elements.size(); ++element)
        for (unsigned int a = 0; elements[element] && a < n; ++a)
          result[surface.element_control_points(element)[a]] = true;
      return result;
    }



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



  // u = Q v: control points that no unknown moves, and are not fixed to the
  // chuck either, stay.
  NodalSums
  nodal_motion(const Eigen::VectorXd        &unknowns,
               const InterfaceConfiguration &configuration)
  {
    NodalSums moved = zero_sums(configuration);
    for (const Side s : both_sides)
      {
        // Entries 3 A + i of unknown_of are component i of control point A in
        // the frame of its body; Q of the bone is the identity.
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



  // Q^T f: virtual work is the same in both, so that the tangent keeps what
  // symmetry it has.
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
      // sum_A f_A . dx_A/dq_k: force or moment on this component [N, N mm]
      result[number] +=
        factor * sums[Side::implant]
                   .cwiseProduct(velocities(configuration, component))
                   .sum();
  }



  // Only unknowns that contact may reach are worth condensing to: a bone is
  // wider than its implant. From sample to sample the closest point is near the
  // last one, which is the guess.
  std::vector<bool>
  bone_control_points_under_implant(const NurbsSurface           &bone,
                                    const NurbsSurface           &implant,
                                    const InterfaceConfiguration &configuration)
  {
    // Places on the implant's face, its edge included, are projected on the
    // bone. Of pieces, and of a hole, the nearest side may be none that faces
    // it; a socket is covered by its implant nearly everywhere, so that all of
    // it is kept.
    if (bone.n_pieces() > 1 || (!bone.is_one_patch() && !bone.is_flat()))
      return std::vector<bool>(bone.n_control_points(), true);
    std::vector<bool> under(bone.n_elements(), false);
    // dense enough to meet every element of the bone that the edge crosses
    const unsigned int samples =
      std::max(4u,
               4 *
                 ((bone.n_elements_across() + implant.n_elements_across() - 1) /
                  implant.n_elements_across()));
    SurfaceBasis    basis;
    Eigen::Vector2d guess(0.5, 0.5);
    for (unsigned int element = 0; element < implant.n_elements(); ++element)
      for (unsigned int k = 0; k < (samples + 1) * (samples + 1); ++k)
        {
          implant.evaluate_in_element(
            element,
            parameters_at(implant.element_bounds(element),
                          {k % (samples + 1) / double(samples),
                           k / (samples + 1) / double(samples)}),
            basis);
          const ClosestPoint closest = closest_point(
            bone,
            configuration.side[Side::bone].positions,
            interpolate(basis, configuration.side[Side::implant].positions),
            &guess);
          guess = closest.xi;
          // also if the sample lies beyond the bone: then that of its edge
          under[bone.element_of(closest.xi)] = true;
        }
    // a bone of several patches has no rows to fill
    if (bone.is_one_patch())
      fill_gaps(under, bone.n_elements_per_direction());
    return control_points_of(bone, under);
  }



  // A sliding point acts at xi_hat, but its slip is seen from xi_hat^n, too:
  // the tangent has columns for both.
  std::vector<bool>
  touched_bone_control_points(const NurbsSurface            &bone,
                              const std::vector<SlavePoint> &points,
                              const Side                     slave)
  {
    std::vector<bool> touched(bone.n_elements(), false);
    for (const SlavePoint &point : points)
      {
        const ContactPointResult &trial = point.trial;
        const bool is_open = trial.state.status == PointStatus::open;
        if (is_open && !point.accepted.joined) // a share of it may be held
          continue;
        touched[slave == Side::bone ? point.element :
                is_open             ? bone.element_of(point.accepted.xi) :
                                      trial.basis.element] = true;
        if (slave != Side::bone && slides(trial.state.status))
          touched[trial.old_basis.element] = true;
      }
    return control_points_of(bone, touched);
  }
} // namespace Debond
