#ifndef debond_output_result_files_h
#define debond_output_result_files_h

#include <debond/scene/output_parameters.h>
#include <debond/support/written_files.h>

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Debond
{
  enum class DirectoryContent
  {
    no_results,
    same_scene,
    other_scene
  };

  /** Whether the directory of @p output holds results, judged by the text of
   *  its parameters.prm. */
  DirectoryContent
  content_of_result_directory(const OutputParameters &output,
                              const std::string      &completed_parameters);

  class DirectoryLock;

  /** The directory that a run writes to. No other process can open it while
   * this object or a copy of it lives; that process gets an InputError. */
  class ResultDirectory
  {
  public:
    /** Creates the directory and writes parameters.prm, the text of
     *  @p completed_parameters, into it. Throws InputError that begins with the
     *  name of the entry if this is impossible, or if there is a parameters.prm
     *  with another text and @p output does not allow to overwrite it. If it
     *  does, the results of that other scene are removed first. */
    ResultDirectory(const OutputParameters &output,
                    const std::string      &completed_parameters);
    /** A directory that holds the results of an earlier run, which goes on. */
    explicit ResultDirectory(const std::string &path);

    /** The directory, without a slash at its end. */
    const std::string &
    path() const
    {
      return directory;
    }

    /** The path of the file @p name in the directory. */
    std::string
    file(const std::string &name) const
    {
      return directory + "/" + name;
    }

  private:
    std::string                          directory;
    std::shared_ptr<const DirectoryLock> lock;
  };

  /** A flat JSON object whose members keep the order in which they are added;
   *  one that is added again gets a new value in its old place. */
  class JsonObject
  {
  public:
    JsonObject() = default;
    /** Reads a file that text() has written, for instance a summary.json.
     *  Throws InputError if it cannot be read. */
    static JsonObject
    from_file(const std::string &filename);

    /** Twelve significant digits; `null` if not finite. */
    void
    add(const std::string &name, double value);
    void
    add(const std::string &name, const std::string &value);
    /** Without this one a literal would be taken for a bool. */
    void
    add(const std::string &name, const char *value);
    void
    add(const std::string &name, const std::vector<std::string> &values);
    /** Whole numbers and bool. */
    template <typename Integral,
              typename = std::enable_if_t<std::is_integral<Integral>::value>>
    void
    add(const std::string &name, Integral value)
    {
      add_text(name,
               std::is_same<Integral, bool>::value ?
                 (value ? "true" : "false") :
                 std::to_string(value));
    }

    /** The value of a member as it stands in the file; `null` if there is
     *  none. */
    std::string
    value(const std::string &name) const;

    /** The whole object, one member in a line. */
    std::string
    text() const;

  private:
    void
    add_text(const std::string &name, const std::string &json);

    std::vector<std::pair<std::string, std::string>> members; ///< name, JSON
  };
} // namespace Debond
#endif
