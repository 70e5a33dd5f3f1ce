#include <debond/bulk/body.h>
#include <debond/bulk/bulk_space.h>
#include <debond/output/body_points.h>
#include <debond/output/bulk_fields.h>
#include <debond/support/ranks.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace Debond
{
  namespace
  {
    FieldNames
    fields_of_bulk(const bool draws_modulus)
    {
      FieldNames fields{{"displacement", 3},
                        {"displacement_in_frame", 3},
                        {"stress_MPa", 9},
                        {"von_Mises_MPa", 1},
                        {"body", 1}};
      if (draws_modulus)
        fields.emplace_back("young_modulus_MPa", 1);
      return fields;
    }



    bool
    is_of_degree_2(const Body *const body)
    {
      return body->mesh().degree() > 1;
    }



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



  // Quadratic elements are quadratic cells in the file, which has one piece:
  // ParaView mixes up the points of curved cells in files of several. Of
  // several ranks each draws its part of the bone, and the first one the
  // implant.
  BulkFields::BulkFields(const std::array<const Body *, 2> &bodies,
                         const Chuck                       &chuck)
    : DrawnPatches<3>(fields_of_bulk(bodies[0]->mesh().parameters().modulus !=
                                     nullptr),
                      std::any_of(bodies.begin(), bodies.end(), is_of_degree_2))
    , draws_modulus(bodies[0]->mesh().parameters().modulus != nullptr)
  {
    const bool has_curves =
      std::any_of(bodies.begin(), bodies.end(), is_of_degree_2);
    for (const Body *const body : bodies)
      if (body->mesh().side() == Side::bone || Ranks::is_first())
        draw(*body,
             chuck,
             has_curves ?
               2 :
               n_pieces(body->surface().n_elements_across(), 24, 2, 8));
  }



  // Trilinear elements at a curved surface have a curved face: of these alone
  // more points are drawn.
  void
  BulkFields::draw(const Body        &body,
                   const Chuck       &chuck,
                   const unsigned int n_of_curved_cells)
  {
    const BulkSpace &space = body.mesh();
    const BodyFields fields(body, chuck);
    const double     side = space.side() == Side::implant;
    std::array<std::vector<unsigned int>, 2> numbers; // plane, curved
    for (unsigned int k = 0; k < space.cells().size(); ++k)
      numbers[space.degree() > 1 ||
              (space.cells()[k].enriched && space.surface().degree() > 1)]
        .push_back(k);
    if (space.side() == Side::bone)
      tension = tension_of(space, fields.vertex_stress);
    for (const bool is_curved : {false, true})
      {
        const unsigned int n = is_curved ? n_of_curved_cells : 1;
        const auto         points =
          dealii::QIterated<3>(dealii::QTrapezoid<1>(), n).get_points();
        std::vector<ShapeValues> phi;
        for (const dealii::Point<3> &point : points)
          phi.push_back(shape_values(space.element(), point));
        add(numbers[is_curved].size(), n, [&](const unsigned int k) {
          const unsigned int     number = numbers[is_curved][k];
          const BulkSpace::Cell &cell   = space.cells()[number];
          const double           modulus =
            body.bulk() ? body.bulk()->young_modulus(number) : 0.;
          return
            [&, modulus, N = CellFunctions(space, cell).values_at(points, phi)](
              const unsigned int p, std::vector<double> &values) {
              const BodyFields::Point point =
                fields.at(cell, points[p], N.col(p));
              append_values(values, point.u);
              append_values(values, point.v);
              append_values(values, point.stress);
              values.push_back(von_mises(point.sigma));
              values.push_back(side);
              if (draws_modulus)
                values.push_back(modulus);
              return point.X;
            };
        });
      }
  }
} // namespace Debond
