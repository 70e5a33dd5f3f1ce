// A contract of contact points on a curved, deformed master, for all laws of
// the interface, friction laws and directions of slip, at random states that
// random motions lead to: the derivatives of the traction and of the forces on
// the master are those of differences, by the slave point, the control points,
// the turn of the point's way and the damage of the share that is held; a point
// sticks if and only if its trial traction is within the limit; otherwise
// traction, gap, direction and sliding distance meet the equations of sliding,
// written here anew; an open point exerts nothing.

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_point.h>
#include <debond/support/input_error.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "checks.h"
#include "law_of_text.h"
#include "rectangle_of.h"

using namespace Debond;

/** A master of size one with 3 x 3 elements, bumps and a distorted net. */
ControlNet
distorted(const NurbsSurface &surface)
{
  ControlNet net = surface.control_points();
  for (unsigned int A = 0; A < net.cols(); ++A)
    net.col(A) += Eigen::Vector3d(random_number(-0.03, 0.03),
                                  random_number(-0.03, 0.03),
                                  random_number(-0.07, 0.07));
  const Eigen::AngleAxisd turn(0.5, Eigen::Vector3d(1, -2, 3).normalized());
  return (turn.toRotationMatrix() * net).eval();
}

const NurbsSurface surfaces[]{rectangle_of(1.2, 1., 3, 3),
                              NurbsSurface::disk(0.6, 3)};
const ControlNet   nets[]{distorted(surfaces[0]), distorted(surfaces[1])};

/** A point of the master, and the normal that points to the slave. */
struct MasterPoint : SurfaceGeometry
{
  Eigen::Vector3d n;

  MasterPoint(const MasterSurface &master, const Eigen::Vector2d &xi)
  {
    SurfaceBasis basis;
    master.surface->evaluate(xi, basis);
    contract(basis, *master.positions, *this);
    n = master.outward_sign * a1.cross(a2).normalized();
  }

  Eigen::Vector3d
  tangential(const Eigen::Vector3d &v) const
  {
    return v - v.dot(n) * n;
  }
};



/** A point and what it is asked. */
struct Question
{
  ContactPointLaw   law;
  ContactPointMode  mode;
  ContactPointState start;
  bool              rubs    = true; ///< there is friction
  unsigned int      surface = 0;
  double            sign = 1., phi_0 = 1.;
  Eigen::Vector3d   x;
  ControlNet        net;

  MasterSurface
  master() const
  {
    return {&surfaces[surface], &net, sign};
  }

  ContactPointResult
  answer() const
  {
    ContactPointResult result;
    // what an earlier update may leave behind
    result.dt.setOnes();
    result.dxi.setOnes();
    result.traction.setOnes();
    result.pressure = 1.;
    update_contact_point(law, start, phi_0, x, master(), mode, result);
    return result;
  }

  PointStart
  begin() const
  {
    PointStart result =
      law.joint->begin(start, phi_0, mode.duration, mode.frictionless);
    result.viscous = viscous_stiffness(law, mode);
    return result;
  }

  Question
  moved(const struct Direction &direction, double h) const;
};

/** A direction in which a question is varied. */
struct Direction
{
  Eigen::Vector3d x;
  ControlNet      net;
  double          turn = 0., damage = 0.;
};

Question
Question::moved(const Direction &direction, const double h) const
{
  Question result = *this;
  result.x += h * direction.x;
  result.net += h * direction.net;
  result.mode.turn += h * direction.turn;
  result.mode.damage += h * direction.damage;
  return result;
}



/** Traction on the slave and forces on the control points of the master. */
Eigen::Matrix3Xd
forces(const ContactPointResult &result, const unsigned int n)
{
  Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, 1 + n);
  all.col(0)           = result.traction;
  for (unsigned int b = 0; b < result.basis.size; ++b)
    all.col(1 + result.basis.control_point[b]) =
      result.basis.N[b] * result.traction;
  return all;
}

