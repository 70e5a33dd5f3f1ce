#include <debond/shapes/body_parameters.h>
#include <debond/shapes/pin.h>
#include <debond/support/number_text.h>

#include <cmath>

namespace Debond
{
  namespace
  {
    /** A pin with a thread, right-handed: turned to the left, seen from above,
     *  it comes out. */
    class Screw : public Pin
    {
    public:
      std::string
      name() const override
      {
        return "screw";
      }
      std::string
      description() const override
      {
        return "a pin with a right-handed thread, a wave with the height "
               "Thread depth from valley to crest and Radius in the middle; "
               "Pitch and Starts give its slope";
      }
      std::vector<std::string>
      entries() const override
      {
        return {"Radius",
                "Height",
                "Inner radius",
                "Pitch",
                "Thread depth",
                "Starts"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        refuse(body.thread_depth >= body.radius,
               "Thread depth",
               "the thread is deeper than the screw is thick: expected less "
               "than its Radius, " +
                 to_text(body.radius) + " mm");
        check_cells_of_side(body, body.height, body.cells, refuse);
        Pin::check(body, refuse);
      }
      void
      check_cells_of_side(const BodyParameters              &body,
                          const double                       height,
                          const std::array<unsigned int, 3> &cells,
                          const EntryCheck &refuse) const override
      {
        const double around = 4. * body.starts,
                     along  = std::ceil(4. * height / body.pitch - 1e-9);
        refuse(cells[0] < around || cells[2] < along,
               "Cells",
               "they do not show the thread, which needs four to each wave: "
               "expected at least " +
                 to_text(around) + " around and " + to_text(along) + " along");
      }

      double
      width(const BodyParameters &body, const unsigned int) const override
      {
        return 2. * body.radius + body.thread_depth;
      }
      double
      area(const BodyParameters &) const override
      {
        return 0.; // no closed form
      }
      // a helix that rises against the clock, seen from above
      double
      radius_of_side(const BodyParameters &body,
                     const double          z,
                     const double          angle) const override
      {
        return body.radius +
               0.5 * body.thread_depth *
                 std::cos(2. * M_PI * z / body.pitch - body.starts * angle);
      }
      double
      thinnest(const BodyParameters &body) const override
      {
        return body.radius - 0.5 * body.thread_depth;
      }
      bool
      is_round_about_axis() const override
      {
        return false;
      }
    };
  } // namespace



  const BodyGeometry &
  screw_geometry()
  {
    static const Screw screw;
    return screw;
  }
} // namespace Debond
