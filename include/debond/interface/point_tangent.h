#ifndef debond_interface_point_tangent_h
#define debond_interface_point_tangent_h

#include <debond/interface/contact_point_state.h>

#include <array>

namespace Debond
{
  struct SlavePoint;

  /** Vectors at control points, with a zero as a fourth component: a column is
   *  what a processor computes with at once. */
  using PaddedNet = Eigen::Matrix<double, 4, Eigen::Dynamic>;

  /** What the tangent of a closed point is made of, in one piece. */
  class PointTangent
  {
  public:
    explicit PointTangent(const SlavePoint &point);

    /** Adds to the nodal forces [N] what they change by when control points of
     *  slave and master move [mm], and components of the chuck [mm, rad]. */
    void
    add_product(const PaddedNet                   &slave,
                const PaddedNet                   &master,
                const Eigen::Matrix<double, 6, 1> &chuck,
                PaddedNet                         &slave_force,
                PaddedNet                         &master_force) const;

  private:
    /** Factors of control points: of x; of y, a_1 and a_2; of y_n and g_n. */
    struct Factors
    {
      explicit Factors(const SurfaceBasis &basis)
        : size(basis.size)
        , control_point(basis.control_point)
      {}
      unsigned int                                              size;
      std::array<unsigned int, SurfaceBasis::max_size>          control_point;
      std::array<std::array<double, 3>, SurfaceBasis::max_size> N;
    };
    Factors on_slave, on_master, on_old;
    bool    slips;
    /** JxW dt/dw [N/mm] and dxi^1/dw. */
    Eigen::Matrix<double, 4, W::size> dt_dxi_1;
    /** dxi^2 by each vector of w, with a zero as a fourth component. */
    Eigen::Matrix<double, 4, 5> dxi_2;
    double                      dxi_2_by_turn;
    Eigen::Vector4d             t; ///< JxW t [N]
    Eigen::Matrix<double, 6, 1> turn_by_chuck;
  };
} // namespace Debond
#endif
