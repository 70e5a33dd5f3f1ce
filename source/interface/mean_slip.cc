#include <debond/geometry/surface_geometry.h>
#include <debond/interface/mean_slip.h>

namespace Debond
{
  // g_s grows by |y(xi_hat) - y(xi_hat^n)|, whose change is that of the
  // difference along its direction; xi_hat moves as the equations of the slip
  // want it.
  MeanSlip
  mean_slip(const std::vector<SlavePoint> &points,
            const Side                     slave,
            const InterfaceConfiguration  &configuration,
            const bool                     frictionless)
  {
    const Side master = other(slave);
    MeanSlip   result;
    result.gradient = zero_sums(configuration);
    double area     = 0.;
    for (const SlavePoint &point : points)
      {
        const ContactPointResult &trial = point.trial;
        if (!point.faces_implant)
          continue;
        area += point.JxW;
        result.value += point.JxW * trial.state.slip;
        const double distance = trial.slip_increment.norm();
        if (trial.state.status != PointStatus::slip || frictionless ||
            distance == 0.)
          continue;
        const SurfaceBasis   &basis     = trial.basis;
        const Eigen::Vector3d direction = trial.slip_increment / distance;
        SurfaceGeometry       y;
        contract(basis, configuration.side[master].positions, false, y);
        Eigen::Matrix<double, 15, 1> d =
          trial.dxi.transpose() *
          Eigen::Vector2d(direction.dot(y.a1), direction.dot(y.a2));
        d.segment<3>(3) += direction;
        d.segment<3>(12) -= direction;
        d *= point.JxW;
        NodalSums &sums = result.gradient;
        spread(point.basis, d.segment<3>(0), sums[slave]);
        for (unsigned int b = 0; b < basis.size; ++b)
          sums[master].col(basis.control_point[b]) +=
            basis.N[b] * d.segment<3>(3) + basis.N_1[b] * d.segment<3>(6) +
            basis.N_2[b] * d.segment<3>(9);
        spread(trial.old_basis, d.segment<3>(12), sums[master]);
      }
    result.value /= area;
    for (ControlNet &gradient : result.gradient)
      gradient /= area;
    return result;
  }
} // namespace Debond
