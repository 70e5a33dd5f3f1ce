#include <debond/bulk/body_parameters.h>
#include <debond/geometry/nurbs_surface.h>
#include <debond/input/allowed_values.h>
#include <debond/support/input_error.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>

namespace Debond
{
  namespace
  {
    /** The entries that bone and implant have in common. */
    void
    declare_common_entries(dealii::ParameterHandler &prm,
                           const std::string        &young_modulus)
    {
      prm.declare_entry(
        "Layer grading",
        "1",
        Allowed::number_above(0, ""),
        "Exponent g that places the layers of cells along the axis: of n "
        "layers in a body of height H, layer k ends at the distance H (k/n)^g "
        "from the contact face. 1: equal layers; more than 1: thinner layers "
        "towards the interface, where the stress changes most.");
      prm.declare_entry(
        "Material",
        "neo-hookean",
        Allowed::choice("rigid | linear | neo-hookean"),
        "How the body deforms. `rigid': not at all. `linear': Hooke's law "
        "with small strains in the body's own moving frame, so that large "
        "rotations of the implant are exact. `neo-hookean': compressible "
        "Neo-Hooke with finite strains (Eq. 1 of the paper).");
      prm.declare_entry("Young modulus",
                        young_modulus,
                        Allowed::number_above(0, "MPa"),
                        "Young's modulus E [MPa]; 18 GPa is 18000. A rigid "
                        "body ignores it.");
      prm.declare_entry("Poisson ratio",
                        "0.3",
                        Allowed::number_between(0, 0.49, ""),
                        "Poisson's ratio nu, dimensionless. Trilinear cells "
                        "lock as it approaches 0.5: beyond 0.45 the program "
                        "warns, beyond 0.49 it refuses. A rigid body ignores "
                        "it.");
      prm.declare_entry(
        "Contact surface",
        "nurbs",
        Allowed::choice("nurbs | bilinear"),
        "Interpolation of the contact face. `nurbs': biquadratic NURBS with "
        "continuous normals (the disk of a coin is an exact circle). "
        "`bilinear': the faces of the ordinary cells, for comparison.");
    }



    void
    parse_common_entries(dealii::ParameterHandler &prm, BodyParameters &body)
    {
      body.layer_grading = prm.get_double("Layer grading");
      body.young_modulus = prm.get_double("Young modulus");
      body.poisson_ratio = prm.get_double("Poisson ratio");

      const std::string material = prm.get("Material");
      body.material              = material == "rigid"  ? Material::rigid :
                                   material == "linear" ? Material::linear :
                                                          Material::neo_hookean;

      body.contact_surface = prm.get("Contact surface") == "nurbs" ?
                               SurfaceKind::nurbs :
                               SurfaceKind::bilinear;
    }



    void
    parse_size(dealii::ParameterHandler &prm, BodyParameters &body)
    {
      const std::vector<double> size = to_numbers(prm.get("Size"));
      std::copy(size.begin(), size.end(), body.size.begin());
    }



    const char *
    name_of(const BodyShape shape)
    {
      return shape == BodyShape::coin ? "coin" :
             shape == BodyShape::cap  ? "cap" :
                                        "block";
    }



    /** `Cells = n, m` of a coin or a cap are n cells across the disk in both
     * directions and m along the axis; a block has three numbers. */
    void
    parse_implant_cells(dealii::ParameterHandler &prm, BodyParameters &body)
    {
      const std::string               text  = prm.get("Cells");
      const std::vector<unsigned int> cells = to_whole_numbers(text);
      if (body.is_round())
        {
          if (cells.size() != 2)
            throw InputError("Implant / Cells = '" + text + "': a " +
                             name_of(body.shape) +
                             " takes two numbers, cells across the "
                             "disk and along the axis");
          body.cells = {{cells[0], cells[0], cells[1]}};
        }
      else
        {
          if (cells.size() != 3)
            throw InputError("Implant / Cells = '" + text +
                             "': a block takes three numbers, cells in x, y "
                             "and z");
          std::copy(cells.begin(), cells.end(), body.cells.begin());
        }
    }



    /** An entry of the other shape that was changed was meant to do something:
     *  refuse it rather than ignore it. */
    void
    refuse_entries_of_other_shape(const BodyParameters &body)
    {
      const std::array<double, 3> default_size{{5, 5, 3}};
      const BodyParameters        defaults;
      if (body.is_round() && body.size != default_size)
        throw InputError(
          std::string("Implant / Size has no meaning for Shape = ") +
          name_of(body.shape) + ": give Radius and Height");
      if (body.shape != BodyShape::cap &&
          body.cap_radius != defaults.cap_radius)
        throw InputError(
          std::string("Implant / Cap radius has no meaning for Shape = ") +
          name_of(body.shape) + ", whose contact face is flat");
      if (body.shape == BodyShape::block && body.radius != defaults.radius)
        throw InputError("Implant / Radius has no meaning for Shape = block: "
                         "give Size");
      if (body.shape == BodyShape::block && body.height != defaults.height)
        throw InputError("Implant / Height has no meaning for Shape = block: "
                         "give Size");
    }
  } // namespace



