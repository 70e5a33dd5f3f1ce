#ifndef debond_system_chuck_path_h
#define debond_system_chuck_path_h

#include <debond/bulk/chuck.h>

#include <string>

namespace Debond
{
  /** The length of the chuck's path, as the scene prescribes it, and how much
   *  of that the steps miss, which know their ends and not what lies between:
   *  curves, and motions or loads that turn back within a step. */
  class ChuckPath
  {
  public:
    /** Share of a length that steps may miss. A circle in 23 steps does; they
     *  lie 8 degrees off the direction at their end, and friction is 0.9 % too
     *  small. */
    static constexpr double largest_missed_share = 0.003;

    /** Keeps a reference. */
    explicit ChuckPath(const ChuckParameters &parameters)
      : parameters(parameters)
    {}

    /** A step between two times. What turns back within 1/32 of it is not
     *  seen. Throws InputError if a value in it is not finite. */
    void
    add(const Chuck &chuck, double from, double to);

    /** The largest share of a length that has been missed so far, of those of
     *  which the last step missed more than it may; 0 if there is none. */
    double
    missed_share() const
    {
      return missed_shares.maxCoeff();
    }
    /** That share and whose it is, for messages. */
    std::string
    describe() const;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &length &missed &missed_shares;
    }

  private:
    /** Of each component (mm, radians, N or N mm), and of the driven
     *  translations together and the driven tilts together, which may go along
     *  curves. */
    using Lengths = Eigen::Matrix<double, ChuckParameters::n_components + 2, 1>;
    static constexpr unsigned int translations = 6, tilts = 7;

    Lengths
    distances(const Chuck::Vector6 &from, const Chuck::Vector6 &to) const;

    const ChuckParameters &parameters;
    Lengths                length = Lengths::Zero(), missed = Lengths::Zero();
    /** Of those of which the last step missed too much, else 0. */
    Lengths missed_shares = Lengths::Zero();
  };
} // namespace Debond
#endif
