#pragma once

#include <debond/bulk/chuck.h>
#include <debond/output/curve_comparison.h>

#include <nlohmann/json_fwd.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace Debond
{
  struct OutputParameters;



  /** One row of torque.csv, or reactions.csv: the accepted state at the end of
   * a planned step. All figures are what the chuck exerts on the implant. */
  struct TorqueRow
  {
    unsigned int step       = 0;
    double       time       = 0;
    double       angle_deg  = 0; ///< of the chuck about the implant's own axis
    double       torque_Nmm = 0; ///< about that axis
    /** Minus the axial force along +z: positive in compression. */
    double force_N      = 0;
    double pressure_MPa = 0; ///< force_N / reference area of the contact face;
                             ///< of implants in a bore the area mean
    double       phi_mean    = 0;
    double       share_stick = 0, share_slip = 0, share_open = 0;
    unsigned int newton_iterations = 0; ///< summed over sub-steps
    double       energy_defect     = 0;
    /** Fx, Fy, Fz [N], Mx, My, Mz [N mm] about C + u. */
    Chuck::Vector6 chuck_reaction = Chuck::Vector6::Zero();
    // further columns
    double work_Nmm = 0, energy_bulk_Nmm = 0, energy_interface_Nmm = 0,
           dissipation_Nmm = 0, adhesive_work_Nmm = 0;
    /** Quadrature bound of energy_defect: sum |dF| |dq| / 2 over max |W|. */
    double energy_defect_bound = 0;
    /** Contact resultant against reaction of the implant's top, relative. */
    double reaction_defect = 0;
    /** Chuck position: u [mm], rotations x, y, z [deg]. */
    Chuck::Vector6 chuck_position   = Chuck::Vector6::Zero();
    double         viscous_work_Nmm = 0; ///< part of dissipation_Nmm
    /** Number of checks of accepted states that this row did not pass. */
    unsigned int warnings = 0;
    /** Of the machine about z: what the scene prescribes if the machine is
     *  compliant, else that of the chuck. */
    double machine_angle_deg = 0;
    /** Energy that jumps have released so far, see ReleasedEnergy. */
    double released_energy_Nmm = 0;
    double share_pulled        = 0; ///< in tension, and without friction
    double damage_Nmm          = 0; ///< part of dissipation_Nmm, of bonds
    /** Part of adhesive_work_Nmm: of tractions across the interface. */
    double adhesive_normal_Nmm = 0;
    /** Of the machine along z, as machine_angle_deg. */
    double machine_uz_mm = 0;
    /** Parts of dissipation_Nmm, of bone that is crushed and sheared. */
    double crushed_Nmm = 0, sheared_Nmm = 0;
    double share_shears = 0; ///< slides in the bone
    /** Bone whose principal stresses are beyond its strengths. */
    double beyond_strength_mm3 = 0;

    /** What the curve between rows is drawn of: torque [N mm], chuck_reaction
     *  and chuck_position. */
    using Curve = Eigen::Matrix<double, 13, 1>;
    Curve
    curve() const
    {
      return (Curve() << torque_Nmm, chuck_reaction, chuck_position).finished();
    }
    /** Its rates, by the unit of time, at the beginning and at the end of the
     *  step that ends with this row; NaN at the beginning: it is drawn as a
     *  straight line. */
    Curve rates_at_begin =
            Curve::Constant(std::numeric_limits<double>::quiet_NaN()),
          rates_at_end = rates_at_begin;

    bool
    is_curved() const
    {
      return !std::isnan(rates_at_begin[0]);
    }
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
        visit(ChuckParameters::column_name(k, true), chuck_reaction[k]);
      visit("work_Nmm", work_Nmm);
      visit("energy_bulk_Nmm", energy_bulk_Nmm);
      visit("energy_interface_Nmm", energy_interface_Nmm);
      visit("dissipation_Nmm", dissipation_Nmm);
      visit("adhesive_work_Nmm", adhesive_work_Nmm);
      visit("energy_defect_bound", energy_defect_bound);
      visit("reaction_defect", reaction_defect);
      for (unsigned int k = 0; k < 6; ++k)
        visit(ChuckParameters::column_name(k, false), chuck_position[k]);
      visit("viscous_work_Nmm", viscous_work_Nmm);
      visit("warnings", warnings);
      visit("machine_angle_deg", machine_angle_deg);
      visit("released_energy_Nmm", released_energy_Nmm);
      visit("share_pulled", share_pulled);
      visit("damage_Nmm", damage_Nmm);
      visit("adhesive_normal_Nmm", adhesive_normal_Nmm);
      visit("machine_uz_mm", machine_uz_mm);
      visit("crushed_Nmm", crushed_Nmm);
      visit("sheared_Nmm", sheared_Nmm);
      visit("share_shears", share_shears);
      visit("beyond_strength_mm3", beyond_strength_mm3);
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      for_each_column(
        [&](const std::string &, auto &value) { archive &value; });
      archive &rates_at_begin &rates_at_end;
    }
  };



  /** A row of torque.csv, with twelve significant digits. */
  std::string
  torque_line(const TorqueRow &row);

  /** The text of torque.csv: a line with the names of the columns, then the
   *  rows; or that of curve.csv, @p of_curve: time, angle, torque, force and
   *  place of the chuck. */
  std::string
  torque_table(const std::vector<TorqueRow> &rows, bool of_curve = false);



  /**
   * The rows of a run, and between those that rates of change are known of
   * further ones on the cubic through both ends with these rates: 16 parts of a
   * step, which drawn as straight lines are within 1/256 of what the ends would
   * be. Other columns are linear in between.
   */
  std::vector<TorqueRow>
  fine_curve(const std::vector<TorqueRow> &rows);

  /** Where a fine_curve() goes through @p angles [deg], or begins to turn from
   *  them, in its order; linear between its rows. */
  std::vector<TorqueRow>
  rows_at(const std::vector<TorqueRow> &fine,
          const std::vector<double>    &angles);

  /** That of a scene; usually angle and torque. */
  ReferenceCurve
  curve_of(const std::vector<TorqueRow> &rows, const CurveAxes &axes = {});



  /** What the measures need to know besides the rows. */
  struct CurveSettings
  {
    /** Area that w_adh refers to [mm^2]: pi R^2 for a coin, Eq.\ (21), that of
     * the sphere for a cap. */
    double contact_area_mm2 = std::numeric_limits<double>::quiet_NaN();
    /** Area mean of phi_0 over the contact face, Eq.\ (21). */
    double mean_phi_0 = 1;
    /** Whether there is a bond to break; else nothing is said of adhesion. */
    bool is_bonded = true;
    /** Whether the mean phi falls as the bond breaks, and by nothing else. */
    bool phi_only_falls = true;
    /** `Expert / Output / Friction energy from angle` [deg]; 0: the curve's. */
    double full_sliding_angle_deg = 0;
    /** First time and ends of the phases, `Load steps / Times`. */
    std::vector<double> phase_times;
    /** Empty: no error measures. */
    ReferenceCurve reference;
    CurveAxes      axes; ///< of the curve

    /** Sets what entries of a scene's @p output ask for, with the @p curve that
     *  `Reference curve` names. */
    void
    take(const OutputParameters &output, const ReferenceCurve &curve);
  };

  /** The members of summary.json in their order, NaN; 0 for the numbers
   *  of rows and angles used of references. */
  nlohmann::ordered_json
  empty_summary();

  /**
   * Evaluates a torque curve, be it complete, interrupted or empty. Integrals
   * are trapezoids over the rows. Returns empty_summary() with what is read off
   * the curve; NaN where undefined, and `remarks`, texts that say why. Angles
   * and energies are undefined if nothing rotates or if the rotation reverses;
   * E_fric and what follows from it also without a bond, if the pressure
   * changes by more than a hundredth while it turns, and if the run ends before
   * full sliding or with more than a fifth of the bond. The names end in the
   * units:
   *
   *  - T_max: largest |T| over the rows; theta_max: where it is first met;
   *    theta_full: end of the flat peak; T_inf: T of the last row;
   *  - pressure: at the end of the last phase before the angle first changes;
   *  - initial_stiffness: torque per angle up to the first row that has turned;
   *  - E_deb, E_fric, W_adh: Eq. (20), without what jumps release;
   *  - w_adh: Eq. (21), w_adh_star: the same with a mean phi_0 of 1;
   *  - D_adh: work the law spends on adhesion;
   *  - dissipation, and viscous_dissipation, which is part of it;
   *  - theta_debonding: angle of the first row whose mean bonding state is
   *    below the initial; theta_bonded: of the row before;
   *  - force_end, work, E_bulk, E_interface: of the last row axial force, work
   *    of the chuck, energy stored in bodies and interface;
   *  - e_mp, e_rel, difference_max, difference_mean, difference_max_deg,
   *    reference_rows_used: see CurveComparison;
   *  - largest_energy_defect, largest_reaction_defect: largest magnitudes over
   *    the rows;
   *  - curve, of one that is no torque over an angle: the columns `over` and
   *    `load`, and in their units the `largest` load, `at` which position, that
   *    at the `end`, and the `initial_stiffness`, along its main_branch().
   */
  nlohmann::ordered_json
  measure_torque_curve(const std::vector<TorqueRow> &rows,
                       const CurveSettings          &settings);
} // namespace Debond
