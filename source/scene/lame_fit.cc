#include <debond/input/expression_parser.h>
#include <debond/scene/lame_fit.h>
#include <debond/scene/scene.h>

#include <cmath>

// Lame's tube and sphere, with the radial displacements A r + B/r and A r +
// B/r^2. Compliances are displacements of the face per pressure on it.
namespace Debond
{
  namespace
  {
    /** A body with the contact face at the radius a [mm] and another one at c
     *  (0: there is none) has the radial stress K A - G B/r^n. */
    double
    compliance(const double K,
               const double G,
               const double n,
               const double a,
               const double c,
               const bool   is_held)
    {
      const double q = std::pow(c / a, n);
      return c == 0. ? a / K :
             is_held ? a * std::abs(1. - q) / (K + G * q) :
                       a * (1. + K / G * q) / (K * std::abs(1. - q));
    }



    double
    of_tube(const BodyParameters &body,
            const bool            keeps_length,
            const double          a,
            const double          c,
            const bool            is_held)
    {
      const double E = body.young_modulus, nu = body.poisson_ratio;
      return body.is_rigid() ?
               0. :
               compliance(E / (keeps_length ? (1. + nu) * (1. - 2. * nu) :
                                              1. - nu),
                          E / (1. + nu),
                          2.,
                          a,
                          c,
                          is_held);
    }



    double
    of_sphere(const BodyParameters &body,
              const double          a,
              const double          c,
              const bool            is_held)
    {
      const double E = body.young_modulus, nu = body.poisson_ratio;
      return body.is_rigid() ?
               0. :
               compliance(
                 E / (1. - 2. * nu), 2. * E / (1. + nu), 3., a, c, is_held);
    }
  } // namespace



  std::optional<LameFit>
  lame_fit(const Scene &scene)
  {
    const BodyParameters &bone = scene.bone, &implant = scene.implant;
    const double          a = implant.radius, b = bone.outer_radius;
    const bool            is_pin = implant.shape == BodyShape::pin &&
                        bone.shape == BodyShape::sleeve,
               is_cup = implant.shape == BodyShape::cup &&
                        bone.shape == BodyShape::cavity && b > 0. &&
                        implant.height == a;
    if (!scene.interface.has_interference() || bone.modulus ||
        !(is_pin || is_cup))
      return {};
    LameFit fit;
    fit.half_interference =
      0.5 * read_time_function(scene.interface.interference,
                               implant.characteristic_radius())(
              scene.load_steps.times.back());
    fit.interface = 1. / scene.interface.normal_penalty;
    // Plates keep the length of a tube and let its ends slide; glued to them
    // they cannot.
    const bool is_glued = bone.ends == "axial" || bone.ends == "held";
    if (is_pin)
      {
        fit.bodies =
          of_tube(bone, !bone.ends.empty(), a, b, bone.support_radius == 0.) +
          of_tube(implant, false, a, implant.inner_radius, false);
        fit.area  = 2. * M_PI * a * implant.height;
        fit.arm   = a;
        fit.error = is_glued ? 0.5 : bone.ends.empty() ? 0.1 : 0.02;
      }
    else
      {
        fit.bodies = of_sphere(bone, a, b, true) +
                     of_sphere(implant, a, implant.inner_radius, false);
        fit.area  = 2. * M_PI * a * a;
        fit.arm   = 0.25 * M_PI * a;
        fit.error = bone.ends == "slides z" ? 0.02 : 0.2;
      }
    // the chuck holds the implant's top
    if (!implant.is_rigid())
      fit.error += 0.05;
    if (!(fit.half_interference > 0.))
      return {};
    return fit;
  }
} // namespace Debond
