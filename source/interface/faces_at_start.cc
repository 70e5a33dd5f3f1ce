#include <debond/bulk/bulk_space.h>
#include <debond/bulk/chuck.h>
#include <debond/interface/contact_interface.h>
#include <debond/interface/slip_problem.h>
#include <debond/shapes/faces_of_mesh.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

// How the faces lie where the bodies are made. Those of files and of some
// shapes are facets, which fit each other only where their meshes match.
namespace Debond
{
  namespace
  {
    /** Distance by which each of several elements may be off the surface that
     * all stand for [mm]. Plane facets of a circle bulge by 1 - cos(theta/2) of
     * its radius, and the middle of one is 2 cos(theta/2) sin^2(theta/2) above
     * the plane of its neighbour: three times that or more, up to theta = 60
     *  degrees, from where on there is an edge. Both directions add up.
     *  Elements that are curved themselves: a twentieth. Of files three times
     *  as much, and what those beside are off, as several elements may be parts
     *  of one triangle, plane or not. */
    std::vector<double>
    errors_of_facets(const NurbsSurface &surface, const bool is_of_file)
    {
      const double share =
        (surface.degree() == 1 ? 3. : 60.) / (is_of_file ? 3. : 1.);
      std::vector<double> result(surface.n_elements(), 0.);
      // one patch is the smooth surface itself
      if (surface.is_one_patch())
        return result;
      const auto middles = surface_quadrature(surface, dealii::QMidpoint<1>());
      for (const auto &middle : middles)
        {
          SurfaceGeometry here;
          contract(middle.basis, surface.control_points(), here);
          const Eigen::Vector3d n = here.a1.cross(here.a2).normalized();
          for (const unsigned int d : {0, 1})
            {
              double highest = 0.;
              for (const auto &corner : surface.element_bounds(middle.element))
                {
                  Eigen::Vector2d xi = middle.xi;
                  xi[d]              = corner[d];
                  for (const auto &place :
                       surface.places_beside(middle.element, xi))
                    {
                      // A neighbour whose middle lies more than 30 degrees off
                      // the tangent plane is behind an edge, and says nothing
                      // of the curvature of this face.
                      const Eigen::Vector3d way =
                        middles[place.element].X - here.y;
                      const double height = std::abs(n.dot(way));
                      if (height < 0.5 * way.norm())
                        highest = std::max(highest, height);
                    }
                }
              result[middle.element] += highest / share;
            }
        }
      if (!is_of_file)
        return result;
      const std::vector<double> own = result;
      for (const auto &middle : middles)
        for (unsigned int side = 0; side < 4; ++side)
          {
            Eigen::Vector2d xi = middle.xi;
            xi[side / 2] =
              surface.element_bounds(middle.element)[side % 2][side / 2];
            for (const auto &place : surface.places_beside(middle.element, xi))
              result[middle.element] =
                std::max(result[middle.element], own[place.element]);
          }
      return result;
    }
  } // namespace



