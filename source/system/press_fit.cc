#include <debond/interface/interface_parameters.h>
#include <debond/shapes/body_parameters.h>
#include <debond/system/press_fit.h>

#include <cmath>

namespace Debond
{
  PressFit::PressFit(const InterfaceParameters &interface,
                     const BodyParameters      &implant,
                     const NurbsSurface        &face)
    : outwards(3, 0)
  {
    if (!interface.has_interference())
      return;
    // A thicker implant is one whose face stands further out by half of the
    // interference, in the direction of BodyGeometry::outwards(): control
    // points move, and the face with them.
    interference  = read_time_function(interface.interference,
                                      implant.characteristic_radius());
    const auto &X = face.control_points();
    outwards.resize(3, X.cols());
    for (unsigned int A = 0; A < X.cols(); ++A)
      outwards.col(A) = implant.geometry().outwards(X.col(A));
  }



  void
  PressFit::set(const double time)
  {
    if (!is_none())
      half = 0.5 * interference(time);
  }



  // Forces are those of the residual, which hold the face back.
  void
  PressFit::commit(const ControlNet &forces)
  {
    if (is_none())
      return;
    // conjugate to `half': work per thickness, over all control points [N]
    const double force = forces.cwiseProduct(outwards).sum();
    work += 0.5 * (accepted_force + force) * (half - accepted_half);
    bound += 0.5 * std::abs((force - accepted_force) * (half - accepted_half));
    accepted_force = force;
    accepted_half  = half;
  }
} // namespace Debond
