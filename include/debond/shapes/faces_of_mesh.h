#pragma once

#include <debond/geometry/nurbs_surface.h>
#include <debond/shapes/body_mesh.h>
#include <debond/shapes/side.h>

#include <array>
#include <utility>
#include <vector>

namespace Debond
{
  /** The face of a cell that is on the contact face. */
  struct ContactFace
  {
    unsigned int number = 0; ///< of the face in its cell, in deal.II's order
    /** Coordinates of the unit cell that are the parameters of the surface
     *  element. */
    std::array<unsigned int, 2> axes{{0, 1}};

    /** Face @p number, with a_1 x a_2 out of a bone and into an implant. */
    static ContactFace
    of(unsigned int number, Side side);
    unsigned int
    across() const
    {
      return number / 2;
    }
  };

  /** Which faces of the boundary. */
  enum class FacesOfMesh
  {
    contact,
    others,
    all
  };

  /** Faces that meet at a larger angle meet at an edge [rad]. */
  constexpr double largest_smooth_angle = 0.7;

  /** Cells that have a face there, and its number, in the order of the surface
   *  elements of contact_surface_of(). */
  std::vector<
    std::pair<dealii::Triangulation<3>::active_cell_iterator, unsigned int>>
  cells_at_contact_face(const dealii::Triangulation<3> &triangulation,
                        FacesOfMesh which = FacesOfMesh::contact);

  /** Of such a face, as corners of the surface element. */
  std::vector<unsigned int>
  vertices_of_face(const dealii::Triangulation<3>::active_cell_iterator &cell,
                   const ContactFace                                    &face);

  using FaceWeights = Eigen::Matrix<double, 9, 1>;

  /** Of values at the 3 x 3 nodes of a face makes those of the control points
   *  with the weights @p w: first of its edges, whose ends have the weight 1.
   */
  void
  interpolate_nodes(Eigen::Matrix3Xd  &x,
                    const FaceWeights &w = FaceWeights::Ones());

  /** The contact face of a body from a file, or others: a patch for each face
   *  of its cells, of degree 1 (bilinear) or 2, which passes through the four
   * or nine nodes of the face, or the six of its triangle. */
  NurbsSurface
  contact_surface_of(const BodyMesh &mesh,
                     unsigned int    degree,
                     Side            side,
                     FacesOfMesh     which = FacesOfMesh::contact);
} // namespace Debond
