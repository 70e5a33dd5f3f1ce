#include <debond/system/coupled_tangent.h>

#include <Eigen/Geometry>

namespace Debond
{
  // The time is what it should be, or the mean slip has grown by what it
  // should.
  double
  PathEquation::evaluate(const ContactInterface       &interface,
                         const InterfaceConfiguration &configuration,
                         const double                  time,
                         const double                  reference)
  {
    gradient.setZero(number + 1);
    rates = configuration.chuck->rates(time);
    if (slip == 0.)
      {
        gradient[number] = reference;
        return 0.;
      }
    const MeanSlip mean   = interface.mean_slip(configuration);
    const double   weight = reference / slip;
    add_in_unknowns(mean.gradient, configuration, weight, gradient);
    return weight * (mean.value - old_slip - slip);
  }



  void
  PathEquation::apply(const InterfaceConfiguration &configuration,
                      const Eigen::VectorXd        &x,
                      Eigen::Ref<Eigen::VectorXd>   y) const
  {
    const Chuck &chuck = *configuration.chuck;
    const double dt    = x[number];
    for (const auto &[k, row] : configuration.chuck_unknowns)
      if (chuck.is_prescribed(k))
        y[row] = stiffness[k] * (x[row] - rates[k] * dt);
      else
        y[row] -= chuck.machine_load_per_value(k) * rates[k] * dt;
    y[number] = gradient.dot(x);
  }



  unsigned int
  CoupledTangent::size() const
  {
    return bodies[0]->n_unknowns() + bodies[1]->n_unknowns() +
           configuration.chuck_unknowns.size() + (path.follow ? 1 : 0);
  }



  // Terms of the tangent that come from the rotation of the implant's frame and
  // of lever arms with the unknown rotations of the chuck:
  // (dQ^T/dq_k) f, f . (b_k x dx) and f . d^2x/dq_k dq_l.
  void
  CoupledTangent::add_geometric_part(const Eigen::VectorXd &x,
                                     Eigen::VectorXd       &y) const
  {
    const Chuck &chuck = *configuration.chuck;
    const auto  &side  = configuration.side[Side::implant];
    for (const auto &[k, row] : configuration.chuck_unknowns)
      {
        y[row] -= chuck.machine_stiffness(k) * x[row];
        if (!is_rotation(k))
          continue;
        for (unsigned int A = 0; A < side.positions.cols(); ++A)
          {
            const Eigen::Vector3d f = interface.force(Side::implant).col(A);
            const Eigen::Vector3d turned =
              side.frame.transpose() * f.cross(chuck.axis(k));
            for (unsigned int c = 0; c < 3; ++c)
              {
                const int number = side.unknown_of[3 * A + c];
                if (number >= 0)
                  {
                    y[number] += turned[c] * x[row];
                    y[row] += turned[c] * x[number];
                  }
              }
            for (const auto &[l, column] : configuration.chuck_unknowns)
              y[row] +=
                f.dot(chuck.second_derivative(k, l, side.positions.col(A))) *
                x[column];
          }
      }
  }



  Eigen::VectorXd
  CoupledTangent::interface_product(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
    interface.apply_tangent(configuration, x, y);
    add_geometric_part(x, y);
    if (path.follow)
      path.apply(configuration, x, y);
    return y;
  }



  Eigen::VectorXd
  CoupledTangent::product(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd y = interface_product(x);
    for_each_bulk([&](const Bulk &bulk, const int first, const int n) {
      y.segment(first, n) += bulk.product(x.segment(first, n));
    });
    return y;
  }



  bool
  CoupledTangent::can_be_assembled() const
  {
    bool result = true;
    for_each_bulk(
      [&](const Bulk &bulk, int, int) { result = result && bulk.is_dense(); });
    return result;
  }



  Eigen::VectorXd
  CoupledTangent::solve_bulk(const Eigen::VectorXd &b) const
  {
    Eigen::VectorXd x = b;
    for_each_bulk([&](const Bulk &bulk, const int first, const int n) {
      x.segment(first, n) = bulk.solve(b.segment(first, n));
    });
    return x;
  }



  void
  CoupledTangent::assemble(Eigen::MatrixXd &matrix) const
  {
    matrix.setZero(size(), size());
    for_each_bulk([&](const Bulk &bulk, const int first, const int n) {
      matrix.block(first, first, n, n) = bulk.dense_stiffness();
    });
    interface.add_tangent(configuration, matrix);
    const unsigned int n_v = bodies[0]->n_unknowns() + bodies[1]->n_unknowns();
    Eigen::VectorXd    column(size());
    for (const auto &[k, number] : configuration.chuck_unknowns)
      {
        column.setZero();
        add_geometric_part(Eigen::VectorXd::Unit(size(), number), column);
        matrix.col(number) += column;
        // the v-part of the border is symmetric
        matrix.row(number).head(n_v) += column.head(n_v).transpose();
      }
    if (path.follow)
      for (unsigned int j = 0; j < size(); ++j)
        path.apply(configuration,
                   Eigen::VectorXd::Unit(size(), j),
                   matrix.col(j));
  }
} // namespace Debond
