#ifndef debond_scene_h
#define debond_scene_h

#include <debond/body_parameters.h>
#include <debond/chuck.h>
#include <debond/contact_interface.h>
#include <debond/input_error.h>
#include <debond/load_stepping.h>
#include <debond/result_files.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Debond
{
  /** Everything a `.prm` file says. A plain value: copy it, change it, run it.
   */
  struct Scene
  {
    std::string            title;
    BodyParameters         bone;
    BodyParameters         implant;
    InterfaceParameters    interface;
    ChuckParameters        chuck;
    LoadSteppingParameters load_steps;
    OutputParameters       output;

    /** All entries, completed with defaults, as a `.prm` text that gives the
     *  same scene again. Filled when the scene is read. */
    std::string completed_parameters;

    /** Reads a file, then the overrides "Subsection/Entry=value" in order.
     *  Throws InputError with file, line, entry, value, what is allowed. */
    static Scene
    from_file(const std::string              &filename,
              const std::vector<std::string> &overrides = {});
    /** The same from a text; @p name stands for the file in messages. */
    static Scene
    from_text(const std::string              &text,
              const std::vector<std::string> &overrides = {},
              const std::string              &name      = "scene");

    static void
    declare(dealii::ParameterHandler &prm);
    void
    parse(dealii::ParameterHandler &prm);

    /** Refuses what is allowed entry by entry but makes no sense together:
     *  throws InputError whose message begins with the name of the entry. Done
     *  by from_file() and from_text(); for scenes that a program changes. */
    void
    check() const;
  };

  /** Writes all entries with documentation, what they allow and their values:
   *  those of @p scene, or the defaults without one. */
  void
  print_parameters(std::ostream &out, const Scene *scene = nullptr);
} // namespace Debond
#endif
