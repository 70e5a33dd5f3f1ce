#ifndef debond_interface_contact_zone_h
#define debond_interface_contact_zone_h

#include <debond/interface/interface_configuration.h>
#include <debond/interface/slave_point.h>

namespace Debond
{
  /** @name Where contact may be, or is, on the bone
   *  Returned for every control point of its surface: whether it belongs to an
   *  element there. */
  //@{
  /** Elements of the @p bone under the contact face of the @p implant, its edge
   *  included, in this configuration. */
  std::vector<bool>
  bone_control_points_under_implant(
    const NurbsSurface           &bone,
    const NurbsSurface           &implant,
    const InterfaceConfiguration &configuration);

  /** Elements of the @p bone that closed ones of the @p points lie on in their
   *  trial states. */
  std::vector<bool>
  touched_bone_control_points(const NurbsSurface            &bone,
                              const std::vector<SlavePoint> &points,
                              Side                           slave);
  //@}
} // namespace Debond
#endif
