#pragma once

#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  /** Words as a shell reads them. */
  std::string
  shell_line(const std::vector<std::string> &words);

  /** To be called by a program with the words that started it. */
  void
  note_command(int argc, const char *const *argv);

  /** "debond 2.0.0" */
  std::string
  program_and_version();

  /** Where results come from, as pairs of a name and a text: program (with its
   *  version), commit, deal.II, date (that of the call, ISO 8601), host,
   *  command. What is not known is left out. */
  std::vector<std::pair<std::string, std::string>>
  provenance();
} // namespace Debond
