#include <debond/input/allowed_values.h>
#include <debond/input/expression_parser.h>
#include <debond/support/input_error.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <map>
#include <regex>
#include <sstream>
#include <vector>

namespace Debond
{
  namespace
  {
    /** deal.II's parser writes its complaints to the error stream, too. */
    class SilentErrorStream
    {
    public:
      SilentErrorStream()
        : original(std::cerr.rdbuf(nullptr))
      {}

      ~SilentErrorStream()
      {
        std::cerr.rdbuf(original);
        std::cerr.clear();
      }

    private:
      std::streambuf *const original;
    };



    /** What muParser says of an expression, taken out of the lines that
     *  deal.II's exception puts around it. */
    std::string
    words_of_parser(const std::string &message)
    {
      const std::string            key   = "The parser said: ";
      const std::string::size_type begin = message.find(key);
      if (begin == std::string::npos)
        return "it is no valid expression";
      // Long sentences are wrapped; an empty line ends them.
      std::istringstream words(
        message.substr(begin, message.find("\n\n", begin) - begin)
          .substr(key.size()));
      std::string result, word;
      while (words >> word && word.compare(0, 2, "--") != 0)
        result += (result.empty() ? "" : " ") + word;
      return result;
    }



    /** The parser takes `0,5 * t` for two expressions and returns the last. */
    bool
    has_comma_outside_parentheses(const std::string &expression)
    {
      int depth = 0;
      for (const char c : expression)
        {
          depth += (c == '(') - (c == ')');
          if (c == ',' && depth == 0)
            return true;
        }
      return false;
    }
  } // namespace



  namespace
  {
    /** The parser takes `r = 1` for an assignment, and its value for that of
     * the expression. */
    bool
    has_assignment(const std::string &expression)
    {
      for (std::string::size_type i = 0; i < expression.size(); ++i)
        {
          if (expression[i] != '=')
            continue;
          const bool is_double =
            i + 1 < expression.size() && expression[i + 1] == '=';
          if (is_double)
            ++i;
          else if (i == 0 || std::string("<>!").find(expression[i - 1]) ==
                               std::string::npos)
            return true;
        }
      return false;
    }



    /** The names of variables and functions in an expression, in order. */
    std::vector<std::string>
    names_in(const std::string &expression)
    {
      static const std::regex word(
        R"((\.?\d[\d.]*([eE][+-]?\d+)?)|([A-Za-z_]\w*))");
      std::vector<std::string> names;
      for (std::sregex_iterator match(expression.begin(),
                                      expression.end(),
                                      word);
           match != std::sregex_iterator();
           ++match)
        if ((*match)[3].matched)
          names.push_back(match->str());
      return names;
    }



    /** What other languages call otherwise; nothing if @p name is not known
     *  to be such a name. */
    std::string
    remark_on_name(const std::string &name, const std::string &variables)
    {
      const std::string remainder =
        "the remainder of a divided by b is written a - b * floor(a / b)";
      static const std::map<std::string, std::string> foreign{
        {"mod", remainder},
        {"fmod", remainder},
        {"%", remainder},
        {"and", "`and' is written &&"},
        {"or", "`or' is written ||"},
        {"e", "the exponential function is written exp(x)"},
        {"|", "absolute values are written abs(x)"}};
      const auto found = foreign.find(name);
      if (found != foreign.end())
        return found->second;

      std::string lower = name;
      for (char &c : lower)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      const auto is_known = [&](const std::string &word) {
        return ("," + variables + ",pi,R,").find("," + word + ",") !=
               std::string::npos;
      };
      if (!is_known(name) && is_known(lower))
        return "it is written " + lower + ", not " + name;
      return "";
    }



    /** A remark on frequent mistakes in an expression that the parser has
     *  refused, or nothing. */
    std::string
    remark_on_expression(const std::string &expression,
                         const std::string &variables)
    {
      if (expression.find_first_of("\"'`") != std::string::npos)
        return "it stands without quotes";
      // regular expressions need a deep stack for long texts
      std::vector<std::string> names = names_in(shortened(expression));
      if (expression.find('%') != std::string::npos)
        names.emplace_back("%");
      if (expression.find('|') != std::string::npos &&
          expression.find("||") == std::string::npos)
        names.emplace_back("|");
      for (const std::string &name : names)
        {
          const std::string remark = remark_on_name(name, variables);
          if (!remark.empty())
            return remark;
        }
      return "";
    }



    /** The parser takes && and || only with blanks around them. */
    std::string
    with_blanks(const std::string &expression)
    {
      std::string result;
      for (std::string::size_type i = 0; i < expression.size(); ++i)
        {
          const std::string two = expression.substr(i, 2);
          if (two == "&&" || two == "||")
            {
              result += " " + two + " ";
              ++i;
            }
          else
            result += expression[i];
        }
      return result;
    }
  } // namespace



  template <int dim>
  std::unique_ptr<dealii::FunctionParser<dim>>
  make_parser(const std::string &variables,
              const std::string &expression,
              const double       radius)
  {
    constexpr std::size_t longest = 10000; // letters
    const std::string     complaint =
      "this expression in " + variables + " cannot be read: ";
    if (expression.size() > longest)
      throw InputError(complaint + "it has more than " +
                       std::to_string(longest) + " letters");
    const std::string special = remark_on_special_character(expression);
    if (!special.empty())
      throw InputError(complaint + special);
    if (expression.find(';') != std::string::npos)
      throw InputError(complaint + "it holds a ;");
    if (expression.find("rand") != std::string::npos)
      throw InputError(complaint + "rand would make another scene of it every "
                                   "time");
    if (expression.find("**") != std::string::npos)
      throw InputError(complaint + "powers are written ^");
    if (has_comma_outside_parentheses(expression))
      throw InputError(complaint + "decimals are written with a point");
    if (has_assignment(expression))
      throw InputError(complaint + "equality is written ==, and nothing can be "
                                   "assigned");
    auto       parser = std::make_unique<dealii::FunctionParser<dim>>();
    const bool last_is_time =
      std::count(variables.begin(), variables.end(), ',') == dim;
    try
      {
        const SilentErrorStream silence;
        parser->initialize(variables,
                           with_blanks(expression),
                           {{"pi", dealii::numbers::PI}, {"R", radius}},
                           last_is_time);
        // The parser reads the expression only when it is first evaluated.
        parser->value(dealii::Point<dim>());
      }
    catch (const std::exception &error)
      {
        const std::string remark = remark_on_expression(expression, variables);
        throw InputError(complaint + (remark.empty() ?
                                        words_of_parser(error.what()) :
                                        remark));
      }
    return parser;
  }



  template std::unique_ptr<dealii::FunctionParser<1>>
  make_parser<1>(const std::string &, const std::string &, double);
  template std::unique_ptr<dealii::FunctionParser<3>>
  make_parser<3>(const std::string &, const std::string &, double);
} // namespace Debond
