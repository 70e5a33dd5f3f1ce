#ifndef debond_system_model_parameters_h
#define debond_system_model_parameters_h

#include <debond/bulk/body_parameters.h>
#include <debond/bulk/chuck.h>
#include <debond/interface/interface_parameters.h>
#include <debond/system/load_step_parameters.h>

namespace Debond
{
  /** The part of a scene that says what is solved: two bodies, the interface
   *  between them, the chuck that moves one of them, and in which steps. */
  struct ModelParameters
  {
    BodyParameters         bone;
    BodyParameters         implant = BodyParameters::default_implant();
    InterfaceParameters    interface;
    ChuckParameters        chuck;
    LoadSteppingParameters load_steps;

    bool
    has_friction() const
    {
      return !interface.friction->is_frictionless();
    }
    /** Whether a step that begins at @p time has friction. It starts at a
     *  planned time, up to rounding. */
    bool
    has_friction_after(const double time) const
    {
      return time >=
             interface.friction_starts_at -
               1e-9 * (load_steps.times.back() - load_steps.times.front());
    }
  };
} // namespace Debond
#endif
