#pragma once

namespace Debond
{
  class EntryTable;

  /** A thin layer of bone in series with the interface, which is crushed by
   *  pressure and gives way to shear; both are off by default. Its history is
   *  that of a point, PointHistory::crushed and sheared. Entries of
   *  `Interface`; equations in doc/explanation/bone.md. All functions are pure.
   */
  struct BoneLayer
  {
    double crushing_strength = 0; ///< p_c [MPa]; 0: none
    double crushing_modulus  = 0; ///< H [MPa/mm]
    double shear_strength    = 0; ///< tau_b [MPa]; 0: none
    /** Whether sliding in the bone counts in g_s, and wears the bond. */
    bool shear_wears_bond = false;

    void
    declare(EntryTable &table);

    bool
    crushes() const
    {
      return crushing_strength > 0.;
    }
    bool
    shears() const
    {
      return shear_strength > 0.;
    }

    /** What pushes across the interface. */
    struct Push
    {
      double pressure; ///< p [MPa], negative where a spring would pull
      double by_gap;   ///< dp/dg_n [MPa/mm]
      double energy;   ///< stored [N/mm]
      double crushed;  ///< c [mm]
    };
    /** Pressure, tangent, energy and new depth at the end of a step: of a
     * spring of the @p stiffness eps_n [MPa/mm] at the gap @p g_n + c_n that is
     * left over bone which was @p crushed by c_n before [mm]. */
    Push
    push(double stiffness, double gap_left, double crushed) const;

    /** Lost as the bone is crushed from one depth to another [N/mm]. */
    double
    work(double before, double after) const;
  };
} // namespace Debond
