#ifndef debond_system_load_stepping_h
#define debond_system_load_stepping_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Debond
{
  /** What the first iteration of a step starts from. */
  enum class Predictor
  {
    extrapolate,
    stick_first,
    rigid,
    none
  };

  /** The subsection `Load steps` of a scene. */
  struct LoadSteppingParameters
  {
    std::vector<double> times{0, 1, 2}; ///< first time and ends of the phases
    std::vector<unsigned int> steps{1, 1000}; ///< planned steps of each phase
    double                    smallest_step_fraction = 1e-4;
    double                    residual_tolerance     = 1e-8;
    bool                      adaptive               = false;
    double                    tolerance = 1e-3; ///< of the curves, if adaptive
    Predictor                 predictor = Predictor::extrapolate;
    /** Follow the path of equilibrium by the mean sliding distance. */
    bool follow_path = false;
    /** Largest step of the mean sliding distance [mm]; 0: from the law. */
    double largest_slip_step = 0;
    /** Mean sliding distance at which the path ends [mm]; 0: the radius. */
    double path_ends_at_slip = 0;

    static void
    declare(dealii::ParameterHandler &prm);
    void
    parse(dealii::ParameterHandler &prm);
  };

  /**
   * The planned times of a scene. Steps are counted, not accumulated: planned
   * times are hit exactly.
   */
  class LoadStepping
  {
  public:
    explicit LoadStepping(const LoadSteppingParameters &parameters);

    /** Number of planned steps; row 0, the first time, is not one of them. */
    unsigned int
    n_steps() const
    {
      return total_steps;
    }
    /** End of planned step @p step; step 0 is the first time. */
    double
    time(unsigned int step) const;
    /** True for the first planned step of a phase. */
    bool
    begins_phase(unsigned int step) const;
    /** Number of a planned step within its phase, from 1; 0 for step 0. */
    unsigned int
    step_in_phase(unsigned int step) const;
    /** True for the last planned step of a phase. */
    bool
    ends_phase(unsigned int step) const;
    /** Index of the phase (0, 1, ...) that a planned step > 0 belongs to. */
    unsigned int
    phase(unsigned int step) const;

  private:
    const LoadSteppingParameters parameters;
    unsigned int                 total_steps = 0;
  };
} // namespace Debond
#endif
