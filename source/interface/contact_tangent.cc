#include <debond/interface/bilinear_bond.h>
#include <debond/interface/contact_interface.h>
#include <debond/interface/point_motion.h>

#include <limits>
#include <optional>
#include <vector>

namespace Debond
{
  // The tangent of the nodal forces of Eq. (36). Where the update of a point
  // says how its traction changes with the place of slave point and master
  // (contact_point.cc, slip_problem.cc), and PointMotion how control points
  // move it, this file puts both together for all points: C = Q^T (df/dx) Q,
  // which is added to the condensed stiffness S of the bodies. It is exact,
  // with the sliding of xi_hat, the softening of the law and the turning of
  // normal and slip direction, and so it is not symmetric. Dropping any of that
  // would cost iterations, not accuracy: the residual decides what a solution
  // is.
  using Eigen::Matrix;
  using Eigen::Vector3d;

  // A solver makes several products with one tangent, and what they take lies
  // scattered among what the update has left: so it is gathered first. An open
  // point has no force and no tangent.
  void
  ContactInterface::gather_tangent() const
  {
    if (tangent_is_gathered)
      return;
    for_each_chunk(points.size(),
                   [&](const unsigned int chunk,
                       const unsigned int first,
                       const unsigned int end) {
                     tangent[chunk].clear();
                     tangent[chunk].reserve(end - first);
                     for (unsigned int q = first; q < end; ++q)
                       if (points[q].trial.state.status != PointStatus::open)
                         tangent[chunk].emplace_back(points[q], slave);
                   });
    tangent_is_gathered = true;
  }



  namespace
  {
    /** Forces on g, a_1 and a_2 of the share that rubs, by w. */
    Matrix<double, 9, W::size>
    forces_by_w(const SlavePoint &point)
    {
      const Vector3d t = point.JxW * point.trial.traction;
      // f acts on the slave at x, and -f on the master at y(xi_hat). By w it
      // changes as the traction does, 3 rows; and as xi_hat moves along the
      // master the force moves with it, -t dxi^alpha on the tangent a_alpha, 3
      // rows for each.
      Matrix<double, 9, W::size> result;
      result << point.JxW * point.trial.dt, -t * point.trial.dxi.row(0),
        -t * point.trial.dxi.row(1);
      return result;
    }

    /** The same by the damage of the share that is held. */
    Matrix<double, 9, 1>
    forces_by_damage(const SlavePoint &point)
    {
      const Vector3d t = point.JxW * point.trial.traction;
      // with the share that is held as the only thing that changes
      Matrix<double, 9, 1> result;
      result << point.JxW * point.trial.by_damage.traction,
        -t * point.trial.by_damage.xi[0], -t * point.trial.by_damage.xi[1];
      return result;
    }

    PointMotion::Vectors<3>
    as_vectors(const Matrix<double, 9, 1> &forces)
    {
      PointMotion::Vectors<3> result = PointMotion::Vectors<3>::Zero();
      result.topRows<3>()            = forces.reshaped(3, 3);
      return result;
    }



    /** Adds rows^T forces columns, @p forces on the first vectors of w by some
     *  of w. One product for all columns, as such small ones cost calls. */
    template <int n>
    void
    add_block(const PointColumns         &rows,
              const Matrix<double, 9, n> &forces,
              const PointColumns         &columns,
              Eigen::MatrixXd            &matrix)
    {
      // rows^T (forces columns), the small product first: 9 x w times w x n
      constexpr int max = PointColumns::max_unknowns;
      const Matrix<double, 9, Eigen::Dynamic, 0, 9, max> changes =
        forces * columns.dw.topRows<n>().leftCols(columns.n);
      Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max, max> block(
        rows.n, columns.n);
      block.noalias() = rows.dw.topLeftCorner(9, rows.n).transpose() * changes;
      for (unsigned int j = 0; j < columns.n; ++j)
        for (unsigned int i = 0; i < rows.n; ++i)
          matrix(rows.number[i], columns.number[j]) += block(i, j);
    }
  } // namespace



  // Those of shares that are held, and what their damage does to the friction
  // of the shares beside them: few scenes have any, so that nothing is gathered
  // for them.
  void
  ContactInterface::add_products_of_shares(const unsigned int chunk,
                                           const PaddedNets  &moved,
                                           PaddedNets        &sums) const
  {
    const std::size_t n = shares.size();
    for (std::size_t q = n * chunk / n_chunks; q < n * (chunk + 1) / n_chunks;
         ++q)
      {
        const SlavePoint    &point = points[q];
        const CohesiveShare &share = shares[q];
        if (!share.holds)
          continue;
        // A share that is held is a spring between x and y(xi) at a fixed xi:
        // of w it knows g, a_1 and a_2 only.
        const PointMotion          motion(point, share.basis, slave);
        const Matrix<double, 9, 1> w =
          motion.gather(moved).topLeftCorner<3, 3>().reshaped();
        PointMotion::Vectors<3> f = PointMotion::Vectors<3>::Zero();
        f.col(0).head<3>()        = point.JxW * share.dt * w;
        motion.scatter(f, sums);
        if (point.trial.state.status != PointStatus::open)
          PointMotion(point, slave)
            .scatter(as_vectors(forces_by_damage(point) * share.ddamage.dot(w)),
                     sums);
      }
  }



