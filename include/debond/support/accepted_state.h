#pragma once

#include <limits>

namespace Debond
{
  /** The last two accepted values of something and their times: what a step
   *  starts from, and the straight line through them as its prediction. */
  template <typename Vector>
  class AcceptedState
  {
  public:
    explicit AcceptedState(const Vector &start)
      : value(start)
      , before(start)
    {}

    void
    commit(const Vector &new_value, const double new_time)
    {
      before      = value;
      time_before = time;
      value       = new_value;
      time        = new_time;
    }

    /** The line through both at @p new_time; the last value if there is only
     *  one. */
    Vector
    extrapolated(const double new_time) const
    {
      if (!(time > time_before)) // one of them may not be a number
        return value;
      return value +
             (new_time - time) / (time - time_before) * (value - before);
    }

    Vector value, before;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &value &before &time &time_before;
    }

  private:
    double time = std::numeric_limits<double>::quiet_NaN(), time_before = time;
  };
} // namespace Debond
