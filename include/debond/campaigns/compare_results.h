#ifndef debond_campaigns_compare_results_h
#define debond_campaigns_compare_results_h

#include <iosfwd>
#include <string>
#include <vector>

namespace Debond
{
  /**
   * Compares what is in a directory of results with a measured curve, and runs
   * nothing: the torque curve of a run, those of all finished variants of a
   * study, closest first, or the band of an ensemble. @p columns: `Output /
   * Reference columns`. Throws InputError if there are no results, or if the
   * curve cannot be read.
   */
  void
  compare_results(const std::string              &directory,
                  const std::string              &measured,
                  const std::vector<std::string> &columns,
                  std::ostream                   &out);
} // namespace Debond
#endif
