#include <debond/input/entry_table.h>
#include <debond/shapes/body_mesh.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/input_error.h>

#include <regex>
#include <tuple>
#include <utility>

namespace Debond
{
  const ShapeRow &
  BodyParameters::shape_row() const
  {
    return shape_rows()[static_cast<unsigned int>(shape)];
  }



  std::array<unsigned int, 3>
  BodyParameters::lattice_of_cells() const
  {
    return mesh ? mesh->lattice_of_cells() : cells;
  }



  BodyParameters
  BodyParameters::default_implant()
  {
    BodyParameters implant;
    implant.shape         = BodyShape::coin;
    implant.size          = {{5, 5, 3}};
    implant.cells         = {{3, 3, 2}};
    implant.young_modulus = 113000;
    return implant;
  }



  namespace
  {
    // far beyond any implant, and far from what a double can hold even to the
    // fourth power
    const AllowedValues allowed_length =
      Allowed::number_between(1e-6, 1e6, "mm");
    const AllowedValues allowed_grading = Allowed::number_above(0, "");


    void
    declare_grading(BodyParameters &bone, EntryTable &table)
    {
      table.add(
        "Expert / Lateral grading",
        bone.lateral_grading,
        allowed_grading,
        "Grading exponent g of the cells across the block: their sides are "
        "at x = sign(s) |s|^g L/2, with s equally spaced from -1 to 1 and "
        "the edge length L; the same in y. 1: equal cells. More than 1: "
        "smaller cells at the centre, under the implant.");
      table.add(
        "Expert / Cells under implant",
        bone.cells_under_implant,
        Allowed::whole_number(1, 1000000000).or_word_for("none", "0"),
        "Number of cells across that lie under the implant, within its rim; "
        "the others are divided equally between both sides. Cells become "
        "smaller towards the rim, where the pressure changes most. `none': "
        "cells do not follow the rim. For Element = spline or quadratic; "
        "trilinear cells become too stiff below the rim.");
      table.add(
        "Expert / Rim grading",
        bone.rim_grading,
        allowed_grading,
        "Grading exponent g of cells that follow the rim: their sides are at "
        "the distances R s^g from it inside, and (L/2 - R) s^g outside, with "
        "s equally spaced from 0 to 1, the radius R of the implant and the "
        "edge length L.");
    }


    void
    declare_solver(BodyParameters &bone, EntryTable &table)
    {
      table.add(
        "Expert / Solver",
        bone.bulk_solver,
        Allowed::choice("auto | direct | lattice | multigrid"),
        "How the linear equations of the bone are solved. `direct': sparse "
        "factorisation, condensed on the contact face. `lattice': sines and "
        "cosines across the block; exact for a bone of splines with cells of "
        "equal width, and fast. Its sides carry no shear then, which is the "
        "limit of sliding sides as cells become smaller. A Neo-Hookean bone "
        "keeps the stiffness at rest in the iterations, which converge to the "
        "same solution as long as strains are small. `multigrid': iterations "
        "on the whole system with algebraic multigrid, for bones too large to "
        "be factorised, on any number of processes (mpirun). `auto': multigrid "
        "on several processes; lattice where it is possible, the implant stays "
        "away from the sides, and strains of a Neo-Hookean bone are below some "
        "1 %; else direct, or multigrid where factors would not fit into "
        "memory.");
    }



    void
    declare_thread(BodyParameters &implant, EntryTable &table)
    {
      table.add(
        "Pitch",
        implant.pitch,
        allowed_length.without_default(),
        "Distance [mm] along the axis between neighbouring crests of the "
        "thread of a screw, which comes out by Pitch times Starts in a turn. "
        "Before it turns, torques without friction are 0.5 % off with four "
        "cells along it, 0.07 % with six.");
      table.add("Thread depth",
                implant.thread_depth,
                allowed_length.without_default(),
                "Height [mm] of the thread of a screw.");
      table.add("Starts",
                implant.starts,
                Allowed::whole_number(1, 100),
                "Number of threads of a screw.");
    }
  } // namespace



