#ifndef debond_support_accepted_state_h
#define debond_support_accepted_state_h

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
      has_rate    = has_value && new_time > time;
      before      = value;
      time_before = time;
      value       = new_value;
      time        = new_time;
      has_value   = true;
    }

    /** The line through both at @p new_time; the last value if there is only
     *  one. */
    Vector
    extrapolated(const double new_time) const
    {
      if (!has_rate)
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
      archive &value &before &time &time_before &has_value &has_rate;
    }

  private:
    double time = 0, time_before = 0;
    bool   has_value = false, has_rate = false;
  };
} // namespace Debond
#endif
