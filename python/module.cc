// The module _debond: what debond.py needs of the library. Numbers go to NumPy,
// everything else is text; what is convenient in Python is written in Python.

#include <debond/campaigns/run_scene.h>
#include <debond/input/expression_parser.h>
#include <debond/input/parameter_loop.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/simulation.h>
#include <debond/models/varying_curve.h>
#include <debond/output/body_points.h>
#include <debond/output/curve_comparison.h>
#include <debond/output/profile_output.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/number_text.h>
#include <debond/support/provenance.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/support/serialization.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <nlohmann/json.hpp>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <sstream>

namespace py = pybind11;
using namespace Debond;

namespace
{
  using Columns = std::map<std::string, std::vector<double>>;
  using Values  = std::map<std::string, double>;
  using Texts   = std::map<std::string, std::string>; ///< by full names
  using Curve   = std::array<std::vector<double>, 2>; ///< angles, torques



  /** The processes that solve together: those of a communicator whose handle is
   *  at @p address, which may be freed afterwards; 0: this one alone. */
  struct Team
  {
    explicit Team(const std::uintptr_t address)
    {
      const py::gil_scoped_release others_go_on;
      if (address != 0)
        pointer =
          Ranks::make_team(*reinterpret_cast<const MPI_Comm *>(address));
    }

    /** What each of them says. Collective. */
    std::vector<std::string>
    gather(const std::string &text) const
    {
      const py::gil_scoped_release others_go_on;
      const Ranks::Together        together(pointer);
      return Ranks::number() == 1 ?
               std::vector<std::string>{text} :
               dealii::Utilities::MPI::all_gather(Ranks::communicator(), text);
    }

    Ranks::TeamPointer pointer;
  };



  /** Does what all processes of a team do together. What is wrong with a scene
   *  or a run is met by all of them, and looking on ends it for all. What one
   *  meets alone, such as a lack of memory, the others wait for in vain, so
   *  that it ends all, as in the program. */
  template <typename Work>
  auto
  work_together(const Ranks::TeamPointer &team, const Work &work)
  {
    const Ranks::Together together(team);
    try
      {
        return work();
      }
    catch (const std::exception &error)
      {
        const bool of_python =
          dynamic_cast<const py::error_already_set *>(&error) != nullptr;
        if (Ranks::number() > 1 && !of_python && !is_of_all_ranks(error))
          {
            std::cerr << "debond: rank " << Ranks::own() << ": " << error.what()
                      << "; all that it works with end" << std::endl;
            Ranks::end_all(2);
          }
        throw;
      }
  }



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



  ReferenceCurve
  curve_of(const Curve &columns)
  {
    ReferenceCurve curve;
    for (std::size_t i = 0; i < columns[0].size(); ++i)
      curve.emplace_back(columns[0][i], columns[1].at(i));
    return curve;
  }



  /** What summary.json says of a curve. */
  std::string
  measures(const Scene                  &scene,
           const std::vector<TorqueRow> &rows,
           CurveSettings                 settings)
  {
    settings.take(scene.output,
                  read_reference_curve(scene.output.reference_curve,
                                       scene.output.reference_columns));
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



  /** Value of a component of the chuck that a script drives: from row to row
   *  along a straight line. */
  struct Drive
  {
    double begin = 0, end = 0, from = 0, to = 0; ///< times, values

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &begin &end &from &to;
    }

    double
    operator()(const double time) const
    {
      if (time >= end)
        return to;
      return time <= begin ?
               from :
               from + (time - begin) / (end - begin) * (to - from);
    }
  };



  /** A simulation and what a script does to it. While it computes other threads
   *  of Python go on. */
  class Run
  {
  public:
    Run(Scene scene, const std::map<std::string, double> &driven)
    {
      for (const auto &[name, value] : driven)
        {
          const unsigned int k = component(name);
          if (!scene.load_steps.rows_are_planned())
            throw EntryError("Load steps / Adaptive",
                             "rows whose chuck a script drives are planned "
                             "ones: expected false, and no path to follow");
          auto drive   = std::make_shared<Drive>();
          drive->begin = drive->end = scene.load_steps.times.front();
          drive->from = drive->to           = value;
          drives[name]                      = drive;
          scene.chuck.component[k].function = [drive](const double time) {
            return (*drive)(time);
          };
        }
      times = scene.load_steps.planned_times();
      const py::gil_scoped_release others_go_on;
      simulation = std::make_unique<Simulation>(scene);
    }

