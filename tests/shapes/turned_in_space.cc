// A scene does not know which way it looks: bodies, supports, chuck, pattern of
// bonding and motion are turned together in space, about the implant's axis and
// about another one, and the chuck's forces turn with them. Implants on the
// bone and in it, with more than their radius (a press fit); the loads press,
// twist, pull and tilt. Largest differences over the largest values of a run.

#include <debond/models/simulation.h>
#include <debond/scene/scene.h>
#include <debond/shapes/bowl_mesh.h>
#include <debond/shapes/mesh_builder.h>
#include <debond/shapes/revolved_mesh.h>
#include <debond/support/number_text.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <fstream>

#include "checks.h"
#include "driven_scene.h"

using namespace Debond;

struct Bodies
{
  StoredMesh implant, bone;
  double     press; ///< displacement along z [mm]
};

std::shared_ptr<const BodyMesh>
turned(StoredMesh stored, const Eigen::Matrix3d &Q)
{
  for (auto &node : stored.nodes)
    {
      const Eigen::Vector3d x = Q * Eigen::Vector3d(node[0], node[1], node[2]);
      node                    = {x[0], x[1], x[2]};
    }
  const auto           &c  = stored.sphere_centre;
  const Eigen::Vector3d x  = Q * Eigen::Vector3d(c[0], c[1], c[2]);
  stored.sphere_centre     = {x[0], x[1], x[2]};
  const FileRefusal refuse = [](const std::string &why) {
    throw std::runtime_error(why);
  };
  return MeshBuilder(stored, refuse).mesh;
}

/** The chuck's components, with angles in degrees, of a motion that moves by @p
 *  u and turns by @p M. */
Chuck::Vector6
components(const Eigen::Vector3d &u, const Eigen::Matrix3d &M)
{
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ().cross(M.col(2)),
                        a    = axis * std::asin(axis.norm()) /
                            std::max(axis.norm(), 1e-300);
  Eigen::Matrix3d tilt = Eigen::Matrix3d::Identity();
  if (axis.norm() > 0.)
    tilt = Eigen::AngleAxisd(a.norm(), a.normalized());
  const Eigen::Matrix3d twist = tilt.transpose() * M;
  Chuck::Vector6        q;
  q << u, a[0], a[1], std::atan2(twist(1, 0), twist(0, 0));
  q.tail<3>() *= 180. / M_PI;
  return q;
}

std::vector<TorqueRow>
rows_of(const Bodies &bodies, const Eigen::Matrix3d &Q)
{
  const auto implant = turned(bodies.implant, Q), bone = turned(bodies.bone, Q);
  std::ofstream pattern("pattern.csv");
  pattern << "phi_0\n";
  for (unsigned int e = 0; e < implant->n_contact_faces; ++e)
    pattern << e % 4 / 3. << "\n";
  pattern.close();
  Scene scene                     = coin_scene("subsection Bone\n"
                                               "  set Material = linear\n"
                                               "  set Young modulus = 500\n"
                                               "  set Element = quadratic\n"
                                               "end\n"
                                               "subsection Implant\n"
                                               "  set Material = linear\n"
                                               "  set Element = quadratic\n"
                                               "end\n"
                                               "subsection Chuck\n"
                                               "  subsection Rotation z\n"
                                               "    set Value = t\n"
                                               "  end\n"
                                               "end\n"
                                               "subsection Load steps\n"
                                               "  set Times = 0, 1\n"
                                               "  set Steps = 6\n"
                                               "end\n"
                                               "subsection Expert\n"
                                               "  subsection Load steps\n"
                                               "    set Residual tolerance = 1e-12\n"
                                               "  end\n"
                                               "end\n");
  scene.interface.bonding.pattern = BondingPatternKind::file;
  scene.interface.bonding.file    = "pattern.csv";
  scene.implant.mesh              = implant;
  scene.bone.mesh                 = bone;
  scene.implant.shape = scene.bone.shape = BodyShape::file;
  const Eigen::Vector3d point            = Q * Eigen::Vector3d(0., 0., 1.);
  scene.chuck.point = to_text(point[0], 17) + ", " + to_text(point[1], 17) +
                      ", " + to_text(point[2], 17);
  for (unsigned int k = 0; k < 6; ++k)
    scene.chuck.component[k].function = [&bodies, Q, k](const double t) {
      const Eigen::Vector3d u(0.01 * t, 0.005 * t, 0.02 * t - bodies.press);
      const Eigen::Matrix3d M(
        Eigen::AngleAxisd(0.02 * t,
                          Eigen::Vector3d(0.1, 0.2, 1.).normalized()));
      return components(Q * u, Q * M * Q.transpose())[k];
    };
  Simulation simulation(scene);
  simulation.run();
  return simulation.rows();
}

