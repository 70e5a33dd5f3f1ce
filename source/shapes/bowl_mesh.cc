#include <debond/shapes/block_mesh.h>
#include <debond/shapes/bowl_mesh.h>

#include <cmath>

namespace Debond
{
  using Point = dealii::Point<3>;



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



  namespace
  {
    // Nodes in the middle of edges and faces are between the corners of these.
    Point
    on_face(const Bowl &bowl, const BowlFace &face, const Block::Place &place)
    {
      const double across = bowl.cells[0] / 4, deep = bowl.cells[2];
      Point        sum;
      unsigned int n = 0;
      for (const unsigned int i : {place[0] / 2, (place[0] + 1) / 2})
        for (const unsigned int j : {place[1] / 2, (place[1] + 1) / 2})
          for (const unsigned int k : {place[2] / 2, (place[2] + 1) / 2})
            {
              sum += face.at({2. * i / across - 1.,
                              2. * j / across - 1.,
                              -std::pow(1. - k / deep, bowl.grading)});
              ++n;
            }
      return face.between(sum / n, place[2] == 2 * deep);
    }



    Point
    between_faces(const Bowl         &bowl,
                  const unsigned int  layer,
                  const Block::Place &place)
    {
      const Point  start = on_face(bowl, bowl.inner, place);
      const double part =
        part_of_way(layer, bowl.cells[1], bowl.contact_is_inner, bowl.grading);
      return part == 0. ?
               start :
               start + part * (on_face(bowl, bowl.outer, place) - start);
    }
  } // namespace



  // Layers from the inner to the outer face over the bottom and the four sides
  // of half a cube, and the core, if there is one.
  StoredMesh
  mesh_of_bowl(const Bowl &bowl)
  {
    using Place               = Block::Place;
    const unsigned int across = bowl.cells[0] / 4, deep = bowl.cells[2];
    std::vector<Block> blocks;
    const auto         add_layers = [&](const Place       &first,
                                const unsigned int axis_1,
                                const unsigned int axis_2,
                                const std::string &opposite) {
      const std::string inner = bowl.is_solid         ? "" :
                                        bowl.contact_is_inner ? "contact" :
                                                                opposite,
                        outer = bowl.contact_is_inner ? opposite : "contact",
                        rim = axis_2 == 2 ? bowl.rim : "";
      blocks.push_back({{{bowl.cells[1], across, axis_2 == 2 ? deep : across}},
                        [=, &bowl](const Place &place) {
                          Place on_cube = first;
                          on_cube[axis_1] += place[1];
                          on_cube[axis_2] += place[2];
                          return between_faces(bowl, place[0], on_cube);
                        },
                        {{inner, outer, "", "", "", rim}}});
    };
    add_layers({{0, 0, 0}}, 0, 1, bowl.bottom);
    for (const unsigned int end : {0U, 2 * across})
      {
        add_layers({{end, 0, 0}}, 1, 2, bowl.sides[0]);
        add_layers({{0, end, 0}}, 0, 2, bowl.sides[1]);
      }
    if (bowl.is_solid)
      blocks.push_back(
        {{{across, across, deep}},
         [&](const Place &place) { return on_face(bowl, bowl.inner, place); },
         {{"", "", "", "", "", bowl.rim}}});
    StoredMesh      mesh   = mesh_of_blocks(blocks);
    const BowlFace &sphere = bowl.contact_is_inner ? bowl.inner : bowl.outer;
    mesh.sphere_centre     = Point(0., 0., sphere.centre);
    mesh.sphere_radius     = sphere.radius;
    mesh.has_arcs          = true;
    return mesh;
  }
} // namespace Debond
