#ifndef debond_tests_law_of_text_h
#define debond_tests_law_of_text_h

#include <debond/interface/friction_law.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

/** The friction law of the entries in `Interface` of a scene. */
inline Debond::FrictionLawPointer
law_of_text(const std::string &entries)
{
  dealii::ParameterHandler prm;
  Debond::declare_friction_laws(prm);
  prm.parse_input_from_string(entries);
  return Debond::create_friction_law(prm);
}
#endif
