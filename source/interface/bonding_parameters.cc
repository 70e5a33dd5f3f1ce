#include <debond/bulk/body_mesh.h>
#include <debond/input/allowed_values.h>
#include <debond/interface/bonding_parameters.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <limits>

namespace Debond
{
  namespace
  {
    // in the order of BondingPatternKind
    const std::array<std::string, 7> pattern_names{{"homogeneous",
                                                    "disk",
                                                    "annulus",
                                                    "random",
                                                    "expression",
                                                    "image",
                                                    "file"}};



    std::string
    all_patterns()
    {
      std::string text;
      for (const std::string &name : pattern_names)
        text += (text.empty() ? "" : " | ") + name;
      return text;
    }



    void
    declare_random_entries(dealii::ParameterHandler &prm)
    {
      prm.declare_entry("Seed",
                        "1",
                        Allowed::whole_number(0,
                                              std::numeric_limits<int>::max()),
                        "Pattern random: which of the random patterns. The "
                        "same seed gives the same pattern on every machine.");
      prm.declare_entry(
        "Correlation length",
        "0",
        AllowedValues(
          [](const std::string &text) {
            double value = 0;
            return read_number(text, value) && (value == 0. || value >= 1e-6);
          },
          "0, or a number >= 1e-6 [mm]"),
        "Pattern random: distance l at which the correlation exp(-(d/l)^2) of "
        "the random field whose highest places are bonded has fallen to 1/e: "
        "the size of patches. 0: elements are drawn independently.");
    }



    void
    declare_place_entries(dealii::ParameterHandler &prm)
    {
      prm.declare_entry(
        "Expression",
        "1",
        Allowed::text("an expression in x, y, r, angle, pi, R"),
        "Pattern expression: phi_0 as a function of the place (muParser): x, y "
        "and the distance r from the axis in mm, angle from the x axis towards "
        "the y axis in degrees, above -180 and up to 180, pi, and the radius "
        "R of the implant in mm. Note that sin and cos expect radians: "
        "cos(angle * pi / 180). Values outside [0, 1] are refused.");
      prm.declare_entry(
        "File",
        "",
        Allowed::optional_text("the name of a file"),
        "Pattern image: PNG or PGM, grey levels from 0 (black) to 1 (white) "
        "are phi_0; the picture spans the square around the contact face (of a "
        "block: the rectangle), its right is +x and its top +y. Pattern file: "
        "CSV whose first line names its columns: element,phi_0 (elements are "
        "numbered from 1, see bonding.csv in the results), phi_0 alone (all "
        "elements in order), or x,y,phi_0 (points, in mm: an element takes the "
        "mean of the points inside it, or that of the point nearest to its "
        "centre; a quadrature point that of the nearest point). The path is "
        "relative to the working directory.");
      prm.declare_entry(
        "Threshold",
        "-1",
        AllowedValues(
          [](const std::string &text) {
            double value = 0;
            return read_number(text, value) &&
                   (value == -1. || (value >= 0. && value < 1.));
          },
          "-1, or a number >= 0 and < 1"),
        "Pattern image: grey level, from 0 (black) to 1 (white), above which "
        "phi_0 = 1; it is 0 elsewhere. -1: grey levels as they are.");
    }
  } // namespace



  std::string
  name_of(const BondingPatternKind pattern)
  {
    return pattern_names[static_cast<unsigned int>(pattern)];
  }



