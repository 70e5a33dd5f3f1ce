#include <debond/input/entry_table.h>
#include <debond/interface/interface_parameters.h>
#include <debond/shapes/body_parameters.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Debond
{
  void
  InterfaceParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Interface");
    table.add(
      "Expert / Slave",
      slave_is_auto && slave == Side::implant ? "auto" : name_of(slave),
      [this](const std::string &text) {
        slave_is_auto = text == "auto";
        slave         = text == "bone" ? Side::bone : Side::implant;
      },
      Allowed::choice("auto | bone | implant"),
      "Body whose contact face has the quadrature points, which are "
      "projected onto the other body, the master. `auto': the implant, or "
      "with a Crushing strength and an implant in a bore the bone, whose dents "
      "then stay where they were made.");
    table.add(
      "Expert / Quadrature points",
      quadrature_points == 0 ? "auto" : entry_text(quadrature_points),
      [this](const std::string &text) {
        quadrature_points = 0;
        if (text != "auto")
          read_entry(text, quadrature_points);
      },
      Allowed::whole_number(1, most_points).or_word("auto"),
      "Gauss points per direction on each surface element of the slave. "
      "`auto': 5; if a body has no trilinear cells 6 (5 if both have fitted "
      "cells), or as many as keep the distance between points below the width "
      "of the other body's cells. Around a bore, and in files, where sides of "
      "cells of both bodies divide the slave's into 2 to 4 equal parts: 3 in "
      "each, as in each part of a triangle, of three; around the axis of a bore in 4 parts, too, where they do not "
      "meet, which leaves stresses in the other body up to some 2 % off.");
    table.add("Normal stiffness",
              normal_penalty,
              Allowed::number_between(1e-6, 1e15, "MPa/mm").without_default(),
              "Normal stiffness eps_n [MPa/mm] of the interface: pressure per "
              "penetration. It is a property of the interface, and is fitted "
              "to measurements, as Tangential stiffness is.");
    table.add(
      "Tangential stiffness",
      tangential_penalty,
      Allowed::number_between(1e-6, 1e15, "MPa/mm")
        .or_word_for("auto", "0")
        .without_default(),
      "Tangential stiffness eps_t [MPa/mm] of the interface: tangential "
      "traction per elastic displacement along the interface. `auto': as "
      "Normal stiffness.");
    law_choice.declare(table, "Tractions across the interface.");
    friction_choice.declare(table, "Friction coefficient mu.");
    pressure_dependence.declare(table);
    bone_layer.declare(table);
    declare_rest(table);
    bonding.declare(table);
    table.leave_subsection();
  }



  namespace
  {
    /** Of equal pieces of a slave element the fewest whose ends meet all sides
     *  of the master's elements, around and along; around at most four, whose
     *  error is up to 2 % where they do not meet, and along one. Of files only
     *  finer elements of the master are likely to be divided alike. */
    unsigned int
    pieces_of_element(const BodyParameters &mine, const BodyParameters &other)
    {
      const bool from_file = mine.shape == BodyShape::file;
      if (!mine.mesh || !other.mesh ||
          from_file != (other.shape == BodyShape::file))
        return 1;
      unsigned int result = 1;
      for (const unsigned int d : {0, 2})
        {
          const auto cells = [&](const BodyParameters &body) {
            return from_file ? body.lattice_of_cells()[0] : body.cells[d];
          };
          // n elements of the slave and m of the master on the same length:
          // sides meet where each of the n is divided into m/gcd(n, m) pieces;
          // for both directions the least common multiple.
          const unsigned int n = cells(mine), m = cells(other),
                             pieces = std::lcm(result, m / std::gcd(n, m));
          if (from_file ? m > n && pieces <= 4 : d == 0 || pieces <= 4)
            result = std::min(pieces, 4U);
        }
      return result;
    }
  } // namespace



  // Six: with splines the error of five is as large as that of the bulk, but
  // where elements are small at the rim (doc/evidence/speed_and_accuracy.md).
  // Functions of the master have kinks at the sides of its elements: three
  // points on either side see them exactly, many on both hardly.
  dealii::Quadrature<1>
  InterfaceParameters::points_per_element(const BodyParameters &bone,
                                          const BodyParameters &implant) const
  {
    if (quadrature_points > 0)
      return dealii::QGauss<1>(quadrature_points);
    // Of a triangle, of three faces, 27: functions there have six nodes, and
    // twelve points give the same pull of a post to 1e-5, but twists of facets
    // that do not match to no better than some 0.2 %.
    const BodyParameters &mine = slave == Side::bone ? bone : implant;
    if (mine.has_tetrahedra())
      return dealii::QGauss<1>(3);
    const unsigned int pieces = slave == Side::bone ?
                                  pieces_of_element(bone, implant) :
                                  pieces_of_element(implant, bone);
    if (pieces > 1)
      return dealii::QIterated<1>(dealii::QGauss<1>(3), pieces);
    if (bone.element == ElementKind::trilinear &&
        implant.element == ElementKind::trilinear)
      return dealii::QGauss<1>(5);
    return dealii::QGauss<1>(
      std::clamp(fewest_points_per_element(bone, implant),
                 bone.is_fitted() && implant.is_fitted() ? 5U : 6U,
                 most_points));
  }



  // Cells of the other body that are finer than the distance of the points
  // give way between them: the interface would be too soft. Up to rounding.
  unsigned int
  InterfaceParameters::fewest_points_per_element(
    const BodyParameters &bone,
    const BodyParameters &implant) const
  {
    // Cells of the other body for each element of the slave, in both
    // directions, rounded up: there is a point for each of them.
    const BodyParameters &mine  = slave == Side::bone ? bone : implant;
    const BodyParameters &other = slave == Side::bone ? implant : bone;
    double                ratio = 0.;
    for (const unsigned int d : {0, 1})
      if (!other.is_rigid())
        ratio = std::max(ratio,
                         // faces around each other are as large
                         mine.mesh && other.mesh ?
                           double(other.lattice_of_cells()[d]) /
                             mine.lattice_of_cells()[d] :
                           mine.cell_width(d) / other.cell_width(d));
    return std::ceil(ratio - 1e-9);
  }



  // A new one each time: members that a program has set since are in it.
  InterfaceLawPointer
  InterfaceParameters::joint() const
  {
    const std::shared_ptr<InterfaceLaw> law = law_choice.make();
    // The entries of `Interface' that all laws share; those of its own
    // subsection the law has read itself.
    law->stiffness           = normal_penalty;
    law->friction            = friction;
    law->bone                = bone_layer;
    law->opening_breaks_bond = opening_breaks_bond;
    law->explicit_friction   = explicit_friction;
    return initialised(law);
  }



  ContactPointLaw
  InterfaceParameters::law() const
  {
    return {joint(), tangential_stiffness(), viscosity, slip_direction};
  }



  // Closed forms and outputs need not ask which law it is: where phi is of no
  // consequence it is zero.
  BondingParameters
  InterfaceParameters::bonding_of_law() const
  {
    if (friction->has_bond() || joint()->pulls())
      return bonding;
    // a homogeneous pattern of phi_0 = 0
    BondingParameters nothing;
    nothing.initial_bonding = 0.;
    return nothing;
  }



  void
  InterfaceParameters::declare_rest(EntryTable &table)
  {
    table.add("Friction starts at",
              friction_starts_at,
              Allowed::number("time").or_word_for("auto", entry_text(-1e100)),
              "Time until which the interface is frictionless. `auto': it has "
              "friction from the first time on.");
    table.add("Interference",
              interference,
              Allowed::text("an expression in t"),
              "Excess of the diameter of the implant over that of its bore "
              "[mm], an expression in the time t; negative: clearance. Bodies "
              "from files: half of it along the normals of the implant's "
              "contact faces. Its "
              "value at the first time is there before anything moves.");
    table.add("Opening breaks bond",
              opening_breaks_bond,
              Allowed::choice("false | true"),
              "`true': a bonded point that opens is debonded for good. "
              "`false': it bonds again when it closes, as in the paper (with "
              "Law = adhesive or mixed mode: as that law says).");
    table.add(
      "Viscosity",
      viscosity,
      Allowed::number_between(1e-15, 1e15, "MPa per (mm per unit of time)")
        .or_number(0),
      "Viscosity eta [MPa per (mm per unit of time)] of sliding: a point "
      "that slides with the speed v has the friction mu p + eta v; one that "
      "sticks has none of it. A bond that would break in a jump breaks in "
      "time instead: the local solution is unique while |d mu/d g_s| p is "
      "below Tangential stiffness plus eta over the duration of the "
      "(sub-)step. Results then depend on the rate. Must be 0 with Friction "
      "law = frictionless.");
  }



  // Methods that are there to show how they fail.
  void
  InterfaceParameters::declare_expert(EntryTable &table)
  {
    table.enter_subsection("Expert");
    table.add(
      "Slip direction",
      slip_direction,
      Allowed::choice("integrated | trial | previous gap"),
      "Direction of slip within a step. `integrated': integrated along the "
      "path of the point during the step; second order in the step. `trial': "
      "that of the gap without sliding in this step; first order where the "
      "direction turns. `previous gap': that of the previous step, Eq. (31) "
      "as printed, which can never turn. `trial' and `previous gap' are for "
      "comparison.");
    table.add(
      "Friction update",
      explicit_friction,
      Allowed::choice("implicit | explicit"),
      "`implicit': friction coefficient for the sliding distance at the end "
      "of the step. `explicit': for that at its beginning, so that softening "
      "lags one step behind; for comparison.");
    table.leave_subsection();
  }



  void
  InterfaceParameters::check(const BodyParameters &implant) const
  {
    if (friction->is_frictionless && viscosity != 0.)
      throw EntryError("Interface / Viscosity",
                       "it is not used by Friction law = frictionless: it "
                       "belongs to laws with friction");
    joint(); // refuses what its entries cannot be
    bonding.check(implant);
  }
} // namespace Debond
