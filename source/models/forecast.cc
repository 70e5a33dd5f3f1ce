#include <debond/bulk/chuck.h>
#include <debond/models/closed_forms.h>
#include <debond/models/forecast.h>
#include <debond/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace Debond
{
  namespace
  {
    // Stiffness of the two half spaces' disk-shaped parts of the surface per
    // area, [MPa/mm]: pressed (rigid punch) and twisted (Reissner-Sagoci), the
    // implant as a bar of its height.
    double
    in_series(const double a, const double b, const double c)
    {
      return 1. / (1. / a + 1. / b + 1. / c);
    }

    double
    compliance_free(const BodyParameters &body, const double stiffness)
    {
      return body.material == Material::rigid ?
               std::numeric_limits<double>::infinity() :
               stiffness;
    }



    // Whether the law has one solution at every point, with the mean pressure
    // for that of a point.
    void
    print_uniqueness(const Scene &scene, const double p, std::ostream &out)
    {
      const InterfaceParameters &interface = scene.interface;
      const double               slope =
        interface.friction->steepest_fall({interface.bonding.initial_bonding});
      const double missing = slope * p - interface.tangential_stiffness();
      if (slope == 0. || interface.explicit_friction)
        return;
      out << "  p / eps_t " << p / interface.tangential_stiffness()
          << " mm; the friction law has one solution below " << 1. / slope
          << " mm\n";
      if (missing >= 0. && interface.viscosity == 0.)
        out << "  so the run will be refused: Interface / Viscosity, a larger "
               "Tangential penalty stiffness, "
            << interface.friction->entries_against_fall() << " helps\n";
      else if (missing >= 0.)
        out << "  so Viscosity makes it unique in steps shorter than "
            << interface.viscosity / missing << " of time\n";
    }
  } // namespace



  void
  print_forecast(const Scene &scene, std::ostream &out)
  {
    const double          R       = scene.implant.radius;
    const BodyParameters &bone    = scene.bone;
    const BodyParameters &implant = scene.implant;
    const double G_b = bone.young_modulus / (2. * (1. + bone.poisson_ratio));
    const double G_i =
      implant.young_modulus / (2. * (1. + implant.poisson_ratio));
    const double k_n = in_series(
      scene.interface.law().normal->initial_stiffness(),
      compliance_free(bone,
                      2. * bone.young_modulus /
                        ((1. - std::pow(bone.poisson_ratio, 2)) * M_PI * R)),
      compliance_free(implant, implant.young_modulus / implant.height));
    const double k_t =
      in_series(scene.interface.tangential_stiffness(),
                compliance_free(bone, 32. * G_b / (3. * M_PI * R)),
                compliance_free(implant, G_i / implant.height));

    const Chuck  chuck(scene.chuck, Eigen::Vector3d::Zero(), R);
    const auto   last = chuck.values(scene.load_steps.times.back());
    const double p =
      std::max(0.,
               scene.chuck.component[ChuckComponent::translation_z].loaded ?
                 -last[ChuckComponent::translation_z] / (M_PI * R * R) :
                 -last[ChuckComponent::translation_z] * k_n);
    out
      << "Closed forms foretell (bodies as springs in series with the interface, "
         "to some 5 %):\n"
      << "  mean pressure at the end " << p << " MPa, force "
      << p * M_PI * R * R << " N\n"
      << "  torsional stiffness while everything sticks "
      << 0.5 * M_PI * std::pow(R, 4) * k_t << " N mm/rad\n";
    print_uniqueness(scene, p, out);
    RigidBodiesTorsion::Parameters parameters;
    parameters.radius    = R;
    parameters.pressure  = p;
    parameters.stiffness = k_t;
    parameters.phi_0     = scene.interface.bonding.initial_bonding *
                       scene.interface.bonding.bonded_fraction;
    parameters.friction = scene.interface.friction;
    if (p <= 0. || scene.interface.friction->depends_on_rate() ||
        scene.chuck.component[ChuckComponent::rotation_z].loaded ||
        last[ChuckComponent::rotation_z] == 0.)
      return;
    if (!RigidBodiesTorsion::has_unique_solution(parameters))
      {
        out
          << "  no closed form of the torque: with the bodies in series the law "
             "softens too fast, and the torque may jump\n";
        return;
      }
    const RigidBodiesTorsion form(parameters);
    double                   T_max = 0.;
    for (unsigned int i = 1; i <= 1000; ++i)
      T_max = std::max(T_max,
                       std::abs(form.torque(last[ChuckComponent::rotation_z] *
                                            i / 1000)));
    out << "  largest torque " << T_max << " N mm, at the end "
        << form.torque(last[ChuckComponent::rotation_z]) << " N mm\n";
  }
} // namespace Debond
