#ifndef debond_models_forecast_h
#define debond_models_forecast_h

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

namespace Debond
{
  class CoupledSystem;

  /** What closed forms predict of a scene with a coin before it is run: the
   *  bodies are springs in series with the interface. NaN where they do not
   *  apply. */
  struct Forecast
  {
    /** @p system is that of the scene at the start. */
    Forecast(const Scene &scene, const CoupledSystem &system);

    static constexpr double none     = std::numeric_limits<double>::quiet_NaN();
    double                  pressure = none; ///< at the end [MPa]
    double torsional_stiffness       = none; ///< while all sticks [N mm/rad]
    double T_max = none, T_end = none;       ///< [N mm]
    /** Relative, of all of them: half a per cent for mesh and steps, 0.15 of the
     *  bodies' share in the compliance, 0.3 of that of the implant squared, and
     *  0.15 on a narrow bone (test `forecast`). */
    double      error = none;
    std::string why; ///< they do not apply; empty if there is a torque
  };

  /** What to say of rows whose largest torque is further from the forecast than
   *  its error; empty: nothing. */
  std::string
  difference_from_forecast(const Scene                  &scene,
                           const CoupledSystem          &system,
                           const std::vector<TorqueRow> &rows);

  /** Prints it, and whether the friction law has one solution. */
  void
  print_forecast(const Scene         &scene,
                 const CoupledSystem &system,
                 std::ostream        &out);
} // namespace Debond
#endif
