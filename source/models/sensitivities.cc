#include <debond/input/csv_table.h>
#include <debond/models/sensitivities.h>
#include <debond/support/input_error.h>

#include <Eigen/Geometry>

// The coupled system, differentiated. An accepted state solves the equations of
// CoupledSystem::evaluate(); with a parameter p they change in the forces of
// the interface (InterfaceSensitivity), in the stiffness of linear bodies,
// which goes with E, in what the chuck is prescribed or loaded with, and in the
// history that the step began with.
namespace Debond
{
  namespace
  {
    std::vector<InterfaceVariation>
    variations_of_interface(const Scene                       &scene,
                            const std::vector<SceneVariation> &variations)
    {
      std::vector<InterfaceVariation> result;
      for (const SceneVariation &variation : variations)
        {
          const std::string why = why_not_differentiable(scene, variation);
          if (!why.empty())
            throw InputError("no derivative by " + variation.name + ": " + why);
          result.push_back({variation.plus.interface,
                            variation.minus.interface,
                            variation.width});
        }
      return result;
    }



    /** How the frame of the implant turns in space. */
    Eigen::Vector3d
    spin_of(const Chuck &chuck, const Chuck::Vector6 &q)
    {
      return q[3] * chuck.axis(3) + q[4] * chuck.axis(4) + q[5] * chuck.axis(5);
    }
  } // namespace



  // At the first time the bodies are placed undeformed where the scene has the
  // chuck; what is loaded starts from zero.
  Sensitivities::Sensitivities(const Scene                       &scene,
                               const CoupledSystem               &system,
                               const std::vector<SceneVariation> &variations)
    : system(system)
    , parameters(make_parameters(scene, system, variations))
    , interface(system.interface,
                variations_of_interface(scene, variations),
                motions(given_motions(scene.load_steps.times.front(),
                                      [&scene](const unsigned int k) {
                                        return !scene.chuck.component[k].loaded;
                                      })))
  {}



