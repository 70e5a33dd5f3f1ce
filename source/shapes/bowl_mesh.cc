#include <debond/shapes/bowl_mesh.h>
#include <debond/shapes/cell_collector.h>

#include <cmath>

namespace Debond
{
  namespace
  {
    using Point = dealii::Point<3>;
  } // namespace



  // Meridians through the poles of x and y are at equal angles, as on a cube
  // that is blown up. Where the face is less than half a sphere all is drawn
  // towards its lowest point.
  Point
  BowlFace::at(const Point &place) const
  {
    if (radius == 0.)
      return {0.5 * box[0] * place[0],
              0.5 * box[1] * place[1],
              box[2] * place[2]};
    const auto tangent = [](const double x) {
      return std::tan(0.25 * M_PI * x);
    };
    const double x = tangent(place[0]), y = tangent(place[1]),
                 across = std::hypot(x, y),
                 polar  = std::atan2(across, -tangent(place[2])) *
                         std::acos(centre / radius) / (0.5 * M_PI),
                 of_axis = across > 0. ? radius * std::sin(polar) / across : 0.;
    return {of_axis * x, of_axis * y, centre - radius * std::cos(polar)};
  }



  // Along the rim on its circle, elsewhere on a great circle.
  Point
  BowlFace::between(const Point &mean, const bool is_at_rim) const
  {
    if (radius == 0.)
      return mean;
    const Point  origin(0., 0., is_at_rim ? 0. : centre);
    const double r =
      is_at_rim ? std::sqrt(radius * radius - centre * centre) : radius;
    return origin + r / (mean - origin).norm() * (mean - origin);
  }



  double
  BowlFace::weight(const Point &p, const Point &q, const bool is_at_rim) const
  {
    const Point origin(0., 0., is_at_rim ? 0. : centre);
    return ((p - origin) + (q - origin)).norm() /
           ((p - origin).norm() + (q - origin).norm());
  }



  namespace
  {
    /** Keys: halves of layers from the inner to the outer face, and the place
     *  on the surface of half a cube, or in it where the core is. */
    class MeshOfBowl : public CellCollector
    {
    public:
      explicit MeshOfBowl(const Bowl &bowl);

    private:
      Point
      on_face(const BowlFace &face, const Key &key) const;
      Point
      position(const Key &key) const override;
      void
      add_layers(const Key                &first,
                 const std::array<int, 2> &axes,
                 const std::string        &opposite);
      void
      add_core();

      const Bowl        &bowl;
      const BowlFace    &sphere;       ///< the contact face
      const unsigned int across, deep; ///< cells of half the cube
    };



    MeshOfBowl::MeshOfBowl(const Bowl &bowl)
      : bowl(bowl)
      , sphere(bowl.contact_is_inner ? bowl.inner : bowl.outer)
      , across(bowl.cells[0] / 4)
      , deep(bowl.cells[2])
    {
      for (unsigned int i = 0; i < 2 * across; i += 2)
        {
          for (unsigned int j = 0; j < 2 * across; j += 2)
            add_layers({{0, i, j, 0}}, {{1, 2}}, bowl.bottom);
          for (unsigned int k = 0; k < 2 * deep; k += 2)
            for (const unsigned int end : {0U, 2 * across})
              {
                add_layers({{0, end, i, k}}, {{2, 3}}, bowl.sides[0]);
                add_layers({{0, i, end, k}}, {{1, 3}}, bowl.sides[1]);
              }
        }
      if (bowl.is_solid)
        add_core();
      stored.sphere_centre = Point(0., 0., sphere.centre);
      stored.sphere_radius = sphere.radius;
    }



    // Nodes in the middle of edges and faces are between the corners of these.
    Point
    MeshOfBowl::on_face(const BowlFace &face, const Key &key) const
    {
      Point        sum;
      unsigned int n = 0;
      for (const unsigned int i : {key[1] / 2, (key[1] + 1) / 2})
        for (const unsigned int j : {key[2] / 2, (key[2] + 1) / 2})
          for (const unsigned int k : {key[3] / 2, (key[3] + 1) / 2})
            {
              sum += face.at({2. * i / across - 1.,
                              2. * j / across - 1.,
                              double(k) / deep - 1.});
              ++n;
            }
      return face.between(sum / n, key[3] == 2 * deep);
    }



    Point
    MeshOfBowl::position(const Key &key) const
    {
      const Point  start = on_face(bowl.inner, key);
      const double part =
        part_of_way(key[0], bowl.cells[1], bowl.contact_is_inner, bowl.grading);
      return part == 0. ? start :
                          start + part * (on_face(bowl.outer, key) - start);
    }



    // Between both faces, over a cell of theirs that spans two coordinates of
    // keys.
    void
    MeshOfBowl::add_layers(const Key                &first,
                           const std::array<int, 2> &axes,
                           const std::string        &opposite)
    {
      const unsigned int n         = bowl.cells[1];
      const bool         is_at_rim = axes[1] == 3 && first[3] == 2 * deep - 2;
      for (unsigned int layer = 0; layer < n; ++layer)
        {
          add({{2 * layer, 0, 0}}, [&](const Place &place) {
            Key key = first;
            key[0]  = place[0];
            key[axes[0]] += place[1];
            key[axes[1]] += place[2];
            return key;
          });
          if (is_at_rim)
            name(bowl.rim, {{4, 5, 6, 7}});
          for (const unsigned int c : {0U, 1U}) // the inner and the outer face
            if (c == 0 ? layer == 0 && !bowl.is_solid : layer == n - 1)
              {
                const bool is_contact = bowl.contact_is_inner == (c == 0);
                name(is_contact ? "contact" : opposite,
                     {{c, c + 2, c + 4, c + 6}});
                for (const auto &[p, q] : {std::pair(c, c + 2),
                                           std::pair(c, c + 4),
                                           std::pair(c + 2, c + 6),
                                           std::pair(c + 4, c + 6)})
                  if (is_contact)
                    add_arc(p,
                            q,
                            sphere.weight(corner(p),
                                          corner(q),
                                          is_at_rim && p == c + 4));
              }
        }
    }



    void
    MeshOfBowl::add_core()
    {
      for (unsigned int i = 0; i < 2 * across; i += 2)
        for (unsigned int j = 0; j < 2 * across; j += 2)
          for (unsigned int k = 0; k < 2 * deep; k += 2)
            {
              add({{i, j, k}}, [](const Place &place) {
                return Key{{0, place[0], place[1], place[2]}};
              });
              if (k == 2 * deep - 2)
                name(bowl.rim, {{4, 5, 6, 7}});
            }
    }
  } // namespace



  StoredMesh
  mesh_of_bowl(const Bowl &bowl)
  {
    return std::move(MeshOfBowl(bowl).stored);
  }
} // namespace Debond