  // Where the bodies are made, whatever the chuck and a press fit do at the
  // first time. A gap that facets account for is none: bonds would else hold,
  // and a press fit press, where meshes match only, and a twist that moves
  // faces by less would meet nothing. Of shapes of our own it stays without
  // these, as an implant may be made larger than the hole for it.
  //
  // It is a vector G in the frame of the slave, taken off by the basis of the
  // point: origin o of the frame and ends of its axes follow the control
  // points, and x' = sum N_A x_A + sum G_k (o - (o + e_k)) = x - Q G. So forces
  // act at x', with its lever arm.
  void
  ContactInterface::find_facets()
  {
    // Each slave point is projected on the master at rest. Its distance is a
    // facet's if it is no more than both elements can be off the smooth face;
    // overlap and range of the rest are for warnings.
    const NurbsSurface &surface = mesh[master_side()]->surface();
    if (surface.is_one_patch() && mesh[slave]->surface().is_one_patch())
      return; // smooth
    const auto is_of_file = [this](const Side side) {
      return mesh[side]->parameters().shape == BodyShape::file;
    };
    const std::vector<double> errors =
                                errors_of_facets(surface,
                                                 is_of_file(master_side())),
                              own = errors_of_facets(mesh[slave]->surface(),
                                                     is_of_file(slave));
    const MasterSurface                                   master{&surface,
                               &surface.control_points(),
                               mesh[master_side()]->outward_sign()};
    bool                                                  fits = true;
    std::vector<std::pair<SlavePoint *, Eigen::Vector3d>> gaps;
    double lowest = std::numeric_limits<double>::max(), highest = -lowest;
    const Eigen::Vector2d *guess = nullptr;
    for (SlavePoint &point : points)
      {
        const Eigen::Vector3d normal =
          normal_of_slave(point, mesh[slave]->surface().control_points());
        Projection rest = project(master, point.X, guess, &normal);
        // Of several pieces another one may be nearer than that of the point
        // before, unless this one is as near as points are to each other. A
        // search over all of them for each point would take longer than all
        // else where faces are many.
        if (surface.n_pieces() > 1 &&
            !(rest.faces && std::abs(rest.height) < std::sqrt(point.JxW)))
          rest = project(master, point.X, nullptr, &normal);
        point.accepted.has_partner = rest.faces;
        if (!rest.faces)
          continue;
        point.accepted.xi = rest.xi;
        guess             = &point.accepted.xi;
        const double facets =
                       own[point.element] + errors[surface.element_of(rest.xi)],
                     gap = std::abs(rest.height);
        at_start.facets  = std::max(at_start.facets, facets);
        at_start.overlap = std::max(at_start.overlap, -rest.height - facets);
        fits             = fits && gap <= facets + touch_tolerance;
        lowest           = std::min(lowest, rest.height);
        highest          = std::max(highest, rest.height);
        // G in the frame of the slave at rest [mm], with both faces where they
        // were made.
        const Eigen::Vector3d G = point.X - surface.point(rest.xi);
        if (gap <= facets && G.norm() > touch_tolerance)
          gaps.emplace_back(&point, G);
      }
    // Facets of two meshes of one face cross each other: somewhere there is no
    // gap. Bodies of files that are apart, or overlap, all over are meant to:
    // an implant drawn thicker than its hole is a press fit.
    const bool vanish = lowest <= 0.1 * highest && highest >= 0.1 * lowest,
               takes_off =
                 law.joint->pulls() || parameters.has_interference() ||
                 (vanish &&
                  (is_of_file(Side::bone) || is_of_file(Side::implant)));
    for (unsigned int k = 0; takes_off && k < gaps.size(); ++k)
      take_off(*gaps[k].first, gaps[k].second);
    if (fits && !takes_off)
      at_start.uneven = std::max(0., highest - lowest);
  }



  // G becomes functions of four further control points, the origin of the frame
  // and the ends of its axes, see InterfaceConfiguration::Surface::add_frame():
  // it turns with the frame, and interpolate() and spread() need not know of
  // it.
  void
  ContactInterface::take_off(SlavePoint &point, const Eigen::Vector3d &G)
  {
    at_start.largest_gap = std::max(at_start.largest_gap, G.norm());
    unsigned int number  = mesh[slave]->surface().n_control_points();
    for (const double N : {G.sum(), -G[0], -G[1], -G[2]})
      {
        const unsigned int k         = point.basis.size++;
        point.basis.control_point[k] = number++;
        point.basis.N[k]             = N;
        point.basis.N_1[k] = point.basis.N_2[k] = 0.;
      }
  }



  // Out of the slave at a point, a unit vector. A face with edges is of several
  // pieces, and the nearest is often none that the point presses against:
  // beside the edge of a post's flat end the wall of its hole is nearer than
  // the bottom once the post has moved. Pieces that face the point are asked
  // only, with normals more than 120 degrees apart.
  Eigen::Vector3d
  ContactInterface::normal_of_slave(const SlavePoint &point,
                                    const ControlNet &positions) const
  {
    SurfaceGeometry geometry;
    contract(point.basis, positions, geometry);
    return MasterNormal(geometry, mesh[slave]->outward_sign()).n;
  }



