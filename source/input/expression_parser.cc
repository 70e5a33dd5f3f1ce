#include <debond/input/allowed_values.h>
#include <debond/input/expression_parser.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <locale>
#include <map>
#include <memory>
#include <numeric>
#include <regex>
#include <utility>
#include <vector>

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
      const std::string special = remark_on_special_character(expression);
      if (!special.empty())
        return special;
      if (expression.find("**") != std::string::npos)
        return "powers are written ^";
      static const std::regex assignment("(^|[^<>!=])=([^=]|$)");
      if (std::regex_search(expression, assignment))
        return "equality is written ==, and nothing can be assigned";
      return "";
    }



    /** What is meant by a @p token that the parser does not know, which may be
     *  a name of another language or one in capitals; nothing if that is not
     *  known either. */
    std::string
    remark_on_token(const std::string              &token,
                    const std::vector<std::string> &names)
    {
      const std::string remainder =
        "the remainder of a divided by b is written a - b * floor(a / b)";
      const std::map<std::string, std::string> foreign{
        {"mod", remainder},
        {"fmod", remainder},
        {"%", remainder},
        {"and", "`and' is written &&"},
        {"&", "`and' is written &&"},
        {"or", "`or' is written ||"},
        {"e", "the exponential function is written exp(x)"},
        {"|", "absolute values are written abs(x)"},
        {"int",
         "int rounds in one language and cuts in another: rint(x) is the "
         "nearest whole number, floor(x) the next one below"},
        {"rand", "rand would make another scene of it every time"},
        {";", "it holds a ;"}};
      std::smatch       word;
      const std::string beginning = shortened(token);
      std::regex_search(beginning, word, std::regex("^(\\w+|.)"));
      const auto found = foreign.find(word.str());
      if (found != foreign.end())
        return found->second;
      const std::string lower =
        boost::to_lower_copy(word.str(), std::locale::classic());
      if (lower != word.str() &&
          std::find(names.begin(), names.end(), lower) != names.end())
        return "it is written " + lower + ", not " + word.str();
      return "";
    }


    // What has no value has none within something else: comparisons, min and
    // max of muParser would make a number of it. A number too large for the
    // machine is infinite, which compares as it should; at a pole there is no
    // value, because its sign would be that of a zero.
    constexpr double no_value = std::numeric_limits<double>::quiet_NaN();



    template <typename Comparison>
    double
    compare(const double a, const double b)
    {
      return std::isunordered(a, b) ? no_value : Comparison()(a, b);
    }



    /** The least or largest of @p n numbers. */
    template <typename Comparison>
    double
    first_of(const double *const x, const int n)
    {
      double first = x[0];
      for (int i = 1; i < n; ++i)
        first = std::isunordered(x[i], first) ? no_value :
                Comparison()(x[i], first)     ? x[i] :
                                                first;
      return first;
    }



    template <double (*function)(double)>
    double
    without_poles(const double x)
    {
      const double value = function(x);
      return std::isinf(value) && std::isfinite(x) ? no_value : value;
    }



    /** A negative number has no power that is not whole, also where it is too
     *  large for the machine. */
    double
    power(const double a, const double b)
    {
      if (std::isunordered(a, b) || (a == 0. && b < 0.) ||
          (a < 0. && b != std::floor(b)))
        return no_value;
      return b == 2. ? a * a : std::pow(a, b);
    }



    /** 1 or 0: what is not 0 is true. */
    double
    truth(const double condition)
    {
      return compare<std::not_equal_to<>>(condition, 0.);
    }



    /** What is not chosen may have no value. */
    double
    choose(const double condition, const double a, const double b)
    {
      const double is_true = truth(condition);
      return std::isnan(is_true) ? no_value : is_true != 0. ? a : b;
    }



    void
    define_operators(mu::Parser &parser)
    {
      const auto define = [&parser](const char *const         name,
                                    const mu::fun_type2       function,
                                    const mu::EOprtPrecedence precedence) {
        parser.DefineOprt(name,
                          function,
                          precedence,
                          precedence == mu::prPOW ? mu::oaRIGHT : mu::oaLEFT,
                          true);
      };
      parser.EnableBuiltInOprt(false);
      define(
        "||",
        [](double a, double b) { return choose(a, 1., truth(b)); },
        mu::prLOR);
      define(
        "&&",
        [](double a, double b) { return choose(a, truth(b), 0.); },
        mu::prLAND);
      define("<", compare<std::less<>>, mu::prCMP);
      define("<=", compare<std::less_equal<>>, mu::prCMP);
      define(">", compare<std::greater<>>, mu::prCMP);
      define(">=", compare<std::greater_equal<>>, mu::prCMP);
      define("==", compare<std::equal_to<>>, mu::prCMP);
      define("!=", compare<std::not_equal_to<>>, mu::prCMP);
      define(
        "+", [](double a, double b) { return a + b; }, mu::prADD_SUB);
      define(
        "-", [](double a, double b) { return a - b; }, mu::prADD_SUB);
      define(
        "*", [](double a, double b) { return a * b; }, mu::prMUL_DIV);
      define(
        "/",
        [](double a, double b) { return b == 0. ? no_value : a / b; },
        mu::prMUL_DIV);
      define("^", power, mu::prPOW);
    }



    /** All that doc/reference/scene_file.md lists, and no more: what they mean
     * does not depend on the version of muParser. */
    void
    define_functions(mu::Parser &parser)
    {
      parser.ClearFun();
      const std::vector<std::pair<const char *, mu::fun_type1>> of_one{
        {"abs", ::fabs},
        {"acos", ::acos},
        {"acosh", ::acosh},
        {"asin", ::asin},
        {"asinh", ::asinh},
        {"atan", ::atan},
        {"atanh", without_poles<::atanh>},
        {"ceil", ::ceil},
        {"cos", ::cos},
        {"cosh", ::cosh},
        {"cot", [](double x) { return choose(x, 1. / std::tan(x), no_value); }},
        {"csc", [](double x) { return choose(x, 1. / std::sin(x), no_value); }},
        {"erf", ::erf},
        {"erfc", ::erfc},
        {"exp", ::exp},
        {"floor", ::floor},
        {"ln", without_poles<::log>},
        {"log", without_poles<::log>},
        {"log10", without_poles<::log10>},
        {"log2", without_poles<::log2>},
        {"rint",
         [](double x) {
           return std::floor(x) + (x - std::floor(x) >= 0.5); // halves go up
         }},
        {"sec", [](double x) { return 1. / std::cos(x); }},
        {"sign", [](double x) { return x > 0. ? 1. :
                                       x < 0. ? -1. :
                                                x; }},
        {"sin", ::sin},
        {"sinh", ::sinh},
        {"sqrt", ::sqrt},
        {"tan", ::tan},
        {"tanh", ::tanh}};
      for (const auto &[name, function] : of_one)
        parser.DefineFun(name, function);
      const auto sum = [](const double *const x, const int n) {
        return std::accumulate(x, x + n, 0.);
      };
      const auto mean = [](const double *const x, const int n) {
        return std::accumulate(x, x + n, 0.) / n;
      };
      parser.DefineFun("sum", sum);
      parser.DefineFun("avg", mean);
      parser.DefineFun("min", first_of<std::less<>>);
      parser.DefineFun("max", first_of<std::greater<>>);
      parser.DefineFun("pow", power);
      parser.DefineFun("atan2", static_cast<mu::fun_type2>(::atan2));
      parser.DefineFun("if", choose);
    }



    /** Where one of @p letters stands from @p begin on, in steps of 1 or -1,
     *  outside of parentheses that open after it. */
    std::size_t
    find_outside(const std::string &text,
                 const std::size_t  begin,
                 const int          step,
                 const char *const  letters)
    {
      int depth = 0;
      for (std::size_t at = begin; at < text.size(); at += step)
        {
          if (depth == 0 && std::strchr(letters, text[at]) != nullptr)
            return at;
          depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
        }
      return step > 0 ? text.size() : std::string::npos;
    }



    /** The same with `if(a, b, c)` for `a ? b : c`, whose meaning to the parser
     *  cannot be changed: for it, what has no value is true. */
    std::string
    with_if(std::string text)
    {
      // behind the last one there is no other
      for (auto mark = text.rfind('?'); mark != std::string::npos;
           mark      = text.rfind('?'))
        {
               const auto begin = find_outside(text, mark - 1, -1, "(,?:") + 1,
                          colon = find_outside(text, mark + 1, 1, ":"),
                          end   = find_outside(text, colon + 1, 1, "),:");
               text =
                 text.substr(0, begin) + "if(" + text.substr(begin, mark - begin) +
                 "," + text.substr(mark + 1, colon - mark - 1) + "," +
                 text.substr(colon + 1, end - colon - 1) + ")" + text.substr(end);
        }
      return text;
    }
  } // namespace



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

    std::vector<std::string> names =
      dealii::Utilities::split_string_list(variables);
    const auto shared = std::make_shared<mu::Parser>();
    const auto variables_at =
      std::make_shared<std::vector<double>>(names.size());
    mu::Parser &parser = *shared;
    for (std::size_t i = 0; i < names.size(); ++i)
      parser.DefineVar(names[i], &(*variables_at)[i]);
    parser.DefineConst("pi", dealii::numbers::PI);
    parser.DefineConst("R", radius);
    define_operators(parser);
    define_functions(parser);
    // The parser wants the parenthesis of a function right behind its name.
    std::string text = expression;
    for (auto at = text.rfind(" ("); at != text.npos; at = text.rfind(" (", at))
      std::swap(text[at], text[at + 1]);
    try
      {
        parser.SetExpr(text);
        parser.Eval(); // reads it; messages are about what was written
        parser.SetExpr(with_if(text));
        parser.Eval();
      }
    catch (const mu::Parser::exception_type &error)
      {
        names.insert(names.end(), {"pi", "R"});
        const bool is_quoted =
          expression.find_first_of("\"'`") != std::string::npos;
        const std::string remark = is_quoted ?
                                     "it stands without quotes" :
                                     remark_on_token(error.GetToken(), names);
        const bool no_product    = error.GetCode() == mu::ecUNEXPECTED_VAR ||
                                error.GetCode() == mu::ecUNEXPECTED_FUN ||
                                error.GetCode() == mu::ecUNEXPECTED_VAL;
        refuse(!remark.empty() ?
                 remark :
                 shortened(error.GetMsg()) +
                   (no_product ? "; a product is written a * b" : ""));
      }
    if (parser.GetNumResults() > 1)
      refuse("decimals are written with a point");

    return [shared, variables_at](const std::vector<double> &values) {
      std::copy(values.begin(), values.end(), variables_at->begin());
      return shared->Eval();
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
