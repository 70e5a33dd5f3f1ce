#include <debond/shapes/mesh_builder.h>
#include <debond/shapes/revolved_mesh.h>
#include <debond/support/input_error.h>

#include <cmath>
#include <tuple>

namespace Debond
{
  namespace
  {
    using Point = dealii::Point<3>;

    /** Nodes are counted in halves of cells: from the inner to the outer face,
     *  around and along; in the core across it and along. */
    class MeshOfRevolution
    {
    public:
      explicit MeshOfRevolution(const RevolvedBody &body);

      StoredMesh stored;

    private:
      using Place = std::array<unsigned int, 3>;
      /** 0: in a ring, 1: in the core. */
      using Key = std::tuple<unsigned int, Place>;

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
        return body.height * (along / (2. * n[2]) - 1.);
      }
      double
      part_of_way(unsigned int radial) const;
      Point
      in_core(const Place &place) const;
      unsigned int
      node(Key key);
      Key
      of_ring(const Place &place) const;
      Key
      of_core(const Place &place) const;
      Point
      position(const Key &key) const;
      template <typename KeyOf>
      void
      add_cell(const Place &first, const KeyOf &key_of);
      void
      name(const std::string                  &group,
           std::initializer_list<unsigned int> corners);
      void
      name_parts(const Place &ring);

      const RevolvedBody               &body;
      const std::array<unsigned int, 3> n;
      const unsigned int                across; ///< the core, halves of cells
      std::map<Key, unsigned int>       number;
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
                add_cell({{2 * i, 2 * j, 2 * k}},
                         [&](const Place &place) { return of_ring(place); });
                name_parts({{i, j, k}});
              }
          for (unsigned int j = 0; j < across && !body.inner; j += 2)
            for (unsigned int i = 0; i < across; i += 2)
              {
                add_cell({{i, j, 2 * k}},
                         [&](const Place &place) { return of_core(place); });
                name_parts({{n[1], 0, k}});
              }
        }
    }



    // Of the way from the inner to the outer face, graded to that of contact;
    // nodes between two layers are in their middle.
    double
    MeshOfRevolution::part_of_way(const unsigned int radial) const
    {
      const auto end = [&](const unsigned int layer) {
        const double part = static_cast<double>(layer) / n[1];
        return body.contact_is_inner ? std::pow(part, body.grading) :
                                       1. - std::pow(1. - part, body.grading);
      };
      return 0.5 * (end(radial / 2) + end((radial + 1) / 2));
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



    MeshOfRevolution::Key
    MeshOfRevolution::of_ring(const Place &place) const
    {
      return {0, {{place[0], place[1] % (2 * n[0]), place[2]}}};
    }



    // Around the core it is a node of the first ring.
    MeshOfRevolution::Key
    MeshOfRevolution::of_core(const Place &place) const
    {
      const auto [x, y, z] = place;
      const int around     = y == 0      ? int(x) :
                             x == across ? int(across + y) :
                             y == across ? int(3 * across - x) :
                             x == 0      ? int(4 * across - y) :
                                           -1;
      return around < 0 ? Key{1, place} :
                          of_ring({{0, static_cast<unsigned int>(around), z}});
    }



    Point
    MeshOfRevolution::position(const Key &key) const
    {
      const auto &[is_core, place] = key;
      if (is_core == 1)
        return in_core(place);
      const double z = height(place[2]), part = part_of_way(place[0]);
      const auto   start_of = [&]() {
        if (body.inner)
          return on_circle(body.inner, z, place[1]);
        const unsigned int side = place[1] / across, on = place[1] % across;
        const unsigned int corner[]{on, across, across - on, 0};
        return in_core({{corner[side], corner[(side + 3) % 4], place[2]}});
      };
      const Point start = start_of(), end = on_circle(body.outer, z, place[1]);
      return start + part * (end - start);
    }



    unsigned int
    MeshOfRevolution::node(const Key key)
    {
      const auto found = number.emplace(key, stored.nodes.size());
      if (found.second)
        stored.nodes.push_back(position(key));
      return found.first->second;
    }



    template <typename KeyOf>
    void
    MeshOfRevolution::add_cell(const Place &first, const KeyOf &key_of)
    {
      std::vector<unsigned int> nodes, places;
      for (const Point &place : places_in_hexahedron())
        {
          places.push_back(places.size());
          Place at = first;
          for (unsigned int d = 0; d < 3; ++d)
            at[d] += std::lround(2. * place[d]);
          nodes.push_back(node(key_of(at)));
        }
      stored.add_hexahedron(nodes, places);
    }



    void
    MeshOfRevolution::name(const std::string                  &group,
                           std::initializer_list<unsigned int> corners)
    {
      if (group == "free")
        return;
      std::array<unsigned int, 4> face;
      unsigned int                i = 0;
      for (const unsigned int corner : corners)
        face[i++] = stored.hexahedra.back()[corner];
      stored.groups[group].push_back(face);
    }



    // Of the cell that was added last.
    void
    MeshOfRevolution::name_parts(const Place &cell)
    {
      if (cell[2] == 0)
        name(body.bottom, {0, 1, 2, 3});
      if (cell[2] == n[2] - 1)
        name(body.top, {4, 5, 6, 7});
      const bool is_inner = body.inner && cell[0] == 0,
                 is_outer = cell[0] == n[1] - 1;
      if (is_inner)
        name(body.contact_is_inner ? "contact" : body.opposite, {0, 2, 4, 6});
      if (is_outer)
        name(body.contact_is_inner ? body.opposite : "contact", {1, 3, 5, 7});
      // edges around, at the bottom and at the top of the contact face
      const auto &nodes = stored.hexahedra.back();
      if (body.is_round && (body.contact_is_inner ? is_inner : is_outer))
        for (const unsigned int c :
             {body.contact_is_inner ? 0 : 1, body.contact_is_inner ? 4 : 5})
          stored.arcs.push_back(
            {{{nodes[c], nodes[c + 2]}}, std::cos(M_PI / n[0])});
    }
  } // namespace



  std::shared_ptr<const FileMesh>
  mesh_of_revolution(const RevolvedBody &body, const FileRefusal &refuse)
  {
    const MeshOfRevolution made(body);
    return MeshBuilder(made.stored, refuse).mesh;
  }
} // namespace Debond
