#include <debond/interface/bilinear_bond.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

// The share that is held stands beside the share that rubs, each with the whole
// pressure or pull of its area; here is what rubs, and CohesiveShare is what is
// held. The damage between them is known before the friction of a point is
// asked for, as it follows from the gap to the place where the point has
// bonded.
namespace Debond
{
  namespace
  {
    // A bond between a share of each point and the place where it bonded, see
    // BilinearBond, and friction without a bond on the share that is broken,
    // after Alfano and Sacco (2006):
    //
    //   L = (1 - phi_0 (1 - omega)) L(p, 0) while p is positive.
    class MixedMode : public InterfaceLaw
    {
    public:
      void
      declare(EntryTable &table) override
      {
        bond.declare(table);
      }

      bool
      initialise() override
      {
        // The measure of a path, the strength for messages and the steepest
        // fall are those of the bond; friction contributes nothing to them, as
        // its coefficient is that of broken faces throughout.
        require_bond("mixed mode");
        if (bone.shears())
          throw EntryError("Interface / Bone shear strength",
                           "with Law = mixed mode the strength of the bond is "
                           "Mixed mode / Shear strength: expected none",
                           to_text(bone.shear_strength));
        bond.check();
        tension                 = bond.tension();
        characteristic_distance = bond.length_of_damage();
        cohesion                = std::make_shared<const BilinearBond>(bond);
        return true;
      }

      InterfaceResponse
      answer(const PointStart &start,
             const double      g_n,
             const double      distance) const override
      {
        InterfaceResponse result =
          InterfaceLaw::answer(broken(start), g_n, distance);
        // the tangent of faces that touch, whichever way they will go
        if (start.history.joined &&
            std::abs(gap_left(start, g_n, distance)) < 1e-9 * bond.N / bond.K)
          result.pressure_by_gap =
            -std::max(stiffness, start.phi_0 * (1. - start.damage) * bond.K);
        // Of the area of the point the share phi_0 (1 - omega) is held and rubs
        // nowhere; omega is that of the end of the step, and dL/domega goes
        // into the tangent beside domega/dw of the CohesiveShare.
        const double bonded    = start.history.joined ? start.phi_0 : 0.,
                     rubs      = 1. - bonded * (1. - start.damage);
        result.limit_by_damage = bonded * result.limit;
        result.limit *= rubs;
        result.limit_by_gap *= rubs;
        result.limit_by_slip *= rubs;
        return result;
      }

      // g_s goes on as without a bond, Eq. (12).
      PointHistory
      advance(const PointStart &start,
              const double      g_n,
              const double      distance) const override
      {
        PointHistory result = InterfaceLaw::advance(start, g_n, distance);
        result.damage       = start.damage;
        return result;
      }

      // Damage is that of the share that is held.
      PointWork
      work(const PointStart &start,
           const double      g_n,
           const double      distance) const override
      {
        PointWork result;
        if (start.frictionless)
          return result;
        PointStart before = start;
        before.damage     = start.history.damage;
        // A trapezoid between the limits of both ends [N/mm]: damage grows in
        // the step, and the share that rubs with it.
        const double L_n = answer(before, start.history.normal_gap, 0.).limit,
                     L   = answer(start, g_n, distance).limit;
        result.friction  = 0.5 * (L_n + L) * distance;
        result.friction_bound = 0.5 * std::abs(L - L_n) * distance;
        return result;
      }

      // Damage is none of slip, so that only the friction law of what is broken
      // may soften.
      double
      softening_by_slip(const PointStart &start,
                        const double      pressure,
                        const double      distance) const override
      {
        return InterfaceLaw::softening_by_slip(broken(start),
                                               pressure,
                                               distance);
      }

      // phi is what is held, in the place of that of Eq. (13).
      FrictionCoefficient
      reported(const PointHistory &history,
               const double        phi_0,
               const double        pressure) const override
      {
        FrictionCoefficient result =
          InterfaceLaw::reported(history, 0., pressure);
        result.phi = history.bond_left(phi_0) * (1. - history.damage);
        return result;
      }

    private:
      /** The share that rubs. */
      static PointStart
      broken(PointStart start)
      {
        start.phi_0 = 0.;
        return start;
      }

      BilinearBond bond;
    };
  } // namespace



  InterfaceLawPlugin
  mixed_mode_interface_law_plugin()
  {
    return {
      "mixed mode",
      "a bilinear cohesive law for tension and shear, and friction where it "
      "is broken",
      MixedMode()};
  }
} // namespace Debond
