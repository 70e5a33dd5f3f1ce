#include <debond/output/report_page.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/written_files.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>

// made by the build of the files in report/
#include <debond_report_files.h>

namespace Debond
{
  namespace ReportPage
  {
    std::string
    escaped(std::string text)
    {
      boost::replace_all(text, "&", "&amp;");
      boost::replace_all(text, "<", "&lt;");
      boost::replace_all(text, ">", "&gt;");
      boost::replace_all(text, "\"", "&quot;");
      return text;
    }



    std::string
    short_number(const double number, const int digits)
    {
      const double size = std::abs(number);
      return size >= std::pow(10., digits) && size < 1e9 ?
               to_text(std::round(number), 10) :
               to_text(number, digits);
    }



    std::string
    section(const std::string &heading, const std::string &content)
    {
      return content.empty() ? "" :
                               "<h2>" + heading + "</h2>\n" + content + "\n";
    }



    std::string
    list_of(const std::vector<std::string> &items, const std::string &style)
    {
      std::string text;
      for (const std::string &item : items)
        text += "<li>" + item + "</li>\n";
      return text.empty() ? "" : "<ul" + style + ">\n" + text + "</ul>";
    }



    bool
    draw(const std::string &script)
    {
      const Scratch     scratch;
      const std::string file = scratch.path + "/script.gp";
      write_file(file, script);
      return std::system(("gnuplot '" + file + "' > /dev/null 2>&1").c_str()) ==
             0;
    }



    std::string
    table_of(const std::vector<std::string>              &head,
             const std::vector<std::vector<std::string>> &rows)
    {
      if (rows.empty())
        return "";
      const auto line = [](const std::vector<std::string> &fields,
                           const std::string              &kind) {
        std::string text = "<tr>";
        for (const std::string &field : fields)
          text += "<" + kind + ">" + field + "</" + kind + ">";
        return text + "</tr>\n";
      };
      std::string text = "<div class=\"wide\"><table>\n";
      if (!head.empty())
        text += line(head, "th");
      for (const auto &row : rows)
        text += line(row, "td");
      return text + "</table></div>";
    }



    std::string
    state(const bool finished, const std::string &reason)
    {
      return std::string("<p><span class=\"state") +
             (finished ? "\">finished" : " failed\">not finished") +
             "</span> " + escaped(reason) + "</p>\n";
    }



    std::string
    origin(const nlohmann::ordered_json &summary, const bool with_seconds)
    {
      std::vector<std::vector<std::string>> rows;
      const auto                            found = summary.find("provenance");
      if (found != summary.end())
        for (const auto &[name, text] : found->items())
          rows.push_back(
            {name, "<code>" + escaped(text.get<std::string>()) + "</code>"});
      const auto seconds = summary.find("wall_seconds");
      if (with_seconds && seconds != summary.end() && seconds->is_number())
        rows.push_back({"run time", to_text(seconds->get<double>(), 3) + " s"});
      return table_of({}, rows);
    }



    std::string
    quoted(std::string text)
    {
      boost::replace_all(text, "'", "''");
      return "'" + text + "'";
    }



    std::string
    image(const std::string &file, const std::string &words)
    {
      const auto bytes = read_whole_file(file);
      if (!bytes)
        return "";
      return "<img alt=\"" + escaped(words) +
             "\" src=\"data:image/svg+xml;base64," +
             dealii::Utilities::encode_base64(
               std::vector<unsigned char>(bytes->begin(), bytes->end())) +
             "\">";
    }



    std::string
    curve(const bool         is_drawn,
          const std::string &file,
          const std::string &words,
          const std::string &directory)
    {
      return is_drawn ?
               "<div class=\"curve\">" + image(file, words) + "</div>" :
               "<p>There are no pictures: gnuplot, which draws them, is missing "
               "or has failed. Once it is there, <code>debond --report " +
                 escaped(directory) + "</code> makes this page anew.</p>";
    }



    void
    write(const std::string &directory,
          const std::string &title,
          const std::string &sections)
    {
      std::string page = report_file_page_html;
      boost::replace_all(page, "{{title}}", escaped(title));
      boost::replace_first(page, "{{sections}}", sections);
      write_file(directory + "/report.html", page);
    }



    Scratch::Scratch()
      : path((std::filesystem::temp_directory_path() / "debond-report-XXXXXX")
               .string())
    {
      if (mkdtemp(&path[0]) == nullptr)
        throw WriteError("cannot make the directory " + path);
    }



    Scratch::~Scratch()
    {
      std::error_code none;
      std::filesystem::remove_all(path, none);
    }
  } // namespace ReportPage
} // namespace Debond
