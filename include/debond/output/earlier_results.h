#ifndef debond_output_earlier_results_h
#define debond_output_earlier_results_h

#include <string>

namespace Debond
{
  /** Removes what debond has written into a directory, but for parameters.prm;
   *  images that others made of the results stay. Throws
   *  std::filesystem::filesystem_error if that is impossible. */
  void
  remove_results(const std::string &directory);

  /** The same for the directories rung-NUMBER of Model = auto only; what else
   *  has such a name is not ours. */
  void
  remove_levels(const std::string &directory);
} // namespace Debond
#endif