  void
  BodyParameters::declare_bone(EntryTable &table)
  {
    table.enter_subsection("Bone");
    declare_shape(table, true);
    table.add("Size",
              size,
              Allowed::list(allowed_length, 3, 3).without_default(),
              "Edge lengths [mm] of the block of bone in x, y and z. Its top "
              "face is at z = 0, with its centre at the origin; its bottom is "
              "held, its sides move in their own planes only.");
    table.add("Outer radius",
              outer_radius,
              AllowedValues(allowed_length).or_word_for("none", "0"),
              "Outer radius [mm] of a sleeve, or of a cavity that is a "
              "shell; the inner radius is that of the implant. `none': a "
              "cavity is a block.");
    table.add("Height",
              sleeve_height,
              AllowedValues(allowed_length).or_word_for("auto", "0"),
              "Height [mm] of a sleeve, downwards from its top at z = 0. "
              "`auto': that of the implant.");
    table.add(
      "Ends",
      ends.empty()       ? "free" :
      ends == "slides z" ? "slide" :
                           ends,
      [this](const std::string &text) {
        ends = text == "free" ? "" : text == "slide" ? "slides z" : text;
      },
      Allowed::choice("free | slide | axial | held"),
      "How top and bottom of a sleeve, or the top of a cavity, are held. "
      "`free': not at all. `slide': they do not move along the axis. "
      "`axial': they move along the axis only. `held': they do not move.");
    table.add("Support radius",
              support_radius,
              AllowedValues(allowed_length).or_word_for("none", "0"),
              "Radius [mm] of the hole in a plate on which a sleeve stands, "
              "as in push-out tests: cells of its bottom whose centre is "
              "beyond this radius are held, and its outer face is free. "
              "`none': no plate, the outer face is held.");
    declare_cells(
      table,
      true,
      "Number of cells in x, y and z. Of a sleeve: around (8 or more), "
      "radially and along its axis. Of a cavity: around (8, 12, ...), radially "
      "and along a meridian, from a square at the bottom, a quarter of those "
      "around across, to the rim. `fitted a, i, o, l': cells of a block that "
      "follow the rim of a coin, cap or ring: a (a multiple of 4) around it, i "
      "from a square core to the rim, o from there to the sides, in l layers, "
      "smaller towards the rim and the contact face; below a ring i from the "
      "core to its hole, and i across its wall. `fitted': 16, 6, 10, 9. "
      "`auto': as Accuracy needs, without it 15, 15, 2. Fitted cells are for "
      "Element = spline and save time where the interface is stiff.");
    declare_grading(*this, table);
    declare_solver(*this, table);
    declare_material(table, true);
    table.leave_subsection();
  }



  void
  BodyParameters::declare_implant(EntryTable &table)
  {
    table.enter_subsection("Implant");
    declare_shape(table, false);
    table.add(
      "Radius",
      radius,
      allowed_length.without_default(),
      "Radius R [mm] of a coin, cap, ring or pin; of a taper at z = 0; of a "
      "screw in the middle between crest and valley; of a cup that of its "
      "sphere.");
    table.add(
      "Inner radius",
      inner_radius,
      AllowedValues(allowed_length).or_number(0),
      "Inner radius [mm] of a hollow pin or cup, or of a ring. 0: solid.");
    table.add("Taper angle",
              taper_angle,
              Allowed::number_between(0, 60, "degrees").without_default(),
              "Angle [deg] between the side of a taper and its axis, half "
              "the opening angle of the cone; the taper is thinner at its "
              "lower end.");
    declare_thread(*this, table);
    table.add("Height",
              height,
              allowed_length.without_default(),
              "Height [mm] on the axis of a coin, cap or ring; along it of a "
              "pin, taper or screw; of a cup its depth, at most its Radius.");
    table.add("Cap radius",
              cap_radius,
              Allowed::number_between(1e-6, 1e9, "mm").without_default(),
              "Radius [mm] of the sphere that is the contact face of a cap, "
              "convex towards the bone; more than Radius. The face meets the "
              "sphere at the Greville points of its cells; between them its "
              "error is of third order in their size.");
    table.add("Expert / Contact radius",
              contact_radius,
              AllowedValues(allowed_length).or_word_for("auto", "0"),
              "Radius [mm] of the circle within a cap that fitted cells of cap "
              "and bone follow: where contact ends. `auto': with Accuracy as "
              "for half spaces and the normal stiffness under the largest "
              "press, else Radius.");
    table.add("Size",
              size,
              Allowed::list(allowed_length, 3, 3).without_default(),
              "Edge lengths [mm] of a block in x, y and z.");
    declare_cells(
      table,
      false,
      "Number of cells in x, y and z. Two numbers n, m mean n, n, m: of a "
      "coin or cap n across the disk and m along the axis. Of a pin and a "
      "ring: around (8 or more, of a solid one 8, 12, ...), radially and "
      "along the axis. Of a cup: as Bone / Cells of a cavity. `fitted a, i, l': "
      "cells of a coin, cap or ring that follow its rim, as Bone / Cells; of a "
      "cap i more beyond its contact radius. `fitted': 12, 5, 5. `auto': as Accuracy needs, without it 3, 2.");
    declare_material(table, false);
    table.leave_subsection();
  }