  // The tangent without a matrix, for iterative solvers: the unknowns move the
  // control points. GMRES needs no more than this product, where the matrix
  // would have to be summed first, point by point. Sums go as in evaluate():
  // threads change no digit.
  void
  ContactInterface::apply_tangent(const InterfaceConfiguration &configuration,
                                  const Eigen::VectorXd        &direction,
                                  Eigen::VectorXd              &result) const
  {
    gather_tangent();
    const PaddedNets moved = padded(nodal_motion(direction, configuration));
    // Components of the chuck enter twice: they move control points, which
    // nodal_motion() knows, and turn the way of the points, which no motion of
    // control points alone says.
    Matrix<double, 6, 1> chuck = Matrix<double, 6, 1>::Zero();
    for (const auto &[component, number] : configuration.chuck_unknowns)
      chuck[component] = direction[number];
    const auto sums =
      sum_in_chunks(n_chunks,
                    padded(zero_sums(configuration)),
                    [&](const unsigned int chunk, PaddedNets &forces) {
                      for (const PointTangent &point : tangent[chunk])
                        point.add_product(moved, chuck, forces);
                      add_products_of_shares(chunk, moved, forces);
                    });
    add_in_unknowns(without_padding(sums), configuration, 1., result);
  }



  // The same tangent as a matrix: a sum of dense blocks, as points are
  // independent. It is formed only where the system is assembled after all, as
  // a preconditioner: for a stiff interface, or an unknown chuck, which the
  // bulk does not resist (doc/explanation/solution.md). What rotation does to
  // frames and lever arms under forces that stay is not in it; CoupledTangent
  // adds that.
  void
  ContactInterface::add_tangent(const InterfaceConfiguration &configuration,
                                Eigen::MatrixXd              &matrix) const
  {
    std::vector<NodalSums> by_chuck;
    for (const auto &unknown : configuration.chuck_unknowns)
      // motions of all control points by one unknown of the chuck, once for all
      // points
      by_chuck.push_back(
        nodal_motion(Eigen::VectorXd::Unit(matrix.cols(), unknown.second),
                     configuration));
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const SlavePoint &point = points[q];
        // up to three blocks: of the share that rubs, of the share that is
        // held, and of how the damage of the second changes the friction of the
        // first
        std::optional<PointColumns> rubbing;
        if (point.trial.state.status != PointStatus::open)
          {
            rubbing.emplace(PointMotion(point, slave),
                            point.trial.turn_by_chuck,
                            configuration,
                            by_chuck);
            add_block(*rubbing, forces_by_w(point), *rubbing, matrix);
          }
        if (shares.empty() || !shares[q].holds)
          continue;
        const PointColumns   held(PointMotion(point, shares[q].basis, slave),
                                point.trial.turn_by_chuck,
                                configuration,
                                by_chuck);
        Matrix<double, 9, 9> forces = Matrix<double, 9, 9>::Zero();
        forces.topRows<3>()         = point.JxW * shares[q].dt;
        add_block(held, forces, held, matrix);
        if (rubbing)
          add_block<9>(*rubbing,
                       forces_by_damage(point) * shares[q].ddamage,
                       held,
                       matrix);
      }
  }



  // How g_s and the opening of a point change its update has left, too, with
  // the motion of xi_hat in it. The damage of a share that is held stands for
  // its opening. How far the share beside it slides does not count: that grows
  // without any loss of bond, and on the way back as well.
  //
  // The mean over the area that faced the implant at the start [mm] is the
  // measure of a path of equilibrium: angle, force and torque may all turn back
  // where a brittle bond snaps back, but neither g_s nor the largest opening
  // ever falls. Newton's method is bordered with its derivative, which
  // therefore is as exact as that of the forces.
  PathLength
  ContactInterface::path_length(
    const InterfaceConfiguration &configuration) const
  {
    // Mean of g_s + opening over the area that faced the implant [mm], and its
    // exact gradient, which borders the tangent of a path.
    PathLength                result;
    PaddedNets                gradient  = padded(zero_sums(configuration));
    double                    area      = 0.;
    const BilinearBond *const by_damage = law.joint->cohesion.get();
    const double length = by_damage ? by_damage->length_of_damage() : 0.;
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const SlavePoint         &point = points[q];
        const ContactPointResult &trial = point.trial;
        if (!point.faces_implant)
          continue;
        area += point.JxW;
        result.value +=
          point.JxW * (by_damage ? length * trial.state.damage :
                                   law.joint->slid(trial.state) +
                                     law.joint->opened(trial.state));
        if (!shares.empty() && shares[q].holds)
          PointMotion(point, shares[q].basis, slave)
            .scatter(as_vectors(point.JxW * length *
                                shares[q].ddamage.transpose()),
                     gradient);
        if (by_damage || trial.state.status == PointStatus::open ||
            trial.dpath.isZero(0.))
          continue;
        PointMotion::Vectors<5> d = PointMotion::Vectors<5>::Zero();
        d.topRows<3>() = point.JxW * trial.dpath.head<W::turn>().reshaped(3, 5);
        PointMotion(point, slave).scatter(d, gradient);
        result.by_chuck +=
          point.JxW * trial.dpath[W::turn] * trial.turn_by_chuck;
      }
    // dimensionless gradient: mm per mm of a control point
    result.value /= area;
    for (PaddedNet &of_side : gradient)
      of_side /= area;
    result.gradient = without_padding(gradient);
    result.by_chuck /= area;
    return result;
  }



  double
  ContactInterface::path_left() const
  {
    if (!law.joint->cohesion)
      return std::numeric_limits<double>::infinity();
    // Slip has no end, damage has: a path that is measured by it ends where all
    // that is bonded is broken.
    double left = 0., area = 0.;
    for (const SlavePoint &point : points)
      if (point.faces_implant)
        {
          area += point.JxW;
          if (point.trial.state.joined && point.phi_0 > 0.)
            left += point.JxW * (1. - point.trial.state.damage);
        }
    return law.joint->cohesion->length_of_damage() * left / area;
  }
} // namespace Debond
