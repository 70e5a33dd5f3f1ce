#ifndef debond_scene_output_parameters_h
#define debond_scene_output_parameters_h

#include <string>
#include <vector>

namespace Debond
{
  class EntryTable;

  /** steps: lines about the steps, progress and timings; quiet: warnings and
   * errors only. */
  enum class ConsoleKind
  {
    steps,
    quiet
  };

  /** The subsection `Output` of a scene. */
  struct OutputParameters
  {
    std::string  directory = "output/coin";
    unsigned int fields_every =
      50;                        ///< planned steps between VTU files, 0: none
    std::string reference_curve; ///< CSV angle_deg,torque_Nmm, or empty
    std::string reference_profiles;     ///< a profiles.csv, or empty
    double      full_sliding_angle = 0; ///< [deg], 0: from the curve
    double      observed_bonding   = 0; ///< mean phi_0 of w_adh, 0: the scene's
    std::vector<double> profile_angles; ///< [deg]
    bool                friction_law_curve = false; ///< write friction_law.csv
    unsigned int        checkpoint_every = 0; ///< rows; 0: if interrupted only
    ConsoleKind         console          = ConsoleKind::steps;
    /** Use a directory that holds results of another scene, or the checkpoint
     * of an interrupted run. No entry of the scene: the option --force of the
     *  program. */
    bool overwrite_other_results = false;
    /** Whether a run leaves a checkpoint when it is interrupted. No entry of
     *  the scene: false for runs that are part of a larger one. */
    bool resumable = true;

    /** Refuses reference files that cannot be read. Throws EntryError. */
    void
    check() const;

    void
    declare(EntryTable &table);
  };
} // namespace Debond
#endif
