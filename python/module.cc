// The module _debond: what debond.py needs of the library. Numbers go to NumPy,
// everything else is text; what is convenient in Python is written in Python.

#include "module.h"

#include <debond/input/expression_parser.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/varying_curve.h>
#include <debond/output/curve_comparison.h>
#include <debond/output/result_files.h>
#include <debond/scene/finer_scenes.h>
#include <debond/support/input_error.h>
#include <debond/support/provenance.h>
#include <debond/support/runtime.h>
#include <debond/system/memory_estimate.h>

#include <nlohmann/json.hpp>
#include <pybind11/functional.h>

py::dict
arrays(const Columns &columns)
{
  py::dict result;
  for (const auto &[name, values] : columns)
    result[name.c_str()] = py::array_t<double>(values.size(), values.data());
  return result;
}



py::dict
arrays(const std::vector<TorqueRow> &rows)
{
  Columns columns;
  for (TorqueRow row : rows)
    row.for_each_column([&](const std::string &name, const double value) {
      columns[name].push_back(value);
    });
  return arrays(columns);
}



/** What summary.json says of a curve. */
std::string
measures(const Scene                  &scene,
         const std::vector<TorqueRow> &rows,
         CurveSettings                 settings)
{
  settings.take(scene.output,
                read_reference_curve(scene.output.reference_curve,
                                     scene.output.reference_columns,
                                     scene.output.axes));
  return measure_torque_curve(rows, settings).dump();
}



std::vector<std::string>
texts_of(const std::vector<Warning> &warnings)
{
  std::vector<std::string> texts;
  for (const Warning &warning : warnings)
    texts.push_back(warning.text);
  return texts;
}



namespace
{
  using Texts = std::map<std::string, std::string>; ///< by full names
  using Curve = std::array<std::vector<double>, 2>; ///< angles, torques



  ReferenceCurve
  points_of(const Curve &columns)
  {
    ReferenceCurve curve;
    for (std::size_t i = 0; i < columns[0].size(); ++i)
      curve.emplace_back(columns[0][i], columns[1].at(i));
    return curve;
  }



  /** What a script says it has said itself: no "--set" in messages, but those
   *  of a command line. */
  std::vector<SceneEntry>
  changed(std::vector<SceneEntry>         entries,
          const std::vector<std::string> &overrides,
          const std::string              &place)
  {
    entries = with_overrides(std::move(entries), overrides);
    for (SceneEntry &entry : entries)
      if (entry.place == "--set")
        entry.place = place;
    return entries;
  }

  /** Entries with other values, in the places where they stand. */
  std::vector<SceneEntry>
  with_values(std::vector<SceneEntry> entries, const Texts &values)
  {
    for (SceneEntry &entry : entries)
      if (const auto value = values.find(entry.full_name());
          value != values.end())
        entry.value = value->second;
    return entries;
  }



  void
  run_into_directory(Scene scene, const bool force, const Team &team)
  {
    const py::gil_scoped_release others_go_on;
    scene.output.overwrite_other_results = force;
    work_together(team.pointer, [&] { run_scene(scene); });
  }



  using Changes = std::vector<std::pair<std::string, std::string>>;

  /** Full names and values, as a scene has them. */
  std::vector<SceneEntry>
  entries_of(const Changes &changes)
  {
    std::vector<SceneEntry> entries;
    for (const auto &[name, value] : changes)
      {
        entries.push_back(read_override(name + "=" + value));
        entries.back().place.clear();
      }
    return entries;
  }



  /** What a scene prescribes of its chuck at these times, by column of
   *  torque.csv. */
  py::dict
  prescribed(const Scene &scene, const std::vector<double> &times)
  {
    const Chuck chuck(scene.chuck,
                      Eigen::Vector3d::Zero(),
                      scene.implant.characteristic_radius());
    Columns     columns;
    for (const double time : times)
      {
        const auto values = chuck.values(time);
        for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
          if (!scene.chuck.component[k].loaded)
            columns[ChuckParameters::column_name(k, false)].push_back(
              values[k] * (is_rotation(k) ? 180. / M_PI : 1.));
      }
    return arrays(columns);
  }



