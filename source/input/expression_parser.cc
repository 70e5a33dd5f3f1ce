#include <debond/input/allowed_values.h>
#include <debond/input/expression_parser.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <muParser.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <memory>
#include <regex>
#include <utility>

namespace Debond
{
  namespace
  {
    /** Why the parser must not see an expression, or nothing: it would take it
     *  for something else than it is meant to be. */
    std::string
    why_refused(const std::string &expression)
    {
      constexpr std::size_t longest = 10000;
      if (expression.size() > longest)
        return "it has more than " + std::to_string(longest) + " letters";
      static const std::regex assignment("(^|[^<>!=])=([^=]|$)");
      if (std::regex_search(expression, assignment))
        return "equality is written ==, and nothing can be assigned";
      return remark_on_special_character(expression);
    }



    /** What doc/reference/scene_file.md lists and muParser has not, or has with
     *  less digits. */
    void
    define_functions(mu::Parser &parser)
    {
      const std::vector<std::pair<const char *, mu::fun_type1>> functions{
        {"acosh", ::acosh},
        {"asinh", ::asinh},
        {"atanh", ::atanh},
        {"ceil", ::ceil},
        {"cot", [](double x) { return 1. / std::tan(x); }},
        {"csc", [](double x) { return 1. / std::sin(x); }},
        {"erf", ::erf},
        {"erfc", ::erfc},
        {"floor", ::floor},
        {"log2", ::log2},
        {"sec", [](double x) { return 1. / std::cos(x); }}};
      for (const auto &[name, function] : functions)
        parser.DefineFun(name, function);
      parser.DefineFun("pow", static_cast<mu::fun_type2>(::pow));
      parser.DefineFun("if", [](double, double a, double) { return a; });
    }



    /** The same with `(a)?(b):(c)` for `if(a, b, c)`: of these the parser
     *  computes the one that is chosen. */
    std::string
    with_choices(std::string text)
    {
      // behind the last one there is no other
      for (auto at = text.rfind("if("); at != text.npos; at = text.rfind("if("))
        {
          text.replace(at, 2, "(");
          unsigned int depth = 1, n_commas = 0;
          for (at += 2; depth > 0 && at < text.size(); ++at)
            {
              depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
              if (depth == 1 && text[at] == ',')
                {
                  text.replace(at, 1, n_commas++ == 0 ? ")?(" : "):(");
                  at += 2;
                }
            }
          text.insert(at, ")");
        }
      return text;
    }
  } // namespace



  // Whether a part had a value is known to the processor: a root of a negative
  // number is an invalid operation to it, a pole a division by zero.
  Expression
  read_expression(const std::string &variables,
                  const std::string &expression,
                  const double       radius)
  {
    const auto refuse = [&](const std::string &why) {
      throw InputError("this expression" +
                       (variables.empty() ? "" : " in " + variables) +
                       " cannot be read: " + why);
    };
    const std::string why = why_refused(expression);
    if (!why.empty())
      refuse(why);

    const auto names  = dealii::Utilities::split_string_list(variables);
    const auto shared = std::make_shared<mu::Parser>();
    const auto variables_at =
      std::make_shared<std::vector<double>>(names.size());
    mu::Parser &parser = *shared;
    for (std::size_t i = 0; i < names.size(); ++i)
      parser.DefineVar(names[i], &(*variables_at)[i]);
    parser.DefineConst("pi", dealii::numbers::PI);
    parser.DefineConst("R", radius);
    parser.EnableOptimizer(false); // it would compute what is never chosen
    define_functions(parser);
    // The parser wants the parenthesis of a function right behind its name.
    std::string text = expression;
    for (auto at = text.rfind(" ("); at != text.npos; at = text.rfind(" (", at))
      std::swap(text[at], text[at + 1]);
    try
      {
        parser.SetExpr(text);
        parser.Eval(); // reads it; messages are about what was written
        parser.SetExpr(with_choices(text));
        parser.Eval();
      }
    catch (const mu::Parser::exception_type &error)
      {
        refuse(shortened(error.GetMsg()) +
               " (expressions are like 2 * pi * t^2, without units and quotes; "
               "and, or are written &&, ||)");
      }
    if (parser.GetNumResults() > 1)
      refuse("decimals are written with a point");

    return [shared, variables_at](const std::vector<double> &values) {
      std::copy(values.begin(), values.end(), variables_at->begin());
      std::feclearexcept(FE_ALL_EXCEPT);
      const double value = shared->Eval();
      return std::fetestexcept(FE_INVALID | FE_DIVBYZERO) == 0 ?
               value :
               std::numeric_limits<double>::quiet_NaN();
    };
  }



  TimeFunction
  read_time_function(const std::string  &expression,
                     const double        radius,
                     const TimeFunction &given)
  {
    TimeFunction function = given;
    if (const auto number = read_number(expression); !function && number)
      return [value = *number](double) { return value; };
    if (!function)
      function = [in_t = read_expression("t", expression, radius)](
                   const double t) { return in_t({t}); };
    const std::string remark =
      read_number(expression) ? "" : remark_on_no_value;
    return [function, remark](const double t) {
      const double value = function(t);
      if (!std::isfinite(value))
        throw InputError("it has no finite value at t = " + to_text(t) +
                         remark);
      return value;
    };
  }
} // namespace Debond
