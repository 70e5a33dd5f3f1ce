#include <debond/input/entry_table.h>
#include <debond/interface/bonding_parameters.h>
#include <debond/shapes/body_parameters.h>
#include <debond/support/input_error.h>

#include <limits>

namespace Debond
{
  namespace
  {
    const char *const pattern_names =
      "homogeneous | disk | annulus | random | expression | image | file";
  }



  std::string
  name_of(const BondingPatternKind pattern)
  {
    return Allowed::choice(pattern_names)
      .names[static_cast<unsigned int>(pattern)];
  }



  void
  BondingParameters::declare(EntryTable &table)
  {
    table.enter_subsection("Bonding");
    table.add(
      "Pattern",
      pattern,
      Allowed::choice(pattern_names),
      "Where the contact face of the implant is bonded at the start (phi_0, in "
      "reference coordinates). `homogeneous': everywhere. `disk': inside the "
      "concentric disk that has Bonded fraction of the area of a coin, cap, "
      "ring, cup or file. `annulus': outside a concentric disk, with that "
      "fraction. `random': as many elements or points (Expert / Interface / "
      "Bonding / Resolution), drawn by Seed, as make up Bonded fraction. "
      "`expression': see Expression. `image', `file': see File.");
    table.add("Bonding degree",
              initial_bonding,
              Allowed::number_between(0, 1, "").without_default(),
              "Bonding degree phi_0 of bonded points, dimensionless, from 0 "
              "to 1: it multiplies every pattern.");
    table.add(
      "Bonded fraction",
      bonded_fraction,
      Allowed::number_between(0, 1, ""),
      "Bonded share f of the area, dimensionless, met exactly: elements at "
      "its border are partly bonded. A disk on a coin is r <= R sqrt(f), an "
      "annulus r >= R sqrt(1 - f). Must be 1 for patterns that do not use it.");
    table.add("Seed",
              seed,
              Allowed::whole_number(0, std::numeric_limits<int>::max()),
              "Number of the random pattern, for Pattern = random; the same "
              "number gives the same pattern on every machine.");
    table.add(
      "Correlation length",
      correlation_length,
      Allowed::number_between(1e-6, 1e6, "mm").or_number(0),
      "Size l [mm] of bonded patches, for Pattern = random: the highest "
      "values of a random field with the correlation exp(-(d/l)^2) at the "
      "distance d in space. 0: independent elements.");
    declare_places(table);
    table.add(
      "Expert / Resolution",
      resolution,
      Allowed::choice("element | quadrature point"),
      "`element': phi_0 is constant on each surface element of the implant "
      "(the area mean, for expression and image). `quadrature point': each "
      "quadrature point has its own.");
    table.leave_subsection();
  }



  // Patterns that are given place by place.
  void
  BondingParameters::declare_places(EntryTable &table)
  {
    table.add(
      "Expression",
      expression,
      Allowed::text("an expression in x, y, r, angle, pi, R", false),
      "Pattern expression: phi_0 in [0, 1] as an expression in the position: x "
      "and y in mm (on a side: x around it from angle = 0, and y = z; on a "
      "cup: along the sphere from its lowest point), the distance r from the "
      "implant's axis in mm, angle about the axis from the x axis towards the "
      "y axis in degrees, above -180 and up to 180, pi, and R, half the width "
      "of the implant (the shorter one) in mm. sin and cos expect radians.");
    table.add(
      "File",
      file,
      Allowed::text("the name of a file", false).or_word_for("none", ""),
      "Pattern image: PNG, grey levels from 0 (black) to 1 (white) are "
      "phi_0; the picture spans the square around the contact face (of a "
      "block, a file or a side: the rectangle), its right is +x and its top "
      "+y. Pattern file: CSV whose first line names its columns: "
      "element,phi_0, or point,phi_0 with Expert / Interface / Bonding / "
      "Resolution = quadrature point (numbered from 1, see bonding.csv in the "
      "results), phi_0 alone (all of these in order), or x,y,phi_0 (places in "
      "mm, seen from above, not in a bore: an element takes the mean of those "
      "inside it, or that of the one nearest to its centre; a quadrature point "
      "that of the nearest). The path is relative to the working directory.");
    table.add("Expert / White level",
              white_level,
              Allowed::whole_number(1, 65535).or_word_for("auto", "0"),
              "Grey level in the file that is white, phi_0 = 1, for Pattern = "
              "image: 4095 for 12 bits in a file of 16. `auto': the largest "
              "that the format has, 255 or 65535; refused of a picture of 16 "
              "bits that stays below 16384, and of one of 8 bits with 0 and 1 "
              "alone.");
    table.add(
      "Expert / Threshold",
      threshold,
      Allowed::number_between(0, 0.9999, "").or_word_for("none", "-1"),
      "Grey level, from 0 (black) to 1 (white), above which phi_0 = 1, for "
      "Pattern = image; below it is 0. `none': grey levels are used as they "
      "are.");
  }



  // An entry that its pattern does not read is refused, and not warned of, as
  // elsewhere: with the wrong pattern all results are those of another test.
  void
  BondingParameters::check(const BodyParameters &implant) const
  {
    using Kind            = BondingPatternKind;
    const bool is_random  = pattern == Kind::random;
    const bool is_disk    = pattern == Kind::disk || pattern == Kind::annulus;
    const bool reads_file = pattern == Kind::image || pattern == Kind::file;
    // it was set, so the pattern was meant to be another one
    struct Row
    {
      bool              is_used, is_set;
      const char *const entry, *const user;
    };
    for (const Row &row :
         {Row{is_disk || is_random,
              bonded_fraction != 1,
              "Bonded fraction",
              "disk, annulus or random (Bonding degree lowers the degree of "
              "bonding)"},
          Row{is_random, seed != 1, "Seed", "random"},
          Row{
            is_random, correlation_length != 0, "Correlation length", "random"},
          Row{pattern == Kind::expression,
              expression != "1",
              "Expression",
              "expression"},
          Row{reads_file, !file.empty(), "File", "image or file"},
          Row{pattern == Kind::image, white_level != 0, "White level", "image"},
          Row{pattern == Kind::image, threshold != -1, "Threshold", "image"}})
      // What a pattern has no use for is refused rather than passed over: a
      // scene would say something else than what is run.
      if (row.is_set && !row.is_used)
        throw EntryError(bonding_section + row.entry,
                         "it is not used by Pattern = " + name_of(pattern) +
                           ": it belongs to Pattern = " + row.user);
    if (reads_file && file.empty())
      throw EntryError(bonding_section + "Pattern",
                       "it needs the name of a file: " + bonding_section +
                         "File");
    if (is_disk && !implant.geometry().is_round &&
        implant.shape != BodyShape::file)
      throw EntryError(bonding_section + "Pattern",
                       "it is for round implants: Implant / Shape = coin, cap, "
                       "ring, cup or file");
  }
} // namespace Debond
