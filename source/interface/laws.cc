#include <debond/input/entry_table.h>
#include <debond/interface/interface_law.h>

#include <debond_laws.h>

#include <set>

namespace Debond
{
  // Each law's own file defines its plug-in; CMake finds their names. (The
  // linker would drop static objects that register themselves.)
#define DECLARED_FRICTION(plugin) FrictionLawPlugin plugin;
#define DECLARED_INTERFACE(plugin) InterfaceLawPlugin plugin;
#define CALLED(plugin) plugin,
  DEBOND_FRICTION_LAWS(DECLARED_FRICTION)
  DEBOND_INTERFACE_LAWS(DECLARED_INTERFACE)

  const std::vector<FrictionLawPlugin> &
  friction_law_plugins()
  {
    static const std::vector<FrictionLawPlugin> all{
      DEBOND_FRICTION_LAWS(CALLED)};
    return all;
  }



  const std::vector<InterfaceLawPlugin> &
  interface_law_plugins()
  {
    static const std::vector<InterfaceLawPlugin> all{
      DEBOND_INTERFACE_LAWS(CALLED)};
    return all;
  }



  const std::vector<double> &
  FrictionLaw::kinks() const
  {
    static const std::vector<double> none{0.};
    return none;
  }



  double
  LawChoice::number(const std::string &entry) const
  {
    return read_number(text(entry)).value_or(0.);
  }



  namespace
  {
    // A row @p entry, @p about something, that chooses a law, and rows for the
    // entries of all laws.
    template <typename Plugin>
    void
    declare(EntryTable                &table,
            const std::string         &entry,
            const std::string         &about,
            const std::string         &default_law,
            const std::vector<Plugin> &plugins,
            LawChoice                 &choice)
    {
      std::string names, text = about;
      for (const Plugin &plugin : plugins)
        {
          names += (names.empty() ? "" : " | ") + plugin.name;
          text += " `" + plugin.name + "': " + plugin.description + ".";
        }
      if (choice.law.empty())
        choice.law = default_law;
      table.add(entry, choice.law, Allowed::choice(names), text);
      std::set<std::string> done;
      for (const Plugin &plugin : plugins)
        for (const LawEntry &own : plugin.entries)
          if (done.insert(own.name).second)
            {
              // a value that is there already is the default
              std::string &value =
                choice.entries.emplace(own.name, own.value).first->second;
              if (!own.subsection.empty())
                table.enter_subsection(own.subsection);
              table.add(own.name, value, own.allowed, own.documentation);
              if (!own.subsection.empty())
                table.leave_subsection();
            }
    }



    template <typename Plugin>
    const Plugin &
    chosen(const std::vector<Plugin> &plugins, const std::string &name)
    {
      for (const Plugin &plugin : plugins)
        if (plugin.name == name)
          return plugin;
      return plugins.front(); // never: the entry admits no other name
    }
  } // namespace



  void
  declare_friction_laws(EntryTable &table, LawChoice &choice)
  {
    declare(table,
            "Friction law",
            "Friction coefficient mu.",
            "modified coulomb",
            friction_law_plugins(),
            choice);
  }



  void
  declare_interface_laws(EntryTable &table, LawChoice &choice)
  {
    declare(table,
            "Law",
            "Tractions across the interface.",
            "friction",
            interface_law_plugins(),
            choice);
  }



  FrictionLawPointer
  create_friction_law(const LawChoice &choice)
  {
    return chosen(friction_law_plugins(), choice.law).create(choice);
  }



  InterfaceLawPointer
  create_interface_law(const LawChoice &choice, const InterfaceLawParts &parts)
  {
    return chosen(interface_law_plugins(), choice.law).create(choice, parts);
  }
} // namespace Debond
