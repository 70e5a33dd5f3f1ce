#pragma once

#include <debond/interface/contact_interface.h>

#include <algorithm>

/** True if a point slides in its trial state while its friction falls by more
 *  than @p slope with the distance [MPa/mm]. */
inline bool
softens(const Debond::ContactInterface &interface, const double slope)
{
  const auto &points = interface.get_points();
  return std::any_of(points.begin(), points.end(), [&](const auto &point) {
    return slides(point.trial.state.status) &&
           -interface.friction(point).dmu * point.trial.pressure > slope;
  });
}
