#include <debond/shapes/block_mesh.h>
#include <debond/shapes/revolved_mesh.h>

#include <cmath>

namespace Debond
{
  namespace
  {
    using Point = dealii::Point<3>;
    using Place = Block::Place;

    // A side that touches ends at both ends, where the pressure changes most.
    // Waves of a thread are as long everywhere.
    double
    height_at(const RevolvedBody &body, const unsigned int along)
    {
      const unsigned int n = body.cells[2];
      if (body.contact == RevolvedBody::Part::bottom)
        return body.lowest +
               body.height * part_of_way(along, n, true, body.grading);
      const auto from_middle = [&](const unsigned int layer) { // -1/2 to 1/2
        const double x = layer - 0.5 * n;
        return std::copysign(0.5 - 0.5 * std::pow(1. - std::abs(2. * x / n),
                                                  body.is_round ? body.grading :
                                                                  1.),
                             x);
      };
      return body.lowest +
             body.height * (0.5 + 0.5 * (from_middle(along / 2) +
                                         from_middle((along + 1) / 2)));
    }



    // Its corners are at half of the radius: cells are no slimmer in the core
    // than around it.
    Point
    in_core(const RevolvedBody &body, const Place &place)
    {
      const double across = body.cells[0] / 2, // halves of cells
        z = height_at(body, place[2]), quarter = 0.25 * body.outer(z, 0.),
                   x = 2. * place[0] / across - 1.,
                   y = 2. * place[1] / across - 1.;
      return {quarter * (x + y), quarter * (y - x), z};
    }



    // From the inner to the outer face, around and along.
    Point
    in_ring(const RevolvedBody &body, const Place &place)
    {
      using Part         = RevolvedBody::Part;
      const double z     = height_at(body, place[2]),
                   angle = M_PI * place[1] / body.cells[0] - M_PI,
                   part =
                     part_of_way(place[0],
                                 body.cells[1],
                                 body.contact == Part::inner,
                                 body.contact == Part::bottom ? 1. :
                                                                body.grading);
      const auto on_circle = [&](const RevolvedBody::Radius &radius) {
        const double r = radius(z, angle);
        return Point(r * std::cos(angle), r * std::sin(angle), z);
      };
      Point start;
      if (body.inner)
        start = on_circle(body.inner);
      else
        {
          const unsigned int across = body.cells[0] / 2,
                             side   = place[1] / across % 4,
                             on     = place[1] % across;
          const unsigned int corner[]{on, across, across - on, 0};
          start =
            in_core(body, {{corner[side], corner[(side + 3) % 4], place[2]}});
        }
      return start + part * (on_circle(body.outer) - start);
    }
  } // namespace



  StoredMesh
  mesh_of_revolution(const RevolvedBody &body)
  {
    using Part                                = RevolvedBody::Part;
    const auto &[n_around, n_radial, n_along] = body.cells;
    const auto name = [&](const Part part, const std::string &other) {
      return body.contact == part ? "contact" : other;
    };
    const std::string  bottom = name(Part::bottom, body.bottom_name);
    std::vector<Block> blocks{
      {{{n_radial, n_around, n_along}},
       [&](const Place &place) { return in_ring(body, place); },
       {{body.inner ? name(Part::inner, body.inner_name) : "",
         name(Part::outer, body.outer_name),
         "",
         "",
         bottom,
         body.top_name}}}};
    if (!body.inner)
      blocks.push_back(
        {{{n_around / 4, n_around / 4, n_along}},
         [&](const Place &place) { return in_core(body, place); },
         {{"", "", "", "", bottom, body.top_name}}});
    StoredMesh mesh = mesh_of_blocks(blocks);
    mesh.has_arcs   = body.is_round;
    return mesh;
  }
} // namespace Debond
