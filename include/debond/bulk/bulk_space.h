#pragma once

#include <debond/geometry/nurbs_surface.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/boundary.h>
#include <debond/shapes/faces_of_mesh.h>
#include <debond/shapes/side.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <bitset>
#include <map>
#include <vector>

namespace Debond
{
  /**
   * Mesh, finite elements, numbering and constraints of one body.
   *
   * The bulk is a deal.II triangulation with FESystem(FE_Q(p), 3), p = 1 of
   * trilinear and 2 of quadratic elements. Degrees of freedom are numbered node
   * by node, three to a node: first those of the DoFHandler, then the control
   * points of the contact surface. In cells with a face on the contact boundary
   * that face is interpolated by the NURBS surface (Corbett & Sauer 2014,
   * 2015): the functions of the nodes on it are replaced by N_A(xi, eta)
   * l_0(zeta), l_0 being the function of FE_Q across. So these nodes are no
   * unknowns: they belong to no cell and follow the control points, v = sum_A
   * N_A v_A, which together with the supports stands in the AffineConstraints.
   *
   * With the contact surface `bilinear` the surface is of degree 1, has one
   * control point at each surface vertex, and everything else stays the same.
   *
   * With the element `spline` all nodes are control points, of functions that
   * are those of the contact surface times quadratic splines of the depth:
   * level by level, that of the contact surface last. In a cell they are
   * combinations of the functions of FE_Q(2). No vertex is a node. Cells are
   * those of a lattice, in deal.II's order, without a triangulation.
   *
   * With BulkSolver::multigrid the cells are dealt out among the ranks as in
   * step-17: each rank knows all nodes and constraints, but has cells() of its
   * own, and rows of the stiffness.
   */
  class BulkSpace
  {
  public:
    /** The bone is fixed at the bottom and held normal to its sides, contact
     *  face on top; the implant is held at its top, contact face at the bottom.
     *  Both contact faces lie in z = 0; that of a cap touches it. */
    BulkSpace(const BodyParameters &parameters, Side side);
    /** The same on this contact face instead of that of the shape. It has as
     *  many elements as the body has cells across. */
    BulkSpace(const BodyParameters &parameters,
              Side                  side,
              const NurbsSurface   &face);

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

    bool
    has_splines() const
    {
      return body_parameters.element == ElementKind::spline;
    }
    /** True if its cells form a lattice, in columns from the contact face. */
    bool
    has_lattice() const
    {
      return body_parameters.mesh == nullptr;
    }
    /** True if its cells are parts of quadratic tetrahedra. */
    bool
    has_tetrahedra() const
    {
      return body_parameters.has_tetrahedra();
    }
    /** Of FE_Q, of which there are but corners in tetrahedra. */
    unsigned int
    degree() const
    {
      return body_parameters.element == ElementKind::trilinear ||
                 has_tetrahedra() ?
               1 :
               2;
    }
    /** Triangulation and FESystem, whose dofs 3 k + component belong to node k.
     *  Splines have none, nor a space that has released its own. */
    const dealii::DoFHandler<3> &
    dof_handler() const
    {
      return dofs;
    }
    /** FE_Q of a component; with splines what they are combinations of. */
    const dealii::FE_Q<3> &
    element() const
    {
      return scalar_fe;
    }
    /** Constraints of nodes that follow others or are held, over 3 n_nodes()
     * degrees of freedom. */
    const dealii::AffineConstraints<double> &
    constraints() const
    {
      return all_constraints;
    }

    /** Nodes of FE_Q, the corners of the cells among them; of splines corners
     *  only, for pictures. */
    unsigned int
    n_vertices() const
    {
      return n_nodes_of_fe;
    }
    /** Nodes before the control points of the contact surface: the vertices,
     *  or the control points of the other levels. */
    unsigned int
    n_inner_nodes() const
    {
      return has_splines() ? contact_surface.n_control_points() *
                               (layer_knots.n_basis_functions() - 1) :
                             n_vertices();
    }
    unsigned int
    n_nodes() const
    {
      return n_inner_nodes() + contact_surface.n_control_points();
    }
    /** Node number of a control point of the contact surface. */
    unsigned int
    control_point_node(unsigned int control_point) const
    {
      return n_inner_nodes() + control_point;
    }

