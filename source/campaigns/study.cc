#include <debond/campaigns/ensemble.h>
#include <debond/campaigns/run_scene.h>
#include <debond/campaigns/study.h>
#include <debond/campaigns/variant_process.h>
#include <debond/campaigns/variant_queue.h>
#include <debond/input/csv_table.h>
#include <debond/input/parameter_loop.h>
#include <debond/output/torque_curve.h>
#include <debond/support/written_files.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
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
  } // namespace



  Study::Study(const std::vector<SceneEntry> &entries, const std::string &name)
  {
    for (const SceneEntry &entry : varied_entries(entries))
      {
        varied.push_back(entry.full_name());
        if (entry.full_name() == "Output / Directory")
          throw EntryError(entry.full_name(),
                           "a study gives each variant a directory of its own "
                           "below this one: expected one value",
                           entry.value,
                           entry.place);
      }
    const Scene first =
      Scene::from_entries(study_variants(entries)[0].entries, name);
    directory = first.output.directory;
    reference = first.study.reference_variant;
    std::vector<StudyVariant> combinations =
      study_variants(entries, first.study.factors_at_once);
    if (reference > combinations.size())
      throw first.with_place(EntryError("Study / Reference variant",
                                        "this study has " +
                                          std::to_string(combinations.size()) +
                                          " variants"));
    for (StudyVariant &combination : combinations)
      {
        // what only the study uses must not make another scene of a variant
        Variant next;
        next.values        = combination.values;
        next.n_repetitions = first.study.repetitions;
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
        variants[i].look_up();
        out << describe(i) << (variants[i].done ? " (done already)" : "")
            << '\n';
        if (variants[i].scene.model != ModelKind::finite_elements)
          {
            std::ostringstream none; // only refuses what it cannot do
            check_scene(variants[i].scene, none);
          }
      }
  }



  // Refuses before anything runs, and finds what is there already.
  DirectoryLock
  Study::prepare(const bool force)
  {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
      throw EntryError("Output / Directory",
                       "this directory cannot be created: " + error.message(),
                       directory);
    const auto lock = lock_directory(directory);
    for (Variant &variant : variants)
      {
        OutputParameters &output       = variant.scene.output;
        output.overwrite_other_results = force;
        variant.look_up();
        if (variant.content == DirectoryContent::other_scene && !force)
          throw EntryError("Output / Directory",
                           output.directory +
                             " holds results of another scene (compare its "
                             "parameters.prm): choose another directory, or "
                             "overwrite them with --force",
                           directory);
        variant.done = variant.done && !force;
        // what is left over from another scene, or not wanted any more
        if (force || variant.content != DirectoryContent::same_scene)
          variant.forget_repetitions();
      }
    return lock;
  }



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
    const auto lock   = prepare(force);
    const auto n_done = std::count_if(variants.begin(),
                                      variants.end(),
                                      [](const Variant &v) { return v.done; });
    out << variants.size() << " variants in " << directory;
    if (n_done > 0)
      out << ", " << n_done << " of them done already";
    out << std::endl;

    VariantProcesses running;
    VariantQueue     waiting(n_jobs);
    for (unsigned int i = 0; i < variants.size(); ++i)
      if (!variants[i].done)
        waiting.add(i, variants[i].scene, variants[i].n_repetitions == 1);
    auto n_ended = n_done;
    while (true)
      {
        while (!waiting.empty() && running.size() < n_jobs)
          {
            const auto next = waiting.next();
            running.start(next.variant,
                          variants[next.variant].scene,
                          next.bodies);
          }
        if (running.size() == 0)
          break;

        const auto ended = running.wait_for_one();
        if (!ended)
          {
            running.stop();
            stop();
          }
        Variant &variant = variants[ended->variant];
        variant.end_run(ended->failure);
        if (variant.wants_another_run())
          {
            running.start(ended->variant, variant.scene, nullptr);
            continue;
          }
        out << ++n_ended << '/' << variants.size() << ' ';
        report(ended->variant, out);
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
        const auto &summary = variants[variant].summary;
        out << "T_max " << to_text(number(summary, "T_max_Nmm"), 4) << " N mm, "
            << to_text(number(summary, "wall_seconds"), 4) << " s" << std::endl;
      }
  }



  StudyRow
  Study::table_row(const unsigned int number) const
  {
    const Variant &variant = variants[number];
    StudyRow       row{{"variant", std::to_string(number + 1)}};
    for (unsigned int i = 0; i < varied.size(); ++i)
      row.emplace_back(varied[i], variant.values[i]);

    nlohmann::ordered_json summary = variant.summary;
    if (!variant.done)
      {
        summary["converged"] = false;
        summary["reason"] =
          variant.failure.empty() ? "not run yet" : variant.failure;
      }
    for (const auto &member : summary.items())
      row.emplace_back(member.key(), text_of(member.value()));
    return row;
  }



  void
  Study::write_table()
  {
    if (reference > 0)
      for (Variant &variant : variants)
        variant.compare_with(variants[reference - 1]);
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
        const std::string curve =
          variant.scene.output.directory + "/torque.csv";
        members.push_back({without_seed(variant.values),
                           variant.done,
                           variant.summary,
                           read_reference_curve(variant.done ? curve : "")});
      }
    const Ensemble ensemble(without_seed(varied), members);
    write_file(directory + "/ensemble.csv", ensemble.curves);
    write_file(directory + "/ensemble_summary.csv", ensemble.summary);
    out << ensemble.notes << "Statistics over all seeds are in " << directory
        << "/ensemble.csv and ensemble_summary.csv" << std::endl;
  }
} // namespace Debond
