#ifndef debond_campaigns_curve_fit_h
#define debond_campaigns_curve_fit_h

#include <debond/campaigns/experiment.h>
#include <debond/support/progress.h>
#include <debond/support/written_files.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace Debond
{
  /** What experiments predict together, or why they do not. */
  struct Evaluation
  {
    std::string     failure;
    Eigen::VectorXd values;
    Eigen::MatrixXd derivatives; ///< by unknown
  };

  /** Curves that could not be computed. */
  struct Failures
  {
    unsigned int n = 0;
    std::string  last; ///< why

    void
    add(const Failures &more)
    {
      n += more.n;
      last = more.n > 0 ? more.last : last;
    }
  };

  /** Evaluations of the scene's own model that have been done: each is done
   *  once, and a calibration that was interrupted finds them in its file. */
  class EvaluationLog
  {
  public:
    /** Goes on with what is in the file, unless it @p begins_anew. */
    EvaluationLog(const std::string &filename, bool begins_anew);

    std::optional<Evaluation>
    find(const std::string     &steps,
         const Eigen::VectorXd &unknowns,
         bool                   with_derivatives);
    /** @p steps: what tells the steps from those of other evaluations. */
    void
    add(const std::string     &steps,
        const Eigen::VectorXd &unknowns,
        const Evaluation      &evaluation);

    unsigned int n_evaluations = 0; ///< of this file

  private:
    std::mutex                        access;
    Progress                          progress;
    std::map<std::string, Evaluation> known;
    GrowingFile                       file;
  };



  /** The experiments of a calibration, and how far they are from what has been
   *  measured. Not to be used by several threads at a time. */
  class Misfit
  {
  public:
    Misfit(const Unknowns    &unknowns,
           unsigned int       n_experiments,
           const std::string &name);

    /** Keeps evaluations of the scene's own model there, and takes from it what
     *  is known. */
    void
    keep_in(EvaluationLog &where)
    {
      log = &where;
    }

    /** From now on runs for derivatives are shared with one more, which nobody
     *  else uses at the same time. */
    void
    helped_by(const Misfit &other)
    {
      for (std::size_t i = 0; i < experiments.size(); ++i)
        experiments[i]->helpers.push_back(other.experiments[i].get());
    }
    void
    helped_by_none()
    {
      for (const auto &experiment : experiments)
        experiment->helpers.clear();
    }

    Evaluation
    evaluate(const Eigen::VectorXd &unknowns,
             Experiment::By         model,
             bool                   with_derivatives);

    /** See Experiment. */
    void
    choose_steps(const Eigen::VectorXd *values);

    /** Differences between @p values and what has been measured, over the
     *  standard deviation of the noise; where that is unknown over the largest
     *  measured value of the curve. */
    Eigen::VectorXd
    residuals(const Eigen::VectorXd &values) const
    {
      return (values - measured).cwiseProduct(weights);
    }
    /** By what differences are multiplied in the measure that is made small. */
    Eigen::VectorXd
    weights_of_measure() const;
    /** The noise is known. */
    bool
    has_noise() const
    {
      return noise_is_known;
    }

    const Unknowns                          &unknowns;
    std::vector<std::unique_ptr<Experiment>> experiments;
    /** Of all experiments that have been measured. */
    Eigen::VectorXd measured, weights;
    Eigen::VectorXd
                  scales; ///< the largest magnitude of the curve of each value
    MisfitMeasure measure;
    Failures      failures; ///< since it was cleared

  private:
    EvaluationLog *log = nullptr;
    std::string    steps; ///< the unknowns that have chosen them
    bool           noise_is_known = false;
  };



  /** Where a search has ended. */
  struct Optimum
  {
    Eigen::VectorXd unknowns;
    double          cost      = 0; ///< half the sum of squares
    bool            converged = false;
    std::string     why;    ///< there is none; else empty
    Eigen::VectorXd values; ///< predicted
  };

  /** Searches within the bounds from @p start with Ceres: Levenberg and
   *  Marquardt's method, a trust region. Unknowns that are @p fixed stay. */
  Optimum
  minimise(Misfit                  &misfit,
           const Eigen::VectorXd   &start,
           Experiment::By           model,
           const std::vector<bool> &fixed = {});
} // namespace Debond
#endif
