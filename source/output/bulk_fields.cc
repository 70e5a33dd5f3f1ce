#include <debond/bulk/body.h>
#include <debond/bulk/bulk_space.h>
#include <debond/output/body_points.h>
#include <debond/output/bulk_fields.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <sstream>
#include <utility>

namespace Debond
{
  /** From v (three components) and the Cauchy stress (nine) in a body's frame
   *  to the fields in space. */
  class BulkFields::FieldsInSpace : public dealii::DataPostprocessor<3>
  {
  public:
    explicit FieldsInSpace(const BodyFrame &frame)
      : frame(frame)
    {}

    void
    evaluate_vector_field(
      const dealii::DataPostprocessorInputs::Vector<3> &inputs,
      std::vector<dealii::Vector<double>>              &fields) const override
    {
      for (unsigned int p = 0; p < fields.size(); ++p)
        {
          const dealii::Vector<double> &values = inputs.solution_values[p];
          const Eigen::Map<const Eigen::Vector3d> v(values.begin());
          const Eigen::Map<const Eigen::Matrix3d> sigma(values.begin() + 3);
          const dealii::Point<3>     &point = inputs.evaluation_points[p];
          Eigen::Map<Eigen::Vector3d> displacement(&fields[p][0]),
            displacement_in_frame(&fields[p][3]);
          Eigen::Map<Eigen::Matrix3d> stress(&fields[p][6]);
          displacement_in_frame = v;
          displacement  = frame.displacement({point[0], point[1], point[2]}, v);
          stress        = frame.stress(sigma);
          fields[p][15] = von_mises(sigma);
        }
    }

    std::vector<std::string>
    get_names() const override
    {
      std::vector<std::string> names(3, "displacement");
      names.insert(names.end(), 3, "displacement_in_frame");
      names.insert(names.end(), 9, "stress_MPa");
      names.push_back("von_Mises_MPa");
      return names;
    }

    std::vector<
      dealii::DataComponentInterpretation::DataComponentInterpretation>
    get_data_component_interpretation() const override
    {
      using namespace dealii::DataComponentInterpretation;
      std::vector<DataComponentInterpretation> kinds(
        6, component_is_part_of_vector);
      kinds.insert(kinds.end(), 9, component_is_part_of_tensor);
      kinds.push_back(component_is_scalar);
      return kinds;
    }

    dealii::UpdateFlags
    get_needed_update_flags() const override
    {
      return dealii::update_values | dealii::update_quadrature_points;
    }

  private:
    const BodyFrame frame;
  };



  class BulkFields::JoinedDataOut : public dealii::DataOut<3>
  {
  public:
    /** Takes the patches of another, as merge_patches() does, but of any
     *  numbers of pieces. Neighbours of patches are left as they are: VTU has
     *  none. */
    void
    take(JoinedDataOut &other)
    {
      for (auto &patch : other.patches)
        {
          patch.patch_index = patches.size();
          patches.push_back(std::move(patch));
        }
      other.patches.clear();
    }
  };



  /**
   * Cells of a body as DataOut draws them: on a triangulation of their own
   * (that of the body is gone when pictures are drawn), with the functions of
   * NURBS and splines interpolated by polynomials.
   */
  class BulkFields::DrawnCells
  {
  public:
    /** @p numbers: which cells of the body. @p degree: of the polynomials, and
     *  the number of pieces in each direction. */
    DrawnCells(const Body               &body,
               std::vector<unsigned int> numbers,
               const unsigned int        degree,
               const Chuck              &chuck)
      : body(body)
      , space(body.mesh())
      , numbers(std::move(numbers))
      , fe(dealii::FE_DGQ<3>(degree), 3, dealii::FE_DGQ<3>(1), 9)
      , dofs(triangulation)
      , mapping(degree)
      , fields(BodyFrame(body, chuck))
    {
      make_mesh();
    }

    /** @p v and @p stress are those at the nodes and vertices of the body. */
    void
    draw(const Eigen::VectorXd              &v,
         const std::vector<Eigen::Matrix3d> &stress,
         bool                                draws_modulus);

  private:
    const BulkSpace::Cell &
    cell(const unsigned int k) const
    {
      return space.cells()[numbers[k]];
    }
    template <typename Field>
    std::vector<Eigen::Matrix3Xd>
    at_support_points(const dealii::FiniteElement<3> &element,
                      const Field                    &field) const;
    void
    make_mesh();
    void
    fill_values(const Eigen::VectorXd              &v,
                const std::vector<Eigen::Matrix3d> &stress);

