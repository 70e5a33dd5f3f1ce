#ifndef debond_models_run_report_h
#define debond_models_run_report_h

#include <debond/output/console.h>
#include <debond/output/interface_maps.h>
#include <debond/output/profile_output.h>

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <map>
#include <optional>
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
    RunReport(const Scene &scene, const ResultDirectory &directory);

    /** Begins CurveAxes::rows_file() with the rows that there are already;
     *  @p points are those of the interface at the last of them. */
    void
    begin(const std::vector<TorqueRow> &rows,
          const InterfaceMaps::Points  &points = {});
    /** A new row, of @p n_steps planned ones (0: their number is not known).
     *  @p points are those of the interface. */
    void
    add(const TorqueRow                                    &row,
        unsigned int                                        n_steps,
        const std::function<std::vector<InterfacePoint>()> &points);
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
      archive &console &profiles &maps;
    }

    Console                    console;
    std::optional<GrowingFile> torque_curve; ///< from begin() on

  private:
    const Scene                             &scene;
    const ResultDirectory                   &directory;
    const std::map<std::string, std::string> files_of_reference;
    const ReferenceCurve                     reference;
    ProfileOutput                            profiles;
    InterfaceMaps                            maps;
    InterfaceMaps::Points                    points_of_last_row;
  };
} // namespace Debond
#endif
