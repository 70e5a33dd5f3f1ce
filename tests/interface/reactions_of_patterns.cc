// A bond on one side of the implant makes the twisted chuck bear a lateral
// force and a tilting moment: those of the closed form for two rigid bodies,
// and, with the pattern turned by 90 degrees, those of the first turned by 90
// degrees, all else being the same. So do those of implants of any shape, with
// any slave, whose pattern and load are turned together, or mirrored.

#include <debond/models/closed_forms.h>
#include <debond/support/number_text.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Geometry>

#include "driven_scene.h"
#include "pressed_and_turned.h"

const std::string scene_text = R"(
subsection Implant
  set Cells = 12, 2
end
subsection Interface
  subsection Bonding
    set Pattern = expression
  end
end
subsection Expert
  subsection Interface
    subsection Bonding
      set Resolution = quadrature point
    end
  end
end
)" + pressed_then("Rotation z", "max(t - 1, 0)") +
                               R"(
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
                                       "Expert/Interface/Quadrature points=3",
                                       "Load steps/Steps=1, 1, 1, 1, 2, 2, 2"};
  for (const std::string resolution : {"element", "quadrature point"})
    {
      auto with = small;
      with.push_back("Expert/Interface/Bonding/Resolution=" + resolution);
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



/** The chuck's motion, or its forces, turned by 90 degrees about z; or mirrored
 *  at y = 0, with moments and angles the other way round. */
Debond::Chuck::Vector6
image_of(const Debond::Chuck::Vector6 &v, const bool mirrored)
{
  Debond::Chuck::Vector6 result;
  if (mirrored)
    result << v[0], -v[1], v[2], -v[3], v[4], -v[5];
  else
    result << -v[1], v[0], v[2], -v[4], v[3], v[5];
  return result;
}



// An implant of a @p shape, and its bone.
std::vector<std::string>
bodies_of(const std::string &shape, const bool on_bone)
{
  std::vector<std::string> all{"Implant/Shape=" + shape,
                               "Bone/Material=rigid",
                               "Implant/Material=rigid",
                               "Expert/Interface/Quadrature points=3",
                               "Load steps/Times=0, 1",
                               "Load steps/Steps=4"};
  const auto               add = [&all](const std::vector<std::string> &more) {
    all = all + more;
  };
  if (on_bone) // no point of the bone lies on a line of symmetry
    add({"Bone/Cells=16, 16, 2"});
  if (shape == "block")
    add({"Implant/Size=4, 4, 2"});
  else
    add({"Implant/Radius=2", "Implant/Height=2"});
  if (shape == "ring")
    add({"Implant/Inner radius=1"});
  if (shape == "ring" || !on_bone)
    add(
      {"Implant/Element=quadratic",
       shape == "ring" ? "Implant/Cells=20, 2, 2" : "Implant/Cells=16, 1, 8"});
  if (!on_bone)
    add({shape == "cup" ? "Bone/Shape=cavity" : "Bone/Shape=sleeve",
         "Bone/Outer radius=5",
         "Bone/Element=quadratic",
         "Bone/Cells=16, 1, 8",
         "Interface/Interference=0.01"});
  if (shape == "taper")
    add({"Implant/Taper angle=5"});
  if (shape == "screw") // which is the same after 90 degrees
    add({"Implant/Starts=4", "Implant/Pitch=8"});
  return all;
}



std::vector<Debond::Chuck::Vector6>
forces_of(std::vector<std::string>      scene,
          const Debond::Chuck::Vector6 &motion,
          const std::string            &angle,
          const double                  phase)
{
  scene.push_back("Interface/Bonding/Expression=0.5 + 0.2 * r / R * sin((" +
                  angle + " - (" + Debond::to_text(phase, 17) +
                  ")) * pi / 180)");
  const char *const names[]{"Translation x",
                            "Translation y",
                            "Press",
                            "Rotation x",
                            "Rotation y",
                            "Rotation z"};
  for (unsigned int k = 0; k < 6; ++k)
    scene.push_back("Chuck/" + std::string(names[k]) + "/Value=(" +
                    Debond::to_text(k == 2 ? -motion[k] : motion[k], 17) +
                    ") * t");
  DrivenScene                         driven(scene_text, scene);
  std::vector<Debond::Chuck::Vector6> rows;
  while (driven.advance())
    rows.push_back(driven.system.chuck_resultant());
  return rows;
}



// Patterns that vary with angle and r, and motions drawn by chance.
void
check_shapes()
{
  for (const std::string shape :
       {"coin", "block", "ring", "pin", "taper", "screw", "cup"})
    {
      const bool on_bone =
        shape == "coin" || shape == "block" || shape == "ring";
      double difference = 0., lateral = 0.;
      for (const std::string slave : {"implant", "bone"})
        {
          auto scene = bodies_of(shape, on_bone);
          scene.push_back("Expert/Interface/Slave=" + slave);
          Debond::Chuck::Vector6 motion; // at the end [mm, degrees]
          for (unsigned int k = 0; k < 6; ++k)
            motion[k] = random_number(-0.005, 0.005) * (k < 3 ? 1. : 10.);
          if (on_bone)
            motion[2] = -0.02;
          motion[5]          = random_number(0.5, 1.);
          const double phase = random_number(-180., 180.);
          const auto   first = forces_of(scene, motion, "angle", phase);
          for (const bool mirrored : {false, true})
            {
              if (mirrored && shape == "screw")
                continue; // its thread would be left-handed
              const auto other = forces_of(scene,
                                           image_of(motion, mirrored),
                                           mirrored ? "-angle" : "(angle - 90)",
                                           phase);
              for (unsigned int i = 0; i < first.size(); ++i)
                {
                  const double scale = first.back().norm();
                  grow(difference,
                       (image_of(first[i], mirrored) - other[i]).norm() /
                         scale);
                  grow(lateral, first[i].head<2>().norm() / scale);
                }
            }
        }
      report(shape + ": pattern and load turned, or mirrored, forces differ by",
             difference,
             1e-9);
      report("  there is a lateral force", lateral > 1e-3);
    }
}



int
main()
{
  Debond::set_up_libraries();
  check_closed_form();
  check_turned();
  check_shapes();
}
