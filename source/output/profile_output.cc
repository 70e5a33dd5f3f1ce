#include <debond/input/csv_table.h>
#include <debond/output/profile_output.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** phi and mu from g_s = 0 to 1.5 times the distance after which no bond is
     *  left. */
    std::string
    friction_law_table(const InterfaceParameters &interface)
    {
      constexpr unsigned int n        = 600;
      const FrictionLaw     &friction = *interface.friction;
      const FrictionState    start{interface.bonding.initial_bonding};
      const double           end     = 1.5 * friction.kinks().back();
      const double           initial = friction.coefficient(start, 0.).mu;
      std::string            table   = "slip_mm,phi,mu,mu_over_initial\n";
      for (unsigned int i = 0; i <= n; ++i)
        {
          const double slip        = end * i / n;
          const auto   coefficient = friction.coefficient(start, slip);
          table += csv_line({slip,
                             coefficient.phi,
                             coefficient.mu,
                             initial > 0. ? coefficient.mu / initial : 0.});
        }
      return table;
    }
  } // namespace



  ProfileOutput::ProfileOutput(const Scene           &scene,
                               const ResultDirectory &directory)
    : directory(directory)
    , angles_to_come(scene.output.profile_angles)
    , reference(read_profiles(scene.output.reference_profiles))
    , wanted(!angles_to_come.empty())
    , table("angle_deg,x_mm,y_mm,r_mm,pressure_MPa,traction_MPa,slip_mm,phi,mu,"
            "state,area_mm2\n")
  {
    std::sort(angles_to_come.begin(), angles_to_come.end());
    if (scene.output.friction_law_curve)
      write_file(directory.file("friction_law.csv"),
                 friction_law_table(scene.interface));
  }



  std::vector<InterfacePoint>
  profile_points(const ContactInterface &interface)
  {
    std::vector<InterfacePoint> points;
    for (const SlavePoint &point : interface.get_points())
      if (point.faces_implant)
        {
          const auto coefficient = interface.friction(point);
          points.push_back({point.X[0],
                            point.X[1],
                            point.trial.pressure,
                            point.trial.tangential_traction.norm(),
                            point.trial.state.slip,
                            coefficient.phi,
                            coefficient.mu,
                            point.trial.state.status,
                            point.JxW});
        }
    return points;
  }



  void
  ProfileOutput::write(
    const double                                        angle_deg,
    const std::function<std::vector<InterfacePoint>()> &points)
  {
    const auto first_to_come =
      std::find_if(angles_to_come.begin(),
                   angles_to_come.end(),
                   [&](const double angle) {
                     return std::abs(angle_deg) < angle * (1. - 1e-9);
                   });
    if (first_to_come == angles_to_come.begin())
      return;
    angles_to_come.erase(angles_to_come.begin(), first_to_come);
    has_points = true;
    for (const InterfacePoint &p : points())
      table += csv_line({angle_deg,
                         p.x,
                         p.y,
                         std::hypot(p.x, p.y),
                         p.pressure,
                         p.traction,
                         p.slip,
                         p.phi,
                         p.mu,
                         double(p.status),
                         p.area});
  }



  std::string
  ProfileOutput::finish()
  {
    if (!wanted)
      return "";
    write_file(directory.file("profiles.csv"), table);
    if (angles_to_come.empty())
      return "";
    return "Output / Profile angles: " + to_text(angles_to_come.front(), 6) +
           " deg was never reached";
  }



  ProfileMeasures
  ProfileOutput::measures() const
  {
    if (reference.empty() || !has_points)
      return {};
    return compare_profiles(read_profiles(directory.file("profiles.csv")),
                            reference);
  }
} // namespace Debond