    /** Degrees of freedom as the paper counts them: all vertices and, with
     *  NURBS, all control points, three each. */
    unsigned int
    n_dofs_as_published() const;
    /** Three for each node that follows no others. */
    unsigned int
    n_unknowns() const;

    /** Splines of the depth, over the fraction 0 (contact face) to 1 of it:
     *  one span for each layer of cells, of the degree of the elements. */
    const KnotVector &
    depth() const
    {
      return layer_knots;
    }

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
    /** True for nodes of FE_Q that follow others: those on the contact surface
     *  its control points, hanging nodes those beside. */
    bool
    is_tied(unsigned int node) const
    {
      return tied[node];
    }

    /** Nodes whose rows of the stiffness this rank has; each node is one
     *  rank's. */
    const dealii::IndexSet &
    owned_nodes() const
    {
      return own_nodes;
    }
    /** True if cells have nodes that follow others: hanging nodes, or those of
     *  a cell that touches the contact face at an edge or a corner only, or
     *  has a second face on it. */
    bool
    cells_have_followers() const
    {
      return followers_in_cells;
    }
    /** Fills in the tied nodes of a displacement vector (3 n_nodes). */
    void
    distribute(Eigen::Ref<Eigen::VectorXd> v) const;
    /** Hands the forces of hanging nodes on to those that they follow. */
    void
    condense(Eigen::Ref<Eigen::VectorXd> force) const;

    /** A cell of the bulk: the nodes of FE_Q in
     *  deal.II's order, or, in the contact layer, the control points of its
     *  surface element followed by the nodes of FE_Q that are not on it. With
     *  splines: those of its surface element, in three levels. Of a part of a
     *  tetrahedron the ten nodes of that. */
    struct Cell
    {
      bool         enriched = false;    ///< it is bounded by the contact face
      ContactFace  face;                ///< of an enriched one
      unsigned int surface_element = 0; ///< above or below it
      unsigned int layer           = 0; ///< from the contact face, in a lattice
      unsigned int first_corner    = 0; ///< of BodyMesh::PartOfSimplex
      std::vector<unsigned int>   nodes;
      std::array<unsigned int, 8> vertices; ///< all vertices, deal.II's order
    };
    const std::vector<Cell> &
    cells() const
    {
      return bulk_cells;
    }

    /** Frees the triangulation, of which nobody asks any more when cells, nodes
     *  and constraints are known. */
    void
    release_triangulation();

  private:
    void
    make_grid();
    void
    find_cells();
    void
    make_cells_of_splines();
    Eigen::Vector3d
    place_in_lattice(const dealii::Point<3> &point) const;
    void
    place_nodes();
    void
    number_nodes_of_splines();
    void
    number_nodes_of_cells();
    void
    number_nodes_of_tetrahedra();
    std::vector<unsigned int>
    nodes_of_element(unsigned int element) const;
    std::vector<unsigned int>
    nodes_of_fe(const dealii::DoFHandler<3>::active_cell_iterator &cell) const;
    void
    make_constraints();
    void
    hold_splines();
    unsigned int
    direction_across(const Cell &cell, unsigned int side) const;
    void
    hold_and_tie_cells();
    void
    tie_node(unsigned int                             node,
             const unsigned int                      *others,
             const Eigen::Ref<const Eigen::VectorXd> &weights);
    void
    tie_middles(const Cell &cell);
    void
    hold_followed_nodes();
    void
    hold(const Cell &cell, unsigned int face, unsigned int components);
    void
    tie_hanging_nodes();
    void
    tie(const ContactFace               &face,
        unsigned int                     element,
        const std::vector<unsigned int> &nodes_of_fe);
    void
    deal_out();

