#include <debond/campaigns/run_scene.h>
#include <debond/campaigns/study.h>
#include <debond/campaigns/variant.h>
#include <debond/campaigns/variant_queue.h>
#include <debond/input/csv_table.h>
#include <debond/input/parameter_loop.h>
#include <debond/output/curve_comparison.h>
#include <debond/output/reference_comparison.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/laboratory.h>
#include <debond/support/number_text.h>
#include <debond/support/progress.h>
#include <debond/support/provenance.h>
#include <debond/support/written_files.h>

#include <deal.II/base/timer.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <ostream>
#include <set>
#include <sstream>

namespace Debond
{
  namespace
  {
    /** A member of a summary as a field of a table: lists joined, null as nan.
     */
    std::string
    text_of(const nlohmann::ordered_json &value)
    {
      if (value.is_string())
        return value;
      if (value.is_number_float())
        return to_text(value);
      if (value.is_array())
        {
          std::vector<std::string> items;
          for (const auto &item : value)
            items.push_back(text_of(item));
          return boost::join(items, "; ");
        }
      return value.is_null() ? "nan" : value.dump();
    }



    std::string
    outcome_of(const Variant &variant)
    {
      const auto number_of = [&](const char *const name) {
        return to_text(number_in(variant.summary, name), 4);
      };
      return variant.done ? "T_max " + number_of("T_max_Nmm") + " N mm, " +
                              number_of("wall_seconds") + " s" :
             variant.failure.rfind("interrupted", 0) == 0 ?
                            variant.failure :
                            "failed: " + variant.failure;
    }



    struct Study
    {
      std::vector<std::string> varied; ///< full names of the varied entries
      std::vector<Variant>     variants;
      std::string              directory;
      unsigned int             reference = 0; ///< number of a variant, 0: none
      unsigned int             n_compared_anew = 0; ///< with references
      bool                     reports         = true;
      dealii::Timer            since_table;
      double                   time_between_tables = 2; ///< [s]

      /** Reads all variants. */
      Study(const std::vector<SceneEntry> &entries, const std::string &name)
      {
        for (const SceneEntry &entry : varied_entries(entries))
          {
            varied.push_back(entry.full_name());
            if (entry.full_name() == "Output / Directory")
              throw EntryError(
                entry.full_name(),
                "a study gives each variant a directory of its own "
                "below this one: expected one value",
                entry.value,
                entry.place);
          }
        const Scene first =
          Scene::from_entries(study_variants(entries)[0].entries, name);
        directory = first.output.directory;
        reference = first.study.reference_variant;
        reports   = first.output.report;
        auto combinations =
          study_variants(entries, first.study.factors_at_once);
        if (reference > combinations.size())
          throw first.with_place(
            EntryError("Study / Reference variant",
                       "this study has " + std::to_string(combinations.size()) +
                         " variants"));
        std::vector<std::vector<std::string>> values;
        for (const StudyVariant &combination : combinations)
          values.push_back(combination.values);
        const auto names = names_of_variants(varied, values);
        for (StudyVariant &combination : combinations)
          {
            const std::string directory_name =
              variant_name(variants.size() + 1);
            // what only the study uses must not make another scene of a variant
            const auto own = with_overrides(std::move(combination.entries),
                                            {"Study/Reference variant=none",
                                             "Study/Factors varied at once=all",
                                             "Study/Repetitions=1",
                                             "Output/Console=quiet",
                                             "Output/Report=false",
                                             "Output/Directory=" + directory +
                                               "/" + directory_name});
            Variant    next;
            next.name          = directory_name + ": " + names[variants.size()];
            next.values        = combination.values;
            next.n_repetitions = first.study.repetitions;
            next.scene         = Scene::from_entries(own, name);
            next.scene.changed_entries.clear();
            next.scene.output.extendable = false;
            variants.push_back(std::move(next));
          }
      }



      unsigned int
      n_done() const
      {
        return std::count_if(variants.begin(),
                             variants.end(),
                             [](const Variant &variant) {
                               return variant.done;
                             });
      }



