#include <debond/campaigns/calibration.h>
#include <debond/input/input_file.h>
#include <debond/output/curve_comparison.h>
#include <debond/output/report.h>
#include <debond/output/result_files.h>
#include <debond/support/interruption.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>

#include <deal.II/base/timer.h>

#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>

#include <algorithm>
#include <numeric>
#include <ostream>

namespace Debond
{
  namespace
  {
    using By = Experiment::By;

    /** Of starts that are followed: runs of finite elements take longer. */
    constexpr unsigned int n_followed = 5, n_followed_slowly = 2;



    void
    stop_if_asked()
    {
      if (interrupting_signal() != 0)
        throw Interrupted(interrupting_signal(),
                          "interrupted by " +
                            signal_name(interrupting_signal()) +
                            ": the same calibration without --force goes on");
    }



    std::vector<StudyVariant>
    experiments_of(const std::vector<SceneEntry> &entries)
    {
      for (const SceneEntry &entry : varied_entries(entries))
        if (entry.full_name() == "Output / Directory")
          entry.refuse("a calibration has one directory: expected one value");
      return study_variants(entries);
    }



    /** The places that a search starts from: that of the scene, and others
     *  spread evenly between the bounds, always the same. */
    std::vector<Eigen::VectorXd>
    starts_of(const Unknowns &unknowns, const unsigned int n)
    {
      std::vector<Eigen::VectorXd> starts{unknowns.starts()};
      boost::random::sobol         sequence(unknowns.list.size());
      boost::random::uniform_01<>  uniform;
      while (starts.size() < n)
        {
          Eigen::VectorXd place(unknowns.list.size());
          for (std::size_t j = 0; j < unknowns.list.size(); ++j)
            {
              const Unknown &u     = unknowns.list[j];
              const double   share = uniform(sequence);
              place[j] = u.from_search((1. - share) * u.to_search(u.lower) +
                                       share * u.to_search(u.upper));
            }
          starts.push_back(place);
        }
      return starts;
    }



    /** Searches, and what it needs to do so at several places at once. */
    class Search
    {
    public:
      Search(const Unknowns    &unknowns,
             const unsigned int n_experiments,
             const std::string &name,
             const unsigned int n_threads)
        : unknowns(unknowns)
      {
        const auto add_worker = [&] {
          workers.push_back(
            std::make_unique<Misfit>(unknowns, n_experiments, name));
        };
        add_worker();
        const auto &experiments   = first().experiments;
        const bool  one_at_a_time = std::any_of(
          experiments.begin(), experiments.end(), [](const auto &experiment) {
            return experiment->scene.bulk_solver() == BulkSolver::multigrid;
          });
        if (one_at_a_time) // Trilinos, which solves there, knows one thread
          Ranks::communicator(); // begins with MPI here
        for (unsigned int i = 1; i < n_threads && !one_at_a_time; ++i)
          add_worker();
        deal_out(1);
      }

      Misfit &
      first()
      {
        return *workers.front();
      }

      /** Why closed forms do not predict all that has been measured. */
      std::string
      why_no_closed_form()
      {
        for (const auto &experiment : first().experiments)
          if (!experiment->measured.file.empty() &&
              !experiment->why_no_closed_form.empty())
            return experiment->why_no_closed_form;
        return "";
      }

      /** The best starts, followed to their ends. */
      std::vector<Optimum>
      from_starts(const unsigned int n_starts,
                  const unsigned int n_best,
                  const By           model)
      {
        const auto          starts = starts_of(unknowns, n_starts);
        std::vector<double> costs(starts.size());
        on_workers(starts.size(), [&](const unsigned int i, Misfit &misfit) {
          const Evaluation at = misfit.evaluate(starts[i], model, false);
          costs[i]            = at.failure.empty() ?
                                  misfit.residuals(at.values).squaredNorm() :
                                  std::numeric_limits<double>::infinity();
        });
        std::vector<unsigned int> order(starts.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(),
                         order.end(),
                         [&](const auto a, const auto b) {
                           return costs[a] < costs[b];
                         });
        std::vector<Eigen::VectorXd> best;
        for (const unsigned int i : order)
          if (std::isfinite(costs[i]) && best.size() < n_best)
            best.push_back(starts[i]);
        return follow(best, model);
      }

