#pragma once

#include <debond/input/entry_table.h>
#include <debond/interface/interface_law.h>
#include <debond/interface/modified_coulomb.h>

#include <map>
#include <string>
#include <vector>

/** Whether entries of the same name are the same entry, with one default. */
template <class Law>
bool
entries_are_shared()
{
  std::map<std::string, std::string> rows;
  bool                               same = true;
  for (const auto &plugin : Debond::all_laws<Law>())
    {
      Debond::EntryTable table;
      plugin.law().declare(table);
      for (const Debond::SceneEntry &entry : table.entries())
        {
          const std::string row = entry.full_name() + " = " + entry.value;
          same = same && rows.emplace(entry.name, row).first->second == row;
        }
    }
  return same;
}

/** The choice in entries in `Interface` of a scene. */
template <class Law>
Debond::LawChoice<Law>
choice_of_text(const std::string &entries, Debond::LawChoice<Law> choice)
{
  Debond::EntryTable table;
  choice.declare(table, "");
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
    choice_of_text<Debond::FrictionLaw>(entries,
                                        {"Friction law", "modified coulomb"}));
}

/** The law of the interface of such entries. */
inline Debond::InterfaceLawPointer
interface_law_of_text(const std::string                &entries,
                      const Debond::FrictionLawPointer &friction,
                      const bool                        is_explicit = false,
                      const Debond::BoneLayer          &bone        = {})
{
  const auto law =
    choice_of_text<Debond::InterfaceLaw>(entries, {"Law", "friction"}).make();
  law->friction          = friction;
  law->explicit_friction = is_explicit;
  law->bone              = bone;
  return Debond::initialised(law);
}
