#ifndef debond_output_interface_fields_h
#define debond_output_interface_fields_h

#include <string>

namespace Debond
{
  class Body;
  class Chuck;
  class ContactInterface;

  /** The text of a VTU file with the fields of the interface in the trial state
   *  on the surface of the body @p slave; class FieldOutput says which, and how
   *  they are interpolated. */
  std::string
  interface_vtu(const Body             &slave,
                const ContactInterface &interface,
                const Chuck            &chuck);
} // namespace Debond
#endif