  void
  BodyParameters::declare_shape(EntryTable &table, const bool is_bone)
  {
    std::string names,
      text = is_bone ? "Shape of the bone. " :
                       "Shape of the implant. The contact face of coin, cap, "
                       "block and ring touches the bone at z = 0, with its "
                       "centre at the origin; pin, taper, screw and cup are "
                       "in the bone. The chuck, which is rigid, holds the "
                       "flat top. ";
    for (const ShapeRow &each : shape_rows())
      if (is_bone ? each.is_for_bone : each.is_for_implant)
        {
          names += (names.empty() ? "" : " | ") + each.name;
          text += "`" + each.name + "': " + each.description + ". ";
        }
    text.pop_back();
    table.add(
      "Shape",
      shape_row().name,
      [this](const std::string &name) {
        for (unsigned int k = 0; k < shape_rows().size(); ++k)
          if (shape_rows()[k].name == name)
            shape = static_cast<BodyShape>(k);
      },
      Allowed::choice(names),
      text);
    const auto file =
      Allowed::text("the name of a file of hexahedra or tetrahedra", false)
        .or_word_for("none", "");
    table.add(
      "Mesh file",
      mesh_file,
      file,
      "File with the hexahedra or tetrahedra of the body, for Shape = file: Gmsh "
      "(.msh) or Abaqus (.inp), relative to the working directory. Lengths are in mm, the contact face is near z = 0, "
      "the chuck on the z axis. Groups of faces have these names: "
      "contact; held; slides x, slides y, slides z (held along it only); axial (moves along z only). Others are free.");
    table.add(
      "Expert / Coarser mesh file",
      coarser_mesh_file,
      file,
      "The body with cells 1.5 times as long, for the estimate of the error. "
      "`none': trilinear cells of Mesh file, with tetrahedra slower than the run.");
  }



  void
  BodyParameters::declare_modulus(EntryTable &table, const bool is_bone)
  {
    const std::string   what = "Young's modulus E [MPa]; 18 GPa is 18000.";
    const AllowedValues number =
      Allowed::number_between(1e-6, 1e12, "MPa").without_default();
    if (!is_bone)
      {
        table.add("Young modulus",
                  young_modulus,
                  number,
                  what + " Not used by a rigid body.");
        return;
      }
    // what names no place is a number, maybe with a mistake
    static const std::regex place(
      "(^|[^A-Za-z_])(x|y|z|[Gg][Rr][EeAa][Yy])([^A-Za-z_]|$)");
    const auto is_expression = [](const std::string &text) {
      return std::regex_search(text, place);
    };
    AllowedValues number_or_expression = number;
    number_or_expression.test = [number, is_expression](const auto &text) {
      return is_expression(text) || number.test(text);
    };
    number_or_expression.description +=
      ", or an expression in x, y, z [mm] and, with a Voxel file, grey";
    table.add(
      "Young modulus",
      modulus_expression.empty() ? entry_text(young_modulus) :
                                   modulus_expression,
      [this, is_expression](const std::string &text) {
        modulus_expression = is_expression(text) ? text : "";
        if (modulus_expression.empty())
          read_entry(text, young_modulus);
      },
      number_or_expression,
      what +
        " Or an expression in the position x, y, z [mm], with z = 0 at the top "
        "and negative below, and R, half the width of the implant (the shorter "
        "one): if(z > -1, 18000, 500) is a cortical layer of 1 mm. With a "
        "Voxel file also in its grey value: max(10, 6850 * max(0, grey / "
        "1000)^1.49). It is evaluated at the Gauss points of the cells, or "
        "averaged over the voxels around them: let it jump at sides of cells. "
        "Not used by a rigid body.");
    table.add(
      "Voxel file",
      voxel_file,
      Allowed::text("the name of a file of voxels", false)
        .or_word_for("none", ""),
      "File with a grey value for each voxel of the bone, such as a "
      "CT image, relative to the working directory: MetaImage (.mhd, "
      ".mha), or CSV with columns x,y,z,grey of the centres [mm]. Young modulus says how grey values "
      "become moduli. `none': no voxels.");
    const AllowedValues places = Allowed::list(Allowed::number("mm"), 3, 3);
    table.add("Expert / Voxel corner",
              voxel_corner,
              places.or_word("centred").or_word("file"),
              "Position x, y, z [mm] of the lowest corner of the grid of "
              "voxels. `centred': the implant is in the middle of the grid, "
              "and the top of the grid is the top of the bone. `file': as "
              "the file says. Axes of MetaImage: x to the patient's left, y "
              "to the back, z to the head.");
  }



