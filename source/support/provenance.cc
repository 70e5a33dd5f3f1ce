#include <debond/support/provenance.h>

#include <deal.II/base/config.h>

#include <unistd.h>

#include <ctime>

// made by the build, of `git describe'
#include <debond_commit.h>

namespace Debond
{
  namespace
  {
    std::string command; // as a shell would read it



    std::string
    quoted(const std::string &word)
    {
      if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                 "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                 "0123456789-_./=,:+@%") == std::string::npos)
        return word;
      std::string text = "'";
      for (const char c : word)
        text += c == '\'' ? "'\\''" : std::string(1, c);
      return text + "'";
    }



    std::string
    date_now()
    {
      const std::time_t now = std::time(nullptr);
      std::tm           local{};
      char              text[40];
      localtime_r(&now, &local);
      std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%S%z", &local);
      return text;
    }
  } // namespace



  std::string
  shell_line(const std::vector<std::string> &words)
  {
    std::string line;
    for (const std::string &word : words)
      line += (line.empty() ? "" : " ") + quoted(word);
    return line;
  }



  void
  note_command(const int argc, const char *const *const argv)
  {
    command = shell_line({argv, argv + argc});
  }



  std::string
  program_and_version()
  {
    return "debond " DEBOND_VERSION;
  }



  std::vector<std::pair<std::string, std::string>>
  provenance()
  {
    char host[256] = "";
    gethostname(host, sizeof(host) - 1);
    std::vector<std::pair<std::string, std::string>> all{
      {"program", program_and_version()},
      {"commit", DEBOND_COMMIT},
      {"deal.II", DEAL_II_PACKAGE_VERSION},
      {"date", date_now()},
      {"host", host},
      {"command", command}};
    std::vector<std::pair<std::string, std::string>> known;
    for (auto &item : all)
      if (!item.second.empty())
        known.push_back(std::move(item));
    return known;
  }
} // namespace Debond