    const Body                     &body;
    const BulkSpace                &space;
    const std::vector<unsigned int> numbers;
    dealii::Triangulation<3>        triangulation;
    const dealii::FESystem<3>       fe; ///< v, stress
    dealii::DoFHandler<3>           dofs;
    dealii::MappingQCache<3>        mapping;
    dealii::Vector<double>          values, side, modulus;
    const FieldsInSpace             fields;

  public:
    JoinedDataOut data_out; ///< which refers to the above
  };



  // Of each cell, a column for each point. field() gives the value at a node.
  template <typename Field>
  std::vector<Eigen::Matrix3Xd>
  BulkFields::DrawnCells::at_support_points(
    const dealii::FiniteElement<3> &element,
    const Field                    &field) const
  {
    const auto              &points = element.get_unit_support_points();
    std::vector<ShapeValues> phi;
    for (const dealii::Point<3> &point : points)
      phi.push_back(shape_values(space.element(), point));
    std::vector<Eigen::Matrix3Xd> result(numbers.size());
    for_each_chunk(numbers.size(),
                   [&](const unsigned int,
                       const unsigned int first,
                       const unsigned int end) {
                     for (unsigned int k = first; k < end; ++k)
                       {
                         const auto      &nodes = cell(k).nodes;
                         Eigen::Matrix3Xd at_nodes(3, nodes.size());
                         for (unsigned int a = 0; a < nodes.size(); ++a)
                           at_nodes.col(a) = field(nodes[a]);
                         result[k] =
                           at_nodes *
                           CellFunctions(space, cell(k)).values_at(points, phi);
                       }
                   });
    return result;
  }



  // Cells hang together as in the body. Beside coarser ones there are vertices
  // in the middle of faces, of which nobody here asks.
  void
  BulkFields::DrawnCells::make_mesh()
  {
    const auto positions =
      at_support_points(dealii::FE_Q<3>(mapping.get_degree()),
                        [this](
                          const unsigned int node) -> const Eigen::Vector3d & {
                          return space.reference_position(node);
                        });
    const auto point = [&](const unsigned int k, const unsigned int a) {
      const auto X = positions[k].col(a);
      return dealii::Point<3>(X[0], X[1], X[2]);
    };
    std::vector<dealii::Point<3>>    vertices(space.n_vertices());
    std::vector<dealii::CellData<3>> cells(numbers.size());
    for (unsigned int k = 0; k < cells.size(); ++k)
      for (const unsigned int a : dealii::GeometryInfo<3>::vertex_indices())
        {
          cells[k].vertices[a]           = cell(k).vertices[a];
          vertices[cells[k].vertices[a]] = point(k, a);
        }
    dealii::SubCellData none;
    dealii::GridTools::delete_unused_vertices(vertices, cells, none);
    triangulation.create_triangulation(vertices, cells, none);
    mapping.initialize(triangulation, [&](const auto &cell) {
      std::vector<dealii::Point<3>> points;
      for (unsigned int a = 0; a < positions[cell->index()].cols(); ++a)
        points.push_back(point(cell->index(), a));
      return points;
    });
  }



