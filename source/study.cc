#include <debond/csv_table.h>
#include <debond/debonding_problem.h>
#include <debond/directory_lock.h>
#include <debond/ensemble.h>
#include <debond/input_error.h>
#include <debond/interruption.h>
#include <debond/memory_estimate.h>
#include <debond/number_text.h>
#include <debond/problem.h>
#include <debond/resumed_run.h>
#include <debond/sample_statistics.h>
#include <debond/study.h>
#include <debond/torque_curve.h>
#include <debond/variant_queue.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <sstream>

namespace Debond
{
  namespace
  {
    std::string
    variant_name(const unsigned int variant)
    {
      char name[32];
      std::snprintf(name, sizeof(name), "variant-%03u", variant + 1);
      return name;
    }



    /** StudyRow of a summary.json as text; lists joined, null as nan. Empty if
     *  there is none. */
    StudyRow
    read_summary(const std::string &filename)
    {
      boost::property_tree::ptree tree;
      try
        {
          boost::property_tree::read_json(filename, tree);
        }
      catch (const boost::property_tree::json_parser_error &)
        {
          return {};
        }
      StudyRow members;
      for (const auto &[name, child] : tree)
        {
          std::string value = child.data() == "null" ? "nan" : child.data();
          for (const auto &item : child)
            value += (value.empty() ? "" : "; ") + item.second.data();
          members.emplace_back(name, value);
        }
      return members;
    }



    std::string
    member(const StudyRow &members, const std::string &name)
    {
      for (const auto &[other, value] : members)
        if (other == name)
          return value;
      return "";
    }



    void
    set_member(StudyRow          &members,
               const std::string &name,
               const std::string &value)
    {
      for (auto &[other, text] : members)
        if (other == name)
          text = value;
    }



    /** Gives the members that are seconds the medians over all runs. */
    void
    take_medians(StudyRow &summary, const std::vector<StudyRow> &repetitions)
    {
      for (auto &[name, text] : summary)
        if (name == "wall_seconds" || name.rfind("seconds_", 0) == 0)
          {
            std::vector<double> seconds;
            for (const StudyRow &repetition : repetitions)
              seconds.push_back(std::atof(member(repetition, name).c_str()));
            text = to_text(sample_statistics(std::move(seconds)).p50);
          }
    }



    /** A number with fewer digits, for people. */
    std::string
    rounded(const std::string &number)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.4g", std::atof(number.c_str()));
      return text;
    }



    std::string
    csv_line(const std::vector<std::string> &texts)
    {
      std::string line;
      for (const std::string &text : texts)
        line += (&text == &texts.front() ? "" : ",") + csv_field(text);
      return line + "\n";
    }



    std::string
    repetition_file(const std::string &directory, const unsigned int number)
    {
      return directory + "/repetition-" + std::to_string(number) + ".json";
    }



    /** Distance of one torque curve from another, both from files. */
    CurveMeasures
    compare_curves(const std::string &file, const std::string &reference_file)
    {
      std::vector<TorqueRow> rows;
      for (const auto &[angle, torque] : read_reference_curve(file))
        {
          rows.emplace_back();
          rows.back().angle_deg  = angle;
          rows.back().torque_Nmm = torque;
        }
      CurveSettings settings;
      settings.reference = read_reference_curve(reference_file);
      return measure_torque_curve(rows, settings);
    }



    using NamedNumbers = std::vector<std::pair<std::string, double>>;

    NamedNumbers
    all_measures(const CurveMeasures &curve, const ProfileMeasures &local)
    {
      NamedNumbers measures = error_measures(curve);
      for (const auto &measure : error_measures(local))
        measures.push_back(measure);
      return measures;
    }



