#include <debond/system/path_equation.h>

namespace Debond
{
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
        return 0.; // the time is what it should be
      }
    const MeanSlip mean   = interface.mean_slip(configuration);
    const double   weight = reference / slip;
    add_in_unknowns(mean.gradient, configuration, weight, gradient);
    return weight * (mean.value - old_slip - slip);
  }



  void
  PathEquation::assemble(const InterfaceConfiguration &configuration,
                         Eigen::MatrixXd              &matrix) const
  {
    const Chuck &chuck = *configuration.chuck;
    for (const auto &[k, row] : configuration.chuck_unknowns)
      if (chuck.is_prescribed(k))
        {
          matrix.row(row).setZero();
          matrix(row, row)    = stiffness[k];
          matrix(row, number) = -stiffness[k] * rates[k];
        }
      else
        matrix(row, number) = -chuck.machine_load_per_value(k) * rates[k];
    matrix.row(number) = gradient.transpose();
  }



  void
  PathEquation::apply(const InterfaceConfiguration &configuration,
                      const Eigen::VectorXd        &x,
                      Eigen::VectorXd              &y) const
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
} // namespace Debond