  // The bone has the faces on which nothing lies, too, and a block its top.
  double
  ContactInterface::area_left_out() const
  {
    if (implant().shape != BodyShape::file)
      return 0.;
    const auto boundary = [this](const Side side, const FacesOfMesh which) {
      const NurbsSurface &contact = mesh[side]->surface();
      const auto         &cells   = mesh[side]->parameters().mesh;
      return cells ? contact_surface_of(*cells, contact.degree(), side, which) :
                     contact;
    };
    // Faces of the implant that are no contact faces, against all of the
    // bone's: where one lies on the other within the error of facets its area
    // counts.
    const NurbsSurface others = boundary(Side::implant, FacesOfMesh::others),
                       bone   = boundary(Side::bone, FacesOfMesh::all);
    const std::vector<double> own    = errors_of_facets(others, false),
                              errors = errors_of_facets(bone, false);
    const MasterSurface master{&bone,
                               &bone.control_points(),
                               mesh[Side::bone]->outward_sign()};
    double              sum = 0.;
    for (const auto &face : surface_quadrature(others, dealii::QMidpoint<1>()))
      {
        const Projection at = project(master, face.X, nullptr);
        if (at.faces && std::abs(at.height) <=
                          own[face.element] + errors[bone.element_of(at.xi)] +
                            1e-6 * std::sqrt(face.JxW))
          sum += face.JxW;
      }
    return sum;
  }



  std::string
  FacesAtStart::in_words(const bool pulls) const
  {
    const std::string bonded =
      pulls ? "bonded in tension: " + std::to_string(n_bonded) + " points, " +
                to_text(bonded_area, 4) + " of " + to_text(bonding_area, 4) +
                " mm^2" :
              "";
    return largest_gap == 0. ?
             bonded :
             bonded + (pulls ? "; " : "") + "gaps between the faces of up to " +
               to_text(largest_gap, 2) + " mm are taken off (facets account " +
               "for " + to_text(facets, 2) + " mm)";
  }



  // "At initial contact the interacting point is the closest projection point"
  // (paper, after Eq. 28).
  //
  // The bonding comes last, as with the bone as slave it asks for the partners.
  void
  ContactInterface::initialise(const InterfaceConfiguration &configuration)
  {
    tangent_is_gathered = false;
    for (const Side side : both_sides)
      accepted_positions[side] = configuration.side[side].positions;
    // Q and C + u of the implant: the rigid motion of the first step begins
    // here.
    accepted_place = Place::of_implant(configuration);
    unprojected    = 0;
    // From one point to the next: a search over the whole master asks all of
    // its elements.
    const SlavePoint *neighbour = nullptr;
    const bool has_pieces       = mesh[master_side()]->surface().n_pieces() > 1;
    for (SlavePoint &point : points)
      {
        // the guess of the search, xi of the point before
        if (neighbour != nullptr)
          point.accepted.xi = neighbour->accepted.xi;
        // on several pieces the place where it was found, find_facets()
        point.trial.normal_gap =
          project_accepted(point,
                           configuration,
                           has_pieces ? point.accepted.has_partner :
                                        neighbour != nullptr)
            .height;
        if (!shares.empty())
          shares[&point - points.data()].xi = point.accepted.xi;
        if (point.accepted.has_partner && !has_pieces)
          neighbour = &point;
      }
    assign_bonding();
    for (SlavePoint &point : points)
      {
        at_start.bonding_area += point.phi_0 * point.JxW;
        if (!point.accepted.has_partner)
          continue;
        at_start.facing_area += point.JxW;
        const double gap = point.trial.normal_gap;
        // faces that touch have grown together; what overlaps has touched once
        // it is in equilibrium
        if (std::abs(gap) <= touch_tolerance)
          {
            point.accepted.joined     = true;
            point.accepted.normal_gap = 0.;
          }
        if (point.phi_0 == 0. || gap > touch_tolerance)
          continue;
        ++at_start.n_bonded;
        at_start.bonded_area += point.phi_0 * point.JxW;
      }
  }
} // namespace Debond
