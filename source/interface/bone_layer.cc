#include <debond/input/allowed_values.h>
#include <debond/input/entry_table.h>
#include <debond/interface/bone_layer.h>

// Bone under a press fit is crushed where the pressure passes its strength, and
// no interface carries more shear than the bone beside it. Both happen in a
// layer that is thin beside the bodies, and are history of a point.
namespace Debond
{
  void
  BoneLayer::declare(EntryTable &table)
  {
    const AllowedValues strength =
      Allowed::number_between(1e-9, 1e9, "MPa").or_word_for("none", "0");
    table.add("Crushing strength",
              crushing_strength,
              strength,
              "Pressure p_c [MPa] from which the bone beside a point is "
              "crushed: p = eps_n (-g_n - c) <= p_c + H c, with the depth c "
              "[mm], which stays. `none': it is not.");
    table.add("Crushing modulus",
              crushing_modulus,
              Allowed::number_between(0, 1e15, "MPa/mm"),
              "H [MPa/mm]: what the pressure rises by as the bone is crushed. "
              "With 0 a force beyond the strength times the area has no "
              "equilibrium.");
    table.add("Bone shear strength",
              shear_strength,
              strength,
              "Largest tangential traction tau_b [MPa] of a point, of friction "
              "and viscosity together: beyond it the point slides in the bone. "
              "`none': there is none.");
    table.add("Shear in bone wears bond",
              shear_wears_bond,
              Allowed::choice("false | true"),
              "Whether sliding in the bone counts in the sliding distance g_s "
              "of the interface.");
  }



  // A return mapping of plasticity in one dimension. The trial is elastic, p =
  // eps_n (-g_n - c_n), Eq. (28) along the normal with a gap that has a plastic
  // part. If it is more than the strength at the depth c_n, which is p_c + H
  // c_n, the bone is crushed until both are the same,
  //
  //   eps_n (-g_n - c) = p_c + H c,   c - c_n = (trial - strength)/(eps_n + H).
  //
  // The tangent is that of two springs in series, eps_n and H; with H = 0 it
  // vanishes, and nothing but the bodies holds the point. On a way that only
  // goes deeper the end does not depend on the steps, as both sides are linear.
  BoneLayer::Push
  BoneLayer::push(const double eps_n, const double gap, const double c_n) const
  {
    const double trial    = -eps_n * gap,
                 strength = crushing_strength + crushing_modulus * c_n;
    if (!crushes() || !(trial > strength))
      return {trial, -eps_n, 0.5 * eps_n * gap * gap, c_n};
    const double more = (trial - strength) / (eps_n + crushing_modulus),
                 p    = strength + crushing_modulus * more;
    return {p,
            -eps_n * crushing_modulus / (eps_n + crushing_modulus),
            0.5 * p * p / eps_n,
            c_n + more};
  }



  // The integral of p_c + H c: all of it is lost. What the spring eps_n stores
  // is p^2 / (2 eps_n) all the while, and comes back.
  double
  BoneLayer::work(const double before, const double after) const
  {
    return after > before ?
             (after - before) *
               (crushing_strength + 0.5 * crushing_modulus * (before + after)) :
             0.;
  }
} // namespace Debond
