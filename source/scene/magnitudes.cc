#include <debond/scene/magnitudes.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <cmath>
#include <string>

namespace Debond
{
  namespace
  {
    /** What a quantity may be, apart from 0 where an entry allows it. */
    struct Range
    {
      double      lower, upper;
      const char *unit;
    };

    // Far beyond any implant, and far from what a double can hold even to the
    // fourth power.
    constexpr Range length{1e-6, 1e6, " mm"};
    constexpr Range radius_of_sphere{1e-6, 1e9, " mm"};
    constexpr Range modulus{1e-6, 1e12, " MPa"};
    constexpr Range pressure{1e-9, 1e12, " MPa"};
    constexpr Range interface_stiffness{1e-6, 1e15, " MPa/mm"};
    constexpr Range viscosity{1e-15, 1e15, ""};
    constexpr Range machine{1e-9, 1e18, ""};
    constexpr Range angle{1e-9, 1e6, " deg"};
    constexpr Range energy{1e-12, 1e12, " N/m"};



    void
    check(const std::string &entry, const double value, const Range &range)
    {
      if (value != 0. && !(value >= range.lower && value <= range.upper))
        throw InputError(entry + ": " + to_text(value) + range.unit +
                         " cannot be computed with: expected " +
                         to_text(range.lower) + " to " + to_text(range.upper) +
                         range.unit + "; are unit and exponent right?");
    }



    void
    check_body(const BodyParameters &body, const std::string &section)
    {
      for (const double size : body.size)
        check(section + "Size", size, length);
      check(section + "Radius", body.radius, length);
      check(section + "Height", body.height, length);
      check(section + "Cap radius", body.cap_radius, radius_of_sphere);
      check(section + "Young modulus", body.young_modulus, modulus);
    }



    void
    check_interface(const InterfaceParameters &interface)
    {
      const std::string section = "Interface / ";
      check(section + "Penalty stiffness",
            interface.normal_penalty,
            interface_stiffness);
      check(section + "Tangential penalty stiffness",
            interface.tangential_penalty,
            interface_stiffness);
      check(section + "Viscosity", interface.viscosity, viscosity);
      for (const LawMagnitude &law : interface.friction->magnitudes())
        check(section + law.entry, law.value, {law.lower, law.upper, law.unit});
    }



    void
    check_closed_form(const ClosedFormParameters &closed_form)
    {
      const std::string section = "Closed form / ";
      check(section + "Pressure", closed_form.pressure, pressure);
      check(section + "Normal stiffness",
            closed_form.normal_stiffness,
            interface_stiffness);
      check(section + "Torsional stiffness",
            closed_form.torsional_stiffness,
            interface_stiffness);
      check(section + "Linear limit angle", closed_form.linear_limit, angle);
      check(section + "Full sliding angle", closed_form.full_sliding, angle);
      check(section + "Shear modulus", closed_form.shear_modulus, modulus);
      check(section + "Adhesion energy", closed_form.adhesion_energy, energy);
    }
  } // namespace



  void
  check_magnitudes(const Scene &scene)
  {
    check_body(scene.bone, "Bone / ");
    check_body(scene.implant, "Implant / ");
    check_interface(scene.interface);
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      check(std::string("Chuck / ") + ChuckParameters::names[k] +
              " / Stiffness",
            scene.chuck.component[k].stiffness,
            machine);
    check_closed_form(scene.closed_form);
  }



  void
  check_chuck_value(const double value, const bool is_load, const double time)
  {
    const double largest = is_load ? 1e12 : 1e6;
    if (std::abs(value) > largest)
      throw InputError("it is " + to_text(value) + " at t = " + to_text(time) +
                       ": expected at most " + to_text(largest) +
                       (is_load ? " N or N mm" : " mm or degrees"));
  }
} // namespace Debond
