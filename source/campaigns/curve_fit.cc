#include <debond/campaigns/curve_fit.h>
#include <debond/support/interruption.h>
#include <debond/support/number_text.h>

#include <ceres/ceres.h>
#include <glog/logging.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace Debond
{
  namespace
  {
    std::string
    key_of(const Eigen::VectorXd &unknowns,
           const bool             with_derivatives,
           const std::string     &steps = "")
    {
      std::string key = steps + (with_derivatives ? "d" : "v");
      for (const double value : unknowns)
        key += " " + exact_text(value);
      return key;
    }



    std::vector<double>
    numbers(const Eigen::Ref<const Eigen::VectorXd> &vector)
    {
      return {vector.begin(), vector.end()};
    }



    /** The numbers of a line are those that were written, to the last bit. */
    std::string
    line_of(const std::string &key, const Evaluation &evaluation)
    {
      nlohmann::ordered_json columns = nlohmann::ordered_json::array();
      for (const auto &column : evaluation.derivatives.colwise())
        columns.push_back(numbers(column));
      return nlohmann::ordered_json{{"key", key},
                                    {"failure", evaluation.failure},
                                    {"values", numbers(evaluation.values)},
                                    {"derivatives", columns}}
               .dump() +
             "\n";
    }



    /** The last line of a calibration that was killed may not be whole. */
    std::string
    whole_lines(const std::string &filename)
    {
      const std::string text = read_whole_file(filename).value_or("");
      return text.substr(0, text.rfind('\n') + 1);
    }



    Eigen::VectorXd
    vector_of(const nlohmann::json &list)
    {
      const auto values = list.get<std::vector<double>>();
      return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
    }



    Evaluation
    evaluation_of(const nlohmann::json &line)
    {
      Evaluation result{line.at("failure"), vector_of(line.at("values")), {}};
      result.derivatives.resize(result.values.size(),
                                line.at("derivatives").size());
      for (Eigen::Index j = 0; j < result.derivatives.cols(); ++j)
        result.derivatives.col(j) = vector_of(line.at("derivatives")[j]);
      return result;
    }
  } // namespace



  EvaluationLog::EvaluationLog(const std::string &filename,
                               const bool         begins_anew)
    : file(filename, begins_anew ? "" : whole_lines(filename))
  {
    Classic<std::istringstream> lines(whole_lines(filename));
    std::string                 line;
    while (std::getline(lines, line))
      {
        const auto json       = nlohmann::json::parse(line);
        known[json.at("key")] = evaluation_of(json);
        ++n_evaluations;
      }
  }



  std::optional<Evaluation>
  EvaluationLog::find(const std::string     &steps,
                      const Eigen::VectorXd &unknowns,
                      const bool             with_derivatives)
  {
    const std::lock_guard<std::mutex> lock(access);
    for (const bool derivatives : {true, false})
      if (derivatives || !with_derivatives)
        if (const auto found = known.find(key_of(unknowns, derivatives, steps));
            found != known.end())
          return found->second;
    return {};
  }



  void
  EvaluationLog::add(const std::string     &steps,
                     const Eigen::VectorXd &unknowns,
                     const Evaluation      &evaluation)
  {
    const std::lock_guard<std::mutex> lock(access);
    const std::string                 key =
      key_of(unknowns, evaluation.derivatives.cols() > 0, steps);
    known[key] = evaluation;
    ++n_evaluations;
    progress.show(std::to_string(n_evaluations) + " evaluations", -1.);
    file.append(line_of(key, evaluation));
  }



  Misfit::Misfit(const Unknowns    &unknowns,
                 const unsigned int n_experiments,
                 const std::string &name)
    : unknowns(unknowns)
  {
    std::vector<double>                         all, all_weights, all_scales;
    std::vector<std::pair<const Scene *, bool>> candidates_noise;
    const auto refuse = [](const Scene &scene) {
      throw scene.with_place(
        EntryError("Calibration / Noise",
                   "either all curves of all experiments have a known noise, "
                   "or none: 0; tests that have not been done need it here"));
    };
    for (unsigned int i = 0; i < n_experiments; ++i)
      {
        experiments.push_back(std::make_unique<Experiment>(unknowns, i, name));
        const Scene       &scene    = experiments.back()->scene;
        const Measurement &own      = experiments.back()->measured;
        const bool         is_known = has_known_noise(scene.calibration);
        if (own.file.empty())
          {
            // for a test that has not been done the file says nothing
            candidates_noise.emplace_back(&scene,
                                          scene.calibration.noise[0] > 0.);
            continue;
          }
        if (!all.empty() && is_known != noise_is_known)
          refuse(scene);
        noise_is_known = is_known;
        const auto add = [](std::vector<double> &list, const auto &numbers) {
          list.insert(list.end(), numbers.begin(), numbers.end());
        };
        add(all, own.values.reshaped());
        for (const double scale : own.scale)
          all_scales.insert(all_scales.end(), own.over.size(), scale);
        add(all_weights, own.sd.cwiseInverse().eval().reshaped());
      }
    for (const auto &[scene, is_known] : candidates_noise)
      if (!all.empty() && is_known != noise_is_known)
        refuse(*scene);
    measured = Eigen::Map<Eigen::VectorXd>(all.data(), all.size());
    weights =
      Eigen::Map<Eigen::VectorXd>(all_weights.data(), all_weights.size());
    scales  = Eigen::Map<Eigen::VectorXd>(all_scales.data(), all_scales.size());
    measure = experiments.front()->scene.calibration.measure;
  }



  void
  Misfit::choose_steps(const Eigen::VectorXd *const values)
  {
    steps = values != nullptr ? key_of(*values, false) + " " : "";
    for (const auto &experiment : experiments)
      experiment->choose_steps(values);
  }



  // Eq. (19) divides by what has been measured, and leaves out what is less
  // than a hundredth of the largest; Eq. (50) divides by the largest.
  Eigen::VectorXd
  Misfit::weights_of_measure() const
  {
    if (measure != MisfitMeasure::e_mp)
      return weights;
    Eigen::VectorXd result = weights;
    Eigen::Index    first  = 0;
    for (const auto &experiment : experiments)
      for (Eigen::Index c = 0; c < experiment->measured.values.cols(); ++c)
        for (const double value : experiment->measured.values.col(c))
          result[first++] =
            std::abs(value) > 0.01 * experiment->measured.scale[c] ?
              1. / std::abs(value) :
              0.;
    return result;
  }



  Evaluation
  Misfit::evaluate(const Eigen::VectorXd &values,
                   const Experiment::By   model,
                   const bool             with_derivatives)
  {
    const bool is_logged = log != nullptr && model == Experiment::By::scene;
    if (is_logged)
      if (auto known = log->find(steps, values, with_derivatives))
        {
          if (!known->failure.empty())
            failures.add({1, known->failure});
          return *known;
        }
    Evaluation result;
    result.values.resize(measured.size());
    result.derivatives.resize(measured.size(),
                              with_derivatives ? values.size() : 0);
    const auto fail = [&](const std::string &why) {
      result = {why, {}, {}};
      result.derivatives.resize(0, with_derivatives ? values.size() : 0);
      failures.add({1, why});
    };
    Eigen::Index first = 0;
    for (const auto &experiment : experiments)
      {
        if (experiment->measured.file.empty())
          continue;
        // a scene that is refused, or a run that fails, is no end of the search
        try
          {
            const PredictedCurves part =
              experiment->predict(values, model, with_derivatives);
            result.values.segment(first, part.values.size()) = part.values;
            if (with_derivatives)
              result.derivatives.middleRows(first, part.values.size()) =
                part.derivatives;
            first += part.values.size();
          }
        catch (const InputError &error)
          {
            fail(error.what());
            break;
          }
        catch (const RunError &error)
          {
            fail(error.what());
            break;
          }
      }
    if (is_logged)
      log->add(steps, values, result);
    return result;
  }



  namespace
  {
    /** Makes squares of what is not: half the square of a residual is then
     *  sqrt(r^2 + d^2) - d, the magnitude but for a smooth bottom. */
    double
    as_square(const double r, double &slope)
    {
      constexpr double d    = 1e-3;
      const double     root = std::hypot(r, d), magnitude = r * r / (root + d);
      const double     result = std::copysign(std::sqrt(2. * magnitude), r);
      slope = std::abs(r) < 1e-12 ? 1. / std::sqrt(d) : r / root / result;
      return result;
    }



    /** For Ceres: one block of unknowns, those that are free. */
    class Residuals : public ceres::CostFunction
    {
    public:
      Residuals(Misfit                          &misfit,
                const Eigen::VectorXd           &start,
                const Experiment::By             model,
                const std::vector<unsigned int> &free)
        : misfit(misfit)
        , start(start)
        , model(model)
        , free(free)
      {
        set_num_residuals(misfit.measured.size());
        mutable_parameter_block_sizes()->push_back(free.size());
      }

      Eigen::VectorXd
      unknowns_at(const double *const searched) const
      {
        Eigen::VectorXd values = start;
        for (std::size_t i = 0; i < free.size(); ++i)
          values[free[i]] =
            misfit.unknowns.list[free[i]].from_search(searched[i]);
        return values;
      }

      bool
      Evaluate(double const *const *parameters,
               double              *residuals,
               double             **jacobians) const override
      {
        if (interrupting_signal() != 0)
          return false;
        const Eigen::VectorXd values = unknowns_at(parameters[0]);
        const bool            derivatives =
          jacobians != nullptr && jacobians[0] != nullptr;
        const Evaluation at = misfit.evaluate(values, model, derivatives);
        if (!at.failure.empty())
          return false;
        const Eigen::VectorXd weights = misfit.weights_of_measure();
        const bool squares = misfit.measure == MisfitMeasure::least_squares;
        for (Eigen::Index i = 0; i < at.values.size(); ++i)
          {
            double slope = 1.;
            double r     = weights[i] * (at.values[i] - misfit.measured[i]);
            residuals[i] = squares ? r : as_square(r, slope);
            if (derivatives)
              for (std::size_t j = 0; j < free.size(); ++j)
                jacobians[0][i * free.size() + j] =
                  slope * weights[i] * at.derivatives(i, free[j]) *
                  misfit.unknowns.list[free[j]].per_search(values[free[j]]);
          }
        if (derivatives)
          hold_at_bounds(values, residuals, jacobians[0]);
        return true;
      }


    private:
      /** An unknown at its bound that would go on beyond it stays: without its
       *  column steps along the others are as long as they can be. */
      void
      hold_at_bounds(const Eigen::VectorXd &values,
                     const double *const    residuals,
                     double *const          jacobian) const
      {
        using Rows = Eigen::
          Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        const Eigen::Index                      n = misfit.measured.size();
        Eigen::Map<Rows>                        J(jacobian, n, free.size());
        const Eigen::Map<const Eigen::VectorXd> r(residuals, n);
        for (std::size_t j = 0; j < free.size(); ++j)
          {
            const Unknown &u     = misfit.unknowns.list[free[j]];
            const double   slope = J.col(j).dot(r), value = values[free[j]],
                         near = 1e-9 * (u.upper - u.lower);
            if ((value - u.lower < near && slope > 0.) ||
                (u.upper - value < near && slope < 0.))
              J.col(j).setZero();
          }
      }

      Misfit                         &misfit;
      const Eigen::VectorXd           start;
      const Experiment::By            model;
      const std::vector<unsigned int> free;
    };
  } // namespace



  Optimum
  minimise(Misfit                  &misfit,
           const Eigen::VectorXd   &start,
           const Experiment::By     model,
           const std::vector<bool> &fixed)
  {
    std::vector<unsigned int> free;
    std::vector<double>       searched;
    for (Eigen::Index j = 0; j < start.size(); ++j)
      if (fixed.empty() || !fixed[j])
        {
          free.push_back(j);
          searched.push_back(misfit.unknowns.list[j].to_search(start[j]));
        }
    Optimum result;
    result.unknowns = start;
    if (!free.empty())
      {
        auto *const    residuals = new Residuals(misfit, start, model, free);
        ceres::Problem problem; // owns them
        problem.AddResidualBlock(residuals, nullptr, searched.data());
        for (std::size_t i = 0; i < free.size(); ++i)
          {
            const Unknown &unknown = misfit.unknowns.list[free[i]];
            problem.SetParameterLowerBound(searched.data(),
                                           i,
                                           unknown.to_search(unknown.lower));
            problem.SetParameterUpperBound(searched.data(),
                                           i,
                                           unknown.to_search(unknown.upper));
          }
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::DENSE_QR;
        options.logging_type       = ceres::SILENT;
        // near unknowns that give no curve steps of runs become many and small
        options.max_num_iterations =
          model == Experiment::By::closed_form ? 100 : 30;
        // Closed forms cost nothing. Runs are only as good as their steps;
        // where the model is right the sum of squares falls to nothing even so.
        // Magnitudes are made smaller in many small steps that mean nothing.
        const bool squares = misfit.measure == MisfitMeasure::least_squares;
        options.function_tolerance  = model == Experiment::By::closed_form ?
                                        1e-12 :
                                      squares ? 1e-6 :
                                                1e-4;
        options.gradient_tolerance  = 1e-14;
        options.parameter_tolerance = 1e-10;
        // what fails is told here, in other words
        FLAGS_minloglevel = google::FATAL;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem, &summary);
        result.converged = summary.termination_type == ceres::CONVERGENCE;
        if (!summary.IsSolutionUsable())
          result.why =
            misfit.failures.n == 0 ? summary.message : misfit.failures.last;
        result.unknowns = residuals->unknowns_at(searched.data());
        result.cost     = summary.final_cost;
      }
    if (result.why.empty())
      {
        const Evaluation at = misfit.evaluate(result.unknowns, model, false);
        result.why          = at.failure;
        result.values       = at.values;
        if (at.failure.empty() && free.empty())
          result.cost = 0.5 * misfit.residuals(at.values).squaredNorm();
      }
    return result;
  }
} // namespace Debond