  std::vector<Sensitivities::Parameter>
  Sensitivities::make_parameters(const Scene                       &scene,
                                 const CoupledSystem               &system,
                                 const std::vector<SceneVariation> &variations)
  {
    std::vector<Parameter> result;
    for (const SceneVariation &variation : variations)
      {
        const auto chuck_of = [&](const Scene &varied) {
          return Chuck(varied.chuck, system.chuck.reference_centre(), system.R);
        };
        Parameter                          parameter{variation.width,
                            {{chuck_of(variation.plus),
                                                       chuck_of(variation.minus)}},
                            {},
                            {}};
        const std::array<const Scene *, 2> scenes{
          {&variation.plus, &variation.minus}};
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int k = 0; k < 6; ++k)
            parameter.stiffness[i][k] = scenes[i]->chuck.component[k].stiffness;
        const auto stiffening = [&](const BodyParameters Scene::*body) {
          return ((variation.plus.*body).young_modulus -
                  (variation.minus.*body).young_modulus) /
                 (variation.width * (scene.*body).young_modulus);
        };
        parameter.stiffening[Side::bone]    = stiffening(&Scene::bone);
        parameter.stiffening[Side::implant] = stiffening(&Scene::implant);
        result.push_back(std::move(parameter));
      }
    return result;
  }



  // A column for each parameter: the unknowns of
  // CoupledSystem::with_whole_chuck(), of which those components of the chuck
  // move that follow what the scene says.
  template <typename Follows>
  Eigen::MatrixXd
  Sensitivities::given_motions(const double time, const Follows &follows) const
  {
    const unsigned int n_v =
      system.n_unknowns() - system.configuration.chuck_unknowns.size();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n_v + 6, parameters.size());
    for (unsigned int j = 0; j < parameters.size(); ++j)
      {
        const Chuck::Vector6 change = (parameters[j].chuck[0].values(time) -
                                       parameters[j].chuck[1].values(time)) /
                                      parameters[j].width;
        for (unsigned int k = 0; k < 6; ++k)
          if (follows(k))
            result(n_v + k, j) = change[k];
      }
    return result;
  }



  std::vector<InterfaceMotion>
  Sensitivities::motions(const Eigen::MatrixXd &unknowns) const
  {
    const InterfaceConfiguration moving = system.with_whole_chuck();
    const unsigned int           n      = unknowns.cols();
    std::vector<InterfaceMotion> result((n + n_lanes - 1) / n_lanes);
    for (InterfaceMotion &motion : result)
      motion.surfaces = zero_lanes(moving);
    for (unsigned int j = 0; j < n; ++j)
      {
        InterfaceMotion      &motion = result[j / n_lanes];
        const unsigned int    lane   = j % n_lanes;
        const Eigen::VectorXd column = unknowns.col(j);
        const Chuck::Vector6  q      = column.tail<6>();
        set_lane(motion.surfaces, lane, nodal_motion(column, moving));
        motion.shift.row(lane) = q.head<3>();
        motion.spin.row(lane)  = spin_of(system.chuck, q);
      }
    return result;
  }



  // dr/dp at rest but for what is given. @p forces: what that, the history and
  // the law do to the interface. K goes with E, and S v_c is in equilibrium
  // with the forces of the contact. The load of the machine is k (value - q),
  // or the value itself.
  Eigen::MatrixXd
  Sensitivities::right_hand_sides(const std::vector<LaneSums> &forces,
                                  const Eigen::MatrixXd       &given) const
  {
    const auto                  &unknown = system.configuration.chuck_unknowns;
    const InterfaceConfiguration moving  = system.with_whole_chuck();
    InterfaceConfiguration       bodies  = system.configuration;
    bodies.chuck_unknowns.clear();
    const PathEquation   no_path;
    const CoupledTangent tangent(system.body,
                                 system.interface,
                                 moving,
                                 no_path);
    const unsigned int   n_v = system.n_unknowns() - unknown.size();
    Eigen::MatrixXd      result(system.n_unknowns(), parameters.size());
    for (unsigned int j = 0; j < parameters.size(); ++j)
      {
        const Parameter &parameter = parameters[j];
        Eigen::VectorXd  change    = Eigen::VectorXd::Zero(n_v + 6);
        NodalSums        internal;
        for (const Side side : both_sides)
          internal[side] =
            -parameter.stiffening[side] * system.interface.force(side);
        add_in_unknowns(get_lane(forces[j / n_lanes], j % n_lanes),
                        moving,
                        1.,
                        change);
        add_in_unknowns(internal, bodies, 1., change);
        tangent.add_geometric_part(given.col(j), change);
        result.col(j).head(n_v) = change.head(n_v);
        for (const auto &[k, number] : unknown)
          {
            const auto load = [&, k = k](const unsigned int i) {
              const double value  = parameter.chuck[i].values(system.time())[k],
                           spring = parameter.stiffness[i][k];
              return spring > 0. ?
                       spring * (value - system.chuck.position()[k]) :
                       value;
            };
            result(number, j) =
              change[n_v + k] - (load(0) - load(1)) / parameter.width;
          }
      }
    return result;
  }



  // Linear systems are solved to what is left of the accuracy of the states,
  // which errors in the history add up to.
  void
  Sensitivities::advance()
  {
    constexpr double   tolerance = 1e-7;
    const auto        &unknown   = system.configuration.chuck_unknowns;
    const unsigned int n_v       = system.n_unknowns() - unknown.size();
    Eigen::MatrixXd    moved =
      given_motions(system.time(), [this](const unsigned int k) {
        return system.chuck.is_prescribed(k);
      });
    const auto forces = interface.forces(system.configuration, motions(moved));
    const Eigen::MatrixXd right    = right_hand_sides(forces, moved);
    Eigen::MatrixXd       solution = -system.solve_all(right, tolerance);
    // A loaded implant that does not touch yet has no stiffness. It stays where
    // it is, as its load does not change with the parameter.
    for (Eigen::Index j = 0; j < right.cols(); ++j)
      if (right.col(j).isZero(0.))
        solution.col(j).setZero();

    Eigen::MatrixXd response = Eigen::MatrixXd::Zero(n_v + 6, moved.cols());
    response.topRows(n_v)    = solution.topRows(n_v);
    for (const auto &[k, number] : unknown)
      response.row(n_v + k) = solution.row(number);
    moved += response;
    auto                  motion = motions(response);
    std::vector<Lanes<6>> chuck(motion.size(), Lanes<6>::Zero());
    for (unsigned int j = 0; j < moved.cols(); ++j)
      chuck[j / n_lanes].row(j % n_lanes) =
        response.col(j).tail<6>().transpose();
    set_row(moved, interface.advance(system.configuration, motion, chuck));
  }



  // Sums over the forces f_A on the implant, with lever arms r_A from C + u:
  // sum df_A and sum (dr_A x f_A + r_A x df_A). The torque is b . M about the
  // implant's own axis b.
  void
  Sensitivities::set_row(const Eigen::MatrixXd       &moved,
                         const std::vector<LaneSums> &forces)
  {
    using Eigen::Vector3d;
    constexpr auto               spin   = ChuckComponent::rotation_z;
    const Chuck                 &chuck  = system.chuck;
    const InterfaceConfiguration moving = system.with_whole_chuck();
    const ControlNet            &f      = system.interface.force(Side::implant);
    const ControlNet             arm =
      system.configuration.side[Side::implant].positions.colwise() -
      chuck.centre();
    const Vector3d moment = system.chuck_resultant().tail<3>();
    row.reaction.setZero(6, parameters.size());
    row.torque.resize(parameters.size());
    row.position = moved.bottomRows<6>();
    row.position.bottomRows<3>() *= 180. / M_PI;
    for (unsigned int j = 0; j < parameters.size(); ++j)
      {
        const Eigen::VectorXd column = moved.col(j);
        const Chuck::Vector6  q      = column.tail<6>();
        const ControlNet      dx =
          nodal_motion(column, moving)[Side::implant].colwise() - q.head<3>();
        const ControlNet df =
          get_lane(forces[j / n_lanes], j % n_lanes)[Side::implant];
        for (unsigned int A = 0; A < f.cols(); ++A)
          {
            const Vector3d change = df.col(A), moved_arm = dx.col(A);
            row.reaction.col(j).head<3>() += change;
            row.reaction.col(j).tail<3>() +=
              moved_arm.cross(f.col(A)) + arm.col(A).cross(change);
          }
        row.torque[j] = chuck.axis(spin).dot(row.reaction.col(j).tail<3>()) +
                        chuck.axis_rate(spin, q).dot(moment);
      }
  }



  std::vector<RowDerivatives>
  differences(const std::vector<SceneVariation> &variations,
              const std::vector<std::array<std::vector<TorqueRow>, 2>> &rows)
  {
    using Numbers                 = Eigen::Map<const Chuck::Vector6>;
    const unsigned int          n = variations.size();
    std::vector<RowDerivatives> result(n > 0 ? rows[0][0].size() : 0);
    for (unsigned int i = 0; i < result.size(); ++i)
      {
        result[i].reaction.resize(6, n);
        result[i].position.resize(6, n);
        result[i].torque.resize(n);
        for (unsigned int j = 0; j < n; ++j)
          {
            const TorqueRow &plus = rows[j][0][i], &minus = rows[j][1][i];
            const double     width    = variations[j].width;
            result[i].reaction.col(j) = (Numbers(plus.chuck_reaction.data()) -
                                         Numbers(minus.chuck_reaction.data())) /
                                        width;
            result[i].position.col(j) = (Numbers(plus.chuck_position.data()) -
                                         Numbers(minus.chuck_position.data())) /
                                        width;
            result[i].torque[j] = (plus.torque_Nmm - minus.torque_Nmm) / width;
          }
      }
    return result;
  }



  std::string
  sensitivity_table(const Scene                       &scene,
                    const std::vector<TorqueRow>      &rows,
                    const std::vector<RowDerivatives> &derivatives)
  {
    // what there is of a row: the columns of torque.csv with these names
    std::vector<std::string> of_row{"torque_Nmm", "force_N"};
    TorqueRow().for_each_column([&](const std::string &name, double) {
      if (name.rfind("chuck_", 0) == 0)
        of_row.push_back(name);
    });
    std::vector<std::string> names{"time", "angle_deg"};
    for (const std::string &entry : scene.output.sensitivities)
      for (const std::string &name : of_row)
        names.push_back("d " + name + " / d " + entry);
    std::string table = csv_line(names);
    for (unsigned int i = 0; i < derivatives.size(); ++i)
      {
        const RowDerivatives &row = derivatives[i];
        std::vector<double>   values{rows[i].time, rows[i].angle_deg};
        for (unsigned int j = 0; j < row.torque.size(); ++j)
          {
            values.insert(values.end(), {row.torque[j], -row.reaction(2, j)});
            for (const auto *six : {&row.reaction, &row.position})
              for (unsigned int k = 0; k < 6; ++k)
                values.push_back((*six)(k, j));
          }
        table += csv_line(values);
      }
    return table;
  }
} // namespace Debond