      void
      check(std::ostream &out)
      {
        out << variants.size() << " variants\n";
        std::set<std::string> said;
        for (Variant &variant : variants)
          {
            variant.look_up();
            out << variant.name
                << (variant.has_other_references ?
                      " (done already, but the content of its reference has "
                      "changed: distances will be computed anew)" :
                    variant.done ? " (done already)" :
                                   "")
                << '\n';
            for (const std::string &doubt : doubts_of_reference(variant.scene))
              if (said.insert(doubt).second)
                out << "warning: " << doubt << '\n';
            Classic<std::ostringstream> none; // only refuses what it cannot do
            if (variant.scene.model != ModelKind::finite_elements)
              run_scene(variant.scene, nullptr, &none);
          }
      }



      // Refuses before anything runs, and finds what is there already.
      DirectoryLock
      prepare(const bool force)
      {
        std::error_code error;
        std::filesystem::create_directories(directory, error);
        if (error)
          throw EntryError("Output / Directory",
                           "this directory cannot be created: " +
                             error.message(),
                           directory);
        const auto lock = lock_directory(directory);
        for (Variant &variant : variants)
          {
            OutputParameters &output       = variant.scene.output;
            output.overwrite_other_results = force;
            variant.look_up();
            if (variant.has_other_scene && !force)
              throw EntryError(
                "Output / Directory",
                output.directory +
                  " holds results of another scene (compare its "
                  "parameters.prm): choose another directory, or "
                  "overwrite them with --force",
                directory);
            if (!variant.other_program.empty() && !force)
              throw EntryError("Output / Directory",
                               output.directory + " holds results of " +
                                 variant.other_program + ", and this is " +
                                 program_and_version() +
                                 ": choose another directory, or compute them "
                                 "again with --force",
                               directory);
            variant.done = variant.done && !force;
            if (variant.done && variant.has_other_references)
              {
                compare_anew(output, output.directory, variant.summary);
                ++n_compared_anew;
              }
            // what is left over from another scene, or not wanted any more
            if (force || !variant.has_this_scene)
              variant.forget_repetitions();
          }
        return lock;
      }



      void
      run(const unsigned int n_jobs, const bool force, std::ostream &out)
      {
        const auto lock = prepare(force);
        out << variants.size() << " variants in " << directory;
        if (n_done() > 0)
          out << ", " << n_done() << " of them done already";
        out << std::endl;
        if (n_compared_anew > 0)
          out << "The content of a reference has changed: the distances of "
              << n_compared_anew
              << (n_compared_anew == 1 ? " variant" : " variants")
              << " that had been done are computed anew" << std::endl;
        run_variants(n_jobs, out);
        write_table();
        write_ensemble(out);
        name_best(out);
        if (reports)
          reports = write_page(directory);
        out << "Results are in " << directory << "/study.csv"
            << (reports ? " and report.html" : "") << std::endl;
        if (n_done() < variants.size())
          throw RunError(Text() << variants.size() - n_done() << " of "
                                << variants.size() << " variants failed: "
                                << directory << "/study.csv says why");
      }



      void
      run_variants(const unsigned int n_jobs, std::ostream &out)
      {
        VariantQueue                waiting(n_jobs);
        std::vector<VariantProcess> running;
        unsigned int                n_ended = n_done();
        Progress                    progress;
        progress.show("starting", double(n_ended) / variants.size());
        for (unsigned int i = 0; i < variants.size(); ++i)
          if (!variants[i].done)
            waiting.add(i, variants[i].scene, variants[i].n_repetitions == 1);
        while (true)
          {
            while (!waiting.empty() && running.size() < n_jobs)
              {
                const auto [number, bodies] = waiting.next();
                running.push_back(
                  start_process(number, variants[number].scene, bodies));
              }
            if (running.empty())
              return;

            const auto ended = wait_for_one(running);
            if (ended == running.end())
              {
                for (const VariantProcess &process : running)
                  {
                    kill(process.id, SIGTERM);
                    end_of(process);
                  }
                stop(interrupting_signal());
              }
            const unsigned int number  = ended->variant;
            Variant           &variant = variants[number];
            const std::string  why     = end_of(*ended);
            running.erase(ended);
            if (variant.end_run(why))
              {
                running.push_back(
                  start_process(number, variant.scene, nullptr));
                continue;
              }
            out << ++n_ended << '/' << variants.size() << ' ' << variant.name
                << ": " << outcome_of(variant) << std::endl;
            progress.show(std::to_string(running.size()) + " at work",
                          double(n_ended) / variants.size());

            write_table_at_times();
          }
      }



