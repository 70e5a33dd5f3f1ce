#pragma once

#include <debond/input/scene_file.h>
#include <debond/scene/curve_axes.h>
#include <debond/support/input_error.h>
#include <debond/system/load_step_parameters.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Debond
{
  class EntryTable;

  /** What is solved: two bodies of finite elements, or one of the closed forms
   * of closed_forms.h. */
  enum class ModelKind
  {
    finite_elements,
    foundation,
    prescribed_angles,
    crack
  };

  /** The subsection `Closed form` of a scene: what the models foundation,
   *  prescribed angles and crack need besides the other entries. */
  struct ClosedFormParameters
  {
    double pressure            = 0;    ///< p [MPa], 0: from the push-in
    double normal_stiffness    = 0;    ///< p / d [MPa/mm], 0: from the bulk
    double torsional_stiffness = 0;    ///< lambda [MPa/mm], 0: from the bulk
    double linear_limit        = 0.13; ///< theta_lin [deg]
    double full_sliding        = 1.13; ///< theta_slide [deg]
    double shear_modulus       = 40.4; ///< G [MPa]
    double adhesion_energy     = 22.2; ///< w_adh [N/m]
  };

  /** The subsection `Study`, for scenes whose entries hold several values. */
  struct StudyParameters
  {
    unsigned int reference_variant = 0; ///< 0: none
    unsigned int factors_at_once   = 0; ///< 0: all combinations
    unsigned int repetitions       = 1; ///< runs of each variant
  };

  /** The subsection `Output` of a scene. */
  struct OutputParameters
  {
    std::string                   directory    = "output/coin";
    static constexpr unsigned int usual_fields = -1;
    /** Planned steps, or rows, between VTU files; 0: none. */
    unsigned int fields_every = usual_fields;
    std::string  curve        = "auto"; ///< see CurveAxes
    CurveAxes    axes;                  ///< what it means in this scene
    std::string  reference_curve; ///< file with a measured curve, or empty
    std::vector<std::string> reference_columns;  ///< of it; empty: recognised
    std::string              reference_profiles; ///< a profiles.csv, or empty
    std::vector<double>      curve_at;           ///< angles [deg]
    std::vector<double>      motion_between;     ///< times; empty: first, last
    double full_sliding_angle = 0;               ///< [deg], 0: from the curve
    double observed_bonding   = 0;      ///< mean phi_0 of w_adh, 0: the scene's
    std::vector<double> profile_angles; ///< [deg]
    bool                friction_law_curve = false; ///< write friction_law.csv
    unsigned int        checkpoint_every = 0; ///< rows; 0: if interrupted only
    double              checkpoint_minutes = 5.;    ///< 0: no such checkpoints
    bool                quiet              = false; ///< warnings only
    bool                report             = true;  ///< write report.html
    /** Use a directory that holds results of another scene, or the checkpoint
     * of an interrupted run. No entry of the scene: the option --force of the
     *  program. */
    bool overwrite_other_results = false;
    /** Whether a run leaves a checkpoint when it is interrupted. No entry of
     *  the scene: false for runs that are part of a larger one. */
    bool resumable = true;
    /** Whether the state at the end is kept, so that the run can be extended to
     *  later times. No entry: false for variants. */
    bool extendable = true;
    /** Print a table of run times. No entry: the option --verbose. */
    bool timings = false;
  };

  /** What a user has to know, once; @p check names what has not been passed. */
  struct Warning
  {
    std::string check, text;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &check &text;
    }
  };



  /** Everything a `.prm` file says. A plain value: make one, copy it, change
   *  it, check() it, run it. One that nothing was said of is the paper's coin
   *  on bone, whose chuck does not move. */
  struct Scene : ModelParameters
  {
    std::string title;
    ModelKind   model = ModelKind::finite_elements;
    /** `Accuracy`, relative error that is asked for; 0: cells and steps are
     *  those of the scene. */
    double               accuracy = 0.;
    ClosedFormParameters closed_form;
    /** How far cells may be refined for the accuracy. */
    unsigned int     most_unknowns = 250000;
    double           most_minutes  = 30.;
    StudyParameters  study;
    OutputParameters output;

    /** The entries that the scene sets, and its name: where to look for a
     *  mistake. */
    std::vector<SceneEntry> entries;
    std::string             name;
    /** Those of them whose value is not the default. Empty for scenes that a
     *  study or an accuracy has made of another one, which need not read all
     *  entries. */
    std::vector<SceneEntry> changed_entries;
    /** Full names of those whose values were chosen for the accuracy, see
     *  numerics.cc; and notes them in completed_parameters, too. */
    std::vector<std::string> chosen;
    /** What is to be chosen: entries that the scene leaves at `auto`. */
    std::vector<SceneEntry>
    chosen_entries() const;
    /** Whether a closed form needs a stiffness that the scene does not say, but
     *  its bodies. */
    bool
    asks_bodies() const;
    /** Whether the implant is only pressed in a phase, which takes one step. */
    bool
    is_press(unsigned int phase) const;
    /** Whether the implant only turns about its axis and moves along it, and
     *  whether all else is round, too, and the same all around. */
    bool
    keeps_axis() const;
    /** `Output / Motion between', or the first time and the end, whenever a run
     *  ends: it may go on to further times. */
    std::vector<double>
    motion_times() const
    {
      return output.motion_between.empty() ?
               std::vector<double>{load_steps.times.front(), 1e300} :
               output.motion_between;
    }
    bool
    is_axisymmetric() const;
    /** Whether the interface, and not the bodies, says what the pressure is: it
     *  has no peak at the rim then. */
    bool
    has_soft_interface() const;
    void
    note_choices(const std::vector<std::string> &entries);

    /** An EntryError with the value of the entry and the place where it is set,
     *  or the name of the scene if it is not; other errors as they are. */
    InputError
    with_place(const InputError &error) const;

    /** All entries, completed with defaults, as a `.prm` text that gives the
     *  same scene again. Filled when the scene is read, or by complete(). */
    std::string completed_parameters;
    /** The same: values of default_entries(). */
    std::vector<std::string> values;

    /** All entries with their values. */
    std::vector<SceneEntry>
    completed_entries() const;

    /** Reads a file, then the overrides "Subsection/Entry=value" in order.
     *  Throws InputError with file, line, entry, value, what is allowed. */
    static Scene
    from_file(const std::string              &filename,
              const std::vector<std::string> &overrides = {});
    /** The same from entries; @p name stands for the file in messages. */
    static Scene
    from_entries(const std::vector<SceneEntry> &entries,
                 const std::string             &name);
    /** The same from a text; @p name stands for the file in messages. */
    static Scene
    from_text(const std::string              &text,
              const std::vector<std::string> &overrides = {},
              const std::string              &name      = "scene");

    void
    declare(EntryTable &table);
    /** Of that the entry `Accuracy`, and what bounds the cells for it. */
    void
    declare_accuracy(EntryTable &table);
    void
    declare_limits(EntryTable &table);

    /** Makes what entries stand for: the friction law, the modulus of the bone,
     *  and where the rim is. After entries have been set. Throws InputError. */
    void
    take_values();

    /** Fills completed_parameters of a scene that a program has made. */
    void
    complete();

    /** Refuses values that are not allowed, and what is allowed entry by entry
     *  but makes no sense together: throws EntryError. Done by from_file() and
     *  from_text(); for scenes that a program has made or changed. */
    void
    check() const;
    /** Of these, what the shapes of the two bodies need of each other. */
    void
    check_shapes() const;

    /** Refuses scenes of ranks that are to solve one together, and have
     *  different ones. Collective; done by all that runs a scene. */
    void
    require_same_on_all_ranks() const;

    /** What is allowed, but has made results worse than they looked, or is
     *  likely to be a slip of the pen. */
    std::vector<Warning>
    warnings() const;

    /** Whether it sets an entry, and not to nothing. */
    bool
    sets(const std::string &full_name) const;
    /** Refuses a scene that reads entries without default and does not set
     *  them: throws InputError with the lines that it lacks. */
    void
    require_physics() const;
  };

  /** All entries, their units, and the values of a scene that nothing was said
   *  of. */
  const EntryTable &
  default_entries();

  /** Writes all entries with documentation, what they allow and their values:
   *  those of @p scene, or the defaults without one. */
  void
  print_parameters(std::ostream &out, const Scene *scene = nullptr);

  /** What would read an entry that nothing reads in the scene; else nothing. */
  std::string
  lacking_reader(const Scene &scene, const std::string &full_name);

  /** Warnings of entries that were set, and that nothing reads in the scene. */
  std::vector<Warning>
  unread_entries(const Scene &scene);
} // namespace Debond