/** Their change in a direction, as the program has it: chain rule from w. */
Eigen::Matrix3Xd
change(const Question           &question,
       const ContactPointResult &result,
       const Direction          &direction)
{
  Eigen::Matrix<double, W::size, 1> dw;
  dw.setZero();
  dw[W::turn] = direction.turn;
  for (const int gap : {W::gap, W::trial_gap})
    dw.segment<3>(gap) = direction.x;
  const Eigen::Vector2d &g = question.start.gap;
  for (unsigned int a = 0; a < result.basis.size; ++a)
    {
      const auto dX = direction.net.col(result.basis.control_point[a]);
      dw.segment<3>(W::gap) -= result.basis.N[a] * dX;
      dw.segment<3>(W::a1) += result.basis.N_1[a] * dX;
      dw.segment<3>(W::a2) += result.basis.N_2[a] * dX;
    }
  const SurfaceBasis &old = result.old_basis;
  if (slides(result.state.status))
    for (unsigned int a = 0; a < old.size; ++a)
      {
        const auto dX = direction.net.col(old.control_point[a]);
        dw.segment<3>(W::trial_gap) -= old.N[a] * dX;
        dw.segment<3>(W::old_gap) +=
          (g[0] * old.N_1[a] + g[1] * old.N_2[a]) * dX;
      }
  const Eigen::Vector3d dt =
    result.dt * dw + result.by_damage.traction * direction.damage;
  const Eigen::Vector2d dxi =
    result.dxi * dw + result.by_damage.xi * direction.damage;
  Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, 1 + direction.net.cols());
  all.col(0)           = dt;
  for (unsigned int b = 0; b < result.basis.size; ++b)
    all.col(1 + result.basis.control_point[b]) =
      result.basis.N[b] * dt + result.traction * (result.basis.N_1[b] * dxi[0] +
                                                  result.basis.N_2[b] * dxi[1]);
  return all;
}



/** What has been found of a law. */
struct Findings
{
  std::map<PointStatus, unsigned int> compared;
  unsigned int                        failed = 0, wrong_status = 0;
  double derivatives = 0., equations = 0., limit = 0., nothing = 0., kept = 0.;
};

/** Differences of fourth order, where first and second differences of twice the
 *  size agree, so that there is no kink. */
void
check_derivatives(const Question           &question,
                  const ContactPointResult &now,
                  Findings                 &found)
{
  std::vector<Direction> directions(3,
                                    {Eigen::Vector3d::Zero(),
                                     0. * question.net});
  for (double &component : directions[0].x)
    component = random_number(-1., 1.);
  for (Eigen::Index k = 0; k < question.net.size(); ++k)
    directions[0].net(k) = random_number(-1., 1.);
  directions[1].turn   = 100.;
  directions[2].damage = 100.;
  const unsigned int n = question.net.cols();
  for (const Direction &direction : directions)
    {
      const double     h = 1e-6;
      Eigen::Matrix3Xd at[5];
      bool             same = true;
      for (const int k : {-2, -1, 1, 2})
        {
          const ContactPointResult there =
            question.moved(direction, k * h).answer();
          same = same && !there.failed &&
                 there.state.status == now.state.status &&
                 there.basis.element == now.basis.element;
          at[k + 2] = forces(there, n);
        }
      at[2]                         = forces(now, n);
      const Eigen::Matrix3Xd fine   = (at[3] - at[1]) / (2. * h),
                             coarse = (at[4] - at[0]) / (4. * h),
                             bend   = (at[3] - 2. * at[2] + at[1]) / h,
                             wide   = (at[4] - 2. * at[2] + at[0]) / h;
      const double scale            = 600. + fine.cwiseAbs().maxCoeff();
      if (!same || (wide - 4. * bend).cwiseAbs().maxCoeff() > 1e-6 * scale ||
          (fine - coarse).cwiseAbs().maxCoeff() > 1e-6 * scale)
        continue;
      ++found.compared[now.state.status];
      grow(found.derivatives,
           ((4. * fine - coarse) / 3. - change(question, now, direction))
               .cwiseAbs()
               .maxCoeff() /
             scale);
    }
}



/** What a point that touches carries: pressure along the normal, the elastic
 *  interface along the face, Eqs. (29) and (30). */
