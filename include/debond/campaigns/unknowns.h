#ifndef debond_campaigns_unknowns_h
#define debond_campaigns_unknowns_h

#include <debond/input/expression_parser.h>
#include <debond/input/parameter_loop.h>

#include <Eigen/Core>

#include <mutex>
#include <string>
#include <vector>

namespace Debond
{
  /** A number that a calibration is to find, in the unit of its entry. */
  struct Unknown
  {
    std::string name;
    double      start = 0, lower = 0, upper = 0;
    bool        logarithmic = false;
    SceneEntry  entry; ///< that says so, for messages

    /** What the search takes: the number, or its logarithm. */
    double
    to_search(double value) const;
    double
    from_search(double searched) const;
    /** d value/d searched. */
    double
    per_search(const double value) const
    {
      return logarithmic ? value : 1.;
    }
  };

  /** Whether an entry holds `<<`. */
  bool
  has_unknown(const SceneEntry &entry);

  /**
   * The unknowns of a calibration, which stand in entries of the scene in the
   * place of numbers:
   *
   *   <<0.022 in 0.002..0.2>>         starts from 0.022, between these bounds
   *   <<0.022 in 0.002..0.2 log>>     the same, searched by its logarithm
   *   <<mu_b: 0.4 in 0.1..0.8>>       with a name
   *   <<1.45 * mu_b>>                 no unknown of its own: follows from
   * others
   *
   * Text around them belongs to the value, as in `-<<0.0049 in 0.001..0.02>> *
   * min(t, 1)`. An unknown that has a name, or whose entry has one value for
   * all experiments, is the same in all of them; else each has its own.
   */
  class Unknowns
  {
  public:
    /** Reads those of all @p experiments. Throws EntryError. */
    explicit Unknowns(const std::vector<StudyVariant> &experiments);

    std::vector<Unknown> list;

    /** The entries of an experiment that depend on unknowns, with what they are
     *  for @p values of all. Throws EntryError where an expression has no
     *  finite value. */
    std::vector<SceneEntry>
    varied_entries(unsigned int           experiment,
                   const Eigen::VectorXd &values) const;
    /** All its entries. */
    std::vector<SceneEntry>
    entries(unsigned int experiment, const Eigen::VectorXd &values) const;

    Eigen::VectorXd
    starts() const;

  private:
    /** An entry, taken apart: text, mark, text, mark, ..., text. */
    struct Varied
    {
      SceneEntry               entry;
      std::vector<std::string> texts;
      std::vector<std::string> marks;
      std::vector<int>         unknowns;    ///< by mark; -1: an expression
      std::vector<Expression>  expressions; ///< by mark
    };
    void
    read_mark(unsigned int       number,
              bool               is_shared,
              const std::string &mark,
              Varied            &item);
    void
    read_expressions();
    int
    add(Unknown unknown, bool has_name);

    std::vector<StudyVariant>        experiments;
    std::vector<std::vector<Varied>> varied; ///< of each experiment
    std::vector<bool>                named;  ///< by unknown
    mutable std::mutex               parsers;
  };
} // namespace Debond
#endif
