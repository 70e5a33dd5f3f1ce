#ifndef debond_output_interface_maps_h
#define debond_output_interface_maps_h

#include <debond/output/profile_output.h>

#include <string>
#include <vector>

namespace Debond
{
  /** Lines of maps.csv: @p of_event, a place of a regular grid on the contact
   *  face, and the columns of @p shown. Values lie between the points of an
   *  element, or are those of the nearest point where that of the bone is the
   *  slave; nan where there is none. */
  std::string
  lines_of_map(const Scene                       &scene,
               const std::vector<InterfacePoint> &points,
               const std::string                 &of_event,
               const std::vector<unsigned int>   &shown);
} // namespace Debond
#endif