    /** Columns of study.csv that compare the results in one directory with
     *  those in another: torque curve and, if both have them, profiles. */
    NamedNumbers
    compare(const std::string &directory, const std::string &reference)
    {
      ProfileMeasures   local;
      const std::string own      = directory + "/profiles.csv",
                        expected = reference + "/profiles.csv";
      if (std::filesystem::exists(own) && std::filesystem::exists(expected))
        local = compare_profiles(read_profiles(own), read_profiles(expected));
      return all_measures(compare_curves(directory + "/torque.csv",
                                         reference + "/torque.csv"),
                          local);
    }
  } // namespace



  Study::Study(const std::vector<SceneEntry> &entries, const std::string &name)
  {
    for (const SceneEntry &entry : varied_entries(entries))
      {
        varied.push_back(entry.full_name());
        if (entry.full_name() == "Output / Directory")
          throw InputError(entry.place +
                           ": Output / Directory: a study gives each variant "
                           "a directory of its own below this one: expected "
                           "one value");
      }
    const Scene first =
      Scene::from_entries(study_variants(entries)[0].entries, name);
    directory     = first.output.directory;
    reference     = first.study.reference_variant;
    n_repetitions = first.study.repetitions;
    std::vector<StudyVariant> combinations =
      study_variants(entries, first.study.factors_at_once);
    if (reference > combinations.size())
      throw InputError(
        first.with_place("Study / Reference variant: this study has " +
                         std::to_string(combinations.size()) + " variants"));
    for (StudyVariant &combination : combinations)
      {
        // what only the study uses must not make another scene of a variant
        Variant next;
        next.values = combination.values;
        next.scene =
          Scene::from_entries(with_overrides(std::move(combination.entries),
                                             {"Study/Reference variant=0",
                                              "Study/Factors varied at once=0",
                                              "Study/Repetitions=1",
                                              "Output/Console=quiet",
                                              "Output/Directory=" + directory +
                                                "/" +
                                                variant_name(variants.size())}),
                              name);
        variants.push_back(std::move(next));
      }
  }



  std::string
  Study::describe(const unsigned int variant) const
  {
    std::string text = variant_name(variant) + ":";
    for (unsigned int i = 0; i < varied.size(); ++i)
      text +=
        (i == 0 ? " " : "; ") + varied[i] + " = " + variants[variant].values[i];
    return text;
  }



  void
  Study::check(std::ostream &out)
  {
    out << variants.size() << " variants\n";
    for (unsigned int i = 0; i < variants.size(); ++i)
      {
        look_up(variants[i]);
        out << describe(i) << (variants[i].done ? " (done already)" : "")
            << '\n';
        if (variants[i].scene.model != ModelKind::finite_elements)
          Problem::create(variants[i].scene); // refuses what it cannot do
      }
  }



  void
  Study::look_up(Variant &variant) const
  {
    const OutputParameters &output = variant.scene.output;
    variant.content =
      content_of_result_directory(output, variant.scene.completed_parameters);
    if (variant.content == DirectoryContent::same_scene)
      variant.summary = read_summary(output.directory + "/summary.json");
    variant.done = member(variant.summary, "converged") == "true" &&
                   std::filesystem::exists(output.directory + "/torque.csv");
    if (n_repetitions == 1)
      return;
    variant.repetitions.clear();
    while (variant.repetitions.size() < n_repetitions)
      {
        const StudyRow next = read_summary(
          repetition_file(output.directory, variant.repetitions.size() + 1));
        if (next.empty())
          break;
        variant.repetitions.push_back(next);
      }
    if (!variant.repetitions.empty())
      take_medians(variant.summary, variant.repetitions);
    variant.done = variant.done && variant.repetitions.size() == n_repetitions;
  }



  // The next run writes a new summary in the place of this one.
  void
  Study::keep_repetition(Variant &variant) const
  {
    const std::string &place = variant.scene.output.directory;
    std::ostringstream summary;
    summary << std::ifstream(place + "/summary.json").rdbuf();
    write_file(repetition_file(place, variant.repetitions.size() + 1),
               summary.str());
  }



  void
  Study::forget_repetitions(Variant &variant)
  {
    const std::string &place = variant.scene.output.directory;
    std::error_code    none;
    for (unsigned int i = 1;
         std::filesystem::remove(repetition_file(place, i), none);
         ++i)
      ;
    variant.repetitions.clear();
  }



  bool
  Study::wants_another_run(const Variant &variant) const
  {
    return n_repetitions > 1 && variant.failure.empty() &&
           member(variant.summary, "converged") == "true" &&
           variant.repetitions.size() < n_repetitions;
  }



  void
  Study::end_run(Variant &variant, const std::string &failure)
  {
    variant.failure = failure;
    if (n_repetitions > 1 && failure.empty())
      keep_repetition(variant);
    look_up(variant);
    variant.done = variant.done && failure.empty();
  }



  // Refuses before anything runs, and finds what is there already.
  std::shared_ptr<const DirectoryLock>
  Study::prepare(const bool force)
  {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
      throw InputError(
        "Output / Directory = '" + directory +
        "': this directory cannot be created: " + error.message());
    const auto lock = DirectoryLock::take(directory);
    for (Variant &variant : variants)
      {
        OutputParameters &output       = variant.scene.output;
        output.overwrite_other_results = force;
        look_up(variant);
        if (variant.content == DirectoryContent::other_scene && !force)
          throw InputError("Output / Directory = '" + directory +
                           "': " + output.directory +
                           " holds results of another scene (compare its "
                           "parameters.prm): choose another directory, or "
                           "overwrite them with --force");
        variant.done = variant.done && !force;
        // what is left over from another scene, or not wanted any more
        if (force || variant.content != DirectoryContent::same_scene)
          forget_repetitions(variant);
      }
    return lock;
  }



  namespace
  {
    /** A variant that runs as a process. */
    struct Job
    {
      unsigned int variant  = 0;
      int          read_end = -1; ///< of the pipe with its last words
    };



    /** From the checkpoint of a run that was ended, if it left one. */
    void
    run_variant(const Scene &scene, const std::shared_ptr<BodyPair> &bodies)
    {
      const bool without = scene.model != ModelKind::finite_elements ||
                           scene.output.overwrite_other_results;
      if (const auto checkpoint =
            without ? std::nullopt : find_checkpoint(scene))
        return DebondingProblem(scene, bodies).resume(*checkpoint);
      // a checkpoint that is of no use is not kept; the study has made sure
      // that there are no results of another scene
      Scene anew                          = scene;
      anew.output.overwrite_other_results = true;
      Problem::create(anew, bodies)->run();
    }



    /** What a child process does: it ends with the message on the pipe, an
     *  empty one if all went well. */
    [[noreturn]] void
    run_in_child(const Scene                     &scene,
                 const std::shared_ptr<BodyPair> &bodies,
                 const int                        write_end)
    {
      // a variant does not outlive its study
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      leave_interruptions_to_parent();
      std::string message;
      if (std::freopen("/dev/null", "w", stdout) == nullptr)
        message = "cannot redirect the output";
      try
        {
          if (message.empty())
            run_variant(scene, bodies);
        }
      catch (const std::bad_alloc &)
        {
          message = out_of_memory;
        }
      catch (const std::exception &error)
        {
          message = error.what();
        }
      const char *text = message.c_str();
      for (std::size_t left = message.size(); left > 0;)
        {
          const ssize_t written = write(write_end, text, left);
          if (written <= 0)
            break;
          text += written;
          left -= written;
        }
      _exit(message.empty() ? 0 : 1);
    }



    std::string
    read_to_end(const int read_end)
    {
      std::string text;
      char        buffer[4096];
      for (ssize_t n; (n = read(read_end, buffer, sizeof(buffer))) > 0;)
        text.append(buffer, n);
      close(read_end);
      return text;
    }



    /** Starts a variant as a process, with bodies that it shares or none, and
     *  adds it to @p jobs. */
    void
    start_job(const Scene                     &scene,
              const std::shared_ptr<BodyPair> &bodies,
              const unsigned int               variant,
              std::map<pid_t, Job>            &jobs)
    {
      int pipe_ends[2];
      if (pipe(pipe_ends) != 0)
        throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
      const pid_t process = fork();
      if (process < 0)
        throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
      if (process == 0)
        {
          close(pipe_ends[0]);
          run_in_child(scene, bodies, pipe_ends[1]);
        }
      close(pipe_ends[1]);
      jobs[process] = {variant, pipe_ends[0]};
    }



    /** Waits until a process begins to end: the one, or 0 if a signal asks to
     *  stop. */
    pid_t
    wait_for_one(const std::map<pid_t, Job> &jobs)
    {
      std::vector<pollfd> waiting{{interruption_descriptor(), POLLIN, 0}};
      for (const auto &job : jobs)
        waiting.push_back({job.second.read_end, POLLIN, 0});
      while (poll(waiting.data(), waiting.size(), -1) < 0)
        if (errno != EINTR)
          throw std::runtime_error(std::string("poll: ") +
                                   std::strerror(errno));
      if (interrupting_signal() != 0)
        return 0;
      auto job = jobs.begin();
      for (auto one = waiting.begin() + 1; one->revents == 0; ++one)
        ++job;
      return job->first;
    }



    /** Waits for the end of a process. Returns its last words. */
    std::string
    end_job(const pid_t process, const Job &job)
    {
      std::string words  = read_to_end(job.read_end);
      int         status = 0;
      while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR)
          throw std::runtime_error(std::string("waitpid: ") +
                                   std::strerror(errno));
      if (WIFSIGNALED(status))
        words = std::string("the process was ended by the system: ") +
                strsignal(WTERMSIG(status));
      return words;
    }
  } // namespace



  void
  Study::stop()
  {
    write_table();
    const auto n_done = std::count_if(variants.begin(),
                                      variants.end(),
                                      [](const Variant &v) { return v.done; });
    throw Interrupted(interrupting_signal(),
                      "interrupted by " + signal_name(interrupting_signal()) +
                        ": " + std::to_string(n_done) + " of " +
                        std::to_string(variants.size()) +
                        " variants are done; the same study without --force "
                        "goes on with the others");
  }



  void
  Study::run(const unsigned int n_jobs, const bool force, std::ostream &out)
  {
    const auto lock = prepare(force);
    std::signal(SIGCHLD,
                SIG_DFL); // ignored, it would leave nothing to wait for
    const auto n_done = std::count_if(variants.begin(),
                                      variants.end(),
                                      [](const Variant &v) { return v.done; });
    out << variants.size() << " variants in " << directory;
    if (n_done > 0)
      out << ", " << n_done << " of them done already";
    out << std::endl;

    std::map<pid_t, Job> jobs;
    VariantQueue         waiting(n_jobs);
    for (unsigned int i = 0; i < variants.size(); ++i)
      if (!variants[i].done)
        waiting.add(i, variants[i].scene, n_repetitions == 1);
    auto n_ended = n_done;
    while (true)
      {
        while (!waiting.empty() && jobs.size() < n_jobs)
          {
            const auto next = waiting.next();
            start_job(variants[next.variant].scene,
                      next.bodies,
                      next.variant,
                      jobs);
          }
        if (jobs.empty())
          break;

        const pid_t process = wait_for_one(jobs);
        if (process == 0)
          {
            for (const auto &[running, job] : jobs)
              {
                kill(running, SIGTERM);
                end_job(running, job);
              }
            stop();
          }
        const Job         ended   = jobs.at(process);
        Variant          &variant = variants[ended.variant];
        const std::string failure = end_job(process, ended);
        jobs.erase(process);
        end_run(variant, failure);
        if (wants_another_run(variant))
          {
            start_job(variant.scene, nullptr, ended.variant, jobs);
            continue;
          }
        out << ++n_ended << '/' << variants.size() << ' ';
        report(ended.variant, out);
        write_table_if_due();
      }
    write_table();
    write_ensemble(out);
    const auto n_failed =
      std::count_if(variants.begin(), variants.end(), [](const Variant &v) {
        return !v.done;
      });
    out << "Results are in " << directory << "/study.csv" << std::endl;
    if (n_failed > 0)
      throw RunError(std::to_string(n_failed) + " of " +
                     std::to_string(variants.size()) +
                     " variants failed: " + directory + "/study.csv says why");
  }



  void
  Study::report(const unsigned int variant, std::ostream &out) const
  {
    out << describe(variant) << ": ";
    if (!variants[variant].done)
      out << "failed: " << variants[variant].failure << std::endl;
    else
      {
        const StudyRow &summary = variants[variant].summary;
        out << "T_max " << rounded(member(summary, "T_max_Nmm")) << " N mm, "
            << rounded(member(summary, "wall_seconds")) << " s" << std::endl;
      }
  }



  // Not a number as long as either curve is missing.
  void
  Study::compare_with_reference()
  {
    const Variant &other = variants[reference - 1];
    for (Variant &variant : variants)
      if (!variant.compared)
        {
          variant.compared = variant.done && other.done;
          for (const auto &[name, value] :
               variant.compared ? compare(variant.scene.output.directory,
                                          other.scene.output.directory) :
                                  all_measures({}, {}))
            set_member(variant.summary, name, to_text(value));
        }
  }



  StudyRow
  Study::table_row(const unsigned int number) const
  {
    const Variant &variant = variants[number];
    StudyRow       row{{"variant", std::to_string(number + 1)}};
    for (unsigned int i = 0; i < varied.size(); ++i)
      row.emplace_back(varied[i], variant.values[i]);

    StudyRow summary = variant.summary;
    if (!variant.done)
      {
        const std::string why =
          variant.failure.empty() ? "not run yet" : variant.failure;
        if (summary.empty())
          summary = {{"converged", ""}, {"reason", ""}};
        set_member(summary, "converged", "false");
        set_member(summary, "reason", why);
      }
    row.insert(row.end(), summary.begin(), summary.end());
    return row;
  }



  void
  Study::write_table()
  {
    if (reference > 0)
      compare_with_reference();
    std::vector<StudyRow> rows;
    for (unsigned int i = 0; i < variants.size(); ++i)
      rows.push_back(table_row(i));

    // finished variants first: they know all columns and their order
    std::map<std::string, std::size_t> column_of;
    std::vector<std::string>           header;
    for (const bool done : {true, false})
      for (unsigned int i = 0; i < variants.size(); ++i)
        if (variants[i].done == done)
          for (const auto &[name, value] : rows[i])
            if (column_of.emplace(name, header.size()).second)
              header.push_back(name);
    std::string text = csv_line(header);
    for (const StudyRow &row : rows)
      {
        std::vector<std::string> fields(header.size(), "nan");
        for (const auto &[name, value] : row)
          fields[column_of.at(name)] = value;
        text += csv_line(fields);
      }
    write_file(directory + "/study.csv", text);
  }



  // The table of a large study takes a while: most of the time is not to go
  // into it.
  void
  Study::write_table_if_due()
  {
    if (since_table.wall_time() < time_between_tables)
      return;
    const dealii::Timer clock;
    write_table();
    time_between_tables = std::max(2., 50. * clock.wall_time());
    since_table.restart();
  }



  // The seed is what stands for chance.
  void
  Study::write_ensemble(std::ostream &out) const
  {
    const auto seed =
      std::find(varied.begin(), varied.end(), "Interface / Bonding / Seed");
    if (seed == varied.end())
      return;
    const auto without_seed = [&](std::vector<std::string> items) {
      items.erase(items.begin() + (seed - varied.begin()));
      return items;
    };
    std::vector<EnsembleMember> members;
    for (const Variant &variant : variants)
      {
        EnsembleMember next;
        next.values    = without_seed(variant.values);
        next.converged = variant.done;
        for (const auto &[name, value] : variant.summary)
          next.summary[name] = std::atof(value.c_str());
        if (variant.done)
          next.curve = read_reference_curve(variant.scene.output.directory +
                                            "/torque.csv");
        members.push_back(std::move(next));
      }
    const Ensemble ensemble(without_seed(varied), members);
    write_file(directory + "/ensemble.csv", ensemble.curves());
    write_file(directory + "/ensemble_summary.csv", ensemble.summary());
    out << ensemble.notes() << "Statistics over all seeds are in " << directory
        << "/ensemble.csv and ensemble_summary.csv" << std::endl;
  }
} // namespace Debond
