// Points that open and close again begin afresh where they close: no torque is
// left over, damage does not heal, and `Opening breaks bond' does what it says.

#include "driven_scene.h"

// Pressed, twisted by 1.2 degrees, lifted, turned back by 0.3, pressed and
// twisted again.
const char *const twice = R"(
subsection Chuck
  subsection Press
    set Value = 0.0049 * if(t < 2, min(t, 1), if(t < 4, 1 - 2 * min(t - 2, 1), 2 * min(t - 4, 1) - 1))
  end
  subsection Rotation z
    set Value = 1.2 * min(max(t - 1, 0), 1) - 0.3 * min(max(t - 3, 0), 1) + max(t - 5, 0)
  end
end
subsection Load steps
  set Times              = 0, 1, 2, 3, 4, 5, 6
  set Steps              = 1, 10, 4, 1, 4, 10
  set Residual tolerance = 1e-12
end
)";

// The same from time 3, when the implant is lifted, to the end.
const char *const once = R"(
subsection Chuck
  subsection Translation z
    set Value = 0.0049 - 0.0098 * min(max(t - 4, 0), 1)
  end
  subsection Rotation z
    set Value = 1.2 - 0.3 * min(max(t - 3, 0), 1) + max(t - 5, 0)
  end
end
subsection Load steps
  set Times              = 3, 4, 5, 6
  set Steps              = 1, 4, 10
  set Residual tolerance = 1e-12
end
)";

std::vector<std::string>
both_bodies(const std::string &material)
{
  return {"Bone/Material=" + material, "Implant/Material=" + material};
}

/** Compares two runs from time 5, when both are pressed, to the end. Returns
 * the largest difference of the torque relative to its largest value. */
double
difference_after_closing(DrivenScene &first, DrivenScene &second)
{
  double difference = 0, T_max = 0;
  do
    {
      const double T = second.system.chuck_forces()[5];
      grow(difference, std::abs(first.system.chuck_forces()[5] - T));
      grow(T_max, std::abs(T));
    }
  while (first.advance() && second.advance());
  return difference / T_max;
}



// With a constant coefficient of friction an interface that was open knows
// nothing of what was before.
void
check_nothing_is_left(const std::string &material)
{
  std::cout << "constant friction, " << material << std::endl;
  const auto overrides =
    both_bodies(material) +
    std::vector<std::string>{"Interface/Friction law=coulomb"};
  DrivenScene before(twice, overrides), fresh(once, overrides);
  before.advance_to(2);
  const double T = before.system.chuck_forces()[5];
  before.advance_to(3);
  report("  open when lifted",
         before.system.interface.summarise().n_closed == 0);
  report("  no torque when lifted",
         std::abs(before.system.chuck_forces()[5]) / T,
         1e-12);
  before.advance_to(5);
  fresh.advance_to(5);
  if (material == "rigid")
    report("  torque left over after closing",
           std::abs(before.system.chuck_forces()[5]) / T,
           1e-10);
  report("  curve differs from that of bodies that never touched before",
         difference_after_closing(before, fresh),
         1e-9);
}



void
check_damage()
{
  std::cout << "damage" << std::endl;
  DrivenScene driven(twice);
  const auto &interface = driven.system.interface;
  while (driven.time() < 2 || interface.summarise().n_closed > 0)
    driven.advance();
  const double phi = interface.summarise().phi_mean;
  report("  partly debonded when it opens", phi > 0.1 && phi < 0.9);
  driven.advance_to(4);
  report("  while open phi differs by",
         std::abs(interface.summarise().phi_mean - phi),
         1e-14);
  driven.advance_to(5);
  report("  when closed again phi differs by",
         std::abs(interface.summarise().phi_mean - phi),
         1e-14);
  while (driven.advance())
    ;
  report("  and falls with further sliding",
         interface.summarise().phi_mean < 0.5 * phi);
}



void
check_opening_breaks_bond()
{
  std::cout << "opening breaks the bond" << std::endl;
  DrivenScene broken(twice, {"Interface/Opening breaks bond=true"}),
    unbonded(once, {"Interface/Bonding/Bonding degree=0"});
  broken.advance_to(2);
  report("  bonded before", broken.system.interface.summarise().phi_mean > 0.1);
  broken.advance_to(5);
  unbonded.advance_to(5);
  report("  broken after", broken.system.interface.summarise().phi_mean == 0);
  report("  curve differs from that of an interface without bond",
         difference_after_closing(broken, unbonded),
         1e-9);
}



// Tilted until one side opens, and back.
void
check_tilting()
{
  std::cout << "tilted until one side opens" << std::endl;
  for (const std::string breaks : {"false", "true"})
    {
      DrivenScene driven(R"(
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation x
    set Value = 0.2 * max(0, 1 - abs(t - 2))
  end
end
subsection Load steps
  set Times = 0, 1, 2, 3
  set Steps = 1, 10, 10
end
)",
                         {"Interface/Opening breaks bond=" + breaks});
      const auto &interface = driven.system.interface;
      driven.advance_to(2);
      const double open = interface.summarise().share_open;
      report("  a part is open", open > 0.1 && open < 0.9);
      driven.advance_to(3);
      report("  closed in the end", interface.summarise().share_open == 0);
      if (breaks == "true")
        report("  the part that was open is debonded, differs",
               std::abs(1 - interface.summarise().phi_mean - open),
               1e-12);
      else
        report("  all is bonded", interface.summarise().phi_mean == 1);
      report("  torque left over",
             std::abs(driven.system.chuck_forces()[5]),
             1e-6);
    }
}



void
test()
{
  check_nothing_is_left("rigid");
  check_nothing_is_left("linear");
  check_nothing_is_left("neo-hookean");
  check_damage();
  check_opening_breaks_bond();
  check_tilting();
}



int
main()
{
  return run_test(test);
}
