// The torque of a disk at many angles at once, against the integrals of the
// closed form angle by angle, and its derivatives against central differences:
// by pressure, stiffness, bonding, bonded radius and the parameters of the
// friction law, for a disk that is bonded all over and one with a bonded core.

#include <debond/interface/bond_friction.h>
#include <debond/models/torsion_curve.h>

#include <functional>
#include <limits>
#include <vector>

#include "checks.h"

using namespace Debond;

TorsionModel::Disk
disk_with(const ModifiedCoulombParameters &law, const double bonded_radius)
{
  TorsionModel::Disk disk;
  disk.radius        = 2.5;
  disk.pressure      = 2.6;
  disk.stiffness     = 400;
  disk.phi_0         = 0.9;
  disk.bonded_radius = bonded_radius;
  disk.friction      = modified_coulomb(law);
  return disk;
}



void
check(const std::string &name, const double bonded_radius)
{
  const ModifiedCoulombParameters law;
  const TorsionModel::Disk        disk = disk_with(law, bonded_radius);
  std::vector<double>             angles{-0.1, 0.};
  for (unsigned int i = 1; i <= 40; ++i)
    angles.push_back(i * 0.005);

  // what each parameter makes of the disk, and by how much it is moved
  using Moved          = std::function<TorsionModel::Disk(double)>;
  const auto of_member = [&](double TorsionModel::Disk::*const member) {
    return [&, member](const double h) {
      TorsionModel::Disk other = disk;
      other.*member += h;
      return other;
    };
  };
  const auto of_law = [&](double ModifiedCoulombParameters::*const member) {
    return [&, member](const double h) {
      ModifiedCoulombParameters other = law;
      other.*member += h;
      return disk_with(other, bonded_radius);
    };
  };
  struct Parameter
  {
    std::string name;
    double      size;
    Moved       moved;
  };
  std::vector<Parameter> parameters{
    {"pressure", 2.6, of_member(&TorsionModel::Disk::pressure)},
    {"stiffness", 400, of_member(&TorsionModel::Disk::stiffness)},
    {"phi_0", 0.9, of_member(&TorsionModel::Disk::phi_0)},
    {"mu_b", 0.4, of_law(&ModifiedCoulombParameters::mu_broken)},
    {"mu_ub", 0.58, of_law(&ModifiedCoulombParameters::mu_unbroken)},
    {"a_s", 0.022, of_law(&ModifiedCoulombParameters::sliding_threshold)},
    {"b_s", 0.74, of_law(&ModifiedCoulombParameters::transition_factor)}};
  if (bonded_radius < disk.radius)
    parameters.push_back(
      {"bonded radius", 1.5, of_member(&TorsionModel::Disk::bonded_radius)});

  std::vector<DiskVariation> variations;
  for (const Parameter &parameter : parameters)
    {
      const double             h     = 1e-5 * parameter.size;
      const TorsionModel::Disk plus  = parameter.moved(h),
                               minus = parameter.moved(-h);
      DiskVariation by;
      by.width     = 2. * h;
      by.pressure  = (plus.pressure - minus.pressure) / by.width;
      by.stiffness = (plus.stiffness - minus.stiffness) / by.width;
      by.phi_0     = (plus.phi_0 - minus.phi_0) / by.width;
      if (bonded_radius < disk.radius)
        by.bonded_radius =
          (plus.bonded_radius - minus.bonded_radius) / by.width;
      by.plus  = plus.friction;
      by.minus = minus.friction;
      variations.push_back(by);
    }
  const TorsionCurve curve = torsion_curve(disk, angles, variations);

  const double largest = curve.torque.maxCoeff();
  double       worst   = 0.;
  for (std::size_t i = 0; i < angles.size(); ++i)
    grow(worst,
         std::abs(curve.torque[i] -
                  RigidBodiesTorsion(disk).torque(angles[i])) /
           largest);
  report(name + ": torque", worst, 1e-10);
  for (std::size_t j = 0; j < parameters.size(); ++j)
    {
      const double          size = parameters[j].size, h = 1e-4 * size;
      const Eigen::VectorXd difference =
        (torsion_curve(parameters[j].moved(h), angles).torque -
         torsion_curve(parameters[j].moved(-h), angles).torque) /
        (2. * h);
      // of a central difference with kinks of the law in the integral
      report(name + ": derivative by " + parameters[j].name,
             (curve.derivative.col(j) - difference).cwiseAbs().maxCoeff() *
               size / largest,
             2e-7);
    }
}



int
main()
{
  check("bonded all over", std::numeric_limits<double>::infinity());
  check("bonded core", 1.5);
}
