#ifndef debond_interface_contact_tangent_h
#define debond_interface_contact_tangent_h

#include <debond/interface/interface_configuration.h>
#include <debond/interface/slave_point.h>

namespace Debond
{
  /** Adds the tangent of the contact forces that @p points exert in their trial
   *  states to a dense matrix: rows are equations of control points in their
   *  bodies' frames and of chuck components, d(force)/d(unknowns), without the
   *  terms that come from the rotation of frames and lever arms (see
   *  CoupledTangent). */
  void
  add_contact_tangent(const std::vector<SlavePoint> &points,
                      Side                           slave,
                      const InterfaceConfiguration  &configuration,
                      Eigen::MatrixXd               &matrix);

  /** The product of that tangent with a vector of unknowns, added to @p result.
   */
  void
  apply_contact_tangent(const std::vector<SlavePoint> &points,
                        Side                           slave,
                        const InterfaceConfiguration  &configuration,
                        const Eigen::VectorXd         &direction,
                        Eigen::VectorXd               &result);
} // namespace Debond
#endif
