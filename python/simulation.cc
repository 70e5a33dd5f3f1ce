#include <debond/input/allowed_values.h>
#include <debond/output/body_points.h>
#include <debond/output/profile_output.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/serialization.h>

#include <pybind11/eigen.h>

#include <algorithm>
#include <sstream>

#include "module.h"

namespace
{
  using Values = std::map<std::string, double>;



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
      if (driven.count("Press") > 0 && driven.count("Translation z") > 0)
        throw InputError("Press and Translation z are one motion, with "
                         "opposite signs: expected one of them to be driven");
      for (const auto &[name, value] : driven)
        {
          const unsigned int k = component(name);
          if (!scene.load_steps.rows_are_planned())
            throw EntryError("Load steps / Adaptive",
                             "rows whose chuck a script drives are planned "
                             "ones: expected false, and no path to follow");
          auto drive   = std::make_shared<Drive>();
          drive->begin = drive->end = scene.load_steps.times.front();
          drive->from = drive->to            = value;
          drives[name]                       = drive;
          scene.chuck.component[k].into_bone = name == "Press";
          scene.chuck.component[k].function  = [drive](const double time) {
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
      require_a_row();
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
      const auto names = split_list(interface_columns);
      Columns    columns;
      for (const auto &point : profile_points(simulation->system().interface))
        for (unsigned int i = 0; i < names.size(); ++i)
          columns[names[i]].push_back(point[i]);
      return arrays(columns);
    }

    /** Displacements (3 x n) and stresses (9 x n). */
    std::pair<Eigen::Matrix3Xd, Eigen::MatrixXd>
    bulk(const bool of_implant, const Eigen::Matrix3Xd &X) const
    {
      require_a_row();
      const auto           &system = simulation->system();
      const Eigen::MatrixXd values =
        values_at_points(*system.body[of_implant], system.chuck, X);
      return {values.topRows<3>(), values.bottomRows<9>()};
    }

    /** The state, for a simulation of the same scene. */
    py::bytes
    save() const
    {
      std::string state, version = DEBOND_VERSION,
                         parameters = simulation->scene.completed_parameters;
      SavingArchive                  archive(state);
      archive &version &parameters &*simulation;
      for (const auto &[name, drive] : drives)
        archive &*drive;
      return state;
    }

    void
    restore(const std::string &state)
    {
      const std::string wrong =
        "this is no state of this scene that debond " DEBOND_VERSION
        " has saved: expected what save() of a simulation of the same scene "
        "gave";
      std::string    version, parameters;
      LoadingArchive archive(state);
      try
        {
          archive &version &parameters;
        }
      catch (const std::length_error &)
        {
          throw InputError(wrong);
        }
      if (version != DEBOND_VERSION ||
          parameters != simulation->scene.completed_parameters)
        throw InputError(wrong);
      archive &*simulation;
      for (auto &[name, drive] : drives)
        archive &*drive;
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
    void
    require_a_row() const
    {
      if (simulation->rows().empty())
        throw InputError("there is no row yet: advance() or run() first");
    }

    static unsigned int
    component(const std::string &name)
    {
      if (name == "Press")
        return ChuckComponent::translation_z;
      const auto &names = ChuckParameters::names;
      const auto  found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        throw InputError("the chuck has no component '" + name +
                         "': expected Press, Translation x, "
                         "Translation y, Translation z, Rotation x, Rotation y "
                         "or Rotation z");
      return found - names.begin();
    }

    std::vector<double>                           times; ///< of all rows
    std::map<std::string, std::shared_ptr<Drive>> drives;
  };
} // namespace



void
bind_simulation(py::module_ &module)
{
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
}
