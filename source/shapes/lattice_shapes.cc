#include <debond/geometry/nurbs_surface.h>
#include <debond/shapes/body_parameters.h>
#include <debond/support/number_text.h>

#include <cmath>

namespace Debond
{
  namespace
  {
    BodyGeometry
    coin(const BodyParameters &body)
    {
      BodyGeometry result       = BodyGeometry::round(body.radius, body.height);
      result.area               = M_PI * body.radius * body.radius;
      result.share_of_rectangle = 0.25 * M_PI;
      result.has_closed_forms   = true;
      return result;
    }

    void
    check_coin(const BodyParameters &body, const EntryCheck &refuse)
    {
      refuse(body.cells[0] != body.cells[1],
             "Cells",
             "a coin and a cap take two numbers, cells across the disk and "
             "along the axis");
    }

    NurbsSurface
    face_of_coin(const BodyParameters &body)
    {
      return body.is_fitted() ?
               NurbsSurface::fitted_disk(body.radius,
                                         body.fitted_cells[0],
                                         body.fitted_cells[1]) :
               NurbsSurface::disk(body.radius, body.cells[0]);
    }



    /** Height of the rim of the contact face above its centre [mm]. */
    double
    rise(const BodyParameters &body)
    {
      return height_on_sphere(body.radius, body.cap_radius);
    }

    BodyGeometry
    cap(const BodyParameters &body)
    {
      BodyGeometry result     = coin(body);
      result.area             = 2. * M_PI * body.cap_radius * rise(body);
      result.has_closed_forms = false;
      return result;
    }

    void
    check_cap(const BodyParameters &body, const EntryCheck &refuse)
    {
      check_coin(body, refuse);
      refuse(body.cap_radius <= body.radius,
             "Cap radius",
             "a cap is flatter than a hemisphere: expected more than Radius, " +
               to_text(body.radius) + " mm");
      refuse(body.contact_radius > body.radius,
             "Contact radius",
             "cells lie within the cap: expected at most Radius, " +
               to_text(body.radius) + " mm");
      refuse(rise(body) >= body.height,
             "Height",
             "the rim of the cap is " + to_text(rise(body)) +
               " mm above its centre: expected more than that");
    }

    NurbsSurface
    face_of_cap(const BodyParameters &body)
    {
      return body.is_fitted() ?
               NurbsSurface::fitted_cap(body.radius,
                                        body.cap_radius,
                                        body.rim[0],
                                        body.fitted_cells[0],
                                        body.fitted_cells[1]) :
               NurbsSurface::cap(body.radius, body.cap_radius, body.cells[0]);
    }



    BodyGeometry
    block(const BodyParameters &body)
    {
      BodyGeometry result;
      result.width     = {{body.size[0], body.size[1]}};
      result.reach     = 0.5 * std::hypot(body.size[0], body.size[1]);
      result.thickness = result.chuck_height = body.size[2];
      return result;
    }

    NurbsSurface
    face_of_block(const BodyParameters &body)
    {
      // Elements meet at an angle at the rim. It is a little outside of the
      // implant's, so that no point of this one goes over it as the bodies
      // give way: the state would jump there, and might have no equilibrium.
      constexpr double margin = 1.001;
      if (body.is_fitted())
        return NurbsSurface::fitted_rectangle(body.size[0],
                                              body.size[1],
                                              margin * body.rim[0],
                                              body.hole / margin,
                                              body.fitted_cells[0],
                                              body.fitted_cells[1],
                                              body.fitted_cells[2]);
      return NurbsSurface::rectangle(
        body.size[0],
        body.size[1],
        KnotVector::from_breakpoints(2, body.lateral_fractions(0)),
        KnotVector::from_breakpoints(2, body.lateral_fractions(1)));
    }
  } // namespace



  void
  BodyParameters::take_rim(const BodyParameters &implant)
  {
    rim = {{0.5 * implant.width(0), 0.5 * implant.width(1)}};
    if (implant.shape == BodyShape::cap && implant.contact_radius > 0.)
      rim = {{implant.contact_radius, implant.contact_radius}};
    hole = implant.shape == BodyShape::ring ? implant.inner_radius : 0.;
    if (is_fitted())
      cells[0] = cells[1] = std::ceil(std::sqrt(n_fitted_elements()));
  }



  // Towards the rim, at both sides of it, as far as the middle and the sides of
  // the block: the pressure has a kink or a singularity there.
  std::vector<double>
  BodyParameters::lateral_fractions(const unsigned int direction) const
  {
    const unsigned int  n = cells[direction], under = cells_under_implant;
    std::vector<double> result;
    if (under == 0)
      return KnotVector::graded(1, n, lateral_grading).breakpoints();
    const double       half = 0.5 * width(direction), R = rim[direction];
    const unsigned int beside = (n - under) / 2;
    for (unsigned int i = 0; i <= n; ++i)
      {
        // cells from the middle, in halves
        const double from_middle = std::abs(i - 0.5 * n) - 0.5 * under;
        const double x =
          from_middle <= 0. ?
            R * (1. - std::pow(-2. * from_middle / under, rim_grading)) :
            R + (half - R) * std::pow(from_middle / beside, rim_grading);
        result.push_back(2 * i < n ? 0.5 * (1. - x / half) :
                                     0.5 * (1. + x / half));
      }
    result.front() = 0.;
    result.back()  = 1.;
    return result;
  }



  std::vector<ShapeRow>
  lattice_shapes()
  {
    return {{"coin",
             "a cylinder given by Radius and Height",
             false,
             true,
             {"Radius", "Height"},
             coin,
             check_coin,
             face_of_coin},
            {"cap",
             "the same with a spherical contact face of radius Cap radius",
             false,
             true,
             {"Radius", "Height", "Cap radius"},
             cap,
             check_cap,
             face_of_cap},
            {"block",
             "a box given by Size",
             true,
             true,
             {"Size"},
             block,
             [](const BodyParameters &, const EntryCheck &) {},
             face_of_block}};
  }
} // namespace Debond
