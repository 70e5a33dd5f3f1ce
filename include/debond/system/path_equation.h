#ifndef debond_system_path_equation_h
#define debond_system_path_equation_h

#include <debond/bulk/chuck.h>
#include <debond/interface/contact_interface.h>

namespace Debond
{
  /**
   * What it takes to follow a path of equilibrium: all six chuck components and
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
    /** Of the equations q_k [N/mm, N mm]. */
    Chuck::Vector6 stiffness = Chuck::Vector6::Zero();

    /** Returns the residual of the equation for the time, in a trial state at
     *  @p time, in units of force: the whole slip step weighs as much as
     *  @p reference [N]. Keeps the derivatives for the functions below. */
    double
    evaluate(const ContactInterface       &interface,
             const InterfaceConfiguration &configuration,
             double                        time,
             double                        reference);

    /** Completes a tangent, or its product @p y with @p x, by the rows of
     *  prescribed components, the column of the time, and its row. */
    void
    assemble(const InterfaceConfiguration &configuration,
             Eigen::MatrixXd              &matrix) const;
    void
    apply(const InterfaceConfiguration &configuration,
          const Eigen::VectorXd        &x,
          Eigen::VectorXd              &y) const;

  private:
    /** d equation / d unknowns, of the last evaluate(). */
    Eigen::VectorXd gradient;
    Chuck::Vector6  rates; ///< of the scene's values, by time
  };
} // namespace Debond
#endif
