#ifndef debond_energy_balance_h
#define debond_energy_balance_h

#include <debond/chuck.h>

namespace Debond
{
  /**
   * The energy balance W = E_bulk + E_interface + D, counted from the first
   * row. W is the work of the chuck, a trapezoid of the generalised forces over
   * the motion of the six components; the trapezoid's own error is bounded by
   * half the sum of |dF| |dq|.
   */
  class EnergyBalance
  {
  public:
    /** Notes an accepted state. Forces and position: generalised, in internal
     *  units; energies in N mm. */
    void
    add(const Chuck::Vector6 &forces,
        const Chuck::Vector6 &position,
        double                energy_bulk,
        double                energy_interface,
        double                dissipation);

    double
    work() const
    {
      return W;
    } ///< [N mm]
    /** (W - E_bulk - E_interface - D) / max |W|, 0 while W = 0. */
    double
    defect() const;
    /** Bound of the trapezoid's share in defect(). */
    double
    defect_bound() const;
    /** Dissipated more than was put in, beyond the bound? */
    bool
    dissipates_too_much() const;
    /** Did the last step give back what had been dissipated? */
    bool
    dissipation_falls() const;
    /** Is more missing, or left over, than trapezoids can account for? */
    bool
    is_out_of_balance() const;

  private:
    bool           started = false;
    Chuck::Vector6 last_forces, last_position;
    double         W = 0, max_W = 0, bound = 0;
    double stored = 0, dissipated = 0, first_stored = 0, first_dissipated = 0;
    double last_dissipated = 0;
  };
} // namespace Debond
#endif