  void
  BulkFields::DrawnCells::fill_values(
    const Eigen::VectorXd              &v,
    const std::vector<Eigen::Matrix3d> &stress)
  {
    const auto v_in_cells =
      at_support_points(fe.base_element(0), [&v](const unsigned int node) {
        return v.segment<3>(3 * node);
      });
    dofs.distribute_dofs(fe);
    values.reinit(dofs.n_dofs());
    std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &drawn : dofs.active_cell_iterators())
      {
        const unsigned int k = drawn->index();
        drawn->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const unsigned int c = fe.system_to_component_index(i).first,
                               a = fe.system_to_base_index(i).second;
            values[indices[i]] =
              c < 3 ? v_in_cells[k](c, a) : stress[cell(k).vertices[a]](c - 3);
          }
      }
  }



  void
  BulkFields::DrawnCells::draw(const Eigen::VectorXd              &v,
                               const std::vector<Eigen::Matrix3d> &stress,
                               const bool draws_modulus)
  {
    fill_values(v, stress);
    data_out.attach_dof_handler(dofs);
    data_out.add_data_vector(values, fields);
    side.reinit(numbers.size());
    side = space.side() == Side::implant ? 1. : 0.;
    data_out.add_data_vector(side, "body", data_out.type_cell_data);
    modulus.reinit(numbers.size());
    for (unsigned int k = 0; draws_modulus && k < numbers.size(); ++k)
      modulus[k] = body.bulk() ? body.bulk()->young_modulus(numbers[k]) : 0.;
    if (draws_modulus)
      data_out.add_data_vector(modulus,
                               "young_modulus_MPa",
                               data_out.type_cell_data);
    data_out.build_patches(mapping,
                           mapping.get_degree(),
                           data_out.curved_inner_cells);
  }



  unsigned int
  n_pieces(const NurbsSurface &surface,
           const unsigned int  across,
           const unsigned int  least,
           const unsigned int  most)
  {
    const unsigned int fewest = surface.n_elements_across();
    return std::clamp((across + fewest - 1) / fewest, least, most);
  }



  // Quadratic elements are quadratic cells in the file, which has one piece:
  // ParaView mixes up the points of curved cells in files of several. Of
  // several ranks each draws its part of the bone, and the first one the
  // implant.
  BulkFields::BulkFields(const std::array<const Body *, 2> &bodies,
                         const Chuck                       &chuck)
  {
    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false;
    flags.compression_level   = flags.best_speed;
    for (const Body *const body : bodies)
      flags.write_higher_order_cells |= body->mesh().degree() > 1;
    const bool draws_modulus =
      bodies[0]->mesh().parameters().modulus != nullptr;
    for (const Body *const body : bodies)
      if (body->mesh().side() == Side::bone || Ranks::is_first())
        add(*body, chuck, flags.write_higher_order_cells, draws_modulus);
    for (unsigned int i = 1; i < parts.size(); ++i)
      parts[0]->data_out.take(parts[i]->data_out);
    parts[0]->data_out.set_flags(flags);
  }



  namespace
  {
    // Vertices of cells, which of splines are no nodes.
    BoneTension
    tension_of(const BulkSpace                    &bone,
               const std::vector<Eigen::Matrix3d> &stress)
    {
      std::vector<double> tension;
      for (const Eigen::Matrix3d &sigma : stress)
        tension.push_back(
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sigma,
                                                         Eigen::EigenvaluesOnly)
            .eigenvalues()[2]);
      std::array<double, 4> found{{0, 0, 0, 0}}; // MPa, X
      for (const BulkSpace::Cell &cell : bone.cells())
        for (const unsigned int a : dealii::GeometryInfo<3>::vertex_indices())
          if (const double own = tension[cell.vertices[a]]; own > found[0])
            {
              const Eigen::Vector3d X =
                CellFunctions(bone, cell)
                  .position(dealii::GeometryInfo<3>::unit_cell_vertex(a));
              found = {{own, X[0], X[1], X[2]}};
            }
      if (Ranks::number() > 1)
        for (const auto &other :
             dealii::Utilities::MPI::all_gather(Ranks::communicator(), found))
          found = std::max(found, other);
      BoneTension result;
      result.MPa  = found[0];
      result.X_mm = {{found[1], found[2], found[3]}};
      return result;
    }
  } // namespace



  // Trilinear elements at a curved surface have a curved face: of these alone
  // more points are drawn.
  void
  BulkFields::add(const Body  &body,
                  const Chuck &chuck,
                  const bool   has_curved_cells,
                  const bool   draws_modulus)
  {
    const BulkSpace                         &space = body.mesh();
    std::array<std::vector<unsigned int>, 2> numbers; // plane, curved
    for (unsigned int k = 0; k < space.cells().size(); ++k)
      numbers[space.degree() > 1 ||
              (space.cells()[k].enriched && space.surface().degree() > 1)]
        .push_back(k);
    const Eigen::VectorXd v      = body.full_displacement();
    const auto            stress = body.vertex_stress(v);
    if (space.side() == Side::bone)
      largest_tension = tension_of(space, stress);
    const std::array<unsigned int, 2> degrees{
      {1, has_curved_cells ? 2 : n_pieces(space.surface(), 24, 2, 8)}};
    for (const bool is_curved : {false, true})
      if (!numbers[is_curved].empty())
        {
          parts.push_back(std::make_unique<DrawnCells>(
            body, numbers[is_curved], degrees[is_curved], chuck));
          parts.back()->draw(v, stress, draws_modulus);
        }
  }



  BulkFields::~BulkFields() = default;



  std::string
  BulkFields::vtu() const
  {
    Classic<std::ostringstream> text;
    parts[0]->data_out.write_vtu(text);
    return text.str();
  }



  std::string
  BulkFields::list_of_pieces(const std::vector<std::string> &pieces) const
  {
    Classic<std::ostringstream> text;
    parts[0]->data_out.write_pvtu_record(text, pieces);
    // which begins with a comment that holds the date
    std::string list  = text.str();
    const auto  begin = list.find("<!--"), end = list.find("-->");
    if (begin != list.npos && end != list.npos)
      list.erase(begin, end + 4 - begin);
    return list;
  }
} // namespace Debond
