#include <debond/bulk/bulk_space.h>
#include <debond/support/ranks.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
        fractions.push_back(
          std::pow(static_cast<double>(k) / n, parameters.layer_grading));
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
    , columns(columns_of_rank(
        parameters.cells,
        parameters.bulk_solver == BulkSolver::multigrid ? Ranks::own() : 0,
        parameters.bulk_solver == BulkSolver::multigrid ? Ranks::number() : 1))
    , contact_surface(face)
    , layer_knots(make_layers(parameters))
    , scalar_fe(degree())
    , vector_fe(dealii::FE_Q<3>(has_splines() ? 1 : degree()), 3)
    , dofs(triangulation)
  {
    if (has_lattice())
      make_grid();
    else
      take_mesh();
    n_nodes_of_fe = dofs.n_dofs() / 3;
    make_mapping();
    number_nodes();
    if (has_lattice())
      complete_cells();
    if (!has_splines())
      add_nodes_of_fe();
    make_constraints();
    if (has_splines()) // of which nothing but the corners is asked for
      {
        dofs.clear();
        triangulation.clear();
      }
  }



  // The cells form a lattice. The triangulation is first made with lattice
  // indices as coordinates; then each vertex moves to its place. Where cells
  // are coarser below, the contact layer is refined, across only.
  void
  BulkSpace::make_grid()
  {
    const auto &n             = body_parameters.cells;
    const auto &[begin, end]  = columns;
    const unsigned int n_wide = body_parameters.coarser_below ? 2 : 1;
    dealii::GridGenerator::subdivided_hyper_rectangle(
      triangulation,
      {(end[0] - begin[0]) / n_wide, (end[1] - begin[1]) / n_wide, n[2]},
      dealii::Point<3>(begin[0], begin[1], 0),
      dealii::Point<3>(end[0], end[1], n[2]));
    set_boundary_ids();
    if (body_parameters.coarser_below)
      {
        for (const auto &[cell, face] : cells_at_contact_face(triangulation))
          cell->set_refine_flag(dealii::RefinementCase<3>::cut_xy);
        triangulation.execute_coarsening_and_refinement();
      }
    dofs.distribute_dofs(vector_fe);
    find_places_in_lattice();
    dealii::GridTools::transform(
      [&](const dealii::Point<3> &p) {
        const Eigen::Vector3d X = place_in_lattice(p);
        return dealii::Point<3>(X[0], X[1], X[2]);
      },
      triangulation);
  }



  void
  BulkSpace::take_mesh()
  {
    triangulation.copy_triangulation(body_parameters.mesh->triangulation);
    dofs.distribute_dofs(vector_fe);
    for (const auto &cell : dofs.active_cell_iterators())
      {
        Cell &info = bulk_cells.emplace_back();
        for (const unsigned int v : cell->vertex_indices())
          info.vertices[v] = cell->vertex_dof_index(v, 0) / 3;
        active_cells.emplace_back(cell);
      }
    unsigned int element = 0;
    for (const auto &[cell, face] : cells_at_contact_face(triangulation))
      {
        Cell &info           = bulk_cells[cell->active_cell_index()];
        info.enriched        = true;
        info.face            = ContactFace::of(face, body_side);
        info.surface_element = element++;
      }
  }



  void
  BulkSpace::find_places_in_lattice()
  {
    lattice.resize(dofs.n_dofs() / 3);
    boxes.resize(triangulation.n_levels());
    for (const auto &cell : dofs.cell_iterators())
      {
        if (degree() == 2 && !has_splines())
          boxes[cell->level()].push_back({{cell->vertex(0), cell->vertex(7)}});
        if (!cell->is_active())
          continue;
        Cell &info = bulk_cells.emplace_back();
        for (const unsigned int v : cell->vertex_indices())
          {
            const dealii::Point<3> p = cell->vertex(v);
            info.vertices[v]         = cell->vertex_dof_index(v, 0) / 3;
            auto &index              = lattice[info.vertices[v]];
            for (unsigned int d = 0; d < 3; ++d)
              index[d] = std::lround(p[d]);
            // layers are counted from the contact face, the bone's top
            if (body_side == Side::bone)
              index[2] = body_parameters.cells[2] - index[2];
          }
        if (!has_splines())
          active_cells.emplace_back(cell);
      }
  }



  // Indices say what is at the boundary. Those of a rank's part are none where
  // it is cut off.
  void
  BulkSpace::set_boundary_ids()
  {
    const auto  &n       = body_parameters.cells;
    const bool   is_bone = body_side == Side::bone;
    const double top = is_bone ? 0 : n[2], contact = is_bone ? n[2] : 0;
    for (const auto &face : triangulation.active_face_iterators())
      if (face->at_boundary())
        {
          const dealii::Point<3> p       = face->center();
          const auto             is_side = [&](const unsigned int d) {
            return is_bone && (p[d] == 0. || p[d] == n[d]);
          };
          face->set_boundary_id(p[2] == contact ? Boundary::contact :
                                p[2] == top     ? Boundary::held :
                                is_side(0)      ? Boundary::slides_x :
                                is_side(1)      ? Boundary::slides_y :
                                                  Boundary::free);
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



  namespace
  {
    /** Each cell by itself. With one thread FEValues takes what it can from the
     *  cell before if that is the same but for its place: other digits than
     * with several. */
    template <typename MappingType>
    class CellByCell : public MappingType
    {
    public:
      using MappingType::MappingType;

    protected:
      dealii::CellSimilarity::Similarity
      fill_fe_values(
        const dealii::Triangulation<3>::cell_iterator &cell,
        const dealii::CellSimilarity::Similarity,
        const dealii::Quadrature<3>                                     &points,
        const dealii::Mapping<3>::InternalDataBase                      &data,
        dealii::internal::FEValuesImplementation::MappingRelatedData<3> &output)
        const override
      {
        return MappingType::fill_fe_values(
          cell, dealii::CellSimilarity::none, points, data, output);
      }
    };
  } // namespace



  // Quadratic cells are curved as the body is.
  void
  BulkSpace::make_mapping()
  {
    if (degree() == 1 || has_splines())
      {
        bulk_mapping = std::make_unique<CellByCell<dealii::MappingQ<3>>>(1);
        return;
      }
    auto mapping =
      std::make_unique<CellByCell<dealii::MappingQCache<3>>>(degree());
    mapping->initialize(
      triangulation, [&](const dealii::Triangulation<3>::cell_iterator &cell) {
        if (!has_lattice())
          return body_parameters.mesh->points_of_second_order(cell);
        const auto &[corner, opposite] = boxes[cell->level()][cell->index()];
        std::vector<dealii::Point<3>> places;
        for (dealii::Point<3> p : scalar_fe.get_unit_support_points())
          {
            for (unsigned int d = 0; d < 3; ++d)
              p[d] = (1. - p[d]) * corner[d] + p[d] * opposite[d];
            const Eigen::Vector3d X = place_in_lattice(p);
            places.emplace_back(X[0], X[1], X[2]);
          }
        return places;
      });
    bulk_mapping = std::move(mapping);
  }



  // For splines fractions of the depth are Greville abscissae: the map is
  // linear in the depth, and the sides of a disk are those of a cylinder.
  void
  BulkSpace::number_nodes()
  {
    const ControlNet &control_points = contact_surface.control_points();
    if (has_splines())
      {
        const std::vector<double> fractions = layer_knots.greville_abscissae();
        const double end = -outward_sign() * body_parameters.thickness();
        for (unsigned int node = 0; node < n_inner_nodes(); ++node)
          {
            const auto      i = place_of(node).index;
            Eigen::Vector3d X = control_points.col(
              i[0] + contact_surface.knots(0).n_basis_functions() * i[1]);
            X[2] += (end - X[2]) * fractions[i[2]];
            reference_positions.push_back(X);
          }
      }
    else
      {
        std::vector<dealii::Point<3>> places(dofs.n_dofs());
        dealii::DoFTools::map_dofs_to_support_points(*bulk_mapping,
                                                     dofs,
                                                     places);
        for (unsigned int node = 0; node < n_inner_nodes(); ++node)
          reference_positions.emplace_back(places[3 * node][0],
                                           places[3 * node][1],
                                           places[3 * node][2]);
      }
    for (unsigned int A = 0; A < control_points.cols(); ++A)
      reference_positions.push_back(control_points.col(A));
  }



  // The first vertex of a cell is the one with the least coordinates.
  void
  BulkSpace::complete_cells()
  {
    const unsigned int n_functions =
      (contact_surface.degree() + 1) * (contact_surface.degree() + 1);
    for (Cell &info : bulk_cells)
      {
        const auto &first = lattice[info.vertices.front()],
                   &last  = lattice[info.vertices.back()];
        info.layer        = std::min(first[2], last[2]);
        info.enriched     = info.layer == 0;
        info.face = ContactFace::of(body_side == Side::bone ? 5 : 4, body_side);
        info.surface_element = first[0] + body_parameters.cells[0] * first[1];
        if (!has_splines())
          continue;
        const auto control_points =
          contact_surface.element_control_points(info.surface_element);
        // functions begin with the number of their first cell
        const auto add_level = [&](const unsigned int level) {
          const auto        &begin = columns.begin, &end = columns.end;
          const unsigned int n_1 = end[0] - begin[0] + 2;
          for (unsigned int a = 0; a < n_functions; ++a)
            info.nodes.push_back(
              level == 0 ? control_point_node(control_points[a]) :
                           (level - 1) * n_in_level() + first[0] - begin[0] +
                             a % 3 + n_1 * (first[1] - begin[1] + a / 3));
        };
        const unsigned int level = layer_knots.first_basis_function(info.layer);
        for (unsigned int k = level; k <= level + layer_knots.degree(); ++k)
          add_level(k);
      }
  }



  void
  BulkSpace::add_nodes_of_fe()
  {
    for (const auto &cell : dofs.active_cell_iterators())
      {
        Cell &info = bulk_cells[cell->active_cell_index()];
        if (info.enriched)
          {
            const auto control_points =
              contact_surface.element_control_points(info.surface_element);
            const unsigned int n = contact_surface.degree() + 1;
            for (unsigned int a = 0; a < n * n; ++a)
              info.nodes.push_back(control_point_node(control_points[a]));
          }
        const auto nodes = nodes_of_fe(cell);
        for (unsigned int a = 0; a < nodes.size(); ++a)
          if (!info.enriched ||
              !scalar_fe.has_support_on_face(a, info.face.number))
            info.nodes.push_back(nodes[a]);
      }
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



  BulkSpace::Place
  BulkSpace::place_of(const unsigned int node) const
  {
    const auto        &n   = body_parameters.cells;
    const unsigned int n_1 = contact_surface.knots(0).n_basis_functions(),
                       n_2 = contact_surface.knots(1).n_basis_functions();
    const bool is_inner    = node < n_inner_nodes();
    if (is_inner && !has_splines())
      return {lattice[node], n};
    const std::array<unsigned int, 3> last{
      {n_1 - 1, n_2 - 1, layer_knots.n_basis_functions() - 1}};
    if (!is_inner)
      {
        const unsigned int A = node - n_inner_nodes();
        return {{{A % n_1, A / n_1, 0}}, last};
      }
    const unsigned int n_here   = columns.end[0] - columns.begin[0] + 2,
                       in_level = node % n_in_level();
    return {{{columns.begin[0] + in_level % n_here,
              columns.begin[1] + in_level / n_here,
              1 + node / n_in_level()}},
            last};
  }



  namespace
  {
    /** Inner nodes of a whole body along x or y. */
    unsigned int
    n_across(const BulkSpace &mesh, const unsigned int direction)
    {
      const unsigned int n = mesh.parameters().cells[direction];
      return mesh.has_splines() ? n + 2 : mesh.degree() * n + 1;
    }
  } // namespace



  unsigned int
  BulkSpace::number_in_whole(const unsigned int node) const
  {
    const auto         i = place_of(node).index;
    const unsigned int n = n_across(*this, 0) * n_across(*this, 1);
    if (node >= n_inner_nodes())
      return n_nodes_of_whole() - n_nodes() + node;
    return i[0] + n_across(*this, 0) * i[1] +
           n * (has_splines() ? i[2] - 1 : i[2]);
  }



  unsigned int
  BulkSpace::n_nodes_of_whole() const
  {
    const unsigned int n_levels = has_splines() ?
                                    layer_knots.n_basis_functions() - 1 :
                                    degree() * body_parameters.cells[2] + 1;
    return n_across(*this, 0) * n_across(*this, 1) * n_levels +
           contact_surface.n_control_points();
  }



  unsigned int
  BulkSpace::n_dofs_as_published() const
  {
    return 3 * ((has_lattice() ? n_nodes_of_whole() : n_nodes()) -
                (body_parameters.contact_surface == SurfaceKind::nurbs ?
                   0 :
                   contact_surface.n_control_points()));
  }



  unsigned int
  BulkSpace::n_unknowns() const
  {
    if (body_parameters.bulk_solver != BulkSolver::multigrid)
      return 3 * (n_nodes() - std::count(tied.begin(), tied.end(), true));
    return 3 * (n_nodes_of_whole() -
                (has_splines() ? 0 : n_across(*this, 0) * n_across(*this, 1)));
  }



  // What several ranks have is the same on all of them.
  Eigen::VectorXd
  BulkSpace::gathered(const Eigen::VectorXd &v) const
  {
    Eigen::VectorXd whole =
      Eigen::VectorXd::Constant(3 * n_nodes_of_whole(),
                                -std::numeric_limits<double>::infinity());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      whole.segment<3>(3 * number_in_whole(node)) = v.segment<3>(3 * node);
    Ranks::take_largest(whole.data(), whole.size());
    return whole;
  }



  Eigen::VectorXd
  BulkSpace::own_part(const Eigen::VectorXd &whole) const
  {
    Eigen::VectorXd v(3 * n_nodes());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      v.segment<3>(3 * node) = whole.segment<3>(3 * number_in_whole(node));
    return v;
  }



  namespace
  {
    const std::array<std::pair<dealii::types::boundary_id, unsigned int>, 3>
      supports{{{Boundary::held, 7}, // bit c: component c
                {Boundary::slides_x, 1},
                {Boundary::slides_y, 2}}};
  } // namespace



  // What does not move at all is held at the far face and, of the bone, normal
  // to its sides. Nodes of FE_Q on the contact face follow the control points;
  // deal.II's make_zero_boundary_constraints() knows nothing of these, so that
  // all functions that do not vanish on a held face are held here.
  void
  BulkSpace::make_constraints()
  {
    fixed.assign(3 * n_nodes(), false);
    tied.assign(n_nodes(), false);
    for (const auto &cell : dofs.active_cell_iterators())
      {
        if (!cell->at_boundary())
          continue;
        const Cell &info = bulk_cells[cell->active_cell_index()];
        for (const unsigned int f : cell->face_indices())
          for (const auto &[id, components] : supports)
            if (cell->at_boundary(f) && cell->face(f)->boundary_id() == id)
              hold(info, f, components);
        if (info.enriched && !has_splines())
          tie(info, nodes_of_fe(cell));
      }
    tell_held_control_points();
    tie_hanging_nodes();
    follow.close();
    hold_followed_nodes();
    for (const Cell &cell : bulk_cells)
      followers_in_cells =
        followers_in_cells ||
        std::any_of(cell.nodes.begin(),
                    cell.nodes.end(),
                    [&](const unsigned int node) { return tied[node]; });
    for (unsigned int dof = 0; dof < fixed.size(); ++dof)
      if (fixed[dof])
        all_constraints.add_line(dof);
    all_constraints.merge(follow);
    all_constraints.close();
  }



  // A node on the contact face that is held by a cell beside: what it follows
  // is. It has been found by its own cell, and functions are not negative.
  void
  BulkSpace::hold_followed_nodes()
  {
    for (const auto &line : follow.get_lines())
      if (fixed[line.index])
        {
          fixed[line.index] = false;
          for (const auto &[other, weight] : line.entries)
            fixed[other] = true;
        }
  }



  void
  BulkSpace::tie_hanging_nodes()
  {
    if (!body_parameters.coarser_below)
      return;
    dealii::AffineConstraints<double> hanging;
    dealii::DoFTools::make_hanging_node_constraints(dofs, hanging);
    hanging.close();
    for (const auto &line : hanging.get_lines())
      {
        // where it is, it follows them, too: cells fit together
        const unsigned int node = line.index / 3;
        if (!tied[node])
          {
            tied[node]                = true;
            reference_positions[node] = Eigen::Vector3d::Zero();
            for (const auto &[other, weight] : line.entries)
              reference_positions[node] +=
                weight * reference_positions[other / 3];
          }
        if (fixed[line.index])
          continue; // and so are those that it would follow
        follow.add_line(line.index);
        follow.add_entries(line.index, line.entries);
      }
  }



  // Functions that do not vanish on a face have no zero at a point of it that
  // is nothing special to them.
  void
  BulkSpace::hold(const Cell        &cell,
                  const unsigned int face,
                  const unsigned int components)
  {
    dealii::Point<3> point(0.3, 0.3, 0.3);
    point[face / 2]     = face % 2;
    const ShapeValues N = CellFunctions(*this, cell).at(point);
    for (unsigned int a = 0; a < N.rows(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        if (std::abs(N(a, 0)) > 1e-12 && (components >> c & 1) != 0)
          fixed[3 * cell.nodes[a] + c] = true;
  }



  // All ranks know all control points, but each has its own cells.
  void
  BulkSpace::tell_held_control_points()
  {
    if (body_parameters.bulk_solver != BulkSolver::multigrid)
      return;
    const unsigned int  first = 3 * n_inner_nodes();
    std::vector<double> held(fixed.begin() + first, fixed.end());
    Ranks::take_largest(held.data(), held.size());
    for (unsigned int i = 0; i < held.size(); ++i)
      fixed[first + i] = held[i] == 1.;
  }



  void
  BulkSpace::tie(const Cell &cell, const std::vector<unsigned int> &nodes_of_fe)
  {
    for (unsigned int a = 0; a < scalar_fe.n_dofs_per_cell(); ++a)
      if (const unsigned int node = nodes_of_fe[a];
          scalar_fe.has_support_on_face(a, cell.face.number) && !tied[node])
        {
          tied[node] = true;
          const ShapeValues N =
            CellFunctions(*this, cell).at(scalar_fe.unit_support_point(a));
          for (unsigned int c = 0; c < 3; ++c)
            {
              follow.add_line(3 * node + c);
              for (unsigned int b = 0; b < N.rows(); ++b)
                if (N(b, 0) != 0.)
                  follow.add_entry(3 * node + c,
                                   3 * cell.nodes[b] + c,
                                   N(b, 0));
            }
        }
  }



  void
  BulkSpace::distribute(Eigen::VectorXd &v) const
  {
    for (const auto &line : follow.get_lines())
      {
        v[line.index] = 0.;
        for (const auto &[other, weight] : line.entries)
          v[line.index] += weight * v[other];
      }
  }



  void
  BulkSpace::condense(Eigen::VectorXd &force) const
  {
    if (!cells_have_followers())
      return;
    for (const auto &line : follow.get_lines())
      {
        for (const auto &[other, weight] : line.entries)
          force[other] += weight * force[line.index];
        force[line.index] = 0.;
      }
  }
} // namespace Debond
