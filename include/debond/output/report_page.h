#ifndef debond_output_report_page_h
#define debond_output_report_page_h

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace Debond
{
  /** What pages of results are made of: pieces of HTML, and pictures that
   *  gnuplot draws. */
  namespace ReportPage
  {
    /** A text as HTML shows it. */
    std::string
    escaped(std::string text);

    /** A number with so many digits, but 17795 rather than 1.78e+04. */
    std::string
    short_number(double number, int digits = 4);

    /** A section of the page; nothing without content. */
    std::string
    section(const std::string &heading, const std::string &content);

    /** @p items are HTML; nothing without any. */
    std::string
    list_of(const std::vector<std::string> &items,
            const std::string              &style = "");

    /** Fields are HTML. */
    std::string
    table_of(const std::vector<std::string>              &head,
             const std::vector<std::vector<std::string>> &rows);

    /** Whether all has ended as it should, and why. */
    std::string
    state(bool finished, const std::string &reason);

    /** Where results come from: `provenance` and `wall_seconds` of a summary.
     *  Those of a variant are no seconds of its study. */
    std::string
    origin(const nlohmann::ordered_json &summary, bool with_seconds = true);

    /** A text in gnuplot's language. */
    std::string
    quoted(std::string text);

    /** Whether gnuplot has drawn all of a script. */
    bool
    draw(const std::string &script);

    /** An SVG file whose bytes stand in the page, so that names in several
     *  pictures do not meet; nothing if there is no such file. */
    std::string
    image(const std::string &file, const std::string &words);

    /** The same as wide as the page, or why there is none. */
    std::string
    curve(bool               is_drawn,
          const std::string &file,
          const std::string &words,
          const std::string &directory);

    /** Writes report.html into a directory. */
    void
    write(const std::string &directory,
          const std::string &title,
          const std::string &sections);

    /** A directory for pictures that only the page is to have. */
    struct Scratch
    {
      Scratch();
      Scratch(const Scratch &) = delete;
      ~Scratch();

      std::string path;
    };
  } // namespace ReportPage
} // namespace Debond
#endif
