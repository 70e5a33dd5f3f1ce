#pragma once

#include <debond/interface/interface_law.h>

namespace Debond
{
  /** Traction of the share of a point's area that is bonded to a place of the
   *  master, at a gap to that place: the stiffness times the gap, without its
   *  normal part where that presses. */
  struct CohesiveResponse
  {
    double stiffness           = 0; ///< [MPa/mm]
    double stiffness_by_damage = 0; ///< [MPa/mm]
    double damage              = 0; ///< from 0 to 1, at the end of the step
    double damage_by_normal = 0, damage_by_tangential = 0; ///< [1/mm]
  };



  /** Bond of that share, with its parameters: the bilinear law of Camanho and
   *  Davila (2002),
   *
   *    t = phi_0 (1 - omega) K delta,   delta = (max(n, 0), delta_t).
   *
   *  omega begins where (max(t_n, 0)/N)^2 + (t_t/T)^2 = 1 and is 1 where the
   * work is that of the criterion, G(B), B = delta_t^2/delta^2. It never falls.
   */
  struct BilinearBond
  {
    double N = 5, T = 5;           ///< strengths [MPa]
    double G_I = 0.05, G_II = 0.1; ///< works to the end [N/mm]
    double K = 2000, exponent = 2; ///< [MPa/mm], dimensionless
    bool   power_law = false;      ///< else Benzeggagh and Kenane's criterion

    void
    declare(EntryTable &table);
    /** Refuses a bond that would be broken before it is damaged. Throws
     *  EntryError. */
    void
    check() const;

    /** At the gap @p g_n across the interface and the distance @p delta_t along
     *  it [mm]. */
    CohesiveResponse
    hold(const PointStart &start, double g_n, double delta_t) const;

    /** Least gap at which nothing is left, for the measure of a path [mm]. */
    double
    length_of_damage() const;

    Tension
    tension() const;

  private:
    double
    least_ratio() const;
    double
    energy(double B, double &slope) const;
  };
} // namespace Debond
