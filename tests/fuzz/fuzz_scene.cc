// Fuzz target: reading a scene with all its checks.

#include <debond/input/allowed_values.h>
#include <debond/scene/scene.h>

#include "fuzz_target.h"

namespace
{
  /** Scenes with many cells or steps are right but take long to check. */
  bool
  is_small(const std::vector<Debond::SceneEntry> &entries)
  {
    for (const Debond::SceneEntry &entry : entries)
      if (entry.name == "Cells" || entry.name == "Steps")
        for (const std::string &item : Debond::split_list(entry.value))
          if (Debond::read_number(item).value_or(0.) > 100.)
            return false;
    return true;
  }



  /** An included file would be read from the disk, and the name of any other
   *  file could be that of a device. */
  bool
  names_files(const std::string &text)
  {
    return text.find("nclude") != std::string::npos ||
           text.find("NCLUDE") != std::string::npos ||
           text.find("/dev") != std::string::npos ||
           text.find("/proc") != std::string::npos;
  }
} // namespace



extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const std::string text(reinterpret_cast<const char *>(data), size);
  if (names_files(text))
    return 0;
  must_read_or_refuse([&text]() {
    const auto entries = Debond::read_scene_text(text, "scene");
    if (!is_small(entries))
      return;
    Debond::Scene::from_entries(entries, "scene");
  });
  return 0;
}
