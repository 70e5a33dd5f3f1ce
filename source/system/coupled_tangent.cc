#include <debond/system/coupled_tangent.h>

#include <Eigen/Geometry>

namespace Debond
{
  CoupledTangent::CoupledTangent(const Body                   &bone,
                                 const Body                   &implant,
                                 const ContactInterface       &interface,
                                 const InterfaceConfiguration &configuration,
                                 const PathEquation           &path)
    : bone(bone)
    , implant(implant)
    , interface(interface)
    , configuration(configuration)
    , path(path)
  {}



  unsigned int
  CoupledTangent::size() const
  {
    return bone.n_unknowns() + implant.n_unknowns() +
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
    const unsigned int n_b = bone.n_unknowns(), n_i = implant.n_unknowns();
    Eigen::VectorXd    y = interface_product(x);
    if (bone.bulk() != nullptr)
      y.head(n_b) += bone.bulk()->product(x.head(n_b));
    if (implant.bulk() != nullptr)
      y.segment(n_b, n_i) += implant.bulk()->product(x.segment(n_b, n_i));
    return y;
  }



  bool
  CoupledTangent::can_be_assembled() const
  {
    return (!bone.deformable() || bone.bulk()->is_dense()) &&
           (!implant.deformable() || implant.bulk()->is_dense());
  }



  // The bulk does not resist the chuck.
  bool
  CoupledTangent::bulk_is_regular() const
  {
    return configuration.chuck_unknowns.empty();
  }



  Eigen::VectorXd
  CoupledTangent::solve_bulk(const Eigen::VectorXd &b) const
  {
    const unsigned int n_b = bone.n_unknowns(), n_i = implant.n_unknowns();
    Eigen::VectorXd    x = b;
    if (bone.bulk() != nullptr)
      x.head(n_b) = bone.bulk()->solve(b.head(n_b));
    if (implant.bulk() != nullptr)
      x.segment(n_b, n_i) = implant.bulk()->solve(b.segment(n_b, n_i));
    return x;
  }



  void
  CoupledTangent::assemble(Eigen::MatrixXd &matrix) const
  {
    const unsigned int n_b = bone.n_unknowns(), n_i = implant.n_unknowns();
    matrix.setZero(size(), size());
    if (n_b > 0)
      matrix.topLeftCorner(n_b, n_b) = bone.bulk()->dense_stiffness();
    if (n_i > 0)
      matrix.block(n_b, n_b, n_i, n_i) = implant.bulk()->dense_stiffness();
    interface.add_tangent(configuration, matrix);
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(size()), column(size());
    for (const auto &[k, number] : configuration.chuck_unknowns)
      {
        unit[number] = 1.;
        column.setZero();
        add_geometric_part(unit, column);
        matrix.col(number) += column;
        // the v-part of the border is symmetric
        matrix.row(number).head(n_b + n_i) +=
          column.head(n_b + n_i).transpose();
        unit[number] = 0.;
      }
    if (path.follow)
      path.assemble(configuration, matrix);
  }
} // namespace Debond
