#include <debond/bulk/bulk_space.h>
#include <debond/support/input_error.h>
#include <debond/support/ranks.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** Layer k of n ends at the fraction (k/n)^g of the depth. */
    KnotVector
    make_layers(const BodyParameters &parameters)
    {
      const unsigned int  n = parameters.cells[2];
      std::vector<double> fractions;
      for (unsigned int k = 0; k <= n; ++k)
        fractions.push_back(std::pow(static_cast<double>(k) / n,
                                     parameters.exponent_of_layers()));
      return KnotVector::from_breakpoints(
        parameters.element == ElementKind::spline ? 2 : 1, fractions);
    }
  } // namespace



  BulkSpace::BulkSpace(const BodyParameters &parameters, const Side side)
    : BulkSpace(parameters, side, make_contact_surface(parameters, side))
  {}



  BulkSpace::BulkSpace(const BodyParameters &parameters,
                       const Side            side,
                       const NurbsSurface   &face)
    : body_parameters(parameters)
    , body_side(side)
    , contact_surface(face)
    , layer_knots(make_layers(parameters))
    , scalar_fe(degree())
    , vector_fe(dealii::FE_Q<3>(degree()), 3)
    , dofs(triangulation)
  {
    if (has_splines())
      {
        make_cells_of_splines();
        number_nodes_of_splines();
      }
    else
      {
        if (has_lattice())
          make_grid();
        else
          triangulation.copy_triangulation(body_parameters.mesh->triangulation);
        dofs.distribute_dofs(vector_fe);
        n_nodes_of_fe = dofs.n_dofs() / 3;
        find_cells();
        place_nodes();
        if (has_tetrahedra())
          number_nodes_of_tetrahedra();
        else
          number_nodes_of_cells();
      }
    const ControlNet &control_points = contact_surface.control_points();
    for (unsigned int A = 0; A < control_points.cols(); ++A)
      reference_positions.push_back(control_points.col(A));
    make_constraints();
    deal_out();
  }



  void
  BulkSpace::release_triangulation()
  {
    dofs.clear();
    triangulation.clear();
  }



  // The cells form a lattice. The triangulation is first made with lattice
  // indices as coordinates; place_nodes() moves each vertex to its place. Where
  // cells are coarser below, the contact layer is refined, across only.
  void
  BulkSpace::make_grid()
  {
    const auto        &n      = body_parameters.cells;
    const unsigned int n_wide = body_parameters.coarser_below ? 2 : 1;
    dealii::GridGenerator::subdivided_hyper_rectangle(
      triangulation,
      {n[0] / n_wide, n[1] / n_wide, n[2]},
      dealii::Point<3>(),
      dealii::Point<3>(n[0], n[1], n[2]),
      true); // boundary ids are the numbers of faces
    using namespace Boundary;
    const Id ids[2][6] = {
      {slides_x, slides_x, slides_y, slides_y, held, contact},
      {Boundary::free,
       Boundary::free,
       Boundary::free,
       Boundary::free,
       contact,
       held}};
    for (const auto &face : triangulation.active_face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(ids[body_side][face->boundary_id()]);
    if (body_parameters.coarser_below)
      {
        for (const auto &[cell, face] : cells_at_contact_face(triangulation))
          cell->set_refine_flag(dealii::RefinementCase<3>::cut_xy);
        triangulation.execute_coarsening_and_refinement();
      }
  }



  // All cells, and which element of the surface they touch. The first vertex of
  // a cell in a lattice is the one with the least indices; layers are counted
  // from the contact face, the bone's top.
  void
  BulkSpace::find_cells()
  {
    for (const auto &cell : dofs.active_cell_iterators())
      {
        Cell &info = bulk_cells.emplace_back();
        for (const unsigned int v : cell->vertex_indices())
          info.vertices[v] = cell->vertex_dof_index(v, 0) / 3;
        if (!has_lattice())
          continue;
        const auto            &n     = body_parameters.cells;
        const dealii::Point<3> first = cell->vertex(0);
        info.surface_element         = std::lround(first[0] + n[0] * first[1]);
        info.layer =
          std::lround(body_side == Side::bone ? n[2] - 1 - first[2] : first[2]);
      }
    unsigned int element = 0;
    for (const auto &[cell, face] : cells_at_contact_face(triangulation))
      {
        Cell             &info    = bulk_cells[cell->active_cell_index()];
        const ContactFace contact = ContactFace::of(face, body_side);
        if (info.enriched)
          {
            other_contact_faces.emplace(cell->active_cell_index(),
                                        std::pair(contact, element++));
            continue;
          }
        info.enriched = true;
        info.face     = contact;
        if (!has_lattice())
          info.surface_element = element++;
      }
  }



  // Of splines: elements of the surface times spans of the depth, from below,
  // in deal.II's order. They need no triangulation, which takes longer to make
  // than the lattice solver needs for its factors.
  void
  BulkSpace::make_cells_of_splines()
  {
    const unsigned int n     = body_parameters.cells[2],
                       level = contact_surface.n_corners();
    const bool is_bone       = body_side == Side::bone;
    n_nodes_of_fe            = level * (n + 1);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int e = 0; e < contact_surface.n_elements(); ++e)
        {
          Cell &cell           = bulk_cells.emplace_back();
          cell.surface_element = e;
          cell.layer           = is_bone ? n - 1 - k : k;
          cell.enriched        = cell.layer == 0;
          if (cell.enriched)
            cell.face = ContactFace::of(is_bone ? 5 : 4, body_side);
          for (unsigned int v = 0; v < 8; ++v)
            cell.vertices[v] =
              contact_surface.corner(e, v % 4) + (k + v / 4) * level;
        }
  }



  // Where a point of the lattice is: below or above the contact surface, the
  // parameters of which go from knot to knot, at the fraction f of the layers
  // at z_0 + (-+ H - z_0) f where the face has the height z_0.
  Eigen::Vector3d
  BulkSpace::place_in_lattice(const dealii::Point<3> &point) const
  {
    const auto between = [](const std::vector<double> &ends, const double s) {
      const std::size_t i = std::min<std::size_t>(s, ends.size() - 2);
      const double      t = s - i;
      return (1. - t) * ends[i] + t * ends[i + 1];
    };
    Eigen::Vector3d X = contact_surface.point(
      {between(contact_surface.knots(0).breakpoints(), point[0]),
       between(contact_surface.knots(1).breakpoints(), point[1])});
    const double layers = body_side == Side::bone ?
                            body_parameters.cells[2] - point[2] :
                            point[2],
                 end    = -outward_sign() * body_parameters.thickness();
    X[2] += (end - X[2]) * between(layer_knots.breakpoints(), layers);
    return X;
  }



  // Of FE_Q, and with them the vertices. A file says where they are.
  void
  BulkSpace::place_nodes()
  {
    reference_positions.resize(n_nodes_of_fe);
    if (!has_lattice())
      {
        for (const auto &cell : dofs.active_cell_iterators())
          {
            const auto nodes = nodes_of_fe(cell);
            const auto places =
              body_parameters.mesh->points_of_second_order(cell);
            for (unsigned int a = 0; a < nodes.size(); ++a)
              reference_positions[nodes[a]] << places[a][0], places[a][1],
                places[a][2];
          }
        return;
      }
    std::vector<dealii::Point<3>> indices(dofs.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(
      dealii::StaticMappingQ1<3>::mapping, dofs, indices);
    for (unsigned int node = 0; node < n_nodes_of_fe; ++node)
      reference_positions[node] = place_in_lattice(indices[3 * node]);
    for (const auto &cell : dofs.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        {
          const Eigen::Vector3d &X =
            reference_positions[cell->vertex_dof_index(v, 0) / 3];
          cell->vertex(v) = dealii::Point<3>(X[0], X[1], X[2]);
        }
  }



  // Level by level, that of the contact face last. Fractions of the depth are
  // Greville abscissae: the map is linear in the depth, and the sides of a disk
  // are those of a cylinder.
  void
  BulkSpace::number_nodes_of_splines()
  {
    const ControlNet         &control_points = contact_surface.control_points();
    const unsigned int        n_in_level     = control_points.cols();
    const std::vector<double> fractions      = layer_knots.greville_abscissae();
    const double end = -outward_sign() * body_parameters.thickness();
    for (unsigned int level = 1; level < fractions.size(); ++level)
      for (unsigned int A = 0; A < n_in_level; ++A)
        {
          Eigen::Vector3d X = control_points.col(A);
          X[2] += (end - X[2]) * fractions[level];
          reference_positions.push_back(X);
        }
    for (Cell &cell : bulk_cells)
      {
        const unsigned int level = layer_knots.first_basis_function(cell.layer);
        for (unsigned int k = level; k <= level + layer_knots.degree(); ++k)
          for (const unsigned int node : nodes_of_element(cell.surface_element))
            cell.nodes.push_back(
              k == 0 ? node : node - n_inner_nodes() + (k - 1) * n_in_level);
      }
  }



  void
  BulkSpace::number_nodes_of_cells()
  {
    for (const auto &cell : dofs.active_cell_iterators())
      {
        Cell &info = bulk_cells[cell->active_cell_index()];
        if (info.enriched)
          info.nodes = nodes_of_element(info.surface_element);
        const auto nodes = nodes_of_fe(cell);
        for (unsigned int a = 0; a < nodes.size(); ++a)
          if (!info.enriched ||
              !scalar_fe.has_support_on_face(a, info.face.number))
            info.nodes.push_back(nodes[a]);
      }
  }



  // Nodes on the contact face are control points themselves.
  void
  BulkSpace::number_nodes_of_tetrahedra()
  {
    const BodyMesh           &mesh = *body_parameters.mesh;
    constexpr unsigned int    none = -1;
    std::vector<unsigned int> node(triangulation.n_vertices(), none);
    unsigned int              element = 0;
    for (const auto &[cell, number] : cells_at_contact_face(triangulation))
      {
        const auto vertices =
          mesh
            .part_of_simplex(
              vertices_of_face(cell, ContactFace::of(number, body_side)))
            .nodes;
        const auto nodes = nodes_of_element(element++);
        for (unsigned int k = 0; k < vertices.size(); ++k)
          node[vertices[k]] = nodes[k];
      }
    for (const auto &cell : dofs.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        if (unsigned int &own = node[cell->vertex_index(v)]; own == none)
          own = cell->vertex_dof_index(v, 0) / 3;
    for (const auto &cell : dofs.active_cell_iterators())
      {
        std::vector<unsigned int> corners;
        for (const unsigned int v : cell->vertex_indices())
          corners.push_back(cell->vertex_index(v));
        const auto part   = mesh.part_of_simplex(corners);
        Cell      &info   = bulk_cells[cell->active_cell_index()];
        info.first_corner = part.first_corner;
        for (const unsigned int vertex : part.nodes)
          info.nodes.push_back(node[vertex]);
      }
  }



  std::vector<unsigned int>
  BulkSpace::nodes_of_element(const unsigned int element) const
  {
    const auto control_points = contact_surface.element_control_points(element);
    std::vector<unsigned int> nodes;
    for (unsigned int a = 0; a < contact_surface.n_control_points_of_element();
         ++a)
      nodes.push_back(control_point_node(control_points[a]));
    return nodes;
  }



  std::vector<unsigned int>
  BulkSpace::nodes_of_fe(
    const dealii::DoFHandler<3>::active_cell_iterator &cell) const
  {
    std::vector<dealii::types::global_dof_index> indices(
      vector_fe.n_dofs_per_cell());
    cell->get_dof_indices(indices);
    std::vector<unsigned int> nodes(scalar_fe.n_dofs_per_cell());
    for (unsigned int i = 0; i < indices.size(); ++i)
      {
        const auto [c, a] = vector_fe.system_to_component_index(i);
        AssertThrow(indices[i] % 3 == c, dealii::ExcInternalError());
        nodes[a] = indices[i] / 3;
      }
    return nodes;
  }



  unsigned int
  BulkSpace::n_dofs_as_published() const
  {
    return 3 * (body_parameters.contact_surface == SurfaceKind::nurbs ?
                  n_nodes() :
                  n_inner_nodes());
  }



  unsigned int
  BulkSpace::n_unknowns() const
  {
    return 3 * (n_nodes() - std::count(tied.begin(), tied.end(), true));
  }



  // Parts of METIS have few faces in common, and are the same on all ranks. A
  // node belongs to the first of the ranks that have a cell with it; those that
  // follow others mostly have none, and are the first rank's.
  void
  BulkSpace::deal_out()
  {
    own_nodes                  = dealii::complete_index_set(n_nodes());
    const unsigned int n_ranks = Ranks::number();
    if (body_parameters.bulk_solver != BulkSolver::multigrid || n_ranks == 1)
      return;
    if (has_splines())
      make_grid();
    dealii::GridTools::partition_triangulation(n_ranks, triangulation);
    std::vector<unsigned int> owner(n_nodes(), n_ranks);
    std::vector<Cell>         all_cells;
    all_cells.swap(bulk_cells);
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        Cell &info = all_cells[cell->active_cell_index()];
        for (const unsigned int node : info.nodes)
          owner[node] = std::min(owner[node], cell->subdomain_id());
        if (cell->subdomain_id() == Ranks::own())
          bulk_cells.push_back(std::move(info));
      }
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      if (std::count(owner.begin(), owner.end(), rank) == 0)
        throw EntryError("Expert / Bone / Solver",
                         std::to_string(n_ranks) + " processes cannot share " +
                           std::to_string(all_cells.size()) +
                           " cells: expected fewer");
    own_nodes = dealii::IndexSet(n_nodes());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (owner[node] % n_ranks == Ranks::own())
        own_nodes.add_index(node);
    own_nodes.compress();
  }
} // namespace Debond
