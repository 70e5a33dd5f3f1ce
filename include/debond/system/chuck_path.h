#pragma once

#include <debond/bulk/chuck.h>

#include <string>

namespace Debond
{
  /** The length of the path of the chuck and of an interference, as the scene
   *  prescribes it, and how much of that the steps miss, which know their ends
   *  and not what lies between: curves, and what turns back within a step. */
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
     *  seen. @p thickening: an interference, or null. Throws InputError if a
     *  value in it is not finite. */
    void
    add(const Chuck        &chuck,
        double              from,
        double              to,
        const TimeFunction &thickening = {});

    /** The largest share of a length that has been missed so far, of those of
     *  which the last step missed more than it may; 0 if there is none. */
    double
    missed_share() const
    {
      return missed_shares.maxCoeff();
    }
    /** Largest share and its component, for messages. */
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
    /** Of each component (mm, radians, N or N mm), of the interference, and of
     *  the driven translations together and the driven tilts together, which
     *  may go along curves. */
    using Lengths = Eigen::Matrix<double, ChuckParameters::n_components + 3, 1>;
    static constexpr unsigned int interference = ChuckParameters::n_components,
                                  translations = interference + 1,
                                  tilts        = interference + 2;
    /** Of the components and the interference. */
    using Place = Eigen::Matrix<double, interference + 1, 1>;

    Lengths
    distances(const Place &from, const Place &to) const;

    const ChuckParameters &parameters;
    Lengths                length = Lengths::Zero(), missed = Lengths::Zero();
    /** Of those of which the last step missed too much, else 0. */
    Lengths missed_shares = Lengths::Zero();
  };
} // namespace Debond
