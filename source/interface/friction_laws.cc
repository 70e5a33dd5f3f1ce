#include <debond/input/entry_table.h>
#include <debond/interface/friction_law.h>

#include <debond_friction_laws.h>

#include <set>

namespace Debond
{
  // Each law's own file defines its plug-in; CMake finds their names. (The
  // linker would drop static objects that register themselves.)
#define DECLARED(plugin) FrictionLawPlugin plugin;
#define CALLED(plugin) plugin,
  DEBOND_FRICTION_LAWS(DECLARED)

  const std::vector<FrictionLawPlugin> &
  friction_law_plugins()
  {
    static const std::vector<FrictionLawPlugin> all{
      DEBOND_FRICTION_LAWS(CALLED)};
    return all;
  }



  const std::vector<double> &
  FrictionLaw::kinks() const
  {
    static const std::vector<double> none{0.};
    return none;
  }



  double
  FrictionLawChoice::number(const std::string &entry) const
  {
    return read_number(text(entry)).value_or(0.);
  }



  void
  declare_friction_laws(EntryTable &table, FrictionLawChoice &choice)
  {
    std::string names, text;
    for (const FrictionLawPlugin &plugin : friction_law_plugins())
      {
        names += (names.empty() ? "" : " | ") + plugin.name;
        text += "`" + plugin.name + "': " + plugin.description + ". ";
      }
    text.pop_back();
    if (choice.law.empty())
      choice.law = "modified coulomb";
    table.add("Friction law", choice.law, Allowed::choice(names), text);
    std::set<std::string> done;
    for (const FrictionLawPlugin &plugin : friction_law_plugins())
      for (const LawEntry &entry : plugin.entries)
        if (done.insert(entry.name).second)
          {
            // a value that is there already is the default
            std::string &value =
              choice.entries.emplace(entry.name, entry.value).first->second;
            if (!entry.subsection.empty())
              table.enter_subsection(entry.subsection);
            table.add(entry.name, value, entry.allowed, entry.documentation);
            if (!entry.subsection.empty())
              table.leave_subsection();
          }
  }



  FrictionLawPointer
  create_friction_law(const FrictionLawChoice &choice)
  {
    for (const FrictionLawPlugin &plugin : friction_law_plugins())
      if (plugin.name == choice.law)
        return plugin.create(choice);
    return nullptr; // never: the entry admits no other name
  }
} // namespace Debond
