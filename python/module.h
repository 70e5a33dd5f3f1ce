#pragma once

// What the parts of the module _debond share.

#include <debond/campaigns/run_scene.h>
#include <debond/models/simulation.h>
#include <debond/support/ranks.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace py = pybind11;
using namespace Debond;

using Columns = std::map<std::string, std::vector<double>>;

/** The processes that solve together: those of a communicator whose handle is
 *  at @p address, which may be freed afterwards; 0: this one alone. */
struct Team
{
  explicit Team(const std::uintptr_t address)
  {
    const py::gil_scoped_release others_go_on;
    if (address != 0)
      pointer = Ranks::make_team(*reinterpret_cast<const MPI_Comm *>(address));
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
      if (!of_python && !Ranks::all_meet(std::current_exception()))
        {
          std::cerr << "debond: rank " << Ranks::own() << ": " << error.what()
                    << "; all that it works with end" << std::endl;
          Ranks::end_all(2);
        }
      throw;
    }
}



py::dict
arrays(const Columns &columns);
py::dict
arrays(const std::vector<TorqueRow> &rows);
/** What summary.json says of a curve. */
std::string
measures(const Scene                  &scene,
         const std::vector<TorqueRow> &rows,
         CurveSettings                 settings);
std::vector<std::string>
texts_of(const std::vector<Warning> &warnings);

/** The classes of a simulation that goes on row by row. */
void
bind_simulation(py::module_ &module);
/** What studies need. */
void
bind_studies(py::module_ &module);
