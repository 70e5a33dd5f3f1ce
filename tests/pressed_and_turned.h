#ifndef debond_tests_pressed_and_turned_h
#define debond_tests_pressed_and_turned_h

#include <string>

/** The motion of the main scene: pressed 4.9 um until t = 1, then turned by 10
 *  degrees until t = 2. */
inline const std::string pressed_and_turned =
  "subsection Chuck\n"
  " subsection Press\n"
  "  set Value = 0.0049 * min(t, 1)\n"
  " end\n"
  " subsection Rotation z\n"
  "  set Value = 10 * max(t - 1, 0)\n"
  " end\n"
  "end\n";
#endif