    const BodyParameters body_parameters;
    const Side           body_side;
    const NurbsSurface   contact_surface;
    const KnotVector     layer_knots;

    dealii::Triangulation<3>          triangulation;
    const dealii::FE_Q<3>             scalar_fe;
    const dealii::FESystem<3>         vector_fe;
    dealii::DoFHandler<3>             dofs;
    dealii::AffineConstraints<double> follow, all_constraints;
    std::vector<Eigen::Vector3d>      reference_positions;
    std::vector<bool>                 fixed, tied;
    std::vector<Cell>                 bulk_cells;
    /** Cells that have more than one contact face: their others, and the
     *  elements of the surface. */
    std::multimap<unsigned int, std::pair<ContactFace, unsigned int>>
                     other_contact_faces;
    unsigned int     n_nodes_of_fe      = 0;
    bool             followers_in_cells = false;
    dealii::IndexSet own_nodes;
  };



  /** The point of [0,1]^2 in the parameters of an element with these @p bounds,
   *  exact at both: neighbours must agree on their border. */
  Eigen::Vector2d
  parameters_at(const std::array<Eigen::Vector2d, 2> &bounds,
                const dealii::Point<2>               &point);

  /** Functions at a point of deal.II's unit cell, a row each: the value and the
   *  derivatives with respect to its three coordinates. */
  using ShapeValues = Eigen::Matrix<double, Eigen::Dynamic, 4, 0, 27, 4>;

  /** Of FE_Q. */
  ShapeValues
  shape_values(const dealii::FE_Q<3> &element, const dealii::Point<3> &point);

  /**
   * The functions of a cell, in the order of its nodes: those of FE_Q, or in
   * the contact layer (Corbett & Sauer 2014)
   *
   *   x = sum_A N_A(xi,eta) l_0(zeta) x_A + sum_a phi_a(xi,eta,zeta) x_a,
   *
   * N_A those of the NURBS by Bezier extraction (Eqs.\ 34, 35 of the paper),
   * phi_a those of FE_Q whose nodes are not on the contact face, l_0 that of
   * FE_Q across which is 1 there. Or, with splines M_k of the depth, in all
   * layers
   *
   *   x = sum_k M_k(zeta) sum_A N_A(xi,eta) x_kA,
   *
   * or, in a part of a tetrahedron, quadratic_functions() of its barycentric
   * coordinates, which are trilinear in the part.
   *
   * In a cell splines are polynomials of the degree of FE_Q(2), known by their
   * values at its support points: B_b = sum_a E_ab phi_a, and those of weight
   * w N_b = w_b B_b / sum_c w_c B_c.
   */
  class CellFunctions
  {
  public:
    CellFunctions(const BulkSpace &space, const BulkSpace::Cell &cell);

    ShapeValues
    at(const dealii::Point<3> &point) const;
    /** The same with the functions of FE_Q at the point, which many cells
     *  share. */
    ShapeValues
    at(const dealii::Point<3> &point, const ShapeValues &phi) const;
    /** Their values alone at several points, a column each. */
    Eigen::MatrixXd
    values_at(const std::vector<dealii::Point<3>> &points,
              const std::vector<ShapeValues>      &phi) const;

    /** Reference position of a point [mm]. */
    Eigen::Vector3d
    position(const dealii::Point<3> &point) const;

  private:
    SurfaceBasis
    functions_of_face(double xi, double eta) const;
    ShapeValues
    of_contact_layer(const dealii::Point<3> &point,
                     const ShapeValues      &phi) const;
    void
    extract_splines();
    ShapeValues
    splines(const ShapeValues &phi) const;

    const BulkSpace       &space;
    const BulkSpace::Cell &cell;
    std::bitset<27>        on_face; ///< functions of FE_Q that NURBS replace
    Eigen::MatrixXd        E;       ///< functions of FE_Q x splines, or L_i
    Eigen::VectorXd        w;       ///< of each spline; empty: all 1
  };
} // namespace Debond
