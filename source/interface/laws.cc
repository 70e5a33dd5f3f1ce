#include <debond/input/allowed_values.h>
#include <debond/input/entry_table.h>
#include <debond/interface/interface_law.h>

#include <debond_laws.h>

#include <algorithm>
#include <type_traits>

// Laws that scenes can choose. All of a kind are there in each scene with their
// parameters, chosen or not: entries of the others are known, printed, and
// checked, and a change of one line tries another law.
namespace Debond
{
  // Each law's own file defines its plug-in; CMake finds their names. (The
  // linker would drop static objects that register themselves.)
#define DECLARED_FRICTION(plugin) FrictionLawPlugin plugin;
#define DECLARED_INTERFACE(plugin) InterfaceLawPlugin plugin;
#define CALLED(plugin) plugin,
  DEBOND_FRICTION_LAWS(DECLARED_FRICTION)
  DEBOND_INTERFACE_LAWS(DECLARED_INTERFACE)

  template <class Law>
  std::vector<LawPlugin<Law>>
  all_laws()
  {
    if constexpr (std::is_same_v<Law, FrictionLaw>)
      return {DEBOND_FRICTION_LAWS(CALLED)};
    else
      return {DEBOND_INTERFACE_LAWS(CALLED)};
  }
  template std::vector<FrictionLawPlugin>
  all_laws();
  template std::vector<InterfaceLawPlugin>
  all_laws();



  template <class Law>
  void
  LawChoice<Law>::declare(EntryTable &table, const std::string &about)
  {
    // The choices of the entry, and the subsection of each law, chosen or not.
    std::string names, text = about;
    for (const LawPlugin<Law> &plugin : laws)
      {
        names += (names.empty() ? "" : " | ") + plugin.name;
        text += " `" + plugin.name + "': " + plugin.description + ".";
      }
    table.add(entry, law, Allowed::choice(names), text);
    for (const LawPlugin<Law> &plugin : laws)
      plugin.law().declare(table);
  }



  // The copy of the plug-in owns the law, and the pointer owns the copy.
  template <class Law>
  std::shared_ptr<Law>
  LawChoice<Law>::make() const
  {
    const auto chosen =
      std::find_if(laws.begin(), laws.end(), [this](const auto &plugin) {
        return plugin.name == law;
      });
    const auto copy = std::make_shared<LawPlugin<Law>>(*chosen); // there is one
    return {copy, &copy->law()};
  }



  namespace
  {
    template <class Law>
    std::vector<SceneEntry>
    entries_of(Law &law)
    {
      // A table is filled for its rows only: names, values and units of one
      // law.
      EntryTable table;
      table.enter_subsection("Interface");
      law.declare(table);
      return table.entries();
    }
  } // namespace



  template <class Law>
  std::vector<std::string>
  LawChoice<Law>::laws_with(const std::string &full_name) const
  {
    std::vector<std::string> result;
    for (const LawPlugin<Law> &plugin : laws)
      for (const SceneEntry &own : entries_of(plugin.law()))
        if (own.full_name() == full_name)
          result.push_back(plugin.name);
    return result;
  }



  template class LawChoice<FrictionLaw>;
  template class LawChoice<InterfaceLaw>;



  FrictionLawPointer
  create_friction_law(const LawChoice<FrictionLaw> &choice)
  {
    const std::shared_ptr<FrictionLaw> law = choice.make();
    // from here on it is pure, and points of all threads ask it
    law->initialise();
    return law;
  }
} // namespace Debond
