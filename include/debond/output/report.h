#ifndef debond_output_report_h
#define debond_output_report_h

#include <debond/scene/scene.h>

#include <string>

namespace Debond
{
  /** Whether the rig shows anything else than the implant does. */
  inline bool
  has_rig(const CalibrationParameters &rig)
  {
    return rig.angle_offset != 0. || rig.slack != 0. ||
           rig.machine_compliance != 0. || rig.torque_offset != 0.;
  }

  /**
   * Writes report.html into a directory of results, of a run, a study or a
   * calibration: curves, maps of the interface, results in words, energies,
   * warnings, the entries that differ from the defaults, and where all that
   * comes from. The page needs no other file. Its pictures are drawn by
   * gnuplot, the curve also as torque.svg and torque.png; without gnuplot the
   * page says so and has the rest.
   *
   * Made from what is in the directory. Throws InputError if there are no
   * results, WriteError if the page cannot be written.
   */
  void
  write_report(const std::string &directory);

  /** The same, of which it is known what it is of. */
  void
  write_report_of_run(const std::string &directory);
  void
  write_report_of_study(const std::string &directory);
  void
  write_report_of_calibration(const std::string &directory);
} // namespace Debond
#endif
