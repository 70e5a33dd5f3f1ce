#include <debond/shapes/body_parameters.h>
#include <debond/shapes/coin.h>

#include <cmath>

namespace Debond
{
  std::string
  Coin::name() const
  {
    return "coin";
  }
  std::string
  Coin::description() const
  {
    return "a cylinder given by Radius and Height";
  }
  std::vector<std::string>
  Coin::entries() const
  {
    return {"Radius", "Height"};
  }

  void
  Coin::check(const BodyParameters &body, const EntryCheck &refuse) const
  {
    refuse(body.cells[0] != body.cells[1],
           "Cells",
           "a coin and a cap take two numbers, cells across the disk and "
           "along the axis");
  }

  double
  Coin::width(const BodyParameters &body, const unsigned int) const
  {
    return 2. * body.radius;
  }
  double
  Coin::thickness(const BodyParameters &body) const
  {
    return body.height;
  }
  double
  Coin::reach(const BodyParameters &body) const
  {
    return body.radius;
  }
  double
  Coin::area(const BodyParameters &body) const
  {
    return M_PI * body.radius * body.radius;
  }
  double
  Coin::share_of_rectangle() const
  {
    return 0.25 * M_PI;
  }

  NurbsSurface
  Coin::contact_face(const BodyParameters &body, const Side) const
  {
    return body.is_fitted() ? NurbsSurface::fitted_disk(body.radius,
                                                        body.fitted_cells[0],
                                                        body.fitted_cells[1]) :
                              NurbsSurface::disk(body.radius, body.cells[0]);
  }



  const BodyGeometry &
  coin_geometry()
  {
    static const Coin coin;
    return coin;
  }
} // namespace Debond
