#include <debond/bulk/body.h>
#include <debond/bulk/chuck.h>
#include <debond/output/body_points.h>
#include <debond/support/ranks.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_q.h>

#include <limits>
#include <optional>

namespace Debond
{
  BodyFields::BodyFields(const Body &body, const Chuck &chuck)
    : space(body.mesh())
    , chuck(space.side() == Side::implant ? &chuck : nullptr)
    , v(body.full_displacement())
    , vertex_stress(body.vertex_stress(v))
  {}



  BodyFields::Point
  BodyFields::at(const BulkSpace::Cell                   &cell,
                 const dealii::Point<3>                  &unit,
                 const Eigen::Ref<const Eigen::VectorXd> &N) const
  {
    Point point;
    for (unsigned int a = 0; a < N.size(); ++a)
      {
        point.X += N[a] * space.reference_position(cell.nodes[a]);
        point.v += N[a] * v.segment<3>(3 * cell.nodes[a]);
      }
    for (const unsigned int a : dealii::GeometryInfo<3>::vertex_indices())
      point.sigma += dealii::GeometryInfo<3>::d_linear_shape_function(unit, a) *
                     vertex_stress[cell.vertices[a]];
    point.u      = point.v;
    point.stress = point.sigma;
    if (chuck != nullptr)
      {
        const Eigen::Matrix3d Q = chuck->rotation();
        point.u                 = chuck->map(point.X, point.v) - point.X;
        point.stress            = Q * point.sigma * Q.transpose();
      }
    return point;
  }



  namespace
  {
    dealii::Point<3>
    as_point(const Eigen::Vector3d &x)
    {
      return {x[0], x[1], x[2]};
    }



    /** A box around the nodes of a cell, and so around the cell: control points
     *  enclose what is curved. */
    dealii::BoundingBox<3>
    box_around(const BulkSpace &space, const BulkSpace::Cell &cell)
    {
      std::vector<dealii::Point<3>> points;
      for (const unsigned int node : cell.nodes)
        points.push_back(as_point(space.reference_position(node)));
      dealii::BoundingBox<3> box(points);
      const auto            &ends = box.get_boundary_points();
      box.extend(0.05 * ends.first.distance(ends.second));
      return box;
    }



    /** The functions of a cell at the point that lies at @p X, and the point,
     * by Newton's method within the unit cell. False if there is none. At the
     *  corners of a disk the derivatives are singular: what counts is where the
     *  point is, to a millionth of the cell. */
    bool
    find_in_cell(const BulkSpace       &space,
                 const BulkSpace::Cell &cell,
                 const CellFunctions   &functions,
                 const Eigen::Vector3d &X,
                 dealii::Point<3>      &unit,
                 ShapeValues           &N)
    {
      using Geometry = dealii::GeometryInfo<3>;
      unit           = dealii::Point<3>(0.5, 0.5, 0.5);
      for (unsigned int iteration = 0; iteration < 30; ++iteration)
        {
          N                          = functions.at(unit);
          Eigen::Vector3d difference = X;
          Eigen::Matrix3d slope      = Eigen::Matrix3d::Zero();
          for (unsigned int a = 0; a < N.rows(); ++a)
            {
              const Eigen::Vector3d &node =
                space.reference_position(cell.nodes[a]);
              difference -= N(a, 0) * node;
              slope += node * N.block<1, 3>(a, 1);
            }
          const double error = difference.norm() / slope.norm();
          if (error < 1e-10)
            return true;
          const Eigen::Vector3d step = slope.partialPivLu().solve(difference);
          const auto            next =
            Geometry::project_to_unit_cell(unit + as_point(step));
          if (!(next.distance(unit) > 1e-9))
            return error < 1e-6;
          unit = next;
        }
      return false;
    }
  } // namespace



  // Cells of several ranks: what none has stays at minus infinity.
  Eigen::MatrixXd
  values_at_points(const Body             &body,
                   const Chuck            &chuck,
                   const Eigen::Matrix3Xd &points)
  {
    constexpr double none  = -std::numeric_limits<double>::infinity();
    const BulkSpace &space = body.mesh();
    const BodyFields fields(body, chuck);
    Eigen::MatrixXd values = Eigen::MatrixXd::Constant(12, points.cols(), none);
    for (const BulkSpace::Cell &cell : space.cells())
      {
        const auto                   box = box_around(space, cell);
        std::optional<CellFunctions> functions; // which are dear
        for (unsigned int p = 0; p < points.cols(); ++p)
          {
            const Eigen::Vector3d X = points.col(p);
            if (values(0, p) != none || !box.point_inside(as_point(X)))
              continue;
            if (!functions)
              functions.emplace(space, cell);
            dealii::Point<3> unit;
            ShapeValues      N;
            if (!find_in_cell(space, cell, *functions, X, unit, N))
              continue;
            const BodyFields::Point point = fields.at(cell, unit, N.col(0));
            values.col(p).head<3>()       = point.u;
            Eigen::Map<Eigen::Matrix3d>(&values(3, p)) = point.stress;
          }
      }
    dealii::Utilities::MPI::max(
      dealii::ArrayView<const double>(values.data(), values.size()),
      Ranks::communicator(),
      dealii::ArrayView<double>(values.data(), values.size()));
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
    values = (values.array() == none).select(nowhere, values).eval();
    if (!body.bulk()) // a rigid body has forces and no stress
      values.bottomRows<9>().setConstant(nowhere);
    return values;
  }
} // namespace Debond
