// The torque of a disk at many angles at once, against the integrals of the
// closed form angle by angle, for a disk that is bonded all over and one with a
// bonded core.

#include <debond/interface/modified_coulomb.h>
#include <debond/models/closed_forms.h>

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

  const Eigen::VectorXd torque  = torsion_curve(disk, angles);
  const double          largest = torque.maxCoeff();
  double                worst   = 0.;
  for (std::size_t i = 0; i < angles.size(); ++i)
    grow(worst,
         std::abs(torque[i] - RigidBodiesTorsion(disk).torque(angles[i])) /
           largest);
  report(name + ": torque", worst, 1e-10);
}



int
main()
{
  check("bonded all over", std::numeric_limits<double>::infinity());
  check("bonded core", 1.5);
}
