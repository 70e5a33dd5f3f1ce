#ifndef debond_shapes_pin_h
#define debond_shapes_pin_h

#include <debond/shapes/meshed_shape.h>

namespace Debond
{
  /** A round pin that is in the bone up to z = 0, where the chuck holds it. */
  class Pin : public MeshedShape
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
    area(const BodyParameters &body) const override;
    double
    chuck_height(const BodyParameters &) const override
    {
      return 0.;
    }
    double
    radius_of_side(const BodyParameters &body,
                   double                z,
                   double                angle) const override;

    Eigen::Vector2d
    on_face(const BodyParameters  &body,
            const Eigen::Vector3d &X) const override;
    std::array<Eigen::Vector2d, 2>
    box_of_face(const BodyParameters &body) const override;

  protected:
    /** The smallest radius of the side [mm]. */
    virtual double
    thinnest(const BodyParameters &body) const;
    StoredMesh
    stored_mesh(const BodyParameters &body,
                const BodyParameters &implant) const override;
  };
} // namespace Debond
#endif
