#include <debond/system/coupled_tangent.h>

#include <Eigen/Geometry>

// The matrix of Newton's method: A = B + C with B = diag(S_bone, S_implant, D),
// the condensed bodies, and C everything else. In step-44's terms it is the
// tangent_matrix, but it is not stored: the linear solver asks for products.
// The derivatives of Eqs. (29) to (32) at a point are in contact_point.cc,
// their sum over points in contact_tangent.cc; here are the terms that come
// from the moving frame of the implant, the chuck, and the path.
//
// C is unsymmetric: friction has no potential while points slide.
namespace Debond
{
  // Along a path the time is unknown, and something else is given instead: the
  // step's growth of the mean sliding distance [mm], which, unlike the time,
  // grows even where the path snaps back,
  //
  //   r_t = (g_mean - g_mean^n - slip) F / slip,
  //
  // F the reference force [N]. g_mean is the area mean of g_s, Eq. (32), which
  // never falls. With slip = 0 the time is given after all, and dt = 0 follows
  // from r_t = 0 and the gradient F.
  //
  // Arc length in the space of all unknowns would do as well in smooth
  // problems, but a bond that breaks does so at a few points, and hardly shows
  // in the norm of all displacements.
  double
  PathEquation::evaluate(const ContactInterface       &interface,
                         const InterfaceConfiguration &configuration,
                         const double                  time,
                         const double                  reference)
  {
    gradient.setZero(number + 1);
    rates.setZero();
    if (slip == 0.)
      {
        gradient[number] = reference;
        return 0.;
      }
    // d value_k / dt of what the scene prescribes, in its unit of time: the
    // column of the time is made of these. At the first time, which is given,
    // they would be asked for before there are any.
    rates = configuration.chuck->rates(time);
    // The exact gradient, in which xi_hat moves: without it Newton's method
    // would not be quadratic.
    const PathLength mean   = interface.path_length(configuration);
    const double     weight = reference / slip;
    add_in_unknowns(mean.gradient, configuration, weight, gradient);
    for (const auto &[component, row] : configuration.chuck_unknowns)
      gradient[row] += weight * mean.by_chuck[component];
    return weight * (mean.value - old_slip - slip);
  }



  // Rows of prescribed components: dq_k = (d value_k / dt) dt, times a
  // stiffness that gives them the size of the other rows. Rows of loaded ones,
  // or ones with a spring: the load, or the point that the spring hangs on,
  // changes with the time, too.
  //
  // So the matrix is bordered by one row and one column, and regular where the
  // tangent without them is singular: at a limit point of the path, where the
  // time has an extreme value.
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
  // chuck:
  //
  //   (dQ^T/dq_k) f,     f . (b_k x dx),     f . d^2x/dq_k dq_l,
  //
  // with b_k the axis of the rotation q_k. Where q_k is prescribed, and no path
  // is followed, it does not change during the iteration. The terms are of the
  // size of forces over lengths, small against the stiffness of the bodies; but
  // without them the iteration with a loaded chuck would not be quadratic.
  void
  CoupledTangent::add_geometric_part(const Eigen::VectorXd &x,
                                     Eigen::VectorXd       &y) const
  {
    const Chuck &chuck = *configuration.chuck;
    const auto  &side  = configuration.side[Side::implant];
    for (const auto &[k, row] : configuration.chuck_unknowns)
      {
        // The load of a spring falls as the chuck gives way: k (value - q), so
        // that this adds +k to the diagonal.
        if (path.stiffness[k] > 0.)
          y[row] -= chuck.machine_stiffness(k) * x[row];
        if (!is_rotation(k))
          continue;
        for (unsigned int A = 0; A < side.positions.cols(); ++A)
          {
            const Eigen::Vector3d f = interface.force(Side::implant).col(A);
            // (dQ^T/dq_k) f = Q^T (f x b_k) [N], and the same number couples
            // the row of q_k with the displacement in the moving frame: f .
            // (b_k x Q dv) = Q^T (f x b_k) . dv. So this part is symmetric.
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
              // The axes b_k move with the rotation themselves, and so do the
              // lever arms.
              y[row] +=
                f.dot(chuck.second_derivative(k, l, side.positions.col(A))) *
                x[column];
          }
      }
  }



  // All of the tangent but the bodies: what the points contribute by their
  // total derivatives df/dx, turned into the frames, then the geometric part,
  // then the path. A product follows one motion of each point; to fill a matrix
  // would take one for each unknown that the point depends on.
  Eigen::VectorXd
  CoupledTangent::product_without_bulk(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
    interface.apply_tangent(configuration, x, y);
    add_geometric_part(x, y);
    if (path.follow)
      path.apply(configuration, x, y);
    scale_rows(y);
    return y;
  }



