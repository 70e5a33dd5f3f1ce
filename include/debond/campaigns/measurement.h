#ifndef debond_campaigns_measurement_h
#define debond_campaigns_measurement_h

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace Debond
{
  /** A column of torque.csv whose derivatives are known: the time, a reaction
   *  or a position of the chuck. */
  struct CurveColumn
  {
    enum Kind
    {
      time,
      reaction,
      position
    };
    std::string  name;
    Kind         kind      = time;
    unsigned int component = 0;
    bool about_own_axis    = false; ///< torque_Nmm: of the implant, not along z

    /** Throws EntryError that names the @p entry of the scene. */
    CurveColumn(const std::string &name, const std::string &entry);
    bool
    is(const Kind other, const unsigned int its_component) const
    {
      return kind == other && component == its_component;
    }
    double
    of(const TorqueRow &row) const;
    std::string
    unit() const;
  };

  /** What has been measured: rows in the order of the file. */
  struct Measurement
  {
    std::string      file;   ///< empty: nothing has been measured yet
    std::vector<int> branch; ///< of each row, between turning points
    /** By which part of its range a curve goes back where it turns. */
    double          least_turn = 0.05;
    Eigen::VectorXd over;   ///< where
    Eigen::MatrixXd values; ///< rows x curves
    Eigen::VectorXd scale;  ///< of each curve: its largest magnitude
    /** Standard deviations of the noise of values; `scale` if not known. */
    Eigen::MatrixXd sd;
    unsigned int    n_left_out = 0; ///< rows that are not fitted

    /** Of the subsection `Calibration`: `Curves` over `Over`. Without a file:
     *  places over all of the load, and no values. The rig may show
     *  @p largest_shift [deg] more than the implant has turned. Throws
     *  EntryError. */
    Measurement(const Scene                    &scene,
                const std::vector<CurveColumn> &columns,
                const CurveColumn              &over,
                double                          largest_shift);

    /** The standard deviation of noise that is given relative to the largest
     *  value of curve @p c, which is @p scale. */
    static double
    sd_of(const CalibrationParameters &parameters,
          unsigned int                 c,
          double                       scale);

  private:
    void
    propose_rows(const Scene &scene, const CurveColumn &over);
  };

  /** Whether the scene says how large the noise is. */
  bool
  has_known_noise(const CalibrationParameters &parameters);

  /** Between which turning points each value lies, 0 before the first. A curve
   *  turns where it goes back by more than @p least of its range. */
  std::vector<int>
  branches_of(const Eigen::VectorXd &over, double least);
} // namespace Debond
#endif
