#pragma once

#include <cstdint>
#include <string>

namespace Debond
{
  class EntryTable;
  struct BodyParameters;

  /** Patterns of phi_0, in the order of their names in the scene: one that is
   *  the same everywhere, two by the radius, one by chance, and three that are
   *  given place by place. */
  enum class BondingPatternKind
  {
    homogeneous,
    disk,
    annulus,
    random,
    expression,
    image,
    file
  };
  /** Parts of the contact face that have one phi_0 each. */
  enum class BondingResolution
  {
    element,
    quadrature_point
  };

  /** Name of the subsection in messages. */
  inline const std::string bonding_section = "Interface / Bonding / ";

  /** The subsection `Interface / Bonding` of a scene. */
  struct BondingParameters
  {
    BondingPatternKind pattern            = BondingPatternKind::homogeneous;
    double             initial_bonding    = 1;   ///< multiplies the pattern
    double             bonded_fraction    = 1;   ///< of the contact area
    std::uint64_t      seed               = 1;   ///< random
    double             correlation_length = 0;   ///< random [mm]
    std::string        expression         = "1"; ///< phi_0(x, y, r, angle)
    std::string        file;                     ///< image or CSV
    /** Of the file when the scene was read, see identity_of(); empty: any. */
    std::string       identity;
    unsigned int      white_level = 0;  ///< image; 0: that of the file
    double            threshold   = -1; ///< image; -1: grey levels as they are
    BondingResolution resolution  = BondingResolution::element;


    /** Refuses entries that contradict each other or the implant. Throws
     *  EntryError. */
    void
    check(const BodyParameters &implant) const;

    void
    declare(EntryTable &table);

  private:
    void
    declare_places(EntryTable &table);
  };

  /** As the scene names it: `quadrature point`. */
  std::string
  name_of(BondingPatternKind pattern);
} // namespace Debond
