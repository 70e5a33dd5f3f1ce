#ifndef debond_output_bulk_fields_h
#define debond_output_bulk_fields_h

#include <array>
#include <string>

namespace Debond
{
  class Body;
  class Chuck;

  /** The text of a VTU file with the fields of both bodies, bone and implant,
   *  in the trial state; class FieldOutput says which. */
  std::string
  bulk_vtu(const std::array<const Body *, 2> &bodies, const Chuck &chuck);
} // namespace Debond
#endif
