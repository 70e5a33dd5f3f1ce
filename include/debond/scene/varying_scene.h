#pragma once

#include <debond/input/entry_table.h>
#include <debond/scene/scene.h>

namespace Debond
{
  /** A scene some of whose entries change again and again: to read all of them
   *  anew would take milliseconds. What belongs to the text, completed
   *  parameters and changed entries, stays as it was. */
  class VaryingScene
  {
  public:
    /** Throws what Scene::from_entries() throws. */
    VaryingScene(const std::vector<SceneEntry> &entries,
                 const std::string             &name)
      : scene(Scene::from_entries(entries, name))
    {
      scene.declare(table);
    }
    /** The table refers to the scene. */
    VaryingScene(const VaryingScene &) = delete;

    /** The scene with these values of entries, until the next call. Throws
     *  EntryError if one of them is not allowed; whether they make sense
     *  together is left to check(). */
    const Scene &
    with(const std::vector<SceneEntry> &entries)
    {
      for (const SceneEntry &entry : entries)
        table.set(entry);
      scene.take_values();
      return scene;
    }

  private:
    Scene      scene;
    EntryTable table;
  };
} // namespace Debond
