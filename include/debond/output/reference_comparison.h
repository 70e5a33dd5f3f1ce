#pragma once

#include <debond/scene/reference_data.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>

namespace Debond
{
  struct OutputParameters;

  /** Writes the reference curve as it was read, in the units of torque.csv, to
   *  reference.csv. */
  void
  write_reference(const std::string    &directory,
                  const ReferenceCurve &curve,
                  const CurveAxes      &axes);

  /** The content of the reference curve and profiles of a scene, see
   *  identity_of(): the member `reference_files` of a summary, whose distances
   *  belong to it. */
  std::map<std::string, std::string>
  reference_files(const OutputParameters &output);

  /** Whether the distances of a summary are from references whose content was
   *  another one. */
  bool
  has_other_references(const OutputParameters       &output,
                       const nlohmann::ordered_json &summary);

  /** Computes the distances of finished results from the references anew, and
   *  writes them into their summary.json, if they have other references;
   * returns whether they had. */
  bool
  compare_anew_if_changed(const OutputParameters &output,
                          const std::string      &directory);
} // namespace Debond