    void
    advance(const std::map<std::string, double> &values)
    {
      if (simulation->is_finished())
        throw InputError("the simulation is finished: there is no row left");
      for (const auto &[name, value] : values)
        if (drives.count(name) == 0)
          throw InputError("'" + name +
                           "' is not driven: name it when the simulation is "
                           "made, Simulation(scene, drive={'" +
                           name + "': 0})");
      const std::size_t            next = simulation->rows().size();
      std::map<std::string, Drive> of_last_row;
      for (auto &[name, drive] : drives)
        {
          of_last_row[name] = *drive;
          if (next == 0)
            continue; // at the first time it is where it was placed
          const auto value = values.find(name);
          *drive           = {times[next - 1],
                              times[next],
                              drive->to,
                    value == values.end() ? drive->to : value->second};
        }
      try
        {
          const py::gil_scoped_release others_go_on;
          simulation->advance();
        }
      catch (...)
        {
          if (simulation->rows().size() == next)
            for (auto &[name, drive] : drives)
              *drive = of_last_row[name];
          throw;
        }
    }

    void
    run(const py::object &on_row)
    {
      const boost::signals2::scoped_connection looks_on =
        simulation->signals.row.connect([&](const TorqueRow &) {
          const py::gil_scoped_acquire python;
          if (PyErr_CheckSignals() != 0)
            throw py::error_already_set();
          if (!on_row.is_none())
            on_row();
        });
      const py::gil_scoped_release others_go_on;
      simulation->run();
    }

    py::dict
    last_row() const
    {
      if (simulation->rows().empty())
        throw InputError("there is no row yet: advance() or run() first");
      py::dict result;
      TorqueRow(simulation->rows().back())
        .for_each_column([&](const std::string &name, const double value) {
          result[name.c_str()] = value;
        });
      return result;
    }

    py::dict
    points() const
    {
      constexpr auto    n        = std::tuple_size<InterfacePoint>::value;
      const char *const names[n] = {"x_mm",
                                    "y_mm",
                                    "r_mm",
                                    "pressure_MPa",
                                    "traction_MPa",
                                    "slip_mm",
                                    "phi",
                                    "mu",
                                    "state",
                                    "area_mm2"};
      Columns           columns;
      for (const auto &point : profile_points(simulation->system().interface))
        for (unsigned int i = 0; i < n; ++i)
          columns[names[i]].push_back(point[i]);
      return arrays(columns);
    }

    /** Displacements (3 x n) and stresses (9 x n). */
    std::pair<Eigen::Matrix3Xd, Eigen::MatrixXd>
    bulk(const bool of_implant, const Eigen::Matrix3Xd &X) const
    {
      const auto      &system = simulation->system();
      const BodyPoints at(*system.body[of_implant], system.chuck, X);
      Eigen::MatrixXd  stress(9, X.cols());
      for (unsigned int p = 0; p < X.cols(); ++p)
        stress.col(p) =
          Eigen::Map<const Eigen::Matrix<double, 9, 1>>(at.stress[p].data());
      return {at.displacement, stress};
    }

    /** The state, for a simulation of the same scene. */
    py::bytes
    save() const
    {
      Classic<std::ostringstream>     bytes(std::ios::binary);
      boost::archive::binary_oarchive archive(bytes);
      archive << std::string(DEBOND_VERSION)
              << simulation->scene.completed_parameters << *simulation;
      for (const auto &[name, drive] : drives)
        archive << *drive;
      return bytes.str();
    }

    void
    restore(const std::string &state)
    {
      const std::string wrong =
        "this is no state of this scene that debond " DEBOND_VERSION
        " has saved: expected what save() of a simulation of the same scene "
        "gave";
      Classic<std::istringstream> bytes(state, std::ios::binary);
      std::string                 version, parameters;
      std::unique_ptr<boost::archive::binary_iarchive> archive;
      try
        {
          archive = std::make_unique<boost::archive::binary_iarchive>(bytes);
          *archive >> version >> parameters;
        }
      catch (const std::exception &) // lengths that make no sense, too
        {
          throw InputError(wrong);
        }
      if (version != DEBOND_VERSION ||
          parameters != simulation->scene.completed_parameters)
        throw InputError(wrong);
      *archive >> *simulation;
      for (auto &[name, drive] : drives)
        *archive >> *drive;
    }

    std::string
    summary() const
    {
      return measures(simulation->scene,
                      simulation->rows(),
                      simulation->curve_settings());
    }

    const Ranks::TeamPointer    team = Ranks::team();
    std::unique_ptr<Simulation> simulation;

  private:
    static unsigned int
    component(const std::string &name)
    {
      const auto &names = ChuckParameters::names;
      const auto  found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        throw InputError("the chuck has no component '" + name +
                         "': expected Translation x, Translation y, "
                         "Translation z, Rotation x, Rotation y or Rotation z");
      return found - names.begin();
    }

