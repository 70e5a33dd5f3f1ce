#include <debond/shapes/cell_collector.h>
#include <debond/shapes/revolved_mesh.h>

#include <cmath>
#include <tuple>

namespace Debond
{
  namespace
  {
    using Point = dealii::Point<3>;

    /** Nodes are counted from the inner to the outer face, around and along; in
     *  the core across it and along. The first number of a key is 1 there. */
    class MeshOfRevolution : public CellCollector
    {
    public:
      explicit MeshOfRevolution(const RevolvedBody &body);

    private:
      Point
      on_circle(const RevolvedBody::Radius &radius,
                const double                z,
                const unsigned int          around) const
      {
        const double angle = 2. * M_PI * around / (2 * n[0]) - M_PI,
                     r     = radius(z, angle);
        return {r * std::cos(angle), r * std::sin(angle), z};
      }
      double
      height(const unsigned int along) const
      {
        return body.lowest +
               body.height * (body.contact == RevolvedBody::Part::bottom ?
                                part_of_way(along, n[2], true, body.grading) :
                                along / (2. * n[2]));
      }
      Point
      in_core(const Place &place) const;
      Key
      of_ring(const Place &place) const;
      Key
      of_core(const Place &place) const;
      Point
      position(const Key &key) const override;
      void
      name_parts(const Place &ring);

      const RevolvedBody               &body;
      const std::array<unsigned int, 3> n;
      const unsigned int                across; ///< the core, halves of cells
    };



    MeshOfRevolution::MeshOfRevolution(const RevolvedBody &body)
      : body(body)
      , n(body.cells)
      , across(n[0] / 2)
    {
      for (unsigned int k = 0; k < n[2]; ++k)
        {
          for (unsigned int j = 0; j < n[0]; ++j)
            for (unsigned int i = 0; i < n[1]; ++i)
              {
                add({{2 * i, 2 * j, 2 * k}},
                    [&](const Place &place) { return of_ring(place); });
                name_parts({{i, j, k}});
              }
          for (unsigned int j = 0; j < across && !body.inner; j += 2)
            for (unsigned int i = 0; i < across; i += 2)
              {
                add({{i, j, 2 * k}},
                    [&](const Place &place) { return of_core(place); });
                name_parts({{n[1], 0, k}});
              }
        }
    }



    // Its corners are at half of the radius: cells are no slimmer in the core
    // than around it.
    Point
    MeshOfRevolution::in_core(const Place &place) const
    {
      const double z = height(place[2]), quarter = 0.25 * body.outer(z, 0.),
                   x = 2. * place[0] / across - 1.,
                   y = 2. * place[1] / across - 1.;
      return {quarter * (x + y), quarter * (y - x), z};
    }



    CellCollector::Key
    MeshOfRevolution::of_ring(const Place &place) const
    {
      return {{0, place[0], place[1] % (2 * n[0]), place[2]}};
    }



    // Around the core it is a node of the first ring.
    CellCollector::Key
    MeshOfRevolution::of_core(const Place &place) const
    {
      const auto [x, y, z] = place;
      const int around     = y == 0      ? int(x) :
                             x == across ? int(across + y) :
                             y == across ? int(3 * across - x) :
                             x == 0      ? int(4 * across - y) :
                                           -1;
      return around < 0 ? Key{{1, x, y, z}} :
                          of_ring({{0, static_cast<unsigned int>(around), z}});
    }



    Point
    MeshOfRevolution::position(const Key &key) const
    {
      const auto [is_core, radial, around, along] = key;
      if (is_core == 1)
        return in_core({{radial, around, along}});
      const double z = height(along);
      const double part =
        part_of_way(radial,
                    n[1],
                    body.contact == RevolvedBody::Part::inner,
                    body.contact == RevolvedBody::Part::bottom ? 1. :
                                                                 body.grading);
      Point start;
      if (body.inner)
        start = on_circle(body.inner, z, around);
      else
        {
          const unsigned int side = around / across, on = around % across;
          const unsigned int corner[]{on, across, across - on, 0};
          start = in_core({{corner[side], corner[(side + 3) % 4], along}});
        }
      return start + part * (on_circle(body.outer, z, around) - start);
    }



    // Of the cell that was added last. Two corners of a face are at one end
    // around, two at the other: edges between them are arcs.
    void
    MeshOfRevolution::name_parts(const Place &cell)
    {
      using Part           = RevolvedBody::Part;
      using Corners        = std::array<unsigned int, 4>;
      const auto from_axis = [&] { // of its bottom
        const Point middle = position({{0, 2 * cell[0] + 1, 0, 0}});
        return std::hypot(middle[0], middle[1]);
      };
      for (const auto &[part, is_there, group, corners] :
           {std::make_tuple(Part::bottom,
                            cell[2] == 0 && from_axis() >= body.bottom_from,
                            body.bottom_name,
                            Corners{{0, 1, 2, 3}}),
            std::make_tuple(Part::inner,
                            body.inner && cell[0] == 0,
                            body.inner_name,
                            Corners{{0, 4, 2, 6}}),
            std::make_tuple(Part::outer,
                            cell[0] == n[1] - 1,
                            body.outer_name,
                            Corners{{1, 5, 3, 7}})})
        if (is_there)
          {
            const bool is_contact = body.contact == part;
            name(is_contact ? "contact" : group, corners);
            for (unsigned int k = 0; k < 2 && is_contact && body.is_round; ++k)
              add_arc(corners[k], corners[k + 2], std::cos(M_PI / n[0]));
          }
      if (cell[2] == n[2] - 1)
        name(body.top_name, {{4, 5, 6, 7}});
    }
  } // namespace



  StoredMesh
  mesh_of_revolution(const RevolvedBody &body)
  {
    return std::move(MeshOfRevolution(body).stored);
  }
} // namespace Debond