  void
  BodyParameters::read_modulus(const double radius)
  {
    modulus.reset();
    if (modulus_expression.empty() && !voxel_file.empty())
      throw EntryError("Bone / Voxel file",
                       "Young modulus is a number: expected an expression of "
                       "the grey value, grey",
                       voxel_file);
    if (modulus_expression.empty())
      return;
    std::shared_ptr<const VoxelImage> image;
    std::array<double, 3>             corner{};
    if (!voxel_file.empty())
      {
        image = read_voxel_image(voxel_file, "Bone / Voxel file");
        if (voxel_corner == "file")
          corner = image->corner;
        else if (voxel_corner == "centred")
          corner = {{-0.5 * image->length(0),
                     -0.5 * image->length(1),
                     -image->length(2)}};
        else
          read_entry(voxel_corner, corner);
      }
    const Eigen::Vector3d half(0.5 * size[0], 0.5 * size[1], 0.);
    ModulusField::Box bone{{-half - size[2] * Eigen::Vector3d::UnitZ(), half}};
    for (unsigned int d = 0; mesh && d < 3; ++d)
      {
        bone[0][d] = mesh->box.lower_bound(d);
        bone[1][d] = mesh->box.upper_bound(d);
      }
    modulus = std::make_shared<ModulusField>(
      modulus_expression, std::move(image), corner, radius, bone);
    young_modulus = modulus->range.mean;
  }



  double
  BodyParameters::softest_modulus() const
  {
    return modulus ? modulus->range.smallest : young_modulus;
  }



  namespace
  {
    void
    declare_strengths(BodyParameters &bone, EntryTable &table)
    {
      for (const auto &[name, strength, is_beyond] :
           {std::tuple("Tensile strength",
                       &bone.tensile_strength,
                       "the largest principal stress is above it"),
            {"Compressive strength",
             &bone.compressive_strength,
             "the smallest principal stress is below minus it"}})
        table.add(
          name,
          *strength,
          Allowed::number_between(1e-9, 1e9, "MPa").or_word_for("none", "0"),
          std::string("Strength [MPa] of the bulk of the bone: the run "
                      "says when, where and in how much volume ") +
            is_beyond + ", and goes on with elastic bone. `none': not asked.");
    }
  } // namespace



  void
  BodyParameters::declare_material(EntryTable &table, const bool is_bone)
  {
    table.add(
      "Element",
      element,
      Allowed::choice("trilinear | quadratic | spline")
        .or_word_for("auto", "trilinear"),
      "Kind of cells. `auto': as Accuracy needs, without it trilinear. `trilinear': hexahedra with 8 nodes, whose side at the "
      "contact face is a NURBS surface, as in the paper; a tetrahedron is four of them. `quadratic': the same "
      "with 27 nodes, or tetrahedra with 10. `spline': quadratic splines in all directions: smaller "
      "error in the same time, especially with cells that follow the rim.");
    table.add(
      "Expert / Layer grading",
      layer_grading,
      AllowedValues(allowed_grading).or_word_for("auto", "1"),
      "Grading exponent g of the layers of cells behind the contact face: of n "
      "layers over the length H, layer k ends at the distance H (k/n)^g from "
      "the contact face. 1: equal layers. More than 1: thinner layers at the "
      "interface, where the stress changes most. Cells along the side of a "
      "pin, taper or sleeve become smaller towards its ends in the same way, "
      "those of a cup or cavity towards the rim. `auto': as Accuracy needs, "
      "without it 1.");
    table.add(
      "Expert / Coarser below",
      coarser_below,
      Allowed::choice("false | true"),
      "Make cells beyond the first layer at the contact face twice as wide in "
      "x and y, with hanging nodes between. For trilinear and quadratic "
      "elements.");
    table.add(
      "Material",
      material,
      Allowed::choice("rigid | linear | neo-hookean")
        .or_word_for("auto", "neo-hookean"),
      "Material law. `auto': as Accuracy needs, without it neo-hookean. `rigid': no deformation. `linear': Hooke's law with "
      "small strains in a frame that moves with the body, so that large "
      "rotations of the implant are exact. `neo-hookean': compressible "
      "Neo-Hooke with finite strains (Eq. 1 of the paper).");
    declare_modulus(table, is_bone);
    table.add("Poisson ratio",
              poisson_ratio,
              Allowed::number_between(0, 0.49, ""),
              "Poisson's ratio nu, dimensionless. Trilinear cells lock as it "
              "approaches 0.5: above 0.45 the program warns, above 0.49 it "
              "refuses. Not used by a rigid body.");
    if (is_bone)
      declare_strengths(*this, table);
    table.add(
      "Expert / Contact surface",
      contact_surface,
      Allowed::choice("nurbs | bilinear"),
      "Interpolation of the contact face. `nurbs': biquadratic NURBS with "
      "normals that are continuous, or nearly so; the disk of a coin is an "
      "exact circle. `bilinear': the faces of the cells, for comparison.");
  }
} // namespace Debond
