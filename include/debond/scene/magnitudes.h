#ifndef debond_scene_magnitudes_h
#define debond_scene_magnitudes_h

namespace Debond
{
  struct Scene;

  /** Refuses sizes, stiffnesses and the like that no implant has and whose
   *  products would overflow or vanish: nearly always a mistake in a unit or an
   *  exponent. Throws InputError that begins with the name of the entry. */
  void
  check_magnitudes(const Scene &scene);

  /** The same for what the chuck prescribes at a time: a displacement [mm] or
   *  angle [deg], or if it is a load [N, N mm]. The message begins with the
   *  value. */
  void
  check_chuck_value(double value, bool is_load, double time);
} // namespace Debond
#endif