  void
  BondingParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Bonding");
    prm.declare_entry(
      "Pattern",
      "homogeneous",
      Allowed::choice(all_patterns()),
      "Where the implant's contact face is bonded at the start (phi_0, in "
      "reference coordinates). `homogeneous': everywhere. `disk': inside the "
      "concentric disk that holds Bonded fraction of the area of a coin or a "
      "cap; `annulus': outside the disk that holds the rest. `random': as many "
      "elements, drawn by Seed, as make up Bonded fraction. `expression': see "
      "Expression. `image', `file': see File.");
    prm.declare_entry("Initial bonding",
                      "1",
                      Allowed::number_between(0, 1, ""),
                      "Degree of osseointegration phi_0 of bonded points, "
                      "dimensionless: multiplies every pattern.");
    prm.declare_entry(
      "Bonded fraction",
      "1",
      Allowed::number_between(0, 1, ""),
      "Bonded part f of the area, dimensionless, met exactly. Pattern disk: "
      "of a coin r <= R sqrt(f); annulus: r >= R sqrt(1 - f); random: as said "
      "there. "
      "Elements at the border of the fraction are partly bonded. Must be 1 for "
      "other patterns.");
    declare_random_entries(prm);
    declare_place_entries(prm);
    prm.declare_entry(
      "Resolution",
      "element",
      Allowed::choice("element | quadrature point"),
      "phi_0 is constant on each surface element of the implant, patterns "
      "expression and image with their area mean there; or it is that of each "
      "quadrature point.");
    prm.leave_subsection();
  }



  void
  BondingParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Bonding");
    for (unsigned int i = 0; i < pattern_names.size(); ++i)
      if (prm.get("Pattern") == pattern_names[i])
        pattern = static_cast<BondingPatternKind>(i);
    initial_bonding    = prm.get_double("Initial bonding");
    bonded_fraction    = prm.get_double("Bonded fraction");
    seed               = to_whole_numbers(prm.get("Seed"))[0];
    correlation_length = prm.get_double("Correlation length");
    expression         = prm.get("Expression");
    file               = prm.get("File");
    threshold          = prm.get_double("Threshold");
    resolution         = prm.get("Resolution") == "element" ?
                           BondingResolution::element :
                           BondingResolution::quadrature_point;
    prm.leave_subsection();
  }



  namespace
  {
    /** Refuses an entry that the pattern does not use but that the scene has
     *  set, or the pattern was meant to be another one. */
    void
    refuse_unused(const bool               is_set,
                  const std::string       &entry,
                  const std::string       &value,
                  const BondingPatternKind pattern,
                  const std::string       &user)
    {
      if (is_set)
        throw InputError(bonding_section + entry + " = '" + value +
                         "' is not used by Pattern = " + name_of(pattern) +
                         ": it belongs to Pattern = " + user);
    }
  } // namespace



  void
  BondingParameters::check(const BodyParameters &implant) const
  {
    using Kind              = BondingPatternKind;
    const bool has_fraction = pattern == Kind::disk ||
                              pattern == Kind::annulus ||
                              pattern == Kind::random;
    if (!has_fraction && bonded_fraction != 1)
      throw InputError(bonding_section +
                       "Bonded fraction = " + to_text(bonded_fraction) +
                       " contradicts Pattern = " + name_of(pattern) +
                       ", which says itself what is bonded: it belongs to "
                       "Pattern = disk, annulus or random (Initial bonding "
                       "lowers the degree of bonding)");
    if ((pattern == Kind::disk || pattern == Kind::annulus) &&
        !implant.is_round())
      throw InputError(bonding_section + "Pattern = '" + name_of(pattern) +
                       "' is defined for Implant / Shape = coin and cap only");

    const bool reads_file = pattern == Kind::image || pattern == Kind::file;
    refuse_unused(pattern != Kind::random && seed != 1,
                  "Seed",
                  std::to_string(seed),
                  pattern,
                  "random");
    refuse_unused(pattern != Kind::random && correlation_length != 0,
                  "Correlation length",
                  to_text(correlation_length),
                  pattern,
                  "random");
    refuse_unused(pattern != Kind::expression && expression != "1",
                  "Expression",
                  expression,
                  pattern,
                  "expression");
    refuse_unused(
      !reads_file && !file.empty(), "File", file, pattern, "image or file");
    refuse_unused(pattern != Kind::image && threshold != -1,
                  "Threshold",
                  to_text(threshold),
                  pattern,
                  "image");
    if (reads_file && file.empty())
      throw InputError(bonding_section + "Pattern = '" + name_of(pattern) +
                       "' needs the name of a file: " + bonding_section +
                       "File");

    // what is given place by place shows its faults when it is used
    if (pattern == Kind::expression || reads_file)
      BondingPattern(*this, implant, make_contact_surface(implant), 3);
  }
} // namespace Debond
