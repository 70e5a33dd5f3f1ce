#ifndef debond_tests_law_of_text_h
#define debond_tests_law_of_text_h

#include <debond/input/entry_table.h>
#include <debond/interface/bond_friction.h>
#include <debond/interface/interface_law.h>

#include <map>
#include <string>
#include <vector>

/** Whether entries of the same name are the same entry. */
template <typename Plugin>
bool
entries_are_shared(const std::vector<Plugin> &plugins)
{
  std::map<std::string, std::string> subsection;
  bool                               same = true;
  for (const Plugin &plugin : plugins)
    for (const Debond::LawEntry &entry : plugin.entries)
      same = same &&
             subsection.emplace(entry.name, entry.subsection).first->second ==
               entry.subsection;
  return same;
}

/** What entries in `Interface` of a scene choose. */
template <typename Declare>
Debond::LawChoice
choice_of_text(const std::string &entries, const Declare &declare)
{
  Debond::LawChoice  choice;
  Debond::EntryTable table;
  declare(table, choice);
  for (const Debond::SceneEntry &entry :
       Debond::read_scene_text(entries, "law"))
    table.set(entry);
  return choice;
}

/** The friction law of the entries in `Interface` of a scene. */
inline Debond::FrictionLawPointer
law_of_text(const std::string &entries)
{
  return Debond::create_friction_law(
    choice_of_text(entries, Debond::declare_friction_laws));
}

/** The law of the interface of such entries. */
inline Debond::InterfaceLawPointer
interface_law_of_text(const std::string               &entries,
                      const Debond::InterfaceLawParts &parts)
{
  return Debond::create_interface_law(
    choice_of_text(entries, Debond::declare_interface_laws), parts);
}
#endif