void
check_equations(const Question           &question,
                const ContactPointResult &result,
                Findings                 &found)
{
  const MasterSurface master = question.master();
  const MasterPoint at(master, result.state.xi), old(master, question.start.xi);
  const InterfaceLaw   &law   = *question.law.joint;
  const double          eps_t = question.law.tangential_penalty;
  const Eigen::Vector3d g = question.x - at.y, g_t = at.tangential(g),
                        trial = old.tangential(question.x - old.y);
  const double distance = law.slid(result.state) - law.slid(question.start);
  const auto   response = law.respond(question.begin(), g.dot(at.n), distance);
  const auto   limit    = [&](const InterfaceResponse &of, const double way) {
    const double eta = of.resists && question.rubs ?
                              question.law.viscosity / question.mode.duration :
                              0.;
    return of.limit + eta * (of.shears ? of.rubbed : way);
  };
  grow(found.equations, std::abs(result.pressure - response.pressure));
  grow(found.equations,
       (result.traction + result.pressure * at.n - eps_t * g_t).norm());
  grow(found.equations,
       eps_t * (interpolate(result.basis, *master.positions) - at.y).norm());
  const double at_rest =
    limit(law.respond(question.begin(), (question.x - old.y).dot(old.n), 0.),
          0.);
  const bool sticks = result.state.status == PointStatus::stick;
  if (std::abs(eps_t * trial.norm() - at_rest) > 1e-9)
    found.wrong_status +=
      sticks != (question.mode.stick_first || eps_t * trial.norm() < at_rest);
  if (sticks)
    {
      grow(found.equations, (result.state.xi - question.start.xi).norm());
      return;
    }
  grow(found.limit, std::abs(eps_t * g_t.norm() - limit(response, distance)));
  if (question.mode.frictionless)
    return;
  if (question.law.slip_direction == SlipDirection::integrated)
    return; // TowedGap, tests/interface/integrated_slip.cc
  grow(found.equations, eps_t * std::abs((at.y - old.y).norm() - distance));
  // where there was no gap before, that without sliding
  const Eigen::Vector2d &gap  = question.start.gap;
  const Eigen::Vector3d  pull = at.tangential(
    question.law.slip_direction == SlipDirection::trial || gap.isZero(0.) ?
      Eigen::Vector3d(question.x - old.y) :
      Eigen::Vector3d(gap[0] * old.a1 + gap[1] * old.a2));
  grow(found.limit,
       (eps_t * g_t - limit(response, distance) * pull.normalized()).norm());
}



/** What a result keeps of the updates before, of all points and both masters,
 *  changes nothing. */
double
difference_of_used(const Question &question, const ContactPointResult &result)
{
  static ContactPointResult used;
  update_contact_point(question.law,
                       question.start,
                       question.phi_0,
                       question.x,
                       question.master(),
                       question.mode,
                       used);
  const unsigned int n   = question.net.cols();
  const auto         old = [&](const ContactPointResult &of) {
    return interpolate(of.old_basis, question.net);
  };
  return (used.dt - result.dt).norm() + (used.dxi - result.dxi).norm() +
         (used.dpath - result.dpath).norm() + (old(used) - old(result)).norm() +
         (forces(used, n) - forces(result, n)).norm() +
         (interpolate(used.basis, question.net) -
          interpolate(result.basis, question.net))
           .norm();
}



/** A point that is taken through three random motions. */
void
check_point(Question question, Findings &found)
{
  const MasterPoint at(question.master(),
                       question.start.xi = {random_number(0.2, 0.8),
                                            random_number(0.2, 0.8)});
  for (unsigned int step = 0; step < 3; ++step)
    {
      const double height = random_number(-0.02, 0.012),
                   way    = 0.06 * std::pow(random_number(0., 1.), 2),
                   angle  = random_number(0., 6.28);
      question.x          = at.y + height * at.n +
                   way * (std::cos(angle) * at.a1.normalized() +
                          std::sin(angle) * at.n.cross(at.a1.normalized()));
      const ContactPointResult result = question.answer();
      grow(found.kept, difference_of_used(question, result));
      found.failed += result.failed;
      if (result.failed)
        return;
      check_derivatives(question, result, found);
      if (result.state.status == PointStatus::open)
        grow(found.nothing,
             result.traction.norm() + result.dt.norm() + result.dxi.norm() +
               std::abs(result.pressure) +
               std::abs(question.law.joint->slid(result.state) -
                        question.law.joint->slid(question.start)));
      else if (result.state.status != PointStatus::pulled)
        check_equations(question, result, found);
      question.start = result.state;
      // At the limit whether it slides at once hangs on rounding.
      question.start.gap *= 0.7;
    }
}



