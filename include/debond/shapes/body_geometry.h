#pragma once

#include <Eigen/Core>

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace Debond
{
  struct BodyParameters;
  class NurbsSurface;
  struct StoredMesh;

  /** Size and contact face of a body; lengths are in mm. */
  struct BodyGeometry
  {
    /** Sizes of a body around the z axis, whose contact face is a disk. */
    static BodyGeometry
    round(double radius, double height);

    /** Extent of the contact face along x and y, seen from above. */
    std::array<double, 2> width{{0., 0.}};
    double                thickness = 0.; ///< on the axis; of a file from z = 0
    double                reach     = 0.; ///< from the axis while it turns
    double                chuck_height = 0.; ///< of the chuck's centre at rest
    /** Area of the contact face where there is a closed form [mm^2]; 0: the sum
     *  of its elements. */
    double area = 0.;
    /** Area of the contact face, seen from above, over that of the rectangle
     *  around it. */
    double share_of_rectangle = 1.;
    bool   is_round         = false; ///< it fills its rectangle but for corners
    bool   has_closed_forms = false; ///< that also the forecast knows

    /** Radius of the contact face, of an implant that is in the bone with its
     *  side, at a height and an angle from the x axis [rad]; empty of others.
     */
    std::function<double(double z, double angle)> side;
    /** Waves of that side around, and the length of one along the axis: cells
     *  show them with four each. Without waves it is round. */
    double waves_around = 0.,
           wave_length  = std::numeric_limits<double>::infinity();
    /** Height of the centre of a contact face that is a sphere. */
    std::optional<double> centre_of_sphere;
    double radius = 0.; ///< of that sphere, or of the side where it is nominal

    /** Whether an implant is in the bone, with its side or its sphere. */
    bool
    is_in_bore() const
    {
      return side || centre_of_sphere;
    }
    /** Motion of a point @p X of that face, or of one of its control points,
     *  while the radius grows, per length. */
    Eigen::Vector3d
    outwards(const Eigen::Vector3d &X) const;
    /** Place of a point of the contact face in the face's own two coordinates,
     *  for patterns and maps: x and y, around a side and along z, or along a
     *  sphere from its lowest point. */
    Eigen::Vector2d
    on_face(const Eigen::Vector3d &X) const;
    /** Rectangle around the face in these. */
    std::array<Eigen::Vector2d, 2>
    box_of_face() const;
    /** Whether there is a face at a place of that rectangle; maps ask. */
    bool
    has_face_at(const Eigen::Vector2d &place) const;
  };



  /** Refusal of an entry that has a mistake, with a message. */
  using EntryCheck = std::function<void(bool               is_mistake,
                                        const std::string &entry,
                                        const std::string &message)>;

  /** Refusal by an EntryError of a section, "Bone". */
  EntryCheck
  refusal_in(const std::string &section);



  /** Row of the table of shapes. Its functions take the entries of a body. */
  struct ShapeRow
  {
    std::string name, description; ///< of the choice of the entry `Shape`
    bool        is_for_bone, is_for_implant;
    /** Entries that give its size; the first one says how wide it is. */
    std::vector<std::string> entries;
    BodyGeometry (*geometry)(const BodyParameters &body);
    void (*check)(const BodyParameters &body, const EntryCheck &refuse);
    /** Contact face of cells in columns, of cells[0] x cells[1] elements or
     *  fitted. It touches z = 0 with its centre at the origin; the far face is
     *  flat, at the distance of the thickness. Null of other cells. */
    NurbsSurface (*contact_face)(const BodyParameters &body);
    /** Cells about the z axis, those around, radial and along; a bone may have
     *  a bore for the @p implant. Throws EntryError. Null of shapes whose
     *  cells are in columns, and of files. */
    StoredMesh (*cells)(const BodyParameters &body,
                        const BodyParameters &implant) = nullptr;

    bool
    is_lattice() const
    {
      return contact_face && !cells;
    }
  };

  /** All shapes, in the order of BodyShape. */
  const std::vector<ShapeRow> &
  shape_rows();

  /** Groups of them: in columns, of files, around an axis, on spheres. */
  std::vector<ShapeRow>
  lattice_shapes();
  std::vector<ShapeRow>
  file_shapes();
  std::vector<ShapeRow>
  revolved_shapes();
  std::vector<ShapeRow>
  bowl_shapes();

  /** Refuses what belongs to cells in columns, with the @p reason why the
   *  shape of @p body has none, or a shape that has them else has others. */
  void
  refuse_entries_of_lattices(const BodyParameters &body,
                             const std::string    &reason,
                             const EntryCheck     &refuse);
  /** The same of cells about the z axis, and wrong numbers of these. @p
   *  has_square: whether there is a square with a quarter of those around on
   *  each edge. */
  void
  check_cells_around(const BodyParameters &body,
                     bool                  has_square,
                     const EntryCheck     &refuse);
} // namespace Debond
