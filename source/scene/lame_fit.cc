#include <debond/input/expression_parser.h>
#include <debond/scene/lame_fit.h>
#include <debond/scene/scene.h>

#include <algorithm>
#include <cmath>

// Lame's tube and sphere, with the radial displacements A r + B/r and A r +
// B/r^2. Compliances are displacements of the face per pressure on it.
namespace Debond
{
  namespace
  {
    /** A body with the contact face at the radius a [mm] and another one at c
     *  (0: there is none) has the radial stress E (K A - G B/r^n). */
    double
    compliance(const BodyParameters &body,
               const double          K,
               const double          G,
               const double          n,
               const double          a,
               const double          c,
               const bool            is_held)
    {
      if (body.is_rigid())
        return 0.;
      const double q = std::pow(c / a, n);
      return (c == 0. ? a / K :
              is_held ? a * std::abs(1. - q) / (K + G * q) :
                        a * (1. + K / G * q) / (K * std::abs(1. - q))) /
             body.young_modulus;
    }



    double
    of_tube(const BodyParameters &body,
            const bool            keeps_length,
            const double          a,
            const double          c,
            const bool            is_held)
    {
      const double nu = body.poisson_ratio;
      return compliance(body,
                        1. /
                          (keeps_length ? (1. + nu) * (1. - 2. * nu) : 1. - nu),
                        1. / (1. + nu),
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
      const double nu = body.poisson_ratio;
      return compliance(
        body, 1. / (1. - 2. * nu), 2. / (1. + nu), 3., a, c, is_held);
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
    LameFit    fit;
    const auto excess     = read_time_function(scene.interface.interference,
                                           implant.characteristic_radius());
    const auto times      = scene.load_steps.planned_times();
    fit.half_interference = 0.5 * excess(times.back());
    fit.changes =
      std::any_of(times.begin(),
                  times.end(),
                  [&](const double time) {
                    return excess(time) != excess(times.back());
                  }) ||
      (bone.sleeve_height > 0. && bone.sleeve_height < implant.height);
    fit.interface = 1. / scene.interface.normal_penalty;
    double of_bone, of_implant, error_of_bone;
    if (is_pin)
      {
        // Plates keep the length of a tube. Without them it is between that and
        // one that is free to become longer.
        const auto tube = [&](const bool keeps_length) {
          return of_tube(bone, keeps_length, a, b, bone.support_radius == 0.);
        };
        const bool slides = bone.ends == "slides z";
        of_bone = slides ? tube(true) : 0.5 * (tube(true) + tube(false));
        // ends that are glued, and a bottom on a plate, do not widen
        error_of_bone =
          bone.ends == "axial" || bone.ends == "held" ||
              bone.support_radius > 0. ?
            2. :
            0.02 + of_bone / std::min(tube(true), tube(false)) - 1.;
        of_implant = of_tube(implant, false, a, implant.inner_radius, false);
        fit.area   = 2. * M_PI * a * implant.height;
        fit.arm    = a;
      }
    else
      {
        of_bone       = of_sphere(bone, a, b, true);
        error_of_bone = bone.ends == "slides z" ? 0.02 : 0.2;
        of_implant    = of_sphere(implant, a, implant.inner_radius, false);
        fit.area      = 2. * M_PI * a * a;
        fit.arm       = 0.25 * M_PI * a;
      }
    fit.bodies = of_bone + of_implant;
    // the chuck holds the implant's top, which makes it stiffer
    fit.error = fit.bodies > 0. ?
                  (error_of_bone * of_bone + 0.8 * of_implant) / fit.bodies :
                  0.;
    if (!(fit.half_interference > 0.))
      return {};
    return fit;
  }
} // namespace Debond
