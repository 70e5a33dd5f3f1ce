#include <debond/shapes/body_geometry.h>
#include <debond/shapes/body_parameters.h>

namespace Debond
{
  namespace
  {
    class Block : public BodyGeometry
    {
    public:
      std::string
      name() const override
      {
        return "block";
      }
      std::string
      description() const override
      {
        return "a box given by Size";
      }
      bool
      is_for_bone() const override
      {
        return true;
      }
      std::vector<std::string>
      entries() const override
      {
        return {"Size"};
      }

      double
      width(const BodyParameters &body,
            const unsigned int    direction) const override
      {
        return body.size[direction];
      }
      double
      thickness(const BodyParameters &body) const override
      {
        return body.size[2];
      }

      NurbsSurface
      contact_face(const BodyParameters &body, const Side) const override
      {
        // Elements meet at an angle at the rim. It is a little outside of the
        // implant's, so that no point of this one goes over it as the bodies
        // give way: the state would jump there, and might have no equilibrium.
        constexpr double margin = 1.001;
        if (body.is_fitted())
          return NurbsSurface::fitted_rectangle(body.size[0],
                                                body.size[1],
                                                margin * body.rim[0],
                                                body.fitted_cells[0],
                                                body.fitted_cells[1],
                                                body.fitted_cells[2]);
        return NurbsSurface::rectangle(
          body.size[0],
          body.size[1],
          KnotVector::from_breakpoints(2, body.lateral_fractions(0)),
          KnotVector::from_breakpoints(2, body.lateral_fractions(1)));
      }
    };
  } // namespace



  const BodyGeometry &
  block_geometry()
  {
    static const Block block;
    return block;
  }
} // namespace Debond
