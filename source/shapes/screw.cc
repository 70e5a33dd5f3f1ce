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
        return "a pin with a right-handed thread, a wave of the height Thread "
               "depth from its valley to its crest, with Radius half way; "
               "Pitch and Starts say how steep it is";
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
        Pin::check(body, refuse);
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
