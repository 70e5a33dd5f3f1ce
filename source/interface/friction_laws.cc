#include <debond/input/allowed_values.h>
#include <debond/interface/friction_law.h>

#include <deal.II/base/parameter_handler.h>

namespace Debond
{
  // Each law's own file defines its plug-in; it is named here, and nowhere
  // else.
  FrictionLawPlugin
  frictionless_plugin(),
    coulomb_plugin(), modified_coulomb_plugin(), table_plugin(),
    rate_and_state_plugin();

  const std::vector<FrictionLawPlugin> &
  friction_law_plugins()
  {
    static const std::vector<FrictionLawPlugin> all{frictionless_plugin(),
                                                    coulomb_plugin(),
                                                    modified_coulomb_plugin(),
                                                    table_plugin(),
                                                    rate_and_state_plugin()};
    return all;
  }



  const std::vector<double> &
  FrictionLaw::kinks() const
  {
    static const std::vector<double> none{0.};
    return none;
  }



  void
  declare_friction_laws(dealii::ParameterHandler &prm)
  {
    std::string choices, text;
    for (const FrictionLawPlugin &plugin : friction_law_plugins())
      {
        choices += (choices.empty() ? "" : " | ") + plugin.name;
        text += "`" + plugin.name + "': " + plugin.description + ". ";
      }
    text.pop_back();
    prm.declare_entry("Friction law",
                      "modified coulomb",
                      Allowed::choice(choices),
                      text);
    for (const FrictionLawPlugin &plugin : friction_law_plugins())
      plugin.declare(prm);
  }



  FrictionLawPointer
  create_friction_law(dealii::ParameterHandler &prm)
  {
    const std::string name = prm.get("Friction law");
    for (const FrictionLawPlugin &plugin : friction_law_plugins())
      if (plugin.name == name)
        return plugin.create(prm);
    return nullptr; // never: the entry admits no other name
  }
} // namespace Debond