      /** Searches from all of them; those that end at the same curves are one.
       */
      std::vector<Optimum>
      follow(const std::vector<Eigen::VectorXd> &starts, const By model)
      {
        std::vector<Optimum> ends(starts.size());
        on_workers(starts.size(), [&](const unsigned int i, Misfit &misfit) {
          if (model == By::scene)
            ends[i] = with_chosen_steps(misfit, starts[i]);
          else
            {
              centre_at(misfit, unknowns.starts());
              ends[i] = minimise(misfit, starts[i], model);
              centre(misfit, ends[i]);
            }
        });
        return distinct(ends);
      }

      /** Makes the closed form exact there, or takes the steps that are right
       *  there. */
      static void
      settle(Misfit &misfit, const Eigen::VectorXd &values, const By model)
      {
        if (model == By::scene)
          misfit.choose_steps(&values);
        else
          for (const auto &experiment : misfit.experiments)
            if (experiment->why_no_closed_form.empty())
              experiment->centre_closed_form(values);
      }

      void
      keep_in(EvaluationLog &log)
      {
        for (const auto &worker : workers)
          worker->keep_in(log);
      }

      /** work(i, misfit) for i < n, at the same time as far as there are
       *  workers; those that are left help the others. */
      template <typename Work>
      void
      for_each(const unsigned int n, const Work &work)
      {
        const unsigned int n_leaders =
          std::clamp<std::size_t>(n, 1, workers.size());
        deal_out(n_leaders);
        for_each_at_once(n,
                         n_leaders,
                         [&](const unsigned int i, const unsigned int leader) {
                           work(i, *workers[leader]);
                         });
        deal_out(1);
        stop_if_asked();
      }

      std::vector<std::unique_ptr<Misfit>> workers;
      Failures                             failures; ///< in the order of starts

    private:
      void
      deal_out(const unsigned int n_leaders)
      {
        for (std::size_t i = 0; i < workers.size(); ++i)
          {
            workers[i]->helped_by_none();
            if (i >= n_leaders)
              workers[i % n_leaders]->helped_by(*workers[i]);
          }
      }

      /** The same, and counts what fails. */
      template <typename Work>
      void
      on_workers(const unsigned int n, const Work &work)
      {
        std::vector<Failures> failed(n);
        for_each(n, [&](const unsigned int i, Misfit &misfit) {
          if (interrupting_signal() != 0)
            return;
          misfit.failures = {};
          work(i, misfit);
          failed[i] = misfit.failures;
        });
        for (const Failures &more : failed)
          failures.add(more);
      }

      static void
      centre_at(Misfit &misfit, const Eigen::VectorXd &values)
      {
        for (const auto &experiment : misfit.experiments)
          if (!experiment->measured.file.empty())
            experiment->centre_closed_form(values);
      }

      /** The closed form has the stiffness of the place that it was centred at:
       *  there, until the fit stays there. */
      static void
      centre(Misfit &misfit, Optimum &end)
      {
        constexpr unsigned int most = 6;
        for (unsigned int i = 0; end.why.empty() && i < most; ++i)
          {
            const Eigen::VectorXd before = end.unknowns;
            centre_at(misfit, before);
            end = minimise(misfit, before, By::closed_form);
            if ((end.unknowns - before).norm() <= 1e-8 * before.norm())
              break;
          }
      }

      /** With the steps that are right where it starts, and again with those
       *  that are right where it has ended. */
      static Optimum
      with_chosen_steps(Misfit &misfit, const Eigen::VectorXd &start)
      {
        Optimum         end;
        Eigen::VectorXd before = start;
        for (const bool again : {false, true})
          {
            try
              {
                misfit.choose_steps(&before);
              }
            catch (const RunError &error)
              {
                end.why = error.what();
                return end;
              }
            end = minimise(misfit, before, By::scene);
            if (!end.why.empty() || again ||
                !misfit.experiments.front()->scene.load_steps.adaptive)
              break;
            before = end.unknowns;
          }
        return end;
      }

      std::vector<Optimum>
      distinct(std::vector<Optimum> ends) const
      {
        std::stable_sort(ends.begin(),
                         ends.end(),
                         [](const Optimum &a, const Optimum &b) {
                           return a.why.empty() != b.why.empty() ?
                                    a.why.empty() :
                                    a.cost < b.cost;
                         });
        std::vector<Optimum> result;
        for (const Optimum &end : ends)
          if (end.why.empty() &&
              std::none_of(
                result.begin(), result.end(), [&](const Optimum &other) {
                  const Eigen::VectorXd apart = end.values - other.values;
                  const double          by_noise =
                    apart.cwiseProduct(workers.front()->weights).norm();
                  return by_noise < 0.2 * std::sqrt(2. * end.cost) ||
                         apart.norm() < 1e-4 * other.values.norm();
                }))
            result.push_back(end);
        return result;
      }

