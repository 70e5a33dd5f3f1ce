#include <debond/support/number_text.h>
#include <debond/support/progress.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace Debond
{
  namespace
  {
    bool is_enabled = false, is_shown = false;



    void
    write_to_terminal(const std::string &text)
    {
      if (::write(STDOUT_FILENO, text.data(), text.size()) < 0)
        is_enabled = false; // the terminal is gone
    }



    /** Writes to std::cout get here first. */
    struct Terminal : std::streambuf
    {
      std::streambuf *const out = std::cout.rdbuf();

      int_type
      overflow(const int_type c) override
      {
        hide_progress();
        return traits_type::eq_int_type(c, traits_type::eof()) ?
                 traits_type::not_eof(c) :
                 out->sputc(traits_type::to_char_type(c));
      }

      std::streamsize
      xsputn(const char *const text, const std::streamsize n) override
      {
        hide_progress();
        return out->sputn(text, n);
      }

      int
      sync() override
      {
        return out->pubsync();
      }
    };



    /** "12 s", "3 min", "2.1 h" */
    std::string
    duration(const double seconds)
    {
      return seconds < 100. ? fixed_text(std::ceil(seconds), 0) + " s" :
             seconds < 6000. ?
                              fixed_text(std::ceil(seconds / 60.), 0) + " min" :
                              fixed_text(seconds / 3600., 1) + " h";
    }



    unsigned int
    width_of_terminal()
    {
      winsize size{};
      return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ?
               size.ws_col :
               80;
    }
  } // namespace



  // Never removed: others may write until the program ends.
  void
  show_progress_on_terminal()
  {
    static Terminal *const terminal = new Terminal;
    std::cout.rdbuf(terminal);
    is_enabled = true;
  }



  bool
  progress_is_shown()
  {
    return is_enabled;
  }



  void
  hide_progress()
  {
    if (is_shown)
      write_to_terminal("\r\033[K");
    is_shown = false;
  }



  void
  Progress::show(const std::string &what, const double fraction)
  {
    constexpr double interval = 0.1; // s
    const auto       now      = std::chrono::steady_clock::now();
    const auto since = [&](const std::chrono::steady_clock::time_point &then) {
      return std::chrono::duration<double>(now - then).count();
    };
    if (first_fraction < 0. && fraction >= 0.)
      first_fraction = fraction;
    if (!is_enabled || since(last_shown) < interval)
      return;
    last_shown       = now;
    std::string line = what;
    if (fraction >= 0.)
      {
        constexpr unsigned int length = 20;
        const unsigned int     filled =
          std::min<double>(length, std::floor(length * fraction));
        line += "  [" + std::string(filled, '#') +
                std::string(length - filled, '.') + "]  " +
                std::to_string(int(100. * fraction)) + " %";
        // the beginning of a run is no measure of its pace
        if (const double pace = fraction - first_fraction;
            pace > 0. && since(start) > 1.)
          line +=
            ", " + duration(since(start) * (1. - fraction) / pace) + " to go";
      }
    std::cout.flush();
    is_shown = true;
    write_to_terminal("\r\033[K" + line.substr(0, width_of_terminal() - 1));
  }
} // namespace Debond
