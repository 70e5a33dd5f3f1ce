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
    /** How the elements of a surface stand for a smooth face. Those of a shape
     *  lie on it with all of their control points, those of a file with the
     *  nodes that it has. */
    struct Elements
    {
      bool are_of_file, are_plane;

      explicit Elements(const BulkSpace &body)
        : are_of_file(body.parameters().shape == BodyShape::file)
        , are_plane(are_of_file ? body.parameters().mesh->order == 1 :
                                  body.surface().degree() == 1)
      {}
      /** Of a shape. */
      explicit Elements(const NurbsSurface &surface)
        : are_of_file(false)
        , are_plane(surface.degree() == 1)
      {}
    };



    /** Distance by which each of several elements may be off the surface that
     * all stand for [mm]. Plane facets of a circle bulge by 1 - cos(theta/2) of
     * its radius, and the middle of one is 2 cos(theta/2) sin^2(theta/2) above
     * the plane of its neighbour: three times that or more, up to theta = 60
     *  degrees, from where on there is an edge. Both directions add up.
     *  Elements that are curved themselves: a twentieth. Of files three times
     *  as much, and the most of the piece, as several elements may be parts of
     *  one facet; whatever the degree of the functions, the nodes of the file
     *  say whether they are plane. */
    std::vector<double>
    errors_of_facets(const NurbsSurface &surface, const Elements &elements)
    {
      const double share =
        (elements.are_plane ? 3. : 60.) / (elements.are_of_file ? 3. : 1.);
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
      if (!elements.are_of_file)
        return result;
      std::vector<double> of_piece(surface.n_pieces(), 0.);
      for (const auto &middle : middles)
        of_piece[surface.piece(middle.element)] =
          std::max(of_piece[surface.piece(middle.element)],
                   result[middle.element]);
      for (const auto &middle : middles)
        result[middle.element] = of_piece[surface.piece(middle.element)];
      return result;
    }



    /** Heights of a piece of the slave above the master, over its area. */
    struct GapsOfPiece
    {
      double area  = 0.; ///< that faces the master [mm^2]
      double apart = 0.; ///< of gaps beyond what facets account for [mm^2]
      double sum = 0., sum_of_squares = 0.; ///< [mm^3], [mm^4]
      double facets = 0.; ///< that plane ones account for, at most [mm]
      std::vector<std::pair<SlavePoint *, Eigen::Vector3d>> gaps{};

      void
      add(const double height, const double JxW, const double facets_here)
      {
        area += JxW;
        sum += JxW * height;
        sum_of_squares += JxW * height * height;
        facets = std::max(facets, facets_here);
      }

      /** Whether the gaps are meant, and no work of facets: a hole drawn wider
       *  than the implant, or narrower for a press fit, is so all over. Facets
       *  that do not match cross each other, and where one of the bodies is
       *  smooth their heights go from 0 to a sagitta, a quarter of what they
       *  account for: the mean of a parabola is 2.2 standard deviations. */
      bool
      is_drawn(const double tolerance) const
      {
        const double mean   = sum / area,
                     square = std::max(0., sum_of_squares / area - mean * mean);
        return std::abs(mean) >
               std::max({tolerance, 0.25 * facets, 3. * std::sqrt(square)});
      }
    };
  } // namespace



  // Of files another part of the face may be nearer than that beside the point
  // before, the far wall of a hole being one, unless this one is as near as
  // points are to each other. A search over all of them for each point would
  // take longer than all else where faces are many.
  Projection
  ContactInterface::project_at_rest(const MasterSurface   &master,
                                    const SlavePoint      &point,
                                    const Eigen::Vector2d *guess) const
  {
    const Eigen::Vector3d normal =
      normal_of_slave(point, mesh[slave]->surface().control_points());
    const Projection rest = project(master, point.X, guess, &normal);
    const bool       is_near =
      rest.faces && std::abs(rest.height) < std::sqrt(point.JxW);
    return is_near || guess == nullptr ||
               mesh[master_side()]->parameters().shape != BodyShape::file ?
             rest :
             project(master, point.X, nullptr, &normal);
  }



  // Where the bodies are made, whatever the chuck and a press fit do at the
  // first time. A gap that facets account for is none: bonds would else hold,
  // and a press fit press, where meshes match only, and a twist that moves
  // faces by less would meet nothing. Bodies of files that are apart, or
  // overlap, all over a piece are meant to. Of shapes of our own gaps stay
  // without a bond or an interference, as an implant may be made larger than
  // the hole for it.
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
    const NurbsSurface &surface = mesh[master_side()]->surface(),
                       &own     = mesh[slave]->surface();
    if (surface.is_one_patch() && own.is_one_patch())
      return; // smooth
    const Elements kind(*mesh[master_side()]), kind_of_own(*mesh[slave]);
    const bool     is_of_file = kind.are_of_file || kind_of_own.are_of_file,
               has_plane      = kind.are_plane || kind_of_own.are_plane;
    const std::vector<double> errors  = errors_of_facets(surface, kind),
                              its_own = errors_of_facets(own, kind_of_own);
    const MasterSurface      master{&surface,
                               &surface.control_points(),
                               mesh[master_side()]->outward_sign()};
    std::vector<GapsOfPiece> pieces(own.n_pieces());
    // what kernels of CAD and files of meshes round to
    const double tolerance =
      is_of_file ? 1e-5 * implant().characteristic_radius() : touch_tolerance;
    double lowest = std::numeric_limits<double>::max(), highest = -lowest;
    bool   fits                  = true;
    const Eigen::Vector2d *guess = nullptr;
    for (SlavePoint &point : points)
      {
        const Projection rest      = project_at_rest(master, point, guess);
        point.accepted.has_partner = rest.faces;
        if (!rest.faces)
          continue;
        point.accepted.xi = rest.xi;
        guess             = &point.accepted.xi;
        const double facets =
          its_own[point.element] + errors[surface.element_of(rest.xi)];
        at_start.facets = std::max(at_start.facets, facets);
        if (has_plane)
          at_start.plane = at_start.facets;
        at_start.overlap = std::max(at_start.overlap, -rest.height - facets);
        fits = fits && std::abs(rest.height) <= facets + touch_tolerance;
        GapsOfPiece &piece = pieces[own.piece(point.element)];
        piece.add(rest.height, point.JxW, has_plane ? facets : 0.);
        lowest  = std::min(lowest, rest.height);
        highest = std::max(highest, rest.height);
        // G in the frame of the slave at rest [mm], with both faces where they
        // were made.
        const Eigen::Vector3d G = point.X - surface.point(rest.xi);
        if (std::abs(rest.height) <= std::max(facets, tolerance) &&
            G.norm() > touch_tolerance)
          piece.gaps.emplace_back(&point, G);
        else if (std::abs(rest.height) > tolerance)
          piece.apart += point.JxW;
      }
    const bool bonds = law.joint->pulls() || parameters.has_interference();
    for (const GapsOfPiece &piece : pieces)
      {
        const bool stays =
          is_of_file ? piece.area > 0. && piece.is_drawn(tolerance) : !bonds;
        if (is_of_file && parameters.has_interference())
          at_start.apart_area += stays ? piece.area : piece.apart;
        for (unsigned int k = 0; !stays && k < piece.gaps.size(); ++k)
          take_off(*piece.gaps[k].first, piece.gaps[k].second);
      }
    if (fits && !bonds && at_start.largest_gap == 0.)
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
    const std::vector<double> own = errors_of_facets(others, Elements(others)),
                              errors = errors_of_facets(bone, Elements(bone));
    const MasterSurface master{&bone,
                               &bone.control_points(),
                               mesh[Side::bone]->outward_sign()};
    double              sum = 0.;
    for (const auto &face : surface_quadrature(others, dealii::QMidpoint<1>()))
      {
        // the distance, as a face that goes on beside the bone's is level with
        // it
        const Projection at = project(master, face.X, nullptr);
        if (at.faces && (face.X - bone.point(at.xi)).norm() <=
                          own[face.element] + errors[bone.element_of(at.xi)] +
                            1e-6 * std::sqrt(face.JxW))
          sum += face.JxW;
      }
    return sum;
  }



  std::string
  FacesAtStart::in_words(const bool pulls) const
  {
    std::string text = pulls ?
                         "bonded in tension: " + std::to_string(n_bonded) +
                           " points, " + to_text(bonded_area, 4) + " of " +
                           to_text(bonding_area, 4) + " mm^2" :
                         "";
    const auto  add  = [&text](const std::string &more) {
      text += (text.empty() ? "" : "; ") + more;
    };
    if (largest_gap > 0.)
      add("gaps between the faces of up to " + to_text(largest_gap, 2) +
          " mm are taken off (facets account for " + to_text(facets, 2) +
          " mm)");
    if (apart_area > 0.)
      add("on " + to_text(apart_area, 4) +
          " mm^2 the faces are drawn apart, or overlap, and stay so");
    return text;
  }



  // With the thickness that the implant has at the first time. Where two faces
  // meet at an edge, walls of a post get longer, too: from the places before it
  // that would be shear.
  void
  ContactInterface::begin_thicker(const InterfaceConfiguration &configuration)
  {
    for (SlavePoint &point : points)
      if (point.accepted.has_partner)
        if (const Projection at =
              facing(point, configuration, &point.accepted.xi);
            at.faces)
          point.accepted.xi = at.xi;
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
    // its elements. Of several patches from where find_facets() found it.
    const SlavePoint *neighbour = nullptr;
    const bool        is_one    = mesh[master_side()]->surface().is_one_patch();
    for (SlavePoint &point : points)
      {
        // the guess of the search, xi of the point before
        if (is_one && neighbour != nullptr)
          point.accepted.xi = neighbour->accepted.xi;
        point.trial.normal_gap =
          project_accepted(point,
                           configuration,
                           is_one ? neighbour != nullptr :
                                    point.accepted.has_partner)
            .height;
        if (!shares.empty())
          shares[&point - points.data()].xi = point.accepted.xi;
        if (point.accepted.has_partner)
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
