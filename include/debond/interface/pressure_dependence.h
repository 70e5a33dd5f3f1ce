#pragma once

#include <debond/input/monotone_curve.h>
#include <debond/interface/friction_law.h>

#include <memory>
#include <string>

namespace Debond
{
  /** Friction that is not in proportion to the pressure: any law under f(p) in
   *  the place of p, L = mu f(p). Entries of `Interface`. */
  struct PressureDependence
  {
    double      exponent  = 1; ///< n
    double      reference = 0; ///< p_0 [MPa]; 0: not set
    std::string table;         ///< file of factors f/p; empty: none

    void
    declare(EntryTable &table);

    /** True if f(p) = p. */
    bool
    is_none() const
    {
      return exponent == 1. && table.empty();
    }

    /** The @p law under f(p), or itself if that is p. Throws EntryError. */
    FrictionLawPointer
    of(const FrictionLawPointer &law) const;
  };
} // namespace Debond
