#include <debond/interface/contact_interface.h>
#include <debond/output/bone_measures.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <algorithm>

namespace Debond
{
  // The last state, and what the layer of bone has taken on the way. Half of
  // what an interference is less than nominal is the mean depth of the dent.
  nlohmann::ordered_json
  bone_measures(const Scene                  &scene,
                const ContactInterface       &interface,
                const std::vector<TorqueRow> &rows)
  {
    const BoneLayer       &bone   = interface.get_law().bone;
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    double area = 0., volume = 0., under = 0., crushed = 0., sheared = 0.,
           deepest = 0., furthest = 0.;
    // dents of bone that the implant has left are there still
    for (const SlavePoint &point : interface.get_points())
      {
        const PointHistory &state = point.accepted;
        const double        faces = point.faces_implant ? point.JxW : 0.;
        area += faces;
        volume += point.JxW * state.crushed;
        under += faces * state.crushed;
        crushed += state.crushed > 0. ? faces : 0.;
        sheared += state.sheared > 0. ? faces : 0.;
        deepest  = std::max(deepest, state.crushed);
        furthest = std::max(furthest, state.sheared);
      }
    if (bone.crushes())
      {
        result.update({{"crushed_volume_mm3", volume},
                       {"crushed_depth_mm", deepest},
                       {"share_crushed", crushed / area},
                       {"crushed_Nmm", interface.work().crushed}});
        if (scene.interface.has_interference() && !rows.empty())
          result["effective_interference_mm"] =
            read_time_function(scene.interface.interference,
                               scene.implant.characteristic_radius())(
              rows.back().time) -
            2. * under / area;
      }
    if (bone.shears())
      result.update({{"share_sheared", sheared / area},
                     {"sheared_mm", furthest},
                     {"sheared_Nmm", interface.work().sheared}});
    if (scene.bone.tensile_strength > 0. ||
        scene.bone.compressive_strength > 0.)
      {
        double most = 0.;
        for (const TorqueRow &row : rows)
          {
            if (most == 0. && row.beyond_strength_mm3 > 0.)
              result.update({{"beyond_strength_step", row.step},
                             {"beyond_strength_time", row.time}});
            most = std::max(most, row.beyond_strength_mm3);
          }
        result["beyond_strength_mm3"] = most;
      }
    return result;
  }
} // namespace Debond
