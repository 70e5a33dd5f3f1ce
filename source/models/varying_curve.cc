#include <debond/models/closed_form_solution.h>
#include <debond/models/foundation.h>
#include <debond/models/simulation.h>
#include <debond/models/varying_curve.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    constexpr double degree = M_PI / 180.;
    constexpr auto   twist  = ChuckComponent::rotation_z;
  } // namespace



  // What a scene predicts needs neither a measured curve nor a directory.
  VaryingCurve::VaryingCurve(const std::vector<SceneEntry> &entries,
                             const std::string             &name)
    : scene(with_overrides(entries,
                           {"Task=simulate",
                            "Output/Reference curve=none",
                            "Expert/Output/Console=quiet"}),
            name)
    , given(scene.with({}))
  {}



  const Scene &
  VaryingCurve::take(const std::vector<SceneEntry> &changed)
  {
    std::string of_bodies;
    for (const SceneEntry &entry : changed)
      if (const auto &in = entry.subsections;
          std::count(in.begin(), in.end(), "Bone") +
            std::count(in.begin(), in.end(), "Implant") >
          0)
        of_bodies += entry.full_name() + "=" + entry.value + "\n";
    if (of_bodies != bulk_entries)
      {
        bodies.reset();
        linear_bodies.reset();
        bulk_entries = of_bodies;
      }
    return scene.with(changed);
  }



  void
  VaryingCurve::check(const std::vector<SceneEntry> &changed)
  {
    take(changed).check();
  }



  std::string
  VaryingCurve::why_no_closed_form() const
  {
    Scene as_foundation   = given;
    as_foundation.model   = ModelKind::foundation;
    const std::string why = Debond::why_no_closed_form(as_foundation);
    return !why.empty()                 ? why :
           given.load_steps.follow_path ? "the scene follows a path" :
           given.chuck.component[twist].stiffness > 0. ?
                                          "the machine is compliant" :
                                          "";
  }



  std::array<double, 2>
  VaryingCurve::compliance_of_bodies(const std::vector<SceneEntry> &changed)
  {
    const Scene                &now  = take(changed);
    const ClosedFormParameters &form = now.closed_form;
    const bool are_rigid             = now.bone.material == Material::rigid &&
                           now.implant.material == Material::rigid;
    if (are_rigid ||
        (form.torsional_stiffness > 0. && form.normal_stiffness > 0.))
      return {{0., 0.}};
    const FoundationStiffness stiffness =
      foundation_stiffness(now, &linear_bodies);
    return {
      {1. / stiffness.normal - 1. / now.interface.normal_penalty,
       1. / stiffness.torsional - 1. / now.interface.tangential_stiffness()}};
  }



  std::pair<Eigen::VectorXd, double>
  VaryingCurve::by_foundation(const std::vector<SceneEntry> &changed,
                              const std::array<double, 2>   &compliance,
                              const std::vector<double>     &angles)
  {
    const Scene                &now       = take(changed);
    const ClosedFormParameters &form      = now.closed_form;
    const auto                  in_series = [](const double given_stiffness,
                              const double of_interface,
                              const double of_bodies) {
      return given_stiffness > 0. ? given_stiffness :
                                                     1. / (1. / of_interface + of_bodies);
    };
    const TorsionModel::Disk disk =
      foundation_disk(now,
                      in_series(form.normal_stiffness,
                                now.interface.normal_penalty,
                                compliance[0]),
                      in_series(form.torsional_stiffness,
                                now.interface.tangential_stiffness(),
                                compliance[1]));
    std::vector<double> radians;
    for (const double angle : angles)
      radians.push_back(angle * degree);
    return {torsion_curve(disk, radians),
            -disk.pressure * M_PI * disk.radius * disk.radius};
  }



  // With the bodies of the run before, where they are the same.
  std::unique_ptr<Simulation>
  VaryingCurve::run(const Scene &now)
  {
    if (bodies)
      bodies->return_to_rest();
    auto simulation = std::make_unique<Simulation>(now, bodies);
    bodies          = simulation->system().bodies();
    simulation->run();
    return simulation;
  }



  std::vector<std::vector<double>>
  VaryingCurve::steps_of(const std::vector<SceneEntry> &changed)
  {
    if (given.model != ModelKind::finite_elements || !given.load_steps.adaptive)
      return {};
    Scene now = take(changed);
    now.load_steps.tolerance *= 0.1;
    const auto                       simulation = run(now);
    const auto                      &phases     = now.load_steps.times;
    std::vector<std::vector<double>> ends(phases.size() - 1);
    for (const TorqueRow &row : simulation->rows())
      if (row.step > 0)
        ends[std::lower_bound(phases.begin(), phases.end(), row.time) -
             phases.begin() - 1]
          .push_back(row.time);
    return ends;
  }



  std::vector<TorqueRow>
  VaryingCurve::by_scene(const std::vector<SceneEntry>          &changed,
                         const std::vector<std::vector<double>> &ends_of_steps)
  {
    Scene now = take(changed);
    if (now.model != ModelKind::finite_elements)
      return ClosedFormSolution(now).rows;
    if (!ends_of_steps.empty())
      {
        now.load_steps.adaptive = false;
        now.load_steps.ends     = ends_of_steps;
        for (std::size_t i = 0; i < ends_of_steps.size(); ++i)
          now.load_steps.steps[i] = ends_of_steps[i].size();
      }
    const auto simulation = run(now);
    return now.load_steps.draws_curve() ? fine_curve(simulation->rows()) :
                                          simulation->rows();
  }
} // namespace Debond
