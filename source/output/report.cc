#include <debond/input/csv_table.h>
#include <debond/output/reference_comparison.h>
#include <debond/output/report.h>
#include <debond/output/report_page.h>
#include <debond/output/result_files.h>
#include <debond/scene/reference_data.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

// made by the build of the files in report/
#include <debond_report_files.h>

namespace Debond
{
  using namespace ReportPage;
  namespace fs = std::filesystem;

  namespace
  {
    /** What the page is made of. */
    struct Results
    {
      std::string            directory;
      nlohmann::ordered_json summary;
      Scene                  scene;

      explicit Results(const std::string &path)
        : directory(path)
        , summary(read_json(path + "/summary.json"))
      {
        const std::string parameters = path + "/parameters.prm";
        if (summary.empty() || !fs::exists(parameters))
          throw InputError("there are no results of a run in '" + path +
                           "' (summary.json, parameters.prm)");
        scene = Scene::from_file(parameters);
      }

      /** A member of the summary; NaN if there is none. */
      double
      number(const std::string &name) const
      {
        const auto found = summary.find(name);
        return found != summary.end() && found->is_number() ?
                 found->get<double>() :
                 std::numeric_limits<double>::quiet_NaN();
      }

      /** "<b>53.8 N mm</b>"; nothing if it is not known. */
      std::optional<std::string>
      in_words(const std::string &name,
               const std::string &unit,
               const double       factor = 1.) const
      {
        const double value = factor * number(name);
        if (!std::isfinite(value))
          return {};
        return "<b>" + short_number(value) + (unit == "°" ? "" : " ") + unit +
               "</b>";
      }
    };



    /** The summary speaks of another content of the reference files. */
    bool
    has_changed_references(const Results &results)
    {
      return results.summary.contains("reference_files") &&
             has_other_references(results.scene.output, results.summary);
    }



    // <h3>The curve</h3>

    /** What is drawn over what: columns of torque.csv, and their names. */
    struct Axes
    {
      std::string x = "angle_deg", y = "torque_Nmm",
                  x_label = "Rotation angle {/:Italic θ} [°]",
                  y_label = "Torque {/:Italic T} [N mm]";
    };



    /** The torque over the angle of an implant that turns; otherwise force or
     *  moment of the component of the chuck that moves most over its way. */
    Axes
    axes_of(const std::string &file)
    {
      const std::string         entry = "torque.csv";
      const auto                known = read_csv_header(file, entry);
      std::vector<std::string>  names{"angle_deg"};
      std::vector<unsigned int> components;
      for (unsigned int k = 0; k < 6; ++k)
        if (const std::string name = ChuckParameters::column_name(k, false);
            std::count(known.begin(), known.end(), name) > 0)
          {
            names.push_back(name);
            components.push_back(k);
          }
      const auto rows = read_csv_columns(file, entry, names, true);
      const auto way  = [&](const unsigned int column) {
        const auto [least, most] =
          std::minmax_element(rows.begin(),
                              rows.end(),
                              [=](const auto &a, const auto &b) {
                                return a[column] < b[column];
                              });
        return rows.empty() ? 0. : (*most)[column] - (*least)[column];
      };
      Axes axes;
      if (way(0) > 1e-9)
        return axes;
      double largest = 0.;
      for (unsigned int i = 0; i < components.size(); ++i)
        {
          const unsigned int k = components[i];
          // a degree at a radius of some mm
          const double length = way(i + 1) * (is_rotation(k) ? 0.05 : 1.);
          if (!(length > largest))
            continue;
          largest                = length;
          const std::string load = ChuckParameters::column_name(k, true),
                            direction(1, "xyz"[k % 3]);
          axes = is_rotation(k) ?
                   Axes{names[i + 1],
                        load,
                        "Rotation about " + direction + " [°]",
                        "Moment about " + direction + " [N mm]"} :
                   Axes{names[i + 1],
                        load,
                        "Displacement along " + direction + " [mm]",
                        "Force along " + direction + " [N]"};
        }
      return axes;
    }



    /** Maps: for each event the words of its columns, and the largest values of
     *  the three quantities. */
    struct Maps
    {
      struct Event
      {
        std::string name, angle, time;
      };
      std::vector<Event>    events;
      std::array<double, 3> largest{};

      explicit Maps(const std::string &file)
      {
        if (!fs::exists(file))
          return;
        const auto header = read_csv_header(file, "maps.csv");
        for (unsigned int i = 2; i + 2 < header.size(); i += 3)
          {
            std::vector<std::string> words =
              dealii::Utilities::split_string_list(header[i], " | ");
            words.resize(4);
            events.push_back({words[0], words[1], words[2]});
          }
        for (const auto &row : read_csv_columns(file, "maps.csv", header, true))
          for (unsigned int i = 2; i < row.size(); ++i)
            if (row[i] > largest[(i - 2) % 3])
              largest[(i - 2) % 3] = row[i];
      }
    };



