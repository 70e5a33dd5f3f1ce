#include <debond/input/allowed_values.h>
#include <debond/input/expression_parser.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/mu_parser_internal.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <regex>
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
        {"rand", "rand would make another scene of it every time"},
        {";", "it holds a ;"}};
      std::smatch       word;
      const std::string beginning = shortened(token);
      std::regex_search(beginning, word, std::regex("^(\\w+|.)"));
      const auto found = foreign.find(word.str());
      if (found != foreign.end())
        return found->second;
      const std::string lower = boost::to_lower_copy(word.str());
      if (lower != word.str() &&
          std::find(names.begin(), names.end(), lower) != names.end())
        return "it is written " + lower + ", not " + word.str();
      return "";
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
    namespace functions = dealii::internal::FunctionParser;
    parser.DefineFun("if", functions::mu_if);
    parser.DefineFun("int", functions::mu_int);
    parser.DefineFun("ceil", functions::mu_ceil);
    parser.DefineFun("floor", functions::mu_floor);
    parser.DefineFun("cot", functions::mu_cot);
    parser.DefineFun("csc", functions::mu_csc);
    parser.DefineFun("sec", functions::mu_sec);
    parser.DefineFun("pow", functions::mu_pow);
    parser.DefineFun("erf", functions::mu_erf);
    parser.DefineFun("erfc", functions::mu_erfc);
    // The parser wants the parenthesis of a function right behind its name.
    std::string text = expression;
    for (auto at = text.rfind(" ("); at != text.npos; at = text.rfind(" (", at))
      std::swap(text[at], text[at + 1]);
    try
      {
        parser.SetExpr(text);
        parser.Eval(); // reads it
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
    return [function](const double t) {
      const double value = function(t);
      if (!std::isfinite(value))
        throw InputError("it has no finite value at t = " + to_text(t));
      return value;
    };
  }
} // namespace Debond
