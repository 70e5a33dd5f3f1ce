#ifndef debond_chuck_way_h
#define debond_chuck_way_h

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
    /** Keeps a reference. */
    explicit ChuckWay(const ChuckParameters &parameters);

    /** A step between two times. */
    void
    add(const Chuck &chuck, double from, double to);

    /** The largest share of a way that has been missed so far, of the ways that
     *  the last step missed a part of; 0 if there is none. */
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
    /** Of the driven translations together, which may go along a curve, and of
     *  each other component: mm, radians, N or N mm. */
    static constexpr unsigned int translation = 0, n_ways = 7;
    using Ways    = Eigen::Matrix<double, n_ways, 1>;
    using Vector6 = Eigen::Matrix<double, 6, 1>;

    Ways
    distances(const Vector6 &from, const Vector6 &to) const;
    Ways
    missed_shares() const;

    const ChuckParameters &parameters;
    Ways                   length = Ways::Zero(), missed = Ways::Zero();
    Ways                   missed_now = Ways::Zero(); ///< by the last step
  };
} // namespace Debond
#endif