  /** Rows and summary. */
  std::pair<py::dict, std::string>
  closed_form(const Scene &scene, const Team &team)
  {
    const auto solution = work_together(team.pointer, [&] {
      const py::gil_scoped_release others_go_on;
      scene.require_same_on_all_ranks();
      try
        {
          return ClosedFormSolution(scene);
        }
      catch (const InputError &error)
        {
          throw scene.with_place(error);
        }
    });
    return {arrays(solution.rows),
            measures(scene, solution.rows, solution.curve_settings())};
  }



  /** The library's errors as those of debond.py, whose classes it gives. */
  void
  translate(std::exception_ptr pointer)
  {
    const auto raise = [](const char *const type, const std::string &message) {
      PyErr_SetString(
        py::object(py::module_::import("debond").attr(type)).ptr(),
        message.c_str());
    };
    try
      {
        std::rethrow_exception(pointer);
      }
    catch (const EntryError &error)
      {
        const py::object type =
          py::module_::import("debond").attr("SceneError");
        py::object value    = type(error.what());
        value.attr("entry") = error.entry;
        value.attr("value") = error.value;
        value.attr("place") = error.place;
        PyErr_SetObject(type.ptr(), value.ptr());
      }
    catch (const InputError &error)
      {
        raise("SceneError", error.what());
      }
    catch (const Interrupted &error)
      {
        PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
      }
    catch (const RunError &error)
      {
        raise("RunError", error.what());
      }
  }



  void
  bind_scenes(py::module_ &module)
  {
    py::class_<SceneEntry>(module, "Entry")
      .def_property_readonly("name", &SceneEntry::full_name)
      .def_readonly("value", &SceneEntry::value)
      .def_readonly("place", &SceneEntry::place)
      .def("refuse", &SceneEntry::refuse)
      .def(py::pickle(
        [](const SceneEntry &e) {
          return py::make_tuple(e.subsections, e.name, e.value, e.place);
        },
        [](const py::tuple &e) {
          return SceneEntry{e[0].cast<std::vector<std::string>>(),
                            e[1].cast<std::string>(),
                            e[2].cast<std::string>(),
                            e[3].cast<std::string>()};
        }));
    module.def("read_file", read_scene_file);
    module.def("read_text", read_scene_text);
    module.def("changed",
               changed,
               py::arg("entries"),
               py::arg("overrides"),
               py::arg("place") = "entries");
    module.def("with_values", with_values);
    module.def("text_of", [](const std::vector<SceneEntry> &entries) {
      return scene_text(entries);
    });
    module.def("expression",
               [](const std::string &names, const std::string &text)
                 -> Expression { return read_expression(names, text, 0.); });
    py::class_<Team>(module, "Team")
      .def(py::init<std::uintptr_t>())
      .def("gather", &Team::gather);
    py::class_<Scene>(module, "Scene")
      .def(py::init([](const std::vector<SceneEntry> &entries,
                       const std::string             &name,
                       const Team                    &team) {
        const py::gil_scoped_release others_go_on;
        const Ranks::Together        together(team.pointer);
        Scene                        scene;
        Ranks::in_agreement(
          [&] { scene = Scene::from_entries(entries, name); });
        return scene;
      }))
      .def_readonly("parameters", &Scene::completed_parameters)
      .def("prescribed", prescribed)
      .def_property_readonly("values",
                             [](const Scene &s) {
                               Texts values;
                               for (const SceneEntry &entry :
                                    s.completed_entries())
                                 values[entry.full_name()] = entry.value;
                               return values;
                             })
      .def_property_readonly("finer", finer_scene) // None if it sets its cells
      .def_property_readonly("n_unknowns",
                             [](const Scene &s) { return n_unknowns_of(s); })
      .def_property_readonly("sample_times",
                             [](const Scene &s) {
                               return s.load_steps.sample_times();
                             })
      .def("refuse",
           [](const Scene &s, const std::string &name, const std::string &why) {
             throw s.with_place(EntryError(name, why));
           })
      .def_property_readonly("curve",
                             [](const Scene &s) {
                               return std::pair(s.output.axes.position_column(),
                                                s.output.axes.load_column());
                             })
      .def_property_readonly("warnings", [](const Scene &s) {
        return texts_of(s.warnings());
      });
  }



