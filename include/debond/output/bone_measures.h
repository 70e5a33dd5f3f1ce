#pragma once

#include <nlohmann/json.hpp>

#include <vector>

namespace Debond
{
  class ContactInterface;
  struct Scene;
  struct TorqueRow;

  /** Members of summary.json about the layer of bone beside the interface, if
   *  it is crushed or sheared: volume [mm^3], largest depth [mm] and share of
   *  the face that is crushed, and the work [N mm]; the interference [mm] at
   *  which faces that are not crushed would be pressed alike; share that has
   *  slid in the bone, its largest distance [mm], and the work [N mm]. Of bone
   *  with strengths the largest volume of the @p rows that is beyond them
   *  [mm^3], and the first step and time when there is any. */
  nlohmann::ordered_json
  bone_measures(const Scene                  &scene,
                const ContactInterface       &interface,
                const std::vector<TorqueRow> &rows);
} // namespace Debond
