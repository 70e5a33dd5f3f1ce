// What debond.study needs of the library: variants that run as processes of
// their own, and what is known of their directories.

#include <debond/campaigns/run_scene.h>
#include <debond/output/curve_comparison.h>
#include <debond/output/profile_output.h>
#include <debond/output/reference_comparison.h>
#include <debond/output/result_files.h>
#include <debond/scene/finer_scenes.h>
#include <debond/support/interruption.h>
#include <debond/support/number_text.h>
#include <debond/support/progress.h>
#include <debond/support/provenance.h>
#include <debond/system/coupled_system.h>
#include <debond/system/memory_estimate.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <sstream>

#include "module.h"

namespace
{
  using Free = py::call_guard<py::gil_scoped_release>;



  /** Warnings about the reference of a scene. Throws InputError if a closed
   *  form that it asks for does not apply. */
  std::vector<std::string>
  check_variant(const Scene &scene)
  {
    Classic<std::ostringstream> none;
    if (scene.model != ModelKind::finite_elements)
      run_scene(scene, nullptr, &none);
    return doubts_of_reference(scene);
  }



  /** Members of a summary that say how far the results in @p directory are from
   *  those in @p other; without a directory all of them undefined. */
  std::string
  distances(const Scene       &scene,
            const std::string &directory,
            const std::string &other)
  {
    const CurveAxes       &axes   = scene.output.axes;
    nlohmann::ordered_json result = CurveComparison().members();
    result.update(compare_profiles({}, {}));
    if (directory.empty())
      return result.dump();
    result.update(
      CurveComparison(read_reference_curve(finest_curve(directory), {}, axes),
                      read_reference_curve(finest_curve(other), {}, axes),
                      axes)
        .members());
    const std::string own       = directory + "/profiles.csv",
                      reference = other + "/profiles.csv";
    if (std::filesystem::exists(own) && std::filesystem::exists(reference))
      result.update(
        compare_profiles(read_profiles(own), read_profiles(reference)));
    return result.dump();
  }



  /** No other process can write to the directory while it lives. */
  struct Locked
  {
    explicit Locked(const std::string &directory)
      : lock(lock_directory(directory))
    {}

    DirectoryLock lock;
  };



  /** Shows the line of a terminal, if standard output is one. */
  struct Shown
  {
    explicit Shown(const bool is_terminal)
    {
      if (is_terminal)
        show_progress_on_terminal();
    }

    Progress progress;
  };
} // namespace



void
bind_studies(py::module_ &module)
{
  module.attr("program")       = program_and_version();
  module.attr("out_of_memory") = std::string("debond: ") + out_of_memory;
  module.def("note_command", [](const std::vector<std::string> &words) {
    std::vector<const char *> pointers;
    for (const std::string &word : words)
      pointers.push_back(word.c_str());
    note_command(pointers.size(), pointers.data());
  });
  module.def("check_variant", check_variant);
  module.def("parameters_in", parameters_in);
  module.def("is_same_scene", is_same_scene);
  module.def("json_in", [](const std::string &filename) {
    return read_json(filename).dump();
  });
  module.def("has_other_references", [](const Scene &scene) {
    return has_other_references(scene.output,
                                read_json(scene.output.directory +
                                          "/summary.json"));
  });
  module.def("compare_anew", [](const Scene &scene) {
    compare_anew_if_changed(scene.output, scene.output.directory);
  });
  module.def("distances", distances);
  py::class_<Locked>(module, "DirectoryLock").def(py::init<std::string>());
  py::class_<BodyPair, std::shared_ptr<BodyPair>>(module, "Bodies");
  module.def("what_bodies_depend_on", what_bodies_depend_on);
  module.def("condensed_bodies", condensed_bodies, Free());
  module.def("run_variant", run_variant, Free());
  module.def("catch_interruptions", catch_interruptions);
  module.def("leave_interruptions_to_parent", leave_interruptions_to_parent);
  module.def("interrupting_signal", interrupting_signal);
  module.def("interruption_descriptor", interruption_descriptor);
  py::class_<Shown>(module, "Progress")
    .def(py::init<bool>())
    .def("show",
         [](Shown &shown, const std::string &what, const double fraction) {
           shown.progress.show(what, fraction);
         })
    .def("hide", [](Shown &) { hide_progress(); });
}
