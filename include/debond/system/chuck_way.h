#ifndef debond_system_chuck_way_h
#define debond_system_chuck_way_h

#include <Eigen/Core>

#include <string>

namespace Debond
{
  class Chuck;
  struct ChuckParameters;

  /** How far the scene wants the chuck to go, and how much of that the steps
   *  miss, which know their ends and not what lies between: curves, and motions
   *  or loads that turn back within a step. */
  class ChuckWay
  {
  public:
    /** Share of a way that steps may miss. A circle in 23 steps does; they lie
     * 8 degrees off the direction at their end, and friction is 0.9 % too
     *  small. */
    static constexpr double largest_missed_share = 0.003;

    /** Keeps a reference. */
    explicit ChuckWay(const ChuckParameters &parameters);

    /** A step between two times. What turns back within 1/32 of it is not
     *  seen. Throws InputError if a value on the way is not finite. */
    void
    add(const Chuck &chuck, double from, double to);

    /** The largest share of a way that has been missed so far, of the ways of
     *  which the last step missed more than it may; 0 if there is none. */
    double
    missed_share() const;

    /** That share and whose it is, for messages. */
    std::string
    describe() const;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &length &missed;
    }

  private:
    /** Of the driven translations together and the driven tilts together, which
     *  may go along curves, and of each other component: mm, radians, N or
     *  N mm. */
    static constexpr unsigned int translations = 0, tilts = 1, n_ways = 8;
    using Ways    = Eigen::Matrix<double, n_ways, 1>;
    using Vector6 = Eigen::Matrix<double, 6, 1>;

    Ways
    distances(const Vector6 &from, const Vector6 &to) const;
    Ways
    missed_shares() const;

    const ChuckParameters &parameters;
    Ways                   length = Ways::Zero(), missed = Ways::Zero();
    /** Of the last step. */
    Ways length_now = Ways::Zero(), missed_now = Ways::Zero();
  };
} // namespace Debond
#endif