    std::vector<double>                           times; ///< of all rows
    std::map<std::string, std::shared_ptr<Drive>> drives;
  };



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



  /** Of a study or of the experiments of a calibration: entries, and full
   *  names of those that hold several values. */
  std::vector<std::pair<std::vector<SceneEntry>, std::vector<std::string>>>
  variants(const std::vector<SceneEntry> &entries)
  {
    std::vector<std::pair<std::vector<SceneEntry>, std::vector<std::string>>>
      result;
    for (const StudyVariant &variant : study_variants(entries))
      {
        result.emplace_back(variant.entries, std::vector<std::string>());
        for (const std::size_t i : variant.varied)
          result.back().second.push_back(variant.entries[i].full_name());
      }
    return result;
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

  py::class_<SceneEntry>(module, "Entry")
    .def_property_readonly("name", &SceneEntry::full_name)
    .def_readonly("value", &SceneEntry::value)
    .def_readonly("place", &SceneEntry::place)
    .def("refuse", &SceneEntry::refuse);
  module.def("read_file", read_scene_file);
  module.def("read_text", read_scene_text);
  module.def("changed",
             changed,
             py::arg("entries"),
             py::arg("overrides"),
             py::arg("place") = "entries");
  module.def("with_values", with_values);
  module.def("text_of", scene_text);
  module.def("variants", variants);
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
      Ranks::in_agreement([&] { scene = Scene::from_entries(entries, name); });
      return scene;
    }))
    .def_readonly("parameters", &Scene::completed_parameters)
    .def("prescribed", prescribed)
    .def_property_readonly("values",
                           [](const Scene &s) {
                             Texts values;
                             for (const SceneEntry &entry :
                                  read_scene_text(s.completed_parameters, ""))
                               values[entry.full_name()] = entry.value;
                             return values;
                           })
    .def_property_readonly("sample_times",
                           [](const Scene &s) {
                             return s.load_steps.sample_times();
                           })
    .def("refuse",
         [](const Scene &s, const std::string &name, const std::string &why) {
           throw s.with_place(EntryError(name, why));
         })
    .def_property_readonly("warnings", [](const Scene &s) {
      return texts_of(s.warnings());
    });
  py::class_<CurveComparison>(module, "CurveComparison")
    .def(py::init([](const Curve &computed, const Curve &measured) {
      return CurveComparison(curve_of(computed), curve_of(measured));
    }))
    .def_readonly("rows_used", &CurveComparison::rows_used)
    .def_readonly("e_mp", &CurveComparison::e_mp)
    .def_readonly("e_rel", &CurveComparison::e_rel)
    .def_readonly("difference_mean", &CurveComparison::difference_mean)
    .def_readonly("difference_max", &CurveComparison::difference_max)
    .def_readonly("angle_of_max_deg", &CurveComparison::angle_of_max_deg)
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
           const auto found =
             curve.by_foundation(entries_of(changes), compliance, angles);
           return std::make_pair(py::array_t<double>(found.torque.size(),
                                                     found.torque.data()),
                                 found.force);
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
  py::class_<Run>(module, "Run")
    .def(
      py::init([](const Scene &scene, const Values &driven, const Team &team) {
        return work_together(team.pointer, [&] {
          return std::make_unique<Run>(scene, driven);
        });
      }))
    .def("advance",
         [](Run &run, const Values &values) {
           work_together(run.team, [&] { run.advance(values); });
         })
    .def("run",
         [](Run &run, const py::object &on_row) {
           work_together(run.team, [&] { run.run(on_row); });
         })
    .def("save", &Run::save)
    .def("restore", &Run::restore)
    .def("last_row", &Run::last_row)
    .def("points", &Run::points)
    .def("bulk",
         [](const Run &run, const bool of_implant, const Eigen::Matrix3Xd &X) {
           return work_together(run.team, [&] {
             const py::gil_scoped_release others_go_on;
             return run.bulk(of_implant, X);
           });
         })
    .def("summary", &Run::summary)
    .def("rows", [](const Run &run) { return arrays(run.simulation->rows()); })
    .def_property_readonly("is_finished",
                           [](const Run &run) {
                             return run.simulation->is_finished();
                           })
    .def_property_readonly("warnings", [](const Run &run) {
      return texts_of(run.simulation->warnings());
    });
  module.def("unit_of", [](const std::string &name) {
    struct Entries // of all of them, made once
    {
      Entries()
      {
        scene.declare(table);
      }

      Scene      scene;
      EntryTable table;
    };
    static const Entries entries;
    return entries.table.unit_of(name);
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
