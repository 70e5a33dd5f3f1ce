// Derivatives of the torque curve by parameters (Simulation::differentiate)
// against central differences of whole runs, for every parameter in scenes with
// different bodies, loads, machines, slaves and laws; and against those of the
// exact torque of rigid bodies.
//
// Between stick and slip, and where a law has a kink, curves have kinks, too,
// over which a difference is no derivative. The interval of the differences,
// 1e-5 of the parameter, is small enough that hardly a point changes in it;
// rows from one on where a point does so are left out, and counted.

#include <debond/models/simulation.h>
#include <debond/support/number_text.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "checks.h"

using namespace Debond;

using Overrides = std::vector<std::string>;

/** An entry and its value; the rest of the value is a factor, see text(). */
struct Parameter
{
  std::string entry;
  double      value;
  std::string factor = "";

  std::string
  text(const double relative_change) const
  {
    const std::string number = exact_text(value * (1. + relative_change));
    return entry + "=" + (factor.empty() ? number : number + factor);
  }
};

/** A run and the states of its points at all rows. */
struct Run
{
  std::vector<TorqueRow>                  rows;
  std::vector<std::vector<PointStatus>>   states;
  std::vector<Simulation::RowDerivatives> derivatives;

  Run(const std::string          &text,
      const Overrides            &overrides,
      std::vector<SceneVariation> variations = {})
  {
    Simulation simulation(Scene::from_text(text, overrides));
    simulation.differentiate(std::move(variations));
    simulation.signals.row.connect([&](const TorqueRow &) {
      states.push_back(simulation.system().interface.statuses());
    });
    simulation.run();
    rows        = simulation.rows();
    derivatives = simulation.row_derivatives();
  }
};

Overrides
with(Overrides list, const std::string &more)
{
  list.push_back(more);
  return list;
}



void
check(const std::string            &name,
      const std::string            &text,
      const Overrides              &given,
      const std::vector<Parameter> &parameters)
{
  std::cout << name << std::endl;
  Overrides overrides = with(given, "Load steps/Residual tolerance=1e-12");
  for (const Parameter &parameter : parameters)
    overrides.push_back(parameter.text(0.));
  std::vector<SceneVariation> variations;
  for (const Parameter &parameter : parameters)
    {
      const double h = 1e-6;
      variations.push_back(
        {parameter.entry,
         Scene::from_text(text, with(overrides, parameter.text(h))),
         Scene::from_text(text, with(overrides, parameter.text(-h))),
         2. * h});
    }
  const Run base(text, overrides, variations), plain(text, overrides);
  bool      same  = base.rows.size() == plain.rows.size();
  double    T_max = 0., F_max = 0., u_max = 0.;
  for (std::size_t i = 0; i < base.rows.size(); ++i)
    {
      same = same && torque_line(base.rows[i]) == torque_line(plain.rows[i]) &&
             base.rows[i].chuck_reaction == plain.rows[i].chuck_reaction;
      for (unsigned int k = 0; k < 6; ++k)
        {
          grow(k < 3 ? F_max : T_max, std::abs(base.rows[i].chuck_reaction[k]));
          grow(u_max, std::abs(base.rows[i].chuck_position[k]));
        }
    }
  report("  the rows are those of a run without derivatives", same);
  for (unsigned int j = 0; j < parameters.size(); ++j)
    {
      const double h = 1e-5;
      const Run    plus(text, with(overrides, parameters[j].text(h))),
        minus(text, with(overrides, parameters[j].text(-h)));
      double       deviation = 0., largest = 0.;
      unsigned int compared = 0;
      for (; compared < base.rows.size(); ++compared)
        {
          const unsigned int i = compared;
          if (plus.states[i] != minus.states[i] ||
              plus.states[i] != base.states[i])
            break;
          const auto difference = [&](const auto &member, const unsigned k) {
            return ((plus.rows[i].*member)[k] - (minus.rows[i].*member)[k]) /
                   (2. * h);
          };
          for (unsigned int k = 0; k < 6; ++k)
            {
              const double scale = k < 3 ? F_max : T_max;
              const double exact = base.derivatives[i].reaction(k, j);
              grow(deviation,
                   std::abs(exact - difference(&TorqueRow::chuck_reaction, k)) /
                     scale);
              grow(deviation,
                   std::abs(base.derivatives[i].position(k, j) -
                            difference(&TorqueRow::chuck_position, k)) /
                     u_max);
              grow(largest, std::abs(exact) / scale);
            }
          grow(deviation,
               std::abs(base.derivatives[i].torque[j] -
                        (plus.rows[i].torque_Nmm - minus.rows[i].torque_Nmm) /
                          (2. * h)) /
                 T_max);
        }
      // a comparison of few rows, or of nothing, is none
      if (2 * compared < base.rows.size() || largest < 1e-5)
        deviation = std::numeric_limits<double>::quiet_NaN();
      if (std::getenv("SHOW"))
        std::cout << "    " << parameters[j].entry << " " << largest << " "
                  << deviation << " rows " << compared << " of "
                  << base.rows.size() << std::endl;
      else
        report("  " + parameters[j].entry + ": difference", deviation, 1e-6);
    }
}