      /** The table of a large study takes a while: most of the time is not to
       *  go into it. */
      void
      write_table_at_times()
      {
        if (since_table.wall_time() < time_between_tables)
          return;
        const dealii::Timer clock;
        write_table();
        time_between_tables = std::max(2., 50. * clock.wall_time());
        since_table.restart();
      }



      /** After a signal that has ended the study. */
      [[noreturn]] void
      stop(const int signal)
      {
        write_table();
        if (reports)
          write_page(directory);
        throw Interrupted(signal,
                          Text()
                            << "interrupted by " << signal_name(signal) << ": "
                            << n_done() << " of " << variants.size()
                            << " variants are done; the same study without "
                               "--force goes on with the others");
      }



      void
      write_table()
      {
        using Fields = std::vector<std::string>;
        std::map<std::string, std::size_t> column_of;
        Fields                             header{"variant"};
        std::vector<Fields>                rows(variants.size());
        header.insert(header.end(), varied.begin(), varied.end());
        // finished variants first: they know all columns and their order
        for (const bool done : {true, false})
          for (unsigned int i = 0; i < variants.size(); ++i)
            {
              Variant &variant = variants[i];
              if (variant.done != done)
                continue;
              if (reference > 0)
                variant.compare_with(variants[reference - 1]);
              nlohmann::ordered_json summary = variant.summary;
              if (!done)
                {
                  summary["converged"] = false;
                  summary["reason"] =
                    variant.failure.empty() ? "not run yet" : variant.failure;
                }
              Fields &row = rows[i] = {std::to_string(i + 1)};
              row.insert(row.end(),
                         variant.values.begin(),
                         variant.values.end());
              for (const auto &[name, value] : summary.items())
                {
                  if (value.is_object() || name == "changed_entries")
                    continue; // not of the variant alone
                  const std::size_t column =
                    column_of.emplace(name, header.size()).first->second;
                  header.resize(std::max(header.size(), column + 1), name);
                  row.resize(std::max(row.size(), column + 1), "nan");
                  row[column] = text_of(value);
                }
            }
        std::string text = csv_line(header);
        for (Fields &row : rows)
          {
            row.resize(header.size(), "nan");
            text += csv_line(row);
          }
        write_file(directory + "/study.csv", text);
      }



      /** The variant closest to the measured curve. */
      void
      name_best(std::ostream &out) const
      {
        const Variant *best = nullptr;
        for (const Variant &variant : variants)
          if (reference == 0 && variant.done &&
              number_in(variant.summary, "difference_mean") <
                (best == nullptr ? std::numeric_limits<double>::infinity() :
                                   number_in(best->summary, "difference_mean")))
            best = &variant;
        if (best == nullptr || variants.size() == 1)
          return;
        const auto percent = [&](const char *const name) {
          return to_text(100. * number_in(best->summary, name), 2) + " %";
        };
        out << "Closest to " << best->scene.output.reference_curve << ": "
            << best->name << ", by " << percent("difference_mean")
            << " in the mean and " << percent("difference_max") << " at most"
            << std::endl;
        if (best->summary.contains("remarks"))
          for (const std::string remark : best->summary["remarks"])
            if (remark.rfind("e_mp", 0) == 0)
              out << "warning: " << remark << std::endl;
      }



      // The seed is what stands for chance.
      void
      write_ensemble(std::ostream &out) const
      {
        const auto seed =
          std::find(varied.begin(), varied.end(), "Interface / Bonding / Seed");
        if (seed == varied.end())
          {
            // of a study that was here before
            for (const char *const name :
                 {"/ensemble.csv", "/ensemble_summary.csv"})
              remove_file(directory + name);
            return;
          }
        if (const int code = Laboratory::run("ensemble", {directory});
            code == 127)
          out << "There are no statistics over all seeds: "
              << Laboratory::what_it_needs << std::endl;
        else if (code != 0)
          throw RunError("the statistics over all seeds in " + directory +
                         " could not be made");
      }
    };
  } // namespace



  void
  run_study(const std::vector<SceneEntry> &entries,
            const std::string             &name,
            const unsigned int             n_jobs,
            const bool                     force,
            std::ostream                  &out)
  {
    const ClassicNumbers classic(out);
    Study(entries, name).run(n_jobs, force, out);
  }



  void
  check_study(const std::vector<SceneEntry> &entries,
              const std::string             &name,
              std::ostream                  &out)
  {
    const ClassicNumbers classic(out);
    Study(entries, name).check(out);
  }
} // namespace Debond
