#ifndef debond_interface_point_history_h
#define debond_interface_point_history_h

#include <array>

namespace Debond
{
  /** What a friction law may keep of a point beside its sliding distance; what
   *  the numbers mean is the law's own affair. */
  using InternalVariables = std::array<double, 2>;

  /** What the laws keep of a point from one accepted state to the next. */
  struct PointHistory
  {
    /** Accumulated sliding distance g_s [mm], Eq. (12). */
    double slip = 0;
    /** The bond is gone for good (only with `Opening breaks bond`). */
    bool              broken = false;
    InternalVariables internal{};

    /** @p phi_0, or 0 if the bond is gone for good. */
    double
    bond_left(const double phi_0) const
    {
      return broken ? 0. : phi_0;
    }
  };
} // namespace Debond
#endif
