#ifndef debond_campaigns_auto_problem_h
#define debond_campaigns_auto_problem_h

#include <debond/campaigns/model_ladder.h>
#include <debond/models/foundation.h>
#include <debond/models/problem.h>
#include <debond/output/console.h>
#include <debond/output/result_files.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /**
   * `Model = auto`: climbs the models of a ModelLadder from the cheapest until
   * the error of one of their torque curves is estimated to be within `Load
   * steps / Tolerance`, and answers with the cheapest one that is. The error
   * is the largest difference from the curve of the scene's own bodies on a
   * converged mesh, relative to the largest torque; doc/auto.md says how it is
   * estimated. run() reads like a table of contents.
   */
  class AutoProblem : public Problem
  {
  public:
    /** Throws InputError, beginning with the name of the entry, if the scene
     *  has no torque curve that models could be compared by. */
    explicit AutoProblem(const Scene &scene);
    ~AutoProblem() override;

    /** Results of the answer are then in the scene's directory, those of every
     *  rung in DIR/rung-1 and so on, and auto.csv lists the rungs. Throws
     *  RunError if the tolerance was not reached; the answer is then the best
     *  rung, and summary.json says so. */
    void
    run() override;

    void
    check(std::ostream &out) override;

    /** Those of the answer. */
    const std::vector<TorqueRow> &
    rows() const override;

  private:
    void
    climb();
    void
    try_foundation();
    double
    foundation_estimate(const Rung                &rung,
                        const FoundationStiffness &stiffness) const;
    void
    try_finite_elements(const Materials &materials, unsigned int mesh);
    void
    refine();
    void
    estimate_errors();
    double
    linearisation_error() const;
    const Rung *
    find(const Materials &materials, unsigned int mesh) const;
    const Rung *
    best() const;
    /** The cheapest rung within the tolerance, or none. */
    const Rung *
    sufficient() const;

    void
    report(const Rung &rung);
    std::string
    verdict(const Rung &rung) const;
    std::string
    reason() const;
    void
    write_results(const ResultDirectory &directory);
    void
    write_table(const ResultDirectory &directory) const;
    void
    write_summary(const ResultDirectory &directory) const;

    const dealii::Timer clock;
    const Scene         scene;
    const double        tolerance, step_tolerance, step_error;
    const ModelLadder   ladder;
    Console             console;
    std::vector<Rung>   rungs; ///< by cost
    const Rung         *answer = nullptr;
    std::string         why_no_further; ///< if the tolerance is not reached
    Materials           refined;        ///< materials of the refined meshes
  };
} // namespace Debond
#endif
