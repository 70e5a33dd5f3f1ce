#ifndef debond_campaigns_experiment_h
#define debond_campaigns_experiment_h

#include <debond/campaigns/measurement.h>
#include <debond/campaigns/unknowns.h>
#include <debond/models/foundation.h>
#include <debond/models/torsion_curve.h>
#include <debond/scene/varying_scene.h>

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  struct BodyPair;
  class Simulation;

  /** What is computed where something has been measured: curve after curve,
   *  each with its rows, and by column the derivatives with respect to the
   *  unknowns of the calibration. */
  struct PredictedCurves
  {
    Eigen::VectorXd values;
    Eigen::MatrixXd derivatives; ///< no columns if they were not asked for
  };

  /**
   * A scene with unknowns, and a measured curve that belongs to it: what the
   * scene predicts for given unknowns at the measured rows. The rig stands
   * between both,
   *
   *   shown angle  = angle + offset + slack + compliance T,
   *   shown torque = T + offset.
   *
   * Not to be used by several threads at a time.
   */
  class Experiment
  {
  public:
    /** Of TorqueRow::chuck_reaction, chuck_position and torque_Nmm, by column
     *  with respect to the unknowns: a closed form has them. */
    using RowDerivative = Eigen::Matrix<double, 13, Eigen::Dynamic>;

    /** Experiment @p number of @p unknowns. Throws InputError. */
    Experiment(const Unknowns    &unknowns,
               unsigned int       number,
               const std::string &name);

    /** Whether a closed form predicts it for any unknowns; else why not. */
    std::string why_no_closed_form;

    /** The model that predicts. */
    enum class By
    {
      closed_form,
      scene ///< the scene's own model
    };
    /** Throws RunError or InputError if there is no such curve. */
    PredictedCurves
    predict(const Eigen::VectorXd &values, By model, bool with_derivatives);

    /** Of a scene with adaptive steps: from now on runs take the steps that one
     *  with these unknowns chooses, so that curves change smoothly with the
     *  unknowns. Without any: each run chooses its own. */
    void
    choose_steps(const Eigen::VectorXd *values);

    /** Throws InputError where a bound of an unknown is not allowed. */
    void
    check_bounds();

    /** At the starts of the unknowns. */
    const Scene              scene;
    std::vector<CurveColumn> columns;
    const CurveColumn        over;
    Measurement              measured;

    /** The same experiment, for runs at the same time as those of this one. */
    std::vector<Experiment *> helpers;

  private:
    void
    find_changes();
    std::string
    find_why_no_closed_form() const;
    const Scene &
    scene_at(const Eigen::VectorXd &values);
    /** The unknown @p j moved by a @p part of itself to both sides, but not
     *  over its bounds. */
    std::array<Eigen::VectorXd, 2>
    moved(const Eigen::VectorXd &values, unsigned int j, double part) const;
    /** Where differences by the unknown @p j are taken. */
    std::array<Eigen::VectorXd, 2>
    ends_of(const Eigen::VectorXd &values, unsigned int j) const;
    /** Of the numbers of the rig. */
    Eigen::Vector4d
    rig_derivative(const Eigen::VectorXd &values, unsigned int j);
    /** Rows of a curve that may turn back -> the measured rows. */
    PredictedCurves
    at_measured_rows(std::vector<TorqueRow>       rows,
                     std::vector<RowDerivative>   row_derivatives,
                     const CalibrationParameters &rig,
                     const Eigen::MatrixXd       &rig_derivatives) const;
    PredictedCurves
    predict_by_disk(const Eigen::VectorXd &values, bool with_derivatives);
    PredictedCurves
    predict_by_differences(const Eigen::VectorXd &values);
    std::unique_ptr<Simulation>
    simulation_of(const Scene &scene);
    /** The rows by the scene's own model, or points of the curve between them.
     */
    std::vector<TorqueRow>
    curve_by_scene(const Eigen::VectorXd &values);
    /** The same at the measured rows. */
    Eigen::VectorXd
    seen(const std::vector<TorqueRow> &curve, const Eigen::VectorXd &values);

    /** Stiffness of the foundation, for unknowns near those that it was
     *  computed for: what the bodies add to the compliance of the interface
     *  changes slowly. */
    struct Foundation
    {
      Eigen::VectorXd  unknowns;   ///< where it is exact
      Eigen::Vector2d  compliance; ///< of the bodies, normal and torsional
      Eigen::Matrix2Xd slopes;     ///< of the logarithms, by unknown
    };
    Eigen::Vector2d
    exact_compliance(const Eigen::VectorXd &values);
    /** Normal and torsional stiffness [MPa/mm] of a scene. */
    Eigen::Vector2d
    foundation(const Scene &scene, const Eigen::VectorXd &values) const;

  public:
    /** Makes the closed form exact in stiffness at these unknowns. */
    void
    centre_closed_form(const Eigen::VectorXd &values);

  private:
    const Unknowns    &unknowns;
    const unsigned int number;
    VaryingScene       varying;
    /** Whether an unknown changes more than the rig, the friction law, what
     *  stiffness bodies and interface have. */
    struct Changes
    {
      bool model = false, law = false, stiffness = false;
    };
    std::vector<Changes>      changes;
    bool                      keeps_bodies = true; ///< no unknown changes them
    bool                      has_elastic_bodies;
    Foundation                begin, centre; ///< the first one, and that now
    std::shared_ptr<BodyPair> bodies, linear_bodies;
    std::vector<std::vector<double>> ends_of_steps; ///< of each phase
  };
} // namespace Debond
#endif
