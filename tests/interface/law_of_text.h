#ifndef debond_tests_law_of_text_h
#define debond_tests_law_of_text_h

#include <debond/input/entry_table.h>
#include <debond/interface/friction_law.h>

#include <string>

/** The friction law of the entries in `Interface` of a scene. */
inline Debond::FrictionLawPointer
law_of_text(const std::string &entries)
{
  Debond::FrictionLawChoice choice;
  Debond::EntryTable        table;
  Debond::declare_friction_laws(table, choice);
  for (const Debond::SceneEntry &entry :
       Debond::read_scene_text(entries, "law"))
    table.set(entry);
  return Debond::create_friction_law(choice);
}
#endif
