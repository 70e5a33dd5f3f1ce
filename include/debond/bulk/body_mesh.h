#ifndef debond_bulk_body_mesh_h
#define debond_bulk_body_mesh_h

#include <debond/bulk/body_parameters.h>
#include <debond/bulk/side.h>
#include <debond/geometry/nurbs_surface.h>

#include <array>
#include <utility>
#include <vector>

namespace Debond
{
  /** The contact face of a body in its reference configuration. */
  NurbsSurface
  make_contact_surface(const BodyParameters &parameters);



  /**
   * Mesh, numbering and boundary conditions of one body.
   *
   * The cells form a lattice of trilinear hexahedra. Degrees of freedom are
   * numbered node by node, three to a node: first the vertices, x fastest and
   * from bottom to top, then the control points of the contact
   * surface. In the layer of cells that touches the contact surface the contact
   * face is interpolated by the NURBS surface (Corbett & Sauer 2014, 2015), so
   * the vertices on it are no unknowns: they are tied to the control points,
   * v_vertex = sum_A N_A(vertex) v_A.
   *
   * With the contact surface `bilinear` the surface is of degree 1, has one
   * control point at each surface vertex, and everything else stays the same.
   */
  class BodyMesh
  {
  public:
    /** The bone is fixed at the bottom and held normal to its sides, contact
     *  face on top; the implant is held at its top, contact face at the bottom.
     *  Both contact faces lie in z = 0; that of a cap touches it. */
    BodyMesh(const BodyParameters &parameters, Side side);

    const BodyParameters &
    parameters() const
    {
      return body_parameters;
    }
    Side
    side() const
    {
      return body_side;
    }
    const NurbsSurface &
    surface() const
    {
      return contact_surface;
    }
    /** +1 or -1: this factor times a_1 x a_2 points out of the body. */
    double
    outward_sign() const
    {
      return body_side == Side::bone ? 1. : -1.;
    }

    unsigned int
    n_vertices() const
    {
      return (body_parameters.cells[0] + 1) * (body_parameters.cells[1] + 1) *
             (body_parameters.cells[2] + 1);
    }
    unsigned int
    n_nodes() const
    {
      return n_vertices() + contact_surface.n_control_points();
    }
    /** Node number of a control point of the contact surface. */
    unsigned int
    control_point_node(unsigned int control_point) const
    {
      return n_vertices() + control_point;
    }

    /** Degrees of freedom as the paper counts them: all vertices and, with
     *  NURBS, all control points, three each. */
    unsigned int
    n_dofs_as_published() const;
    /** The same less the surface vertices that follow the control points. */
    unsigned int
    n_unknowns() const;

    /** Reference position of a node [mm] (vertices and control points). */
    const Eigen::Vector3d &
    reference_position(unsigned int node) const
    {
      return reference_positions[node];
    }
    /** True where the boundary conditions fix this component of this node. */
    bool
    is_fixed(unsigned int node, unsigned int component) const
    {
      return fixed[3 * node + component];
    }
    /** True for vertices of the contact surface. */
    bool
    is_tied(unsigned int node) const
    {
      return tied[node];
    }
    /** Fills in the tied vertices of a displacement vector (3 n_nodes). */
    void
    distribute(Eigen::VectorXd &v) const;

    /** A cell of the bulk: the eight vertices of a trilinear hexahedron in
     *  deal.II's order, or, in the contact layer, the control points of its
     *  surface element followed by the four vertices of the opposite face. */
    struct Cell
    {
      bool                        enriched        = false;
      unsigned int                surface_element = 0; ///< if enriched
      std::vector<unsigned int>   nodes;
      std::array<unsigned int, 8> vertices; ///< all vertices, deal.II's order
    };
    const std::vector<Cell> &
    cells() const
    {
      return bulk_cells;
    }

  private:
    using Lattice = std::array<unsigned int, 3>;
    /** Number of the vertex at a place of the lattice. */
    unsigned int
    vertex(const Lattice &place) const
    {
      const auto &n = body_parameters.cells;
      return place[0] + (n[0] + 1) * (place[1] + (n[1] + 1) * place[2]);
    }
    /** Calls work(vertex number, i, j, layer) for all vertices; layers count
     *  from the contact face. */
    template <typename Work>
    void
    for_each_vertex(const Work &work) const;
    /** Layer of the lattice, counted from the bottom, that is the given one
     *  from the contact face, and the other way round. */
    unsigned int
    flipped(const unsigned int layer) const
    {
      return body_side == Side::bone ? body_parameters.cells[2] - layer : layer;
    }
    /** Parameters of the contact surface where the knot lines i and j cross. */
    Eigen::Vector2d
    knots_at(unsigned int i, unsigned int j) const;
    void
    place_nodes();
    void
    collect_cells();
    void
    support_nodes();
    double
    layer_height(unsigned int layer, double height_of_face) const;

    const BodyParameters body_parameters;
    const Side           body_side;

    const NurbsSurface contact_surface;

    std::vector<Eigen::Vector3d> reference_positions;
    std::vector<bool>            fixed, tied;
    /** Tied vertices and the functions of the control points at them. */
    std::vector<std::pair<unsigned int, SurfaceBasis>> followers;
    std::vector<Cell>                                  bulk_cells;
  };
} // namespace Debond
#endif