  bool
  BodyParameters::is_round() const
  {
    return shape == BodyShape::coin || shape == BodyShape::cap;
  }



  double
  BodyParameters::thickness() const
  {
    return is_round() ? height : size[2];
  }



  double
  BodyParameters::width(const unsigned int direction) const
  {
    return is_round() ? 2. * radius : size[direction];
  }



  double
  BodyParameters::rise() const
  {
    return shape == BodyShape::cap ? height_on_sphere(radius, cap_radius) : 0.;
  }



  double
  BodyParameters::characteristic_radius() const
  {
    return 0.5 * std::min(width(0), width(1));
  }



  void
  BodyParameters::declare_bone(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Bone");
    prm.declare_entry("Size",
                      "12.5, 12.5, 5",
                      Allowed::numbers(3, 3, true, "mm"),
                      "Edge lengths [mm] of the block of bone in x, y and z. "
                      "Its top face is at z = 0, centred below the implant; "
                      "its bottom is held, its sides slide along themselves.");
    prm.declare_entry("Cells",
                      "15, 15, 2",
                      Allowed::whole_numbers(3, 3),
                      "Number of cells in x, y and z.");
    prm.declare_entry(
      "Lateral grading",
      "1",
      Allowed::number_above(0, ""),
      "Exponent g that places the cells across the block: their sides are at "
      "x = sign(s) |s|^g L/2 with s equally spaced from -1 to 1 and L the "
      "edge length, in y alike. 1: equal cells; more than 1: smaller cells "
      "towards the centre, under the implant.");
    declare_common_entries(prm, "18000");
    prm.leave_subsection();
  }



  void
  BodyParameters::declare_implant(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Implant");
    prm.declare_entry("Shape",
                      "coin",
                      Allowed::choice("coin | cap | block"),
                      "Shape of the implant. Its contact face touches z = 0 "
                      "with its centre at the origin; its flat top face is "
                      "held by the rigid chuck. `coin': a cylinder given by "
                      "Radius and Height. `cap': the same with a spherical "
                      "contact face of radius Cap radius. `block': a box given "
                      "by Size.");
    prm.declare_entry("Radius",
                      "2.5",
                      Allowed::number_above(0, "mm"),
                      "Radius R [mm] of a coin or a cap.");
    prm.declare_entry("Height",
                      "3",
                      Allowed::number_above(0, "mm"),
                      "Height [mm] of a coin or a cap, on its axis.");
    prm.declare_entry("Cap radius",
                      "50",
                      Allowed::number_above(0, "mm"),
                      "Radius [mm] of the sphere that is the contact face of a "
                      "cap, convex towards the bone; more than Radius. The "
                      "face meets the sphere at the Greville points of its "
                      "cells; between them its error is of third order in "
                      "their size.");
    prm.declare_entry("Size",
                      "5, 5, 3",
                      Allowed::numbers(3, 3, true, "mm"),
                      "Edge lengths [mm] of a block in x, y and z.");
    prm.declare_entry(
      "Cells",
      "3, 2",
      Allowed::whole_numbers(2, 3),
      "Number of cells. Coin and cap: two numbers, across the disk "
      "and along the axis. Block: three numbers, in x, y and z.");
    declare_common_entries(prm, "113000");
    prm.leave_subsection();
  }



  void
  BodyParameters::parse_bone(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Bone");
    shape = BodyShape::block;
    parse_size(prm, *this);
    const std::vector<unsigned int> numbers =
      to_whole_numbers(prm.get("Cells"));
    std::copy(numbers.begin(), numbers.end(), cells.begin());
    lateral_grading = prm.get_double("Lateral grading");
    parse_common_entries(prm, *this);
    prm.leave_subsection();
  }



  void
  BodyParameters::parse_implant(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Implant");
    const std::string name = prm.get("Shape");
    shape                  = name == "coin" ? BodyShape::coin :
                             name == "cap"  ? BodyShape::cap :
                                              BodyShape::block;
    radius                 = prm.get_double("Radius");
    height                 = prm.get_double("Height");
    cap_radius             = prm.get_double("Cap radius");
    parse_size(prm, *this);
    parse_common_entries(prm, *this);
    parse_implant_cells(prm, *this);
    refuse_entries_of_other_shape(*this);
    prm.leave_subsection();
  }
} // namespace Debond
