#ifndef debond_interface_interface_configuration_h
#define debond_interface_interface_configuration_h

#include <debond/bulk/side.h>
#include <debond/geometry/nurbs_surface.h>

#include <array>
#include <utility>
#include <vector>

namespace Debond
{
  class Chuck;

  /** The two contact surfaces in space and how their control points are
   *  numbered in the coupled system. */
  struct InterfaceConfiguration
  {
    struct Surface
    {
      ControlNet positions; ///< spatial positions of the control points [mm]
      Eigen::Matrix3d frame = Eigen::Matrix3d::Identity(); ///< Q of the body
      /** For 3 (control point) + component (body frame): number in the coupled
       *  system, -1: none. */
      std::vector<int> unknown_of;
    };
    std::array<Surface, 2> side;
    /** Numbers of the chuck components that are unknowns. */
    std::vector<std::pair<unsigned int, unsigned int>> chuck_unknowns;
    const Chuck                                       *chuck = nullptr;
  };
} // namespace Debond
#endif
