#pragma once

#include <string>

/** A chuck that presses by 4.9 um until t = 1, and what it does then. */
inline std::string
pressed_then(const std::string &component, const std::string &value)
{
  return "subsection Chuck\n"
         " subsection Press\n"
         "  set Value = 0.0049 * min(t, 1)\n"
         " end\n"
         " subsection " +
         component +
         "\n"
         "  set Value = " +
         value +
         "\n"
         " end\n"
         "end\n";
}

/** Both bodies of a material. */
inline std::string
bodies_of(const std::string &material)
{
  return "subsection Bone\n set Material = " + material +
         "\nend\nsubsection Implant\n set Material = " + material + "\nend\n";
}

/** The motion of the main scene: it turns by 10 degrees until t = 2. */
inline const std::string pressed_and_turned =
  pressed_then("Rotation z", "10 * max(t - 1, 0)");