    /** The names that report/pictures.gp asks for. */
    std::string
    names_for_pictures(const Results     &results,
                       const Maps        &maps,
                       const std::string &scratch)
    {
      const std::string file = finest_curve(results.directory);
      const Axes        axes = axes_of(file);
      Text              text;
      text << "file = " << quoted(file) << "\nx = " << quoted(axes.x)
           << "\ny = " << quoted(axes.y)
           << "\nx_label = " << quoted(axes.x_label)
           << "\ny_label = " << quoted(axes.y_label)
           << "\nsvg = " << quoted(results.directory + "/torque.svg")
           << "\npng = " << quoted(results.directory + "/torque.png") << "\n";
      ReferenceCurve reference;
      const bool     turns = axes.x == Axes().x;
      if (turns && fs::exists(results.scene.output.reference_curve) &&
          !has_changed_references(results))
        reference =
          read_reference_curve(results.scene.output.reference_curve,
                               results.scene.output.reference_columns);
      text << "$reference << EOD\nangle,torque\n";
      for (const auto &[angle, torque] : reference)
        text << angle << "," << torque << "\n";
      text << "EOD\nn_reference = " << reference.size() << "\npublished = '";
      for (const double value : results.scene.output.published)
        text << (turns ? to_text(value) + " " : "");
      text << "'\nmaps = " << quoted(results.directory + "/maps.csv")
           << "\nn_maps = " << maps.events.size() << "\nlargest = '";
      for (const double largest : maps.largest)
        text << (largest > 0. ? largest : 1.) << " ";
      text << "'\nmap_file(k, q) = sprintf('%s/%d-%d.svg', " << quoted(scratch)
           << ", k, q)\n";
      return text;
    }



    std::string
    section_of_maps(const Maps &maps, const std::string &scratch)
    {
      static const struct
      {
        const char *name, *unit;
      } quantities[]{{"Pressure", " MPa"},
                     {"Sliding distance g_s", " mm"},
                     {"Friction coefficient mu", ""}};
      const bool  turns = std::any_of(maps.events.begin(),
                                     maps.events.end(),
                                     [](const Maps::Event &event) {
                                       return event.angle != "0";
                                     });
      std::string text;
      for (unsigned int q = 0; q < 3; ++q)
        {
          text += Text() << "<div class=\"scale\">" << quantities[q].name
                         << ": 0 <span class=\"bar\"></span> "
                         << to_text(maps.largest[q], 3) << quantities[q].unit
                         << "</div>\n<div class=\"maps\">\n";
          for (unsigned int k = 0; k < maps.events.size(); ++k)
            {
              const auto       &event = maps.events[k];
              const std::string words =
                (turns ? event.angle + "°: " : "time " + event.time + ": ") +
                event.name;
              text += "<figure>" +
                      image(scratch + "/" + std::to_string(k + 1) + "-" +
                              std::to_string(q + 1) + ".svg",
                            quantities[q].name + (" at " + words)) +
                      "<figcaption>" + escaped(words) +
                      "</figcaption></figure>\n";
            }
          text += "</div>\n";
        }
      return maps.events.empty() ? "" : text;
    }



    // <h3>Words and tables</h3>

    std::vector<std::string>
    findings(const Results &results)
    {
      std::vector<std::string> list;
      const auto               value = [&](const char *const name,
                             const char *const unit,
                             const double      factor = 1.) {
        return results.in_words(name, unit, factor);
      };
      if (const auto angle = value("theta_max_deg", "°"))
        {
          const auto full = value("theta_full_deg", "°");
          list.push_back(
            "The torque is largest, " + *value("T_max_Nmm", "N mm") + ", at " +
            *angle +
            (full ? ", and stays within 0.1 % of that up to " + *full : "") +
            ". At the end it is " +
            value("T_inf_Nmm", "N mm").value_or("not known") + ".");
        }
      if (const auto angle = value("theta_debonding_deg", "°"))
        list.push_back("The bond begins to break between " +
                       value("theta_bonded_deg", "°").value_or("") + " and " +
                       *angle + ".");
      if (const auto pressure = value("pressure_MPa", "MPa");
          pressure && results.number("pressure_MPa") > 0.)
        list.push_back("The implant is pressed on with a mean pressure of " +
                       *pressure + ".");
      if (const auto force = value("force_end_N", "N"))
        list.push_back("The axial force at the end is " + *force +
                       " (positive in compression).");
      if (const auto stiffness =
            value("initial_stiffness_Nmm_per_rad", "N mm/rad"))
        list.push_back("The initial torsional stiffness is " + *stiffness +
                       ".");
      if (const auto work = value("W_adh_Nmm", "N mm"))
        list.push_back(
          "The work of adhesion read off the curve is " + *work + ", or " +
          value("w_adh_N_per_m", "N/m").value_or("not known") +
          " of the bonded face; the law spends " +
          value("D_adh_Nmm", "N mm").value_or("nothing") + " on adhesion.");
      if (const auto mean = value("difference_mean", "%", 100.))
        list.push_back("The torque differs from that of " +
                       escaped(results.scene.output.reference_curve) + " by " +
                       *mean + " of the largest in the mean and " +
                       value("difference_max", "%", 100.).value_or("") +
                       " at most." +
                       (has_rig(results.scene.calibration) ?
                          " The run is without the rig: offsets, slack and "
                          "compliance (subsection Calibration) are still in "
                          "that file." :
                          ""));
      return list;
    }