      const Unknowns &unknowns;
    };



    /** By how much experiments that have not been done would shrink the
     *  intervals. */
    void
    judge_candidates(Calibration &calibration, Misfit &misfit, const By model)
    {
      const Eigen::VectorXd &best = calibration.optima.front().unknowns;
      for (unsigned int i = 0; i < misfit.experiments.size(); ++i)
        {
          Experiment &experiment = *misfit.experiments[i];
          if (!experiment.measured.file.empty())
            continue;
          stop_if_asked();
          PredictedCurves curves;
          try
            {
              curves =
                experiment.predict(best,
                                   experiment.why_no_closed_form.empty() ?
                                     model :
                                     By::scene,
                                   true);
            }
          catch (const RunError &error)
            {
              calibration.statistics->warnings.push_back(
                "experiment " + std::to_string(i + 1) +
                ", not done yet, could not be computed: " + error.what());
              continue;
            }
          const Eigen::Index n        = experiment.measured.over.size();
          Eigen::MatrixXd    jacobian = curves.derivatives;
          for (std::size_t c = 0; c < experiment.columns.size(); ++c)
            jacobian.middleRows(c * n, n) /= Measurement::sd_of(
              experiment.scene.calibration,
              c,
              curves.values.segment(c * n, n).cwiseAbs().maxCoeff());
          for (std::size_t j = 0; j < misfit.unknowns.list.size(); ++j)
            jacobian.col(j) *= misfit.unknowns.list[j].per_search(best[j]);
          calibration.candidates.push_back(
            {i, calibration.statistics->intervals_with(jacobian)});
        }
    }



    /** Fits the others while one unknown is held at several values around its
     *  best one. */
    void
    find_profiles(Calibration &calibration, Search &search, const By model)
    {
      constexpr unsigned int n        = 11;
      const Unknowns        &unknowns = search.first().unknowns;
      const Optimum         &best     = calibration.optima.front();
      const FitStatistics   &known    = *calibration.statistics;
      std::vector<std::vector<Calibration::ProfilePoint>> profiles(
        unknowns.list.size());
      search.for_each(
        unknowns.list.size(), [&](const unsigned int j, Misfit &misfit) {
          const Unknown &u      = unknowns.list[j];
          const double   centre = u.to_search(best.unknowns[j]),
                       reach    = 2. * known.half_widths[j];
          const double begin = std::max(u.to_search(u.lower), centre - reach),
                       end   = std::min(u.to_search(u.upper), centre + reach);
          if (known.half_widths[j] == 0.) // at its bound
            return;
          std::vector<bool> fixed(unknowns.list.size(), false);
          fixed[j] = true;
          for (unsigned int i = 0; i < n; ++i)
            {
              Eigen::VectorXd start = best.unknowns;
              start[j] = u.from_search(begin + (end - begin) * i / (n - 1));
              const Optimum other = minimise(misfit, start, model, fixed);
              profiles[j].push_back(
                {j,
                 start[j],
                 2. * (other.cost - best.cost) / (known.s * known.s),
                 other.unknowns});
              if (!other.why.empty() || !other.converged)
                profiles[j].back().chi_squared = NAN;
            }
        });
      for (const auto &points : profiles)
        calibration.profiles.insert(calibration.profiles.end(),
                                    points.begin(),
                                    points.end());
    }
  } // namespace



  bool
  is_calibration(const std::vector<SceneEntry> &entries)
  {
    return std::any_of(entries.begin(),
                       entries.end(),
                       [](const SceneEntry &entry) {
                         return entry.full_name() == "Task" &&
                                entry.value == "calibrate";
                       });
  }



  namespace
  {
    /** What the results of a calibration belong to. */
    std::string
    identity_of_calibration(const std::vector<SceneEntry> &entries,
                            const Misfit                  &misfit)
    {
      std::string identity = DEBOND_VERSION "\n" + scene_text(entries);
      for (const auto &experiment : misfit.experiments)
        {
          // the files that a scene depends on are in comments behind it
          const std::string &text  = experiment->scene.completed_parameters;
          const auto         files = text.find("\n# ");
          identity +=
            (files == std::string::npos ? "" : text.substr(files + 1)) +
            identity_of(experiment->measured.file);
        }
      return identity;
    }



