#pragma once

#include <debond/output/console.h>
#include <debond/output/interface_tables.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>
#include <vector>

namespace Debond
{
  /** What runs leave of their rows, whatever the model: torque.csv or
   *  reactions.csv, profiles, lines on the console and, at the end,
   *  summary.json. */
  class RunReport
  {
  public:
    /** Keeps references. */
    RunReport(const Scene            &scene,
              const ResultDirectory  &directory,
              InterfaceTables::Points points);

    /** Begins CurveAxes::rows_file() with the rows that there are already. */
    void
    begin(const std::vector<TorqueRow> &rows);
    /** A new row, of @p n_steps planned ones (0: their number is not known). */
    void
    add(const TorqueRow &row, unsigned int n_steps);
    /** Writes summary.json: the measures of the torque curve of all @p rows,
     *  and @p facts, which tell the effort and the end. Area and mean bonding
     *  of @p settings are set, where the scene does not observe the latter. */
    void
    finish(const std::vector<TorqueRow> &rows,
           CurveSettings                 settings,
           const nlohmann::ordered_json &facts);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &console &tables;
    }

    Console console;

  private:
    void
    write_errors(const std::vector<TorqueRow> &fine,
                 nlohmann::ordered_json       &summary);

    const Scene                             &scene;
    const ResultDirectory                   &directory;
    const std::map<std::string, std::string> files_of_reference;
    const ReferenceCurve                     reference;
    InterfaceTables                          tables;
  };
} // namespace Debond