  // C x. What B has of the chuck, C takes away again.
  Eigen::VectorXd
  CoupledTangent::interface_product(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd y = product_without_bulk(x);
    for (const auto &[k, row] : configuration.chuck_unknowns)
      y[row] -= chuck_stiffness_of_bulk(k) * x[row];
    return y;
  }



  // A x. Needed only where a factorisation is the preconditioner; with B^-1
  // there is no product with B.
  Eigen::VectorXd
  CoupledTangent::product(const Eigen::VectorXd &x) const
  {
    return product_without_bulk(x) + bulk_product(x);
  }



  Eigen::VectorXd
  CoupledTangent::bulk_product(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
    for_each_bulk(
      [&](const CondensingBulk &bulk, const int first, const int n) {
        y.segment(first, n) = bulk.product(x.segment(first, n));
      });
    return y;
  }



  // A bulk that is not condensed has no S to write down. GMRES with its own
  // solver as preconditioner has to do then.
  bool
  CoupledTangent::can_be_assembled() const
  {
    bool result = !bodies[0]->whole();
    for_each_bulk([&](const CondensingBulk &bulk, int, int) {
      result = result && bulk.is_dense();
    });
    return result;
  }



  // B^-1 b, body by body: the preconditioner. The bodies know nothing of each
  // other; the interface is what the iteration has to find. An unknown
  // component of the chuck, which no body resists, is one direction more that
  // it has to find, or leaves B without an inverse (bulk_is_regular).
  Eigen::VectorXd
  CoupledTangent::solve_bulk(const Eigen::VectorXd &b) const
  {
    Eigen::VectorXd x = b;
    for_each_bulk(
      [&](const CondensingBulk &bulk, const int first, const int n) {
        x.segment(first, n) = bulk.solve(b.segment(first, n));
      });
    for (const auto &[k, row] : configuration.chuck_unknowns)
      x[row] /= chuck_stiffness_of_bulk(k);
    return x;
  }



  // The implant, the chuck and, along a path, the time, for a bone whose
  // unknowns are a part of something larger. B has a stiffness for the chuck
  // here.
  Eigen::VectorXd
  CoupledTangent::product_beside_bone(const Eigen::VectorXd &x) const
  {
    const unsigned int n_bone = bodies[0]->n_unknowns(),
                       n      = bodies[1]->n_unknowns();
    Eigen::VectorXd y         = Eigen::VectorXd::Zero(x.size());
    if (bodies[1]->condensing())
      y.head(n) = bodies[1]->condensing()->product(x.head(n));
    for (const auto &[k, row] : configuration.chuck_unknowns)
      y[row - n_bone] = chuck_stiffness_of_bulk(k) * x[row - n_bone];
    return y;
  }

  Eigen::VectorXd
  CoupledTangent::solve_beside_bone(const Eigen::VectorXd &b) const
  {
    const unsigned int n_bone = bodies[0]->n_unknowns(),
                       n      = bodies[1]->n_unknowns();
    Eigen::VectorXd x         = b;
    if (bodies[1]->condensing())
      x.head(n) = bodies[1]->condensing()->solve(b.head(n));
    for (const auto &[k, row] : configuration.chuck_unknowns)
      x[row - n_bone] /= chuck_stiffness_of_bulk(k);
    return x;
  }



  // The geometric part of the matrix, column by column: that of a chuck
  // component is what it makes of a unit vector. The part of the border that
  // couples with v is symmetric. What couples components with each other is in
  // the column already.
  void
  CoupledTangent::add_chuck(Eigen::MatrixXd &matrix) const
  {
    for (const auto &[component, number] : configuration.chuck_unknowns)
      {
        const unsigned int n_v    = configuration.chuck_unknowns[0].second;
        Eigen::VectorXd    column = Eigen::VectorXd::Zero(size());
        add_geometric_part(Eigen::VectorXd::Unit(size(), number), column);
        matrix.col(number) += column;
        matrix.row(number).head(n_v) += column.head(n_v).transpose();
      }
  }



  // The same as a matrix, for a factorisation where the bulk alone is no good
  // preconditioner: with a loaded chuck, or an interface that is stiff against
  // the bodies.
  void
  CoupledTangent::assemble(Eigen::MatrixXd &matrix) const
  {
    matrix.setZero(size(), size());
    for_each_bulk(
      [&](const CondensingBulk &bulk, const int first, const int n) {
        matrix.block(first, first, n, n) = bulk.dense_stiffness();
      });
    interface.add_tangent(configuration, matrix);
    add_chuck(matrix);
    if (path.follow)
      for (unsigned int j = 0; j < size(); ++j)
        path.apply(configuration,
                   Eigen::VectorXd::Unit(size(), j),
                   matrix.col(j));
    scale_rows(matrix);
  }

} // namespace Debond