    /** Refuses what could not be searched for. */
    void
    check_what_is_measured(const Misfit &misfit)
    {
      const Scene &scene = misfit.experiments.front()->scene;
      if (misfit.unknowns.list.empty())
        throw scene.with_place(EntryError(
          "Task",
          "a calibration needs unknowns: write <<START in LOWER..UPPER>> in "
          "the place of numbers that are to be found",
          "calibrate"));
      if (misfit.measured.size() == 0)
        throw scene.with_place(
          EntryError("Output / Reference curve",
                     "a calibration needs a measured curve"));
      if (!misfit.has_noise() &&
          misfit.measured.size() <= Eigen::Index(misfit.unknowns.list.size()))
        throw scene.with_place(
          EntryError("Output / Reference curve",
                     std::to_string(misfit.measured.size()) +
                       " measured values for " +
                       std::to_string(misfit.unknowns.list.size()) +
                       " unknowns do not tell how well they fit: give more, or "
                       "Calibration / Noise"));
      if (scene.calibration.profiles &&
          misfit.measure != MisfitMeasure::least_squares)
        throw scene.with_place(
          EntryError("Calibration / Profiles",
                     "profiles are those of Measure = least squares",
                     "true"));
      for (const auto &experiment : misfit.experiments)
        experiment->check_bounds();
    }



    /** With the closed form where there is one, and from there with the
     *  scene's own model: with that alone where the closed form says no to
     *  all starts. */
    void
    find_optima(Calibration &result, Search &search, std::ostream &out)
    {
      const dealii::Timer clock;
      const Scene        &scene     = search.first().experiments.front()->scene;
      const unsigned int  n_starts  = scene.calibration.starts;
      const bool          is_closed = search.why_no_closed_form().empty();
      result.by_closed_form = scene.model == ModelKind::foundation && is_closed;
      if (is_closed)
        result.optima =
          search.from_starts(n_starts, n_followed, By::closed_form);
      if (is_closed && !result.by_closed_form && !result.optima.empty())
        {
          out << "Closed form: " << result.optima.size()
              << (result.optima.size() == 1 ? " optimum, after " :
                                              " optima, after ")
              << to_text(clock.wall_time(), 2) << " s" << std::endl;
          std::vector<Eigen::VectorXd> starts;
          for (const Optimum &optimum : result.optima)
            if (optimum.cost <= 4. * result.optima.front().cost + 1e-12 &&
                starts.size() < n_followed_slowly)
              starts.push_back(optimum.unknowns);
          result.optima = search.follow(starts, By::scene);
        }
      else if (!result.by_closed_form)
        result.optima =
          search.from_starts(n_starts,
                             scene.model == ModelKind::finite_elements ?
                               n_followed_slowly :
                               n_followed,
                             By::scene);
      result.failures = search.failures;
      if (result.optima.empty())
        throw RunError("nothing was found: no unknowns that were tried give a "
                       "curve. The last reason: " +
                       result.failures.last);
    }



    /** What the best fit says of the unknowns. */
    void
    judge(Calibration &result, Search &search)
    {
      const By model  = result.by_closed_form ? By::closed_form : By::scene;
      Misfit  &misfit = search.first();
      const Eigen::VectorXd &best = result.optima.front().unknowns;
      const bool             profiles =
        misfit.experiments.front()->scene.calibration.profiles;
      for (const auto &worker : search.workers)
        if (worker == search.workers.front() || profiles)
          search.settle(*worker, best, model);
      result.at_best = misfit.evaluate(best, model, true);
      if (!result.at_best.failure.empty())
        throw RunError("the best fit cannot be differentiated: " +
                       result.at_best.failure);
      // with the steps that are right here
      if (misfit.measure == MisfitMeasure::least_squares)
        result.optima.front().cost =
          0.5 * misfit.residuals(result.at_best.values).squaredNorm();
      result.statistics =
        std::make_unique<FitStatistics>(misfit, best, result.at_best);
      if (!result.optima.front().converged)
        result.statistics->warnings.push_back(
          "the search has not converged: it ended after 100 steps with closed "
          "forms, 30 with runs, or where no step helped");
      judge_candidates(result, misfit, model);
      if (profiles)
        find_profiles(result, search, model);
    }
  } // namespace



