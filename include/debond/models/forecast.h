#pragma once

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

namespace Debond
{
  struct LameFit;

  /** What closed forms predict of a scene before it is run, with stiffnesses of
   *  the bodies in closed form: `Model = foundation` of a coin or ring, Lame's
   *  press fit of a pin or a cup. NaN where nothing applies. */
  struct Forecast
  {
    explicit Forecast(const Scene &scene);

    static constexpr double none     = std::numeric_limits<double>::quiet_NaN();
    double                  pressure = none; ///< at the end [MPa]
    double torsional_stiffness       = none; ///< while all sticks [N mm/rad]
    double T_max = none, T_end = none;       ///< [N mm]
    double F_max = none;                     ///< that pulls a pin out [N]
    double area  = none;                     ///< of a flat face [mm^2]
    /** Relative, of all of them. Of a flat face: half a per cent for mesh and
     * steps, 0.18 of the bodies' share in the compliance, 0.3 of that of the
     * implant squared, 0.15 on a narrow bone, 0.03 for a bonded disk, whose rim
     * cuts elements (test `forecast`), and (3/2)(L/R)^2 on a soft interface
     * (doc/explanation/closed_forms.md). */
    double      error = none;
    std::string why; ///< it does not apply; else empty

  private:
    void
    of_flat_face(Scene scene);
    void
    of_press_fit(const Scene &scene, const LameFit &fit);
  };

  /** What to say of rows whose largest torque is further from the forecast than
   *  its error; empty: nothing. */
  std::string
  difference_from_forecast(const Scene                  &scene,
                           const std::vector<TorqueRow> &rows);

  /** Prints it. */
  void
  print_forecast(const Scene &scene, std::ostream &out);
} // namespace Debond