double
difference(const std::vector<TorqueRow> &rows,
           const std::vector<TorqueRow> &others,
           const Eigen::Matrix3d        &Q)
{
  double force = 0., forces = 0., moment = 0., moments = 0., rest = 0.;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      using Vector  = Eigen::Map<const Eigen::Vector3d>;
      const auto &a = rows[i].chuck_reaction, &b = others[i].chuck_reaction;
      grow(forces, Vector(a.data()).norm());
      grow(moments, Vector(a.data() + 3).norm());
      grow(force, (Q * Vector(a.data()) - Vector(b.data())).norm());
      grow(moment, (Q * Vector(a.data() + 3) - Vector(b.data() + 3)).norm());
      grow(rest, std::abs(rows[i].phi_mean - others[i].phi_mean));
      grow(rest,
           std::abs(rows[i].dissipation_Nmm / others[i].dissipation_Nmm - 1.));
    }
  return rows.size() == others.size() ?
           std::max({force / forces, moment / moments, rest}) :
           1.;
}

Bodies
pin_in_sleeve()
{
  RevolvedBody pin, sleeve;
  pin.cells    = {{8, 1, 3}};
  sleeve.cells = {{8, 2, 3}};
  pin.lowest = sleeve.lowest = -3.;
  pin.height = sleeve.height = 3.;
  pin.outer                  = [](double, double) { return 2.004; };
  pin.top_name               = "held";
  sleeve.inner               = [](double, double) { return 2.; };
  sleeve.outer               = [](double, double) { return 5.; };
  sleeve.contact             = RevolvedBody::Part::inner;
  sleeve.outer_name          = "held";
  return {mesh_of_revolution(pin), mesh_of_revolution(sleeve), 0.};
}

Bodies
cup_in_cavity()
{
  Bowl cup, cavity;
  cup.cells = cavity.cells = {{8, 2, 1}};
  cup.outer.radius         = 2.004;
  cup.is_solid             = true;
  cup.inner.box            = {{1.6, 1.6, 0.8}};
  cup.rim                  = "held";
  cavity.inner.radius      = 2.;
  cavity.outer.radius      = 5.;
  cavity.contact_is_inner  = true;
  cavity.bottom            = "held";
  cavity.sides             = {{"held", "held"}};
  return {mesh_of_bowl(cup), mesh_of_bowl(cavity), 0.};
}

Bodies
ring_on_ring()
{
  RevolvedBody ring, bone;
  ring.cells = bone.cells = {{8, 1, 2}};
  ring.height = bone.height = 2.;
  ring.inner                = [](double, double) { return 1.; };
  ring.outer                = [](double, double) { return 2.; };
  bone.inner                = [](double, double) { return 0.5; };
  bone.outer                = [](double, double) { return 3.; };
  ring.contact              = RevolvedBody::Part::bottom;
  ring.top_name = bone.top_name = "held";
  bone.contact                  = RevolvedBody::Part::bottom;
  StoredMesh of_bone            = mesh_of_revolution(bone);
  for (auto &node : of_bone.nodes) // its contact face looks up
    node = {node[0], -node[1], -node[2]};
  return {mesh_of_revolution(ring), std::move(of_bone), 0.03};
}

int
main()
{
  return run_test([] {
    for (const auto &[name, bodies] : {std::make_pair("pin", pin_in_sleeve()),
                                       std::make_pair("cup", cup_in_cavity()),
                                       std::make_pair("ring", ring_on_ring())})
      {
        const Eigen::Matrix3d as_it_is = Eigen::Matrix3d::Identity();
        const auto            rows     = rows_of(bodies, as_it_is);
        report(std::string(name) + ": slides",
               std::any_of(rows.begin(), rows.end(), [](const TorqueRow &row) {
                 return row.share_slip > 0.3;
               }));
        for (const auto &[angle, axis] :
             {std::make_pair(30., Eigen::Vector3d(0., 0., 1.)),
              std::make_pair(117., Eigen::Vector3d(0., 0., 1.)),
              std::make_pair(50., Eigen::Vector3d(1., 2., -0.5))})
          {
            const Eigen::Matrix3d Q(
              Eigen::AngleAxisd(angle * M_PI / 180., axis.normalized()));
            report(std::string(name) + ", turned by " +
                     std::to_string(int(angle)),
                   difference(rows, rows_of(bodies, Q), Q),
                   1e-9);
          }
      }
  });
}
