#ifndef debond_models_sensitivities_h
#define debond_models_sensitivities_h

#include <debond/interface/interface_sensitivity.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene_variation.h>
#include <debond/support/serialization.h>
#include <debond/system/coupled_system.h>

#include <vector>

namespace Debond
{
  /** Derivatives of a row of the torque curve: column j belongs to variation j;
   *  per unit of its parameter. */
  struct RowDerivatives
  {
    /** Of TorqueRow::chuck_reaction and chuck_position: N, N mm; mm, deg. */
    Eigen::Matrix<double, 6, Eigen::Dynamic> reaction, position;
    /** Of TorqueRow::torque_Nmm, about the implant's own axis [N mm]. */
    Eigen::RowVectorXd torque;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &reaction &position &torque;
    }
  };



  /**
   * Derivatives of the accepted states of a coupled system by parameters p, by
   * direct differentiation of every step. In an accepted state z the equations
   * r(z, history, p) = 0 hold, so that
   *
   *   A dz/dp = - dr/dp at z fixed,
   *
   * with the tangent A of Newton's method and, in dr/dp, the derivative of the
   * history that the step began with; that of the history at its end follows.
   */
  class Sensitivities
  {
  public:
    /** After CoupledSystem::start(); keeps references to @p system. Throws
     *  InputError for what why_not_differentiable() refuses. */
    Sensitivities(const Scene                       &scene,
                  const CoupledSystem               &system,
                  const std::vector<SceneVariation> &variations);

    /** Goes on to the trial state, which is going to be accepted. */
    void
    advance();

    /** In the state of the last advance(). Not finite where the equations were
     *  singular. */
    const RowDerivatives &
    of_row() const
    {
      return row;
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &interface &row;
    }

  private:
    struct Parameter
    {
      double width; ///< 2 h
      // at p + h and p - h: the chuck, its springs [N/mm, N mm]
      std::array<Chuck, 2>          chuck;
      std::array<Chuck::Vector6, 2> stiffness;
      std::array<double, 2>         stiffening; ///< d ln E / dp, of both bodies
    };

    std::vector<InterfaceMotion>
    motions(const Eigen::MatrixXd &unknowns) const;
    static std::vector<Parameter>
    make_parameters(const Scene                       &scene,
                    const CoupledSystem               &system,
                    const std::vector<SceneVariation> &variations);
    template <typename Follows>
    Eigen::MatrixXd
    given_motions(double time, const Follows &follows) const;
    Eigen::MatrixXd
    right_hand_sides(const std::vector<LaneSums> &forces,
                     const Eigen::MatrixXd       &given) const;
    void
    set_row(const Eigen::MatrixXd &moved, const std::vector<LaneSums> &forces);

    const CoupledSystem   &system;
    std::vector<Parameter> parameters;
    InterfaceSensitivity   interface;
    RowDerivatives         row;
  };



  /** The derivatives of rows by differences of the rows at p + h and p - h,
   *  given for each variation. */
  std::vector<RowDerivatives>
  differences(const std::vector<SceneVariation> &variations,
              const std::vector<std::array<std::vector<TorqueRow>, 2>> &rows);

  /** The text of sensitivities.csv. */
  std::string
  sensitivity_table(const Scene                       &scene,
                    const std::vector<TorqueRow>      &rows,
                    const std::vector<RowDerivatives> &derivatives);
} // namespace Debond
#endif
