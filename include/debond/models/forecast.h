#ifndef debond_models_forecast_h
#define debond_models_forecast_h

#include <iosfwd>

namespace Debond
{
  struct Scene;

  /** Prints what closed forms foretell of a scene with a coin: mean pressure,
   *  torsional stiffness, largest torque, and whether the friction law has one
   *  solution. */
  void
  print_forecast(const Scene &scene, std::ostream &out);
} // namespace Debond
#endif
