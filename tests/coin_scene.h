#pragma once

#include <debond/input/scene_file.h>
#include <debond/scene/scene.h>

#include <algorithm>
#include <string>
#include <vector>

/** A scene of the coin of tests/coin.prm, but for what a text says otherwise:
 *  tests say what they are about. */
inline Debond::Scene
coin_scene(const std::string              &text,
           const std::vector<std::string> &overrides = {},
           const std::string              &name      = "scene")
{
  using namespace Debond;
  std::vector<SceneEntry> entries = read_scene_text(text, name);
  const auto              own     = entries;
  for (const SceneEntry &usual :
       read_scene_file(DEBOND_SOURCE_DIR "/tests/coin.prm"))
    if (std::none_of(own.begin(), own.end(), [&](const SceneEntry &entry) {
          return entry.full_name() == usual.full_name();
        }))
      entries.push_back(usual);
  return Scene::from_entries(with_overrides(entries, overrides), name);
}