  void
  run_calibration(const std::vector<SceneEntry> &entries,
                  const std::string             &name,
                  const unsigned int             n_threads,
                  const bool                     force,
                  std::ostream                  &out)
  {
    const ClassicNumbers classic(out);
    const dealii::Timer  clock;
    const auto           experiments = experiments_of(entries);
    const Unknowns       unknowns(experiments);
    // reads all that is to be read, and refuses, before anything is written
    set_number_of_threads(1); // a search for each thread
    Search        search(unknowns, experiments.size(), name, n_threads);
    const Misfit &misfit = search.first();
    check_what_is_measured(misfit);
    const Scene     &scene         = misfit.experiments.front()->scene;
    OutputParameters output        = scene.output;
    output.overwrite_other_results = force;
    const ResultDirectory directory(output,
                                    identity_of_calibration(entries, misfit));
    EvaluationLog         log(directory.file("evaluations.jsonl"), force);
    search.keep_in(log);

    for (const auto &experiment : misfit.experiments)
      if (const unsigned int n = experiment->measured.n_left_out; n > 0)
        out << n << " rows of " << experiment->measured.file
            << " are not in the windows, stay where the row before was, or are "
               "beyond what the scene comes to"
            << std::endl;
    out << misfit.measured.size() << " measured values, "
        << unknowns.list.size() << " unknowns" << std::endl;

    Calibration result;
    result.directory = directory.path();
    find_optima(result, search, out);
    judge(result, search);
    result.n_evaluations = log.n_evaluations;
    result.seconds       = clock.wall_time();
    report(result, misfit, out);
    if (scene.output.report)
      write_report_of_calibration(directory.path());
    if (result.statistics->e_rel > scene.calibration.largest_misfit)
      throw RunError(
        "no parameters of this scene fit the measured curve: the best ones "
        "leave e_rel = " +
        to_text(100. * result.statistics->e_rel, 3) +
        " %, more than Calibration / Largest misfit, " +
        to_text(100. * scene.calibration.largest_misfit, 3) + " %" +
        (misfit.measured.dot(result.optima.front().values) < 0. ?
           "; the measured values have the opposite sign: turn the load round, "
           "or the values by a minus before the unit, as in Reference columns "
           "= 1 [deg], 2 [-N m]" :
           ""));
  }



  namespace
  {
    std::string
    ranges_of(const Experiment &experiment)
    {
      std::string text;
      for (std::size_t c = 0; c < experiment.columns.size(); ++c)
        {
          const CurveColumn &column = experiment.columns[c];
          const auto         values = experiment.measured.values.col(c);
          text += column.name + " from " + to_text(values.minCoeff(), 6) +
                  " to " + to_text(values.maxCoeff(), 6) + " " + column.unit() +
                  "; ";
        }
      return text;
    }



    /** Torques over the angle that help the rotation that is prescribed. */
    bool
    turns_against_its_load(const Experiment &experiment)
    {
      constexpr auto twist = ChuckComponent::rotation_z;
      const auto    &over  = experiment.measured.over;
      for (std::size_t c = 0; c < experiment.columns.size(); ++c)
        if (experiment.over.is(CurveColumn::position, twist) &&
            experiment.columns[c].is(CurveColumn::reaction, twist))
          {
            ReferenceCurve curve;
            for (Eigen::Index i = 0; i < over.size(); ++i)
              curve.emplace_back(over[i], experiment.measured.values(i, c));
            const auto remarks =
              comparison_before_run(experiment.scene, curve).remarks;
            if (std::count(remarks.begin(),
                           remarks.end(),
                           CurveComparison::opposite_sign) > 0)
              return true;
          }
      return false;
    }
  } // namespace



  void
  check_calibration(const std::vector<SceneEntry> &entries,
                    const std::string             &name,
                    std::ostream                  &out)
  {
    const ClassicNumbers classic(out);
    const auto           experiments = experiments_of(entries);
    const Unknowns       unknowns(experiments);
    Misfit               misfit(unknowns, experiments.size(), name);
    check_what_is_measured(misfit);
    for (const Unknown &u : unknowns.list)
      out << u.name << ": from " << to_text(u.start, 6) << ", between "
          << to_text(u.lower, 6) << " and " << to_text(u.upper, 6)
          << (u.logarithmic ? ", by its logarithm" : "") << '\n';
    for (const auto &experiment : misfit.experiments)
      {
        const Measurement &measured = experiment->measured;
        if (measured.file.empty())
          {
            out << "A candidate without a measured curve\n";
            continue;
          }
        out << measured.file << ": " << measured.over.size() << " rows, "
            << experiment->over.name << " from "
            << to_text(measured.over.minCoeff(), 6) << " to "
            << to_text(measured.over.maxCoeff(), 6) << ' '
            << experiment->over.unit() << "; " << ranges_of(*experiment)
            << (experiment->why_no_closed_form.empty() ?
                  "searched with the closed form first" :
                  "no closed form: " + experiment->why_no_closed_form)
            << '\n';
        if (turns_against_its_load(*experiment))
          out << "warning: " << measured.file << ": "
              << CurveComparison::opposite_sign << '\n';
      }
  }
} // namespace Debond
