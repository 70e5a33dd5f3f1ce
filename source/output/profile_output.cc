#include <debond/output/profile_output.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <locale>
#include <sstream>

namespace Debond
{
  namespace
  {
    std::string
    csv_line(const std::initializer_list<double> &values)
    {
      std::ostringstream line;
      line.imbue(std::locale::classic());
      line.precision(12);
      const char *separator = "";
      for (const double value : values)
        {
          line << separator << value + 0.; // no "-0"
          separator = ",";
        }
      return line.str() + "\n";
    }



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



  bool
  ProfileOutput::reaches(const double angle_deg)
  {
    bool reached = false;
    while (!angles_to_come.empty() &&
           std::abs(angle_deg) >= angles_to_come.front() * (1. - 1e-9))
      {
        angles_to_come.erase(angles_to_come.begin());
        reached = has_points = true;
      }
    return reached;
  }



  void
  ProfileOutput::write(const double            angle_deg,
                       const ContactInterface &interface)
  {
    if (!reaches(angle_deg))
      return;
    for (const SlavePoint &point : interface.get_points())
      if (point.faces_implant)
        {
          const auto             coefficient = interface.friction(point);
          const Eigen::Vector3d &X           = point.X;
          table += csv_line({angle_deg,
                             X[0],
                             X[1],
                             std::hypot(X[0], X[1]),
                             point.trial.pressure,
                             point.trial.tangential_traction.norm(),
                             point.trial.state.slip,
                             coefficient.phi,
                             coefficient.mu,
                             double(point.trial.state.status),
                             point.JxW});
        }
  }



  void
  ProfileOutput::write(const double angle_deg, const TorsionModel &model)
  {
    if (!reaches(angle_deg))
      return;
    // between the points, so that neither the axis nor the rim is hit, where
    // the traction of a bonded disk is infinite
    constexpr unsigned int n     = 250;
    const double           theta = angle_deg * M_PI / 180.;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double r     = model.radius() * (i + 0.5) / n;
        const auto   point = model.point(r, theta);
        table += csv_line(
          {angle_deg,
           r,
           0.,
           r,
           model.pressure(),
           std::abs(point.traction),
           point.slip,
           point.phi,
           point.mu,
           double(point.sticks ? PointStatus::stick : PointStatus::slip),
           2. * M_PI * r * model.radius() / n});
      }
  }



  std::string
  ProfileOutput::finish()
  {
    if (!wanted)
      return "";
    write_file(directory.file("profiles.csv"), table);
    if (angles_to_come.empty())
      return "";
    std::ostringstream warning;
    warning << "Output / Profile angles: " << angles_to_come.front()
            << " deg was never reached";
    return warning.str();
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
