#pragma once

#include <debond/shapes/body_geometry.h>
#include <debond/shapes/side.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  class EntryTable;
  struct BodyMesh;
  class ModulusField;

  /** Each is a row of shape_rows(). */
  enum class BodyShape
  {
    coin,
    cap,
    block,
    file,
    pin,
    taper,
    screw,
    ring,
    sleeve,
    cup,
    cavity
  };
  /** In the order of their cost, and of the choices of the entry. Those after
   *  `linear' have large strains. */
  enum class Material
  {
    rigid,
    linear,
    neo_hookean
  };
  enum class ElementKind
  {
    trilinear,
    quadratic,
    spline
  };
  enum class BulkSolver
  {
    automatic,
    direct,
    lattice,
    multigrid
  };
  enum class SurfaceKind
  {
    nurbs,
    bilinear
  };

  /** The subsections `Bone` and `Implant` of a scene; the defaults are those of
   *  the bone. */
  struct BodyParameters
  {
    BodyShape             shape = BodyShape::block;
    std::array<double, 3> size{{12.5, 12.5, 5}}; ///< block [mm]
    double                radius       = 2.5;    ///< of round implants [mm]
    double                inner_radius = 0;      ///< [mm]; 0: solid
    double                outer_radius = 0; ///< sleeve, cavity [mm]; 0: a block
    double                height = 3; ///< of round implants, on the axis [mm]
    double                sleeve_height = 0; ///< 0: that of the implant [mm]
    double support_radius = 0; ///< of the hole below a sleeve [mm]; 0: none
    /** How both ends of a sleeve, or the top of a cavity, are held, as the
     * files of meshes call it; empty: free. */
    std::string  ends;
    double       taper_angle = 3;               ///< half of the cone's [deg]
    double       pitch = 1, thread_depth = 0.2; ///< screw [mm]
    unsigned int starts     = 1;                ///< screw
    double       cap_radius = 50;               ///< of the sphere [mm]
    /** Of a cap, that cells are fitted to [mm]; 0: its radius. */
    double      contact_radius = 0;
    std::string mesh_file, coarser_mesh_file;
    /** Of a shape that is no lattice; see make_mesh(). */
    std::shared_ptr<const BodyMesh> mesh;
    /** Whether its cells are parts of quadratic tetrahedra. */
    bool
    has_tetrahedra() const;
    /** Number of cells in x, y, z; z along the axis (`Cells = n, m` becomes
     *  n, n, m). Around, radial and along of pin and sleeve. */
    std::array<unsigned int, 3> cells{{15, 15, 2}};
    /** Of `Cells = fitted ...`: around the rim, from the core to it, from it to
     *  the sides of a bone; below a ring as many inside its hole as in its
     *  wall; of a cap as many beyond its contact radius. `cells` are those of a
     * lattice with as many. */
    std::array<unsigned int, 3> fitted_cells{{0, 0, 0}};
    ElementKind                 element         = ElementKind::trilinear;
    double                      lateral_grading = 1; ///< bone
    unsigned int cells_under_implant            = 0; ///< bone; 0: as they come
    double       rim_grading                    = 1.5; ///< of such a bone
    /** Half the widths of the implant and the radius of its hole [mm], which
     *  such a bone heeds; no entries. */
    std::array<double, 2> rim{{0, 0}};
    double                hole          = 0;
    double                layer_grading = 1;
    bool                  coarser_below = false; ///< than the first layer
    Material              material      = Material::neo_hookean;
    /** Where there is a modulus_expression, the mean [MPa]. */
    double young_modulus = 18000;
    /** Of the bone: `Young modulus` if it is no number, and where its voxels
     *  are; see read_modulus(). */
    std::string modulus_expression, voxel_file, voxel_corner = "centred";
    std::shared_ptr<const ModulusField> modulus; ///< null: young_modulus
    double                              poisson_ratio = 0.3;
    /** Of the bone, for messages [MPa]; 0: not known. */
    double      tensile_strength = 0, compressive_strength = 0;
    SurfaceKind contact_surface = SurfaceKind::nurbs;
    BulkSolver  bulk_solver     = BulkSolver::automatic; ///< bone

    /** Whether the body does not deform, and has no unknowns. */
    bool
    is_rigid() const
    {
      return material == Material::rigid;
    }
    /** Whether its stiffness depends on its strains. */
    bool
    has_large_strains() const
    {
      return material > Material::linear;
    }
    /** Whether its cells follow the rim of the implant. */
    bool
    is_fitted() const
    {
      return fitted_cells[0] > 0;
    }
    /** Exponent of the layers of cells: those that are fitted have their own,
     *  for layers become smaller with them. */
    double
    exponent_of_layers() const
    {
      return is_fitted() ? 2. : layer_grading;
    }
    /** Elements of the contact face, of cells that are fitted; @p inside: of
     *  those within the rim. */
    double
    n_fitted_elements(const bool inside = false) const
    {
      const double quarter = fitted_cells[0] / 4,
                   core    = shape == BodyShape::ring ? 0. : quarter,
                   parts   = core > 0. && hole > 0. ? 2. : 1.,
                   beyond  = shape == BodyShape::cap && rim[0] < radius ?
                               fitted_cells[1] :
                               fitted_cells[2],
                   outside = inside ? 0. : beyond;
      return quarter * (core + 4. * (parts * fitted_cells[1] + outside));
    }
    /** Notes the rims of an implant, which may be the body itself. */
    void
    take_rim(const BodyParameters &implant);
    const ShapeRow &
    shape_row() const;
    BodyGeometry
    geometry() const
    {
      return shape_row().geometry(*this);
    }
    /** Whether it is a block of splines whose cells across are equal. */
    bool
    has_equal_splines() const
    {
      return element == ElementKind::spline && shape == BodyShape::block &&
             cells_under_implant == 0 && lateral_grading == 1. && !is_fitted();
    }
    double
    thickness() const
    {
      return geometry().thickness;
    }
    /** A tenth of the thickness [mm]: what penetrates deeper has most likely a
     *  wrong unit. */
    double
    penetration_limit() const
    {
      return 0.1 * thickness();
    }
    /** Size of the contact face along x (0) or y (1), seen from above [mm]. */
    double
    width(const unsigned int direction) const
    {
      return geometry().width[direction];
    }
    /** Cells in x, y, z of a lattice; of a mesh those of a lattice that has as
     *  many in all and at the contact face. */
    std::array<unsigned int, 3>
    lattice_of_cells() const;
    /** Mean width of the cells [mm] along x (0) or y (1), under the implant if
     *  a bone has them there. */
    double
    cell_width(const unsigned int direction) const
    {
      return is_fitted() ? 2. * (rim[0] > 0. ? rim[0] : radius) /
                             std::sqrt(n_fitted_elements(true)) :
             cells_under_implant > 0 ?
                           2. * rim[direction] / cells_under_implant :
                           width(direction) / lattice_of_cells()[direction];
    }
    /** Radius of a coin or a cap, half the shorter side of a block [mm]: the
     * `R` of expressions and of length tolerances. */
    double
    characteristic_radius() const
    {
      return 0.5 * std::min(width(0), width(1));
    }

    /** Whether the contact face of an implant is a bore, or, of a file, higher
     *  than a quarter of its width: there is no push then, and no rim that
     *  leaves the bone. */
    bool
    is_in_socket() const;

    /** Sides of the cells across a block along x (0) or y (1), as fractions of
     *  its edge from 0 to 1. */
    std::vector<double>
    lateral_fractions(unsigned int direction) const;

    /** Makes or reads the mesh of a shape that has one; a bone may have a bore
     *  for the @p implant. Throws EntryError. */
    void
    make_mesh(const std::string &section, const BodyParameters &implant);
    /** Makes `modulus` and the mean young_modulus of the expression and the
     *  voxels, if there are any. @p radius: R of the expression [mm]. Throws
     *  EntryError. */
    void
    read_modulus(double radius);
    double
    softest_modulus() const; ///< [MPa]

    /** Refuses what makes no sense together. Throws EntryError; @p section is
     *  "Bone" or "Implant". */
    void
    check(const std::string &section) const;

    /** What a scene has that says nothing of the implant. */
    static BodyParameters
    default_implant();

    void
    declare_bone(EntryTable &table);
    void
    declare_implant(EntryTable &table);

  private:
    void
    declare_shape(EntryTable &table, bool is_bone);
    void
    declare_material(EntryTable &table, bool is_bone);
    void
    declare_cells(EntryTable        &table,
                  bool               is_bone,
                  const std::string &description);
    void
    declare_modulus(EntryTable &table, bool is_bone);
  };

  /** The contact face of a body: that of its shape, or bilinear. */
  NurbsSurface
  make_contact_surface(const BodyParameters &body, Side side = Side::implant);
} // namespace Debond