  /** What fits take of the library. */
  void
  bind_curves(py::module_ &module)
  {
    py::class_<CurveComparison>(module, "CurveComparison")
      .def(py::init([](const Curve       &computed,
                       const Curve       &measured,
                       const std::string &over,
                       const std::string &load) {
             const auto axes = CurveAxes::of_columns(over, load);
             return CurveComparison(points_of(computed),
                                    points_of(measured),
                                    axes ? *axes : CurveAxes());
           }),
           py::arg("computed"),
           py::arg("measured"),
           py::arg("over") = "angle_deg",
           py::arg("load") = "torque_Nmm")
      .def_property_readonly_static("opposite_sign",
                                    [](const py::object &) {
                                      return CurveComparison::opposite_sign();
                                    })
      .def_readonly("rows_used", &CurveComparison::rows_used)
      .def_readonly("e_mp", &CurveComparison::e_mp)
      .def_readonly("e_rel", &CurveComparison::e_rel)
      .def_readonly("difference_mean", &CurveComparison::difference_mean)
      .def_readonly("difference_max", &CurveComparison::difference_max)
      .def_readonly("position_of_max", &CurveComparison::position_of_max)
      .def_readonly("remarks", &CurveComparison::remarks)
      .def_readonly("why_none", &CurveComparison::why_none)
      .def("text", &CurveComparison::text);
    using Free = py::call_guard<py::gil_scoped_release>;
    py::class_<VaryingCurve>(module, "VaryingCurve")
      .def(py::init<const std::vector<SceneEntry> &, const std::string &>(),
           Free())
      .def_property_readonly("why_no_closed_form",
                             &VaryingCurve::why_no_closed_form)
      .def("check",
           [](VaryingCurve &curve, const Changes &changes) {
             curve.check(entries_of(changes));
           })
      .def(
        "compliance_of_bodies",
        [](VaryingCurve &curve, const Changes &changes) {
          return curve.compliance_of_bodies(entries_of(changes));
        },
        Free())
      .def(
        "steps_of",
        [](VaryingCurve &curve, const Changes &changes) {
          return curve.steps_of(entries_of(changes));
        },
        Free())
      .def("by_foundation",
           [](VaryingCurve                &curve,
              const Changes               &changes,
              const std::array<double, 2> &compliance,
              const std::vector<double>   &angles) {
             const auto [torque, force] =
               curve.by_foundation(entries_of(changes), compliance, angles);
             return std::make_pair(py::array_t<double>(torque.size(),
                                                       torque.data()),
                                   force);
           })
      .def("by_scene",
           [](VaryingCurve                           &curve,
              const Changes                          &changes,
              const std::vector<std::vector<double>> &steps) {
             std::vector<TorqueRow> rows;
             {
               const py::gil_scoped_release others_go_on;
               rows = curve.by_scene(entries_of(changes), steps);
             }
             return arrays(rows);
           });
  }
} // namespace



PYBIND11_MODULE(_debond, module)
{
  set_up_libraries();
  module.attr("version") = DEBOND_VERSION;
  char mpi_library[MPI_MAX_LIBRARY_VERSION_STRING];
  int  length = 0;
  MPI_Get_library_version(mpi_library, &length);
  module.attr("mpi_library") = std::string(mpi_library, length);
  py::register_exception_translator(translate);
  py::list columns; // of the chuck: position, load, their units, component
  for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
    columns.append(py::make_tuple(ChuckParameters::column_name(k, false),
                                  ChuckParameters::column_name(k, true),
                                  is_rotation(k) ? "deg" : "mm",
                                  is_rotation(k) ? "N mm" : "N",
                                  k));
  module.attr("chuck_columns") = columns;

  bind_scenes(module);
  bind_curves(module);
  bind_simulation(module);
  bind_studies(module);
  module.def("unit_of", [](const std::string &name) {
    return default_entries().unit_of(name);
  });
  module.def("closed_form", closed_form);
  module.def("provenance", [] {
    Texts texts;
    for (const auto &[name, text] : provenance())
      texts[name] = text;
    return texts;
  });
  py::class_<ResultDirectory>(module, "ResultDirectory");
  module.def("claim_directory",
             [](const Scene &scene, const std::string &text, const bool force) {
               OutputParameters output        = scene.output;
               output.overwrite_other_results = force;
               return ResultDirectory(output, text);
             });
  module.def("run_into_directory", run_into_directory);
  module.def("set_number_of_threads", set_number_of_threads);
}
