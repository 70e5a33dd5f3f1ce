#pragma once

#include <debond/interface/contact_point.h>
#include <debond/interface/interface_configuration.h>

#include <array>
#include <vector>

namespace Debond
{
  /** Vectors at control points, with a zero as a fourth component: a column is
   *  what a processor computes with at once. */
  using PaddedNet  = Eigen::Matrix<double, 4, Eigen::Dynamic>;
  using PaddedNets = std::array<PaddedNet, 2>;

  /** @p sums with zeros. */
  PaddedNets
  padded(const NodalSums &sums);
  NodalSums
  without_padding(const PaddedNets &nets);

  /**
   * The motion w = B u of a point by that of the control points of both
   * surfaces, and its transpose, which takes forces back to them, Eq.\ (36).
   *
   * Each of the vectors of w is a sum over control points: x with the factors
   * N_A of the slave; y, a_1 and a_2 with N_B, N_B,1 and N_B,2 of the master at
   * xi_hat; and, while the point slides, y_n with N_B at xi_hat^n and the old
   * gap, whose parts g^alpha along a_alpha there move with these.
   */
  class PointMotion
  {
  public:
    /** Vectors of w, or forces on them, a column each, from W::gap on. */
    template <int n>
    using Vectors = Eigen::Matrix<double, 4, n>;

    /** Of the share that rubs. */
    PointMotion(const SlavePoint &point, Side slave);
    /** Of a share that is held where the master has the functions @p held: g,
     *  a_1 and a_2. */
    PointMotion(const SlavePoint &point, const SurfaceBasis &held, Side slave);

    /** B u. */
    Vectors<5>
    gather(const PaddedNets &u) const;
    /** Adds B^T f, f being forces on the first n vectors of w. */
    template <int n>
    void
    scatter(const Vectors<n> &f, PaddedNets &sums) const;

    /** Calls work(side, control point, factors) for each column of B. */
    template <typename Work>
    void
    for_each_control_point(const Work &work) const;

    bool slides;

  private:
    struct OfMaster
    {
      unsigned int control_point;
      /** In g, a_1, a_2, the trial gap and the old gap. */
      std::array<double, 5> factor;
    };

    Side         slave;
    unsigned int n_slave, n_master = 0;

    std::array<unsigned int, SurfaceBasis::max_size> of_slave;
    std::array<double, SurfaceBasis::max_size>       N;
    std::array<OfMaster, 2 * 9>                      of_master;
  };



  /** B of the unknowns of the coupled system: a column of w for each that moves
   *  the point, components of the chuck and control points in the frames of
   *  their bodies. */
  struct PointColumns
  {
    /** @p by_chuck: nodal_motion() of each unknown component of the chuck. */
    PointColumns(const PointMotion                 &motion,
                 const Eigen::Matrix<double, 6, 1> &turn_by_chuck,
                 const InterfaceConfiguration      &configuration,
                 const std::vector<NodalSums>      &by_chuck);

    static constexpr int                         max_unknowns = 3 * 27 + 6;
    Eigen::Matrix<double, W::size, max_unknowns> dw;
    std::array<int, max_unknowns>                number;
    unsigned int                                 n = 0;
  };



  /** Tangent of a closed point for products: what they take of it, in one
   * piece.
   */
  class PointTangent
  {
  public:
    PointTangent(const SlavePoint &point, Side slave);

    /** Adds to the nodal forces [N] what they change by when control points
     *  move by @p u [mm], and components of the chuck [mm, rad]. */
    void
    add_product(const PaddedNets                  &u,
                const Eigen::Matrix<double, 6, 1> &chuck,
                PaddedNets                        &forces) const;

  private:
    PointMotion motion;
    /** JxW dt/dw [N/mm] and dxi^1/dw. */
    Eigen::Matrix<double, 4, W::size> dt_dxi_1;
    /** dxi^2 by each vector of w, with a zero as a fourth component. */
    Eigen::Matrix<double, 4, 5> dxi_2;
    double                      dxi_2_by_turn;
    Eigen::Vector4d             t; ///< JxW t [N]
    Eigen::Matrix<double, 6, 1> turn_by_chuck;
  };



  template <int n>
  void
  PointMotion::scatter(const Vectors<n> &f, PaddedNets &sums) const
  {
    PaddedNet      &on_slave = sums[slave], &on_master = sums[other(slave)];
    Eigen::Vector4d on_x = f.col(0);
    if constexpr (n > 3)
      on_x += f.col(3);
    for (unsigned int a = 0; a < n_slave; ++a)
      on_slave.col(of_slave[a]) += N[a] * on_x;
    for (unsigned int b = 0; b < n_master; ++b)
      {
        const auto &factor = of_master[b].factor;
        // all at once: a sum in between would be stored
        const Eigen::Vector4d force =
          factor[0] * f.col(0) + factor[1] * f.col(1) + factor[2] * f.col(2);
        on_master.col(of_master[b].control_point) += force;
        if constexpr (n > 3)
          on_master.col(of_master[b].control_point) +=
            factor[3] * f.col(3) + factor[4] * f.col(4);
      }
  }



  template <typename Work>
  void
  PointMotion::for_each_control_point(const Work &work) const
  {
    using Factors = Eigen::Matrix<double, 1, 5>;
    for (unsigned int a = 0; a < n_slave; ++a)
      work(slave, of_slave[a], Factors(N[a], 0., 0., slides ? N[a] : 0., 0.));
    for (unsigned int b = 0; b < n_master; ++b)
      work(other(slave),
           of_master[b].control_point,
           Factors(Eigen::Map<const Factors>(of_master[b].factor.data())));
  }
} // namespace Debond