void
check(const std::string &name, const ContactPointLaw &law, const bool rubs)
{
  const bool shears = law.joint->bone.shears();
  Findings   found;
  for (unsigned int sample = 0; sample < 150; ++sample)
    {
      Question question;
      question.law = law;
      // softer and stiffer than along the normal
      question.law.tangential_penalty = sample % 4 < 2 ? 250. : 900.;
      question.surface                = sample % 2;
      question.net                    = nets[question.surface];
      question.sign                   = sample % 3 ? 1. : -1.;
      question.phi_0                  = sample % 5 ? 0.9 : 0.4;
      question.start.joined           = sample % 4 != 3;
      question.start.has_partner      = true;
      question.start.status           = PointStatus::stick;
      question.start.normal_gap       = -0.01;
      question.start.internal         = law.joint->friction->initial_variables;
      question.mode.duration          = 0.5;
      question.mode.turn = std::array<double, 3>{{0., 0.6, -1.}}[sample % 3];
      question.mode.frictionless = sample % 10 == 0;
      question.mode.stick_first  = sample % 15 == 1;
      question.rubs              = rubs && !question.mode.frictionless;
      if (sample % 4 == 0)
        question.law.viscosity = 30.;
      check_point(question, found);
    }
  const auto compared = [&found](const PointStatus status) {
    return found.compared[status] > 20;
  };
  report(name + ": twenty states each, and hardly one is not found",
         compared(PointStatus::slip) && compared(PointStatus::open) &&
           (compared(PointStatus::shears) || !shears) &&
           (compared(PointStatus::stick) || !rubs) && found.failed < 3);
  report(name + ": derivatives, deviation from differences",
         found.derivatives,
         1e-6);
  report(name + ": equations are missed by [MPa]", found.equations, 1e-10);
  report(name + ": the limit is missed by [MPa]", found.limit, 1e-9);
  report(name + ": open points exert [MPa]", found.nothing, 1e-30);
  report(name + ": a result that was used before differs by",
         found.kept,
         1e-30);
  report(name + ": all stick or slide as the trial traction demands",
         found.wrong_status == 0);
}



int
main()
{
  std::ofstream("contact_point_tangent.csv")
    << "slip_mm,phi\n0,1\n0.01,0.9\n0.02,0.4\n0.03,0.1\n0.05,0\n";
  const struct
  {
    std::string   name;
    SlipDirection direction;
    bool          is_explicit;
  } methods[]{{"integrated", SlipDirection::integrated, false},
              {"trial", SlipDirection::trial, false},
              {"trial, explicit", SlipDirection::trial, true},
              {"previous gap", SlipDirection::previous_gap, false}};
  // with entries that do nothing by default
  const std::string adhesive = "set Law = adhesive\nsubsection Adhesive\n"
                               "set Adhesive friction = 1\n"
                               "end\nsubsection Expert\nsubsection Adhesive\n"
                               "set Opening viscosity = 20\nend\nend\n";
  // crushed up to a third of the pressures, and sheared below mu p
  const BoneLayer layers[]{{}, {4., 150., 2.}, {4., 0., 2., true}};
  for (const InterfaceLawPlugin &plugin : all_laws<InterfaceLaw>())
    for (const FrictionLawPlugin &friction : all_laws<FrictionLaw>())
      for (const auto &[name, direction, is_explicit] : methods)
        for (BoneLayer bone : layers)
          {
            const bool is_layer = bone.crushes(),
                       rubs     = friction.name != "frictionless";
            if (is_layer && direction != SlipDirection::integrated)
              continue;
            if (plugin.name == "mixed mode" || !rubs)
              bone.shear_strength = 0.; // refused, not reached
            ContactPointLaw law;
            try
              {
                law.joint = interface_law_of_text(
                  plugin.name == "adhesive" ? adhesive :
                                              "set Law = " + plugin.name + "\n",
                  law_of_text("set Friction law = " + friction.name +
                              "\nset Friction table = "
                              "contact_point_tangent.csv\n"),
                  is_explicit,
                  bone);
              }
            catch (const EntryError &) // it has no bond
              {
                continue;
              }
            law.tangential_penalty = 250.;
            law.slip_direction     = direction;
            check(plugin.name + ", " + friction.name + ", " + name +
                    (!is_layer             ? "" :
                     bone.shear_wears_bond ? ", bone, sheared with the bond" :
                                             ", bone"),
                  law,
                  rubs);
          }
}
