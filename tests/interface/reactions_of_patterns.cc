// A bond on one side of the implant makes the twisted chuck bear a lateral
// force and a tilting moment: those of the closed form for two rigid bodies,
// and, with the pattern turned by 90 degrees, those of the first turned by 90
// degrees, all else being the same.

#include <debond/models/closed_forms.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Geometry>

#include "driven_scene.h"

const std::string scene_text = R"(
subsection Implant
  set Cells = 12, 2
end
subsection Interface
  subsection Bonding
    set Pattern    = expression
    set Resolution = quadrature point
  end
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 1.05, 1.1, 1.4, 2, 3, 6
  set Steps = 1, 1, 1, 10, 20, 30, 90
end
)";



/** What the chuck holds against the friction of the implant whose half x > 0 is
 *  bonded, along x and y of the implant: the area integrals of the tractions of
 *  the bonded half less those of the other. A point is held back by a point
 * that it tows on a string of the length of the elastic gap; in circular motion
 * that point goes round on a smaller circle, so that the traction pulls inwards
 * as well. */
Eigen::Vector2d
lateral_force(const double theta)
{
  Debond::TorsionModel::Disk parameters;
  parameters.radius    = 2.5;
  parameters.pressure  = 585 * 0.0049;
  parameters.stiffness = 585;
  const Debond::RigidBodiesTorsion bonded(parameters);
  parameters.phi_0 = 0;
  const Debond::RigidBodiesTorsion unbonded(parameters);

  Eigen::Vector2d            sum = Eigen::Vector2d::Zero();
  const dealii::QIterated<1> quadrature(dealii::QGauss<1>(2), 2000);
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      const double r        = 2.5 * quadrature.point(q)[0];
      const auto   traction = [&](const Debond::RigidBodiesTorsion &half) {
        const double t = half.point(r, theta).traction;
        // of points that stick the gap is a chord
        const double inwards =
          half.slip(r, theta) > 0. ? std::min(1., t / (585 * r)) : theta / 2;
        return Eigen::Vector2d(t * inwards,
                               t * std::sqrt(1. - inwards * inwards));
      };
      sum += 2.5 * quadrature.weight(q) * r *
             (traction(bonded) - traction(unbonded));
    }
  return 2. * sum;
}



void
check_closed_form()
{
  DrivenScene driven(scene_text,
                     {"Bone/Material=rigid",
                      "Implant/Material=rigid",
                      "Interface/Bonding/Expression=x > 0"});
  // once all slides and nothing is debonded yet, (mu_ub - mu_b) p R^2
  const double scale = 0.18 * 585 * 0.0049 * 6.25;
  double       force = 0., moment = 0., others = 0.;
  for (const double angle : {0.1, 0.4, 1., 2., 5.})
    {
      driven.advance_to(1 + angle);
      const double theta = angle * M_PI / 180;
      // the pattern turns with the implant; forces act at z = 0, moments are
      // about the chuck at z = 3
      const Eigen::Vector2d F =
        Eigen::Rotation2Dd(theta) * lateral_force(theta);
      const double height = 3;
      const auto   chuck  = driven.system.chuck_resultant();
      grow(force, (chuck.head<2>() - F).norm() / scale);
      grow(
        moment,
        (chuck.segment<2>(3) - height * Eigen::Vector2d(F[1], -F[0])).norm() /
          (height * scale));
      grow(others, std::abs(chuck[2] / (-585 * 0.0049 * M_PI * 6.25) - 1.));
    }
  report("lateral force against the closed form, deviation", force, 1e-3);
  report("tilting moment against the closed form, deviation", moment, 1e-3);
  report("axial force, relative deviation", others, 1e-5);
}



void
check_turned()
{
  const std::vector<std::string> small{"Bone/Cells=10, 10, 2",
                                       "Bone/Material=linear",
                                       "Implant/Material=linear",
                                       "Implant/Cells=6, 2",
                                       "Interface/Quadrature points=3",
                                       "Load steps/Steps=1, 1, 1, 1, 2, 2, 2"};
  for (const std::string resolution : {"element", "quadrature point"})
    {
      auto with = small;
      with.push_back("Interface/Bonding/Resolution=" + resolution);
      with.push_back("Interface/Bonding/Expression=x > 0.21*R && y < 0.33*R");
      DrivenScene first(scene_text, with);
      with.back() = "Interface/Bonding/Expression=y > 0.21*R && -x < 0.33*R";
      DrivenScene turned(scene_text, with);
      double      same = 0., lateral = 0., smallest = 1e9;
      while (first.advance())
        {
          turned.advance();
          const auto   a = first.system.chuck_resultant();
          const auto   b = turned.system.chuck_resultant();
          const double F = std::abs(a[2]), M = 2.5 * F;
          grow(same, std::abs(a[2] - b[2]) / F);
          grow(same, std::abs(a[5] - b[5]) / M);
          grow(lateral, std::hypot(b[0] + a[1], b[1] - a[0]) / F);
          grow(lateral, std::hypot(b[3] + a[4], b[4] - a[3]) / M);
          if (first.time() > 1.3 && first.time() < 1.5)
            smallest = std::min(smallest, a.head<2>().norm() / F);
        }
      report("turned by 90 degrees, by " + resolution +
               ": axial force and torque, deviation",
             same,
             1e-9);
      report("  lateral forces and moments turn along, deviation",
             lateral,
             1e-9);
      report("  and are more than a hundredth of the axial force",
             smallest > 0.01);
    }
}



int
main()
{
  Debond::set_up_libraries();
  check_closed_form();
  check_turned();
}
