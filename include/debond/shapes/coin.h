#ifndef debond_shapes_coin_h
#define debond_shapes_coin_h

#include <debond/shapes/body_geometry.h>

namespace Debond
{
  /** A cylinder on an exact disk. */
  class Coin : public BodyGeometry
  {
  public:
    std::string
    name() const override;
    std::string
    description() const override;
    std::vector<std::string>
    entries() const override;
    void
    check(const BodyParameters &body, const EntryCheck &refuse) const override;

    double
    width(const BodyParameters &body, unsigned int direction) const override;
    double
    thickness(const BodyParameters &body) const override;
    double
    reach(const BodyParameters &body) const override;
    double
    area(const BodyParameters &body) const override;
    double
    share_of_rectangle() const override;
    bool
    is_round() const override
    {
      return true;
    }
    bool
    has_closed_forms() const override
    {
      return true;
    }

    NurbsSurface
    contact_face(const BodyParameters &body, Side side) const override;
  };
} // namespace Debond
#endif
