#include <debond/system/coupled_tangent.h>

#include <Eigen/Geometry>

namespace Debond
{
  // Along a path the time is unknown, and something else is given instead: the
  // step's growth of the mean sliding distance, which, unlike the time, grows
  // even where the path snaps back,
  //
  //   r_t = (g_mean - g_mean^n - slip) F / slip,
  //
  // F the reference force. With slip = 0 the time is given after all, and dt =
  // 0 follows from r_t = 0 and the gradient F.
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



  // Rows of prescribed components: dq_k = (d value_k / dt) dt, times a
  // stiffness that gives them the size of the other rows. Rows of loaded ones:
  // the load changes with the time, too.
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



  // A row of a body is Q^T f, one of the chuck f . dx/dq_k. Their derivatives
  // with f at rest are the terms of the tangent that come from the rotation of
  // the implant's frame and of lever arms with the unknown rotations of the
  // chuck: (dQ^T/dq_k) f, f . (b_k x dx) and f . d^2x/dq_k dq_l.
  void
  CoupledTangent::add_geometric_part(const Eigen::VectorXd &x,
                                     Eigen::VectorXd       &y) const
  {
    const Chuck &chuck = *configuration.chuck;
    const auto  &side  = configuration.side[Side::implant];
    for (const auto &[k, row] : configuration.chuck_unknowns)
      {
        // the load of a spring falls as the chuck gives way
        y[row] -= chuck.machine_stiffness(k) * x[row];
        if (!is_rotation(k))
          continue;
        for (unsigned int A = 0; A < side.positions.cols(); ++A)
          {
            const Eigen::Vector3d f = interface.force(Side::implant).col(A);
            // (dQ^T/dq_k) f = Q^T (f x b_k), and the same number couples the
            // row of q_k with the displacement in the moving frame
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



  // C x, all of the tangent but the bodies: what the points contribute by their
  // total derivatives df/dx, turned into the frames, then the geometric part.
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



  // (B + C) x, B = diag(S_bone, S_implant, 0).
  Eigen::VectorXd
  CoupledTangent::product(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd y = interface_product(x);
    for_each_bulk([&](const Bulk &bulk, const int first, const int n) {
      y.segment(first, n) += bulk.product(x.segment(first, n));
    });
    return y;
  }



  // A bulk that is not condensed has no S to write down.
  bool
  CoupledTangent::can_be_assembled() const
  {
    bool result = true;
    for_each_bulk(
      [&](const Bulk &bulk, int, int) { result = result && bulk.is_dense(); });
    return result;
  }



  // B^-1 b, body by body: the preconditioner.
  Eigen::VectorXd
  CoupledTangent::solve_bulk(const Eigen::VectorXd &b) const
  {
    Eigen::VectorXd x = b;
    for_each_bulk([&](const Bulk &bulk, const int first, const int n) {
      x.segment(first, n) = bulk.solve(b.segment(first, n));
    });
    return x;
  }



  // The same as a matrix, for a factorisation where the bulk alone is no good
  // preconditioner.
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
