#ifndef debond_system_coupled_tangent_h
#define debond_system_coupled_tangent_h

#include <debond/bulk/body.h>
#include <debond/system/dense_solver.h>
#include <debond/system/path_equation.h>

namespace Debond
{
  /**
   * The tangent of the coupled system in the contact unknowns of the bone,
   * those of the implant and the unknown chuck components, as the Newton
   * iteration uses it [N/mm, N, N mm]: the condensed bodies and, as of the last
   * evaluate() of the interface and the path, everything else.
   */
  class CoupledTangent : public SplitMatrix
  {
  public:
    /** Keeps references to everything. */
    CoupledTangent(const Body                   &bone,
                   const Body                   &implant,
                   const ContactInterface       &interface,
                   const InterfaceConfiguration &configuration,
                   const PathEquation           &path);

    Eigen::VectorXd
    product(const Eigen::VectorXd &x) const override;
    Eigen::VectorXd
    interface_product(const Eigen::VectorXd &x) const override;
    bool
    can_be_assembled() const override;
    bool
    bulk_is_regular() const override;
    Eigen::VectorXd
    solve_bulk(const Eigen::VectorXd &b) const override;
    void
    assemble(Eigen::MatrixXd &matrix) const override;

  private:
    unsigned int
    size() const;
    void
    add_geometric_part(const Eigen::VectorXd &x, Eigen::VectorXd &y) const;

    const Body                   &bone, &implant;
    const ContactInterface       &interface;
    const InterfaceConfiguration &configuration;
    const PathEquation           &path;
  };
} // namespace Debond
#endif