    std::string
    energies(const Results &results)
    {
      static const struct
      {
        const char *name, *words;
      } parts[]{{"work_Nmm", "work of the chuck"},
                {"E_bulk_Nmm", "stored in the bodies at the end"},
                {"E_interface_Nmm", "stored in the interface at the end"},
                {"dissipation_Nmm", "dissipated"},
                {"D_adh_Nmm", "of that by the bond"},
                {"viscous_dissipation_Nmm", "of that by viscosity"},
                {"released_energy_Nmm", "released by jumps"}};
      double largest = 0.;
      for (const auto &part : parts)
        largest = std::fmax(largest, std::abs(results.number(part.name)));
      std::vector<std::vector<std::string>> rows;
      for (const auto &part : parts)
        if (const double energy = results.number(part.name);
            std::abs(energy) > 1e-9 * largest)
          rows.push_back({part.words, to_text(energy, 4) + " N mm"});
      std::string  text      = table_of({}, rows);
      const double reactions = results.number("largest_reaction_defect");
      if (const double defect = results.number("largest_energy_defect");
          std::isfinite(defect))
        text += "<p>Work and energies differ by " + to_text(defect, 2) +
                " of the largest work at most" +
                (std::isfinite(reactions) ?
                   ", forces on both sides of the implant by " +
                     to_text(reactions, 2) :
                   "") +
                ".</p>";
      return text;
    }



    std::string
    changed_entries(const Scene &scene)
    {
      std::vector<std::vector<std::string>> rows;
      for (const SceneEntry &entry : scene.changed_entries)
        rows.push_back({escaped(entry.full_name()),
                        "<code>" + escaped(entry.value) + "</code>"});
      return table_of({}, rows);
    }



    std::vector<std::string>
    warnings_of(const Results &results)
    {
      std::vector<std::string> list;
      if (has_changed_references(results))
        list.push_back("The content of " +
                       escaped(results.scene.output.reference_curve) +
                       " or of the reference profiles is not that which the "
                       "differences on this page belong to: run the scene "
                       "again.");
      for (const char *const name : {"warnings", "remarks"})
        if (const auto found = results.summary.find(name);
            found != results.summary.end())
          for (const std::string text : *found)
            if (std::find(list.begin(), list.end(), escaped(text)) ==
                list.end())
              list.push_back(escaped(text));
      return list;
    }
  } // namespace



  void
  write_report_of_run(const std::string &directory)
  {
    const Results results(directory);
    const Maps    maps(directory + "/maps.csv");
    const Scratch scratch;
    const bool is_drawn = draw(names_for_pictures(results, maps, scratch.path) +
                               report_file_pictures_gp);
    std::string sections =
      state(results.summary.value("converged", false),
            results.summary.value("reason", "")) +
      section("Results", list_of(findings(results))) +
      section("Warnings",
              list_of(warnings_of(results), " class=\"warnings\"")) +
      section("Curve",
              curve(is_drawn,
                    directory + "/torque.svg",
                    "curve of the run",
                    directory));
    if (is_drawn)
      sections += section("Contact face", section_of_maps(maps, scratch.path));
    sections += section("Energies", energies(results)) +
                section("Entries that differ from the defaults",
                        changed_entries(results.scene)) +
                section("Origin", origin(results.summary));
    write(directory,
          results.scene.title.empty() ? "Results in " + directory :
                                        results.scene.title,
          sections);
  }



  void
  write_report(const std::string &directory)
  {
    if (!Ranks::is_first())
      return;
    if (fs::exists(directory + "/study.csv"))
      write_report_of_study(directory);
    else if (fs::exists(directory + "/calibration.json"))
      write_report_of_calibration(directory);
    else
      write_report_of_run(directory);
  }
} // namespace Debond