const std::string coin = R"(
subsection Bone
  set Material = linear
  set Cells    = 6, 6, 2
end
subsection Implant
  set Material = linear
  set Cells    = 2, 2
end
subsection Interface
  set Quadrature points = 4
  set Tangential penalty stiffness = 350
end
subsection Chuck
  subsection Translation z
    set Value = -0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 2 * max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 2, 12
end
)";

const Overrides rigid{"Bone/Material=rigid", "Implant/Material=rigid"};

const std::vector<Parameter> law{
  {"Interface/Friction coefficient broken", 0.4},
  {"Interface/Friction coefficient unbroken", 0.58},
  {"Interface/Sliding threshold", 0.022},
  {"Interface/Transition factor", 0.74},
  {"Interface/Penalty stiffness", 585},
  {"Interface/Tangential penalty stiffness", 350},
  {"Bone/Young modulus", 18000},
  {"Implant/Young modulus", 113000},
  {"Chuck/Translation z/Value", -0.0049, " * min(t, 1)"},
  {"Chuck/Rotation z/Value", 2, " * max(t - 1, 0)"}};

Overrides
operator+(Overrides a, const Overrides &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Overrides
operator+(Overrides a, const std::string &b)
{
  a.push_back(b);
  return a;
}

const std::vector<Parameter> bond{{"Interface/Bonding/Initial bonding", 0.8},
                                  {"Interface/Bonding/Bonded fraction", 0.47},
                                  {"Interface/Friction coefficient unbroken",
                                   0.58},
                                  {"Interface/Sliding threshold", 0.022}};

// Nothing has moved yet, and nothing is determined by contact.
void
check_load_from_zero()
{
  const Overrides given{"Chuck/Translation z/Control=force",
                        "Chuck/Translation z/Value=-50 * min(t, 1)",
                        "Load steps/Times=0, 1",
                        "Load steps/Steps=2"};
  const auto      varied = [&](const std::string &mu) {
    return Scene::from_text(
      coin, with(given, "Interface/Friction coefficient unbroken=" + mu));
  };
  const Run run(coin, given, {{"mu_ub", varied("0.6"), varied("0.5"), 0.1}});
  const RowDerivatives &first = run.derivatives.at(0);
  report("Pressed by a force that begins at zero: no derivative there",
         first.torque.isZero(0.) && first.reaction.isZero(0.) &&
           first.position.isZero(0.));
}

int
main()
{
  const Overrides sideways{
    "Chuck/Translation x/Value=0.03 * max(t - 1, 0) * (2 - t)",
    "Load steps/Steps=3, 14"};
  // whose Young's moduli change nothing
  auto law_alone = law;
  law_alone.erase(law_alone.begin() + 6, law_alone.begin() + 8);
  check("Rigid bodies", coin, rigid, law_alone);
  check("Rigid bodies, sideways", coin, rigid + sideways, law_alone);
  check("Linear bodies", coin, {}, law);
  check("Linear bodies, sideways", coin, sideways, law);
  check("Bone as slave", coin, sideways + "Interface/Slave=bone", law);
  check("Along the trial gap",
        coin,
        sideways + "Interface/Slip direction=trial",
        law);
  for (const std::string pattern : {"disk", "annulus"})
    check("Bonded " + pattern,
          coin,
          {"Interface/Bonding/Pattern=" + pattern,
           "Interface/Bonding/Resolution=quadrature point"},
          bond);
  const Parameter to_and_fro{"Chuck/Rotation z/Value",
                             0.8,
                             " * sin(2 * pi * max(t - 1, 0))"};
  check("Rotation that reverses",
        coin,
        sideways + to_and_fro.text(0.) + "Load steps/Steps=3, 25",
        {law[1], law[2], law[4], law[5], law[8], to_and_fro});
  const Parameter force{"Chuck/Translation z/Value", -50, " * min(t + 0.1, 1)"};
  check("Pressed by a force, and free to tilt",
        coin,
        sideways + "Chuck/Translation z/Control=force" + force.text(0.) +
          "Chuck/Rotation x/Control=moment" + "Chuck/Rotation y/Control=moment",
        {law[1], law[2], law[3], law[4], law[5], law[6], force, law[9]});
  check("Rigid bodies, pressed by a force, and free to tilt",
        coin,
        rigid + sideways + "Chuck/Translation z/Control=force" +
          force.text(0.) + "Chuck/Rotation x/Control=moment" +
          "Chuck/Rotation y/Control=moment",
        {law[1], law[2], law[3], law[4], law[5], force, law[9]});
  check("Splines on the lattice, a force, free to tilt, a spring",
        coin,
        Overrides{"Bone/Element=spline",
                  "Bone/Cells=14, 14, 2",
                  "Bone/Bulk solver=lattice",
                  "Implant/Element=spline",
                  "Chuck/Translation z/Control=force",
                  "Chuck/Rotation y/Control=moment",
                  "Chuck/Rotation z/Stiffness=4000"} +
          force.text(0.),
        {law[1], law[2], force, {"Chuck/Rotation z/Stiffness", 4000}});
  check("A compliant machine",
        coin,
        sideways + "Chuck/Rotation z/Stiffness=4000" +
          "Chuck/Translation x/Stiffness=3000",
        {law[1],
         law[2],
         law[4],
         law[5],
         law[7],
         law[9],
         {"Chuck/Rotation z/Stiffness", 4000},
         {"Chuck/Translation x/Stiffness", 3000}});
  check("Viscosity, and friction that starts late",
        coin,
        sideways + "Interface/Viscosity=20" + "Interface/Friction starts at=1",
        {law[1], law[4], law[5], law[9], {"Interface/Viscosity", 20}});
  std::ofstream("sensitivities.csv")
    << "slip_mm,phi\n0,1\n0.01,0.9\n0.02,0.5\n0.03,0.1\n0.05,0\n";
  check("Law from a table, in divided steps",
        coin,
        {"Interface/Friction law=table",
         "Interface/Friction table=sensitivities.csv",
         "Load steps/Times=0, 1, 3",
         "Load steps/Steps=1, 3"},
        {law[0],
         law[1],
         law[4],
         law[6],
         {"Chuck/Rotation z/Value", 9.5, " * max(t - 1, 0)"}});
  check("Tilted, and lifted in part",
        coin,
        sideways + "Chuck/Rotation y/Value=0.25 * sin(pi * max(t - 1, 0))",
        {law[0],
         law[4],
         law[5],
         law[6],
         {"Chuck/Rotation y/Value", 0.25, " * sin(pi * max(t - 1, 0))"},
         law[8]});
  check("Over the edge of the bone and back",
        coin,
        Overrides{"Bone/Size=5.02, 5.02, 4",
                  "Interface/Quadrature points=6",
                  "Load steps/Steps=3, 25"} +
          "Chuck/Translation x/Value=0.2 * sin(pi * max(t - 1, 0))",
        {law[1],
         law[5],
         law[8],
         {"Chuck/Translation x/Value", 0.2, " * sin(pi * max(t - 1, 0))"}});
  check_load_from_zero();
}
