#pragma once

#include <debond/bulk/body.h>
#include <debond/bulk/chuck.h>
#include <debond/interface/contact_interface.h>
#include <debond/system/dense_solver.h>

namespace Debond
{
  /**
   * Equation of a path of equilibrium: all six chuck components and
   * the time are unknowns of the coupled system then, with the equations q_k =
   * value_k(time) for prescribed components and, for the time, that it or the
   * mean sliding distance has a given value.
   */
  struct PathEquation
  {
    bool         follow = false;
    unsigned int number = 0; ///< of the time among the unknowns
    /** Growth of the mean slip in this step [mm]; 0: the time is given. */
    double slip     = 0;
    double old_slip = 0; ///< mean slip of the accepted state [mm]
    /** Of the whole face against each component of the chuck: eps_n A [N/mm],
     *  or eps_n A R^2 [N mm] for rotations. It gives the equations of q_k along
     *  a path the size of the others, and is D of CoupledTangent. 0: the
     *  machine counts for nothing. */
    Chuck::Vector6 stiffness = Chuck::Vector6::Zero();
    /** Factor of the equation of a component of the chuck: of a
     *  spring stiffer than the face it would be the rounding of positions times
     *  that, and becomes a length or angle as those of prescribed ones. */
    Chuck::Vector6 row_scale = Chuck::Vector6::Ones();

    /** Returns the residual of the equation for the time, in a trial state at
     *  @p time, in units of force: the whole slip step weighs as much as
     *  @p reference [N]. Keeps the derivatives for apply(). */
    double
    evaluate(const ContactInterface       &interface,
             const InterfaceConfiguration &configuration,
             double                        time,
             double                        reference);

    /** Completes the product @p y of the tangent with @p x by the rows of
     *  prescribed components, the column of the time, and its row. */
    void
    apply(const InterfaceConfiguration &configuration,
          const Eigen::VectorXd        &x,
          Eigen::Ref<Eigen::VectorXd>   y) const;

  private:
    /** d equation / d unknowns, of the last evaluate(). */
    Eigen::VectorXd gradient;
    Chuck::Vector6  rates; ///< of the scene's values, by time
  };



  /**
   * The tangent of the coupled system in the contact unknowns of the bone,
   * those of the implant and the unknown chuck components, as the Newton
   * iteration uses it [N/mm, N, N mm]: the condensed bodies and, as of the last
   * evaluate() of the interface and the path, everything else.
   *
   * It is unsymmetric, by friction, and not stored: the linear solver gets
   * products, and the matrix itself only if it asks for it.
   */
  class CoupledTangent : public SplitMatrix
  {
  public:
    /** Keeps references to everything. */
    CoupledTangent(const std::array<Body *, 2>  &bodies,
                   const ContactInterface       &interface,
                   const InterfaceConfiguration &configuration,
                   const PathEquation           &path)
      : bodies(bodies)
      , interface(interface)
      , configuration(configuration)
      , path(path)
    {}

    Eigen::VectorXd
    product(const Eigen::VectorXd &x) const override;
    Eigen::VectorXd
    interface_product(const Eigen::VectorXd &x) const override;
    bool
    can_be_assembled() const override;
    bool
    bulk_is_regular() const override
    {
      return configuration.chuck_unknowns.empty() || !can_be_assembled();
    }
    Eigen::VectorXd
    solve_bulk(const Eigen::VectorXd &b) const override;
    void
    assemble(Eigen::MatrixXd &matrix) const override;
    /** B x without the chuck. */
    Eigen::VectorXd
    bulk_product(const Eigen::VectorXd &x) const;

    /** @name Without the bone
     *  B of the unknowns that follow those of the bone, and its inverse. */
    //@{
    Eigen::VectorXd
    product_beside_bone(const Eigen::VectorXd &x) const;
    Eigen::VectorXd
    solve_beside_bone(const Eigen::VectorXd &b) const;
    //@}

    /** Adds the product of @p x with the part that comes from the rotation of
     *  the implant's frame and of lever arms, and from the machine. */
    void
    add_geometric_part(const Eigen::VectorXd &x, Eigen::VectorXd &y) const;

  private:
    /** Calls work(bulk, first, n) for the n unknowns of each body that is
     *  condensed, of which the first has the number @p first. */
    template <typename Work>
    void
    for_each_bulk(const Work &work) const
    {
      unsigned int first = 0;
      for (const Body *body : bodies)
        {
          if (body->condensing())
            work(*body->condensing(), first, body->n_unknowns());
          first += body->n_unknowns();
        }
    }
    unsigned int
    size() const;
    /** All of the tangent but the bodies, times x. */
    Eigen::VectorXd
    product_without_bulk(const Eigen::VectorXd &x) const;
    /** Adds the part of it that add_geometric_part() makes of the component of
     *  the chuck with a number, as a column, and of the coupling as a row. */
    void
    add_chuck(Eigen::MatrixXd &matrix) const;
    /** Multiplies the rows of the chuck. */
    template <typename Rows>
    void
    scale_rows(Rows &rows) const
    {
      for (const auto &[k, row] : configuration.chuck_unknowns)
        rows.row(row) *= path.row_scale[k];
    }
    /** D: stiffness of the unknown component @p k of the chuck in B [N/mm,
     *  N mm]. No body resists it. Where A can be assembled D is 0, B has no
     *  inverse, and LU takes over. Otherwise the stiffness of the whole face
     *  makes B regular, and C takes it away again: A is the same. */
    double
    chuck_stiffness_of_bulk(const unsigned int k) const
    {
      return can_be_assembled() ? 0. : path.stiffness[k];
    }

    const std::array<Body *, 2>   bodies;
    const ContactInterface       &interface;
    const InterfaceConfiguration &configuration;
    const PathEquation           &path;
  };
} // namespace Debond
