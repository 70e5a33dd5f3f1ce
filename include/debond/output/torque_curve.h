#ifndef debond_output_torque_curve_h
#define debond_output_torque_curve_h

#include <debond/output/profile_output.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  /** One row of torque.csv: the accepted state at the end of a planned step.
   *  All figures are what the chuck exerts on the implant. */
  struct TorqueRow
  {
    unsigned int step       = 0;
    double       time       = 0;
    double       angle_deg  = 0; ///< of the chuck about the implant's own axis
    double       torque_Nmm = 0; ///< about that axis
    double       force_N =
      0; ///< minus the axial force along +z: positive in compression
    double pressure_MPa = 0; ///< force_N / reference area of the contact face
    double phi_mean     = 0;
    double share_stick = 0, share_slip = 0, share_open = 0;
    unsigned int newton_iterations = 0; ///< summed over sub-steps
    double       energy_defect     = 0;
    std::array<double, 6>
      chuck_reaction{}; ///< Fx, Fy, Fz [N], Mx, My, Mz [N mm] about C + u
    // further columns
    double work_Nmm = 0, energy_bulk_Nmm = 0, energy_interface_Nmm = 0,
           dissipation_Nmm = 0, adhesive_work_Nmm = 0;
    /** Quadrature bound of energy_defect: sum |dF| |dq| / 2 over max |W|. */
    double energy_defect_bound = 0;
    /** Contact resultant against reaction of the implant's top, relative. */
    double reaction_defect = 0;
    /** Chuck position: u [mm], rotations x, y, z [deg]. */
    std::array<double, 6> chuck_position{};
    double                viscous_work_Nmm = 0; ///< part of dissipation_Nmm
    /** Number of checks of accepted states that this row did not pass. */
    unsigned int warnings = 0;
    /** Of the machine about z: what the scene prescribes if the machine is
     *  compliant, else that of the chuck. */
    double machine_angle_deg = 0;
    /** Energy that jumps have released so far, see ReleasedEnergy. */
    double released_energy_Nmm = 0;

    /** Calls visit(name, value) for the columns of torque.csv in their order.
     *  The first eighteen are fixed: users' scripts count on them. */
    template <typename Visitor>
    void
    for_each_column(const Visitor &visit)
    {
      visit("step", step);
      visit("time", time);
      visit("angle_deg", angle_deg);
      visit("torque_Nmm", torque_Nmm);
      visit("force_N", force_N);
      visit("pressure_MPa", pressure_MPa);
      visit("phi_mean", phi_mean);
      visit("share_stick", share_stick);
      visit("share_slip", share_slip);
      visit("share_open", share_open);
      visit("newton_iterations", newton_iterations);
      visit("energy_defect", energy_defect);
      for (unsigned int k = 0; k < 6; ++k)
        visit(std::string("chuck_") + "FFFMMM"[k] + "xyzxyz"[k] +
                (k < 3 ? "_N" : "_Nmm"),
              chuck_reaction[k]);
      visit("work_Nmm", work_Nmm);
      visit("energy_bulk_Nmm", energy_bulk_Nmm);
      visit("energy_interface_Nmm", energy_interface_Nmm);
      visit("dissipation_Nmm", dissipation_Nmm);
      visit("adhesive_work_Nmm", adhesive_work_Nmm);
      visit("energy_defect_bound", energy_defect_bound);
      visit("reaction_defect", reaction_defect);
      for (unsigned int k = 0; k < 6; ++k)
        visit(std::string("chuck_") + "uuurrr"[k] + "xyzxyz"[k] +
                (k < 3 ? "_mm" : "_deg"),
              chuck_position[k]);
      visit("viscous_work_Nmm", viscous_work_Nmm);
      visit("warnings", warnings);
      visit("machine_angle_deg", machine_angle_deg);
      visit("released_energy_Nmm", released_energy_Nmm);
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      for_each_column(
        [&](const std::string &, auto &value) { archive &value; });
    }
  };



  /** A row of torque.csv, with twelve significant digits. */
  std::string
  torque_line(TorqueRow row);

  /** The text of torque.csv: a line with the names of the columns, then the
   *  rows. */
  std::string
  torque_table(const std::vector<TorqueRow> &rows);



  /** Torque at an angle, linear between the points of a curve whose angles do
   *  not fall; NaN beside them. Differences of angles up to @p tolerance are
   *  rounding errors. */
  double
  torque_at(const ReferenceCurve &curve, double angle, double tolerance);



  /** What the measures need to know besides the rows. */
  struct CurveSettings
  {
    /** Area that w_adh refers to [mm^2]: pi R^2 for a coin, Eq. (21), that of
     * the sphere for a cap. */
    double contact_area_mm2 = std::numeric_limits<double>::quiet_NaN();
    /** Area mean of phi_0 over the contact face, Eq. (21). */
    double mean_phi_0 = 1;
    /** `Output / Full sliding angle` [deg]; 0: from the curve. */
    double full_sliding_angle_deg = 0;
    /** First time and ends of the phases, `Load steps / Times`. */
    std::vector<double> phase_times;
    /** Empty: no error measures. */
    ReferenceCurve reference;
  };

  /**
   * What is read off a torque curve; NaN where undefined. Angles and energies
   * are undefined if nothing rotates or if the rotation reverses; E_fric and
   * what follows from it also if the run ends before full sliding.
   */
  struct CurveMeasures
  {
    static constexpr double undefined =
      std::numeric_limits<double>::quiet_NaN();

    double T_max_Nmm      = undefined; ///< largest |T| over the rows
    double theta_max_deg  = undefined; ///< where T_max is first met
    double theta_full_deg = undefined; ///< beginning of full sliding
    double T_inf_Nmm      = undefined; ///< T of the last row
    /** At the end of the last phase before the angle first changes. */
    double pressure_MPa = undefined;
    /** Torque per angle up to the first row that has turned. */
    double initial_stiffness_Nm_per_rad = undefined;
    double E_deb_Nm                     = undefined; ///< Eq. (20)
    double E_fric_Nm                    = undefined; ///< Eq. (20)
    double W_adh_Nm                     = undefined; ///< Eq. (20)
    double w_adh_N_per_m                = undefined; ///< Eq. (21)
    double w_adh_star_N_per_m = undefined; ///< Eq. (21) with a mean phi_0 of 1
    double D_adh_Nm           = undefined; ///< work the law spends on adhesion
    double dissipation_Nm     = undefined;
    double viscous_dissipation_Nm = undefined; ///< part of the dissipation
    /** Angle of the first row whose mean bonding state is below the initial. */
    double theta_debonding_deg = undefined;
    double force_end_N         = undefined; ///< axial force of the last row
    /** Of the last row: work of the chuck, energy stored in bodies and
     *  interface. */
    double work_Nm = undefined, E_bulk_Nm = undefined,
           E_interface_Nm = undefined;
    double e_mp           = undefined; ///< Eq. (19), a ratio
    double e_rel          = undefined; ///< Eq. (50), a ratio
    /** Largest and mean |T - T_reference| over the reference's rows, relative
     *  to the largest |T_reference|. */
    double       difference_max = undefined, difference_mean = undefined;
    unsigned int reference_rows_used = 0; ///< in e_mp and e_rel
    double       largest_energy_defect =
      undefined; ///< largest magnitude over the rows
    double largest_reaction_defect = undefined;
  };

  /** Evaluates a torque curve, be it complete, interrupted or empty. Integrals
   *  are trapezoids over the rows. */
  CurveMeasures
  measure_torque_curve(const std::vector<TorqueRow> &rows,
                       const CurveSettings          &settings);



  /** A warning if there is a reference curve and no row of it could be used,
   *  else nothing. */
  std::string
  warning_about_reference(const CurveMeasures &measures,
                          const CurveSettings &settings);



  /** Everything summary.json tells. */
  struct RunSummary
  {
    CurveMeasures   measures;
    ProfileMeasures profile_measures;
    unsigned int    steps = 0; ///< accepted, sub-steps included
    /** Time of the shortest accepted step. */
    double       smallest_step      = std::numeric_limits<double>::quiet_NaN();
    unsigned int newton_iterations  = 0;
    unsigned int dofs               = 0; ///< as the paper counts them
    unsigned int unknowns           = 0; ///< dofs less tied surface vertices
    unsigned int condensed_unknowns = 0; ///< of the coupled system at the end
    double       wall_seconds       = 0;
    double       peak_memory_MB     = 0; ///< of the process
    bool         converged          = false;
    std::string  reason; ///< why the run ended
    std::vector<std::string> warnings;
    /** Parts of the wall time; {"dense solve", 1.5} becomes
     *  "seconds_dense_solve": 1.5. */
    std::vector<std::pair<std::string, double>> seconds;
  };

  /** The members of summary.json in their order: `nlohmann::ordered_json json =
   *  summary;`. */
  void
  to_json(nlohmann::ordered_json &json, const RunSummary &summary);
} // namespace Debond
#endif
