// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/options/expression.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <regex>
#include <sstream>

namespace undine
{
  namespace
  {
    template <int dim>
    std::string
    variables()
    {
      return dealii::FunctionParser<dim>::default_variable_names() + ",t";
    }


    /// "1, 0" -> "1;0" if the text has no ';' and as many commas as needed, else the text.
    std::string
    semicolons(const std::string &text, const unsigned int n_components)
    {
      const bool plain_list = text.find(';') == std::string::npos &&
                              text.find('(') == std::string::npos &&
                              std::count(text.begin(), text.end(), ',') == int(n_components) - 1;
      std::string result = text;
      if (plain_list)
        std::replace(result.begin(), result.end(), ',', ';');
      return result;
    }


    /// What follows "Message:" in muParser's report.
    std::string
    first_message(const std::string &report)
    {
      const std::string mark  = "Message:";
      const auto        begin = report.find(mark);
      if (begin == std::string::npos)
        return "muParser cannot read it";
      const auto from = begin + mark.size();
      return dealii::Utilities::trim(report.substr(from, report.find('\n', from) - from));
    }


    /// muParser takes the last of several values: 1,5 would be 5.
    void
    assert_one_value(const std::string &text)
    {
      int depth = 0;
      for (const char c : text)
        {
          depth += c == '(' ? 1 : (c == ')' ? -1 : 0);
          if (c == ',' && depth <= 0)
            throw InputError(
              "has several values, separated by ',', where one is expected. Decimals "
              "are written with a point: 1.5");
        }
    }


    /// What draws random numbers gives every rank and every run its own.
    void
    assert_repeatable(const std::string &text)
    {
      static const std::regex random("\\brand(_seed)?\\b");
      if (std::regex_search(text, random))
        throw InputError("draws random numbers, which would differ from rank to rank and from run "
                         "to run. Try: a sum of sines of several wave lengths");
    }


    bool
    only_zeros(const std::string &text)
    {
      return text.find_first_not_of("0.;, ") == std::string::npos;
    }
  } // namespace


  template <int dim>
  std::string
  UndefinedValue<dim>::text() const
  {
    std::string result;
    for (unsigned int d = 0; d < dim; ++d)
      result += fmt::format("{}{:.6g}", d == 0 ? "(" : ", ", place[d]);
    return result + fmt::format(") and {:.6g} s", time);
  }


  template <int dim, int n_components>
  struct Expression<dim, n_components>::Function
  {
    dealii::FunctionParser<dim>        parser{n_components};
    std::optional<UndefinedValue<dim>> undefined;
  };


  template <int dim, int n_components>
  Expression<dim, n_components>::Expression()
    : Expression(n_components == 1 ? "0" : (n_components == 2 ? "0; 0" : "0; 0; 0"))
  {
  }


  template <int dim, int n_components>
  Expression<dim, n_components>::Expression(const std::string &text)
    : expression(text)
    , zero(only_zeros(text))
    , function(std::make_shared<Function>())
  {
    const std::string list       = semicolons(text, n_components);
    const auto        parts      = dealii::Utilities::split_string_list(list, ';');
    const auto        separators = std::count(list.begin(), list.end(), ';');
    if (parts.size() != n_components || separators != n_components - 1)
      throw InputError("needs " + std::to_string(n_components) +
                       " expression(s), with ';' between, but has " +
                       std::to_string(separators + 1));
    for (const auto &part : parts)
      assert_one_value(part);
    assert_repeatable(text);
    // deal.II prints muParser's complaint before it throws: keep it for the message.
    std::ostringstream complaint;
    auto *const        screen = std::cerr.rdbuf(complaint.rdbuf());
    try
      {
        function->parser.initialize(variables<dim>(), list, {{"pi", dealii::numbers::PI}}, true);
        dealii::Point<dim> somewhere;
        for (unsigned int c = 0; c < n_components; ++c)
          function->parser.value(somewhere, c);
        std::cerr.rdbuf(screen);
      }
    catch (const std::exception &)
      {
        std::cerr.rdbuf(screen);
        const auto reason = first_message(complaint.str());
        // What muParser says of an operator without an operand.
        throw InputError(
          "is not an expression in " + variables<dim>() + ": " +
          (reason.find("Internal error") == std::string::npos ? reason : "a part is missing"));
      }
  }


  template <int dim, int n_components>
  double
  Expression<dim, n_components>::value(const dealii::Point<dim> &point,
                                       const double              time,
                                       const unsigned int        component) const
  {
    if (zero)
      return 0;
    function->parser.set_time(time);
    const double result = function->parser.value(point, component);
    if (auto &undefined = function->undefined;
        !std::isfinite(result) && (!undefined || undefined->time < time))
      undefined = {point, time};
    return result;
  }


  template <int dim, int n_components>
  std::optional<UndefinedValue<dim>>
  Expression<dim, n_components>::undefined_value() const
  {
    return function->undefined;
  }


  template <int dim, int n_components>
  dealii::Tensor<1, n_components>
  Expression<dim, n_components>::vector(const dealii::Point<dim> &point, const double time) const
  {
    dealii::Tensor<1, n_components> result;
    for (unsigned int c = 0; c < n_components; ++c)
      result[c] = value(point, time, c);
    return result;
  }


  template <int dim, int n_components>
  bool
  Expression<dim, n_components>::names_time() const
  {
    static const std::regex time("\\bt\\b");
    return std::regex_search(expression, time);
  }


  template <int dim, int n_components>
  bool
  Expression<dim, n_components>::names_place() const
  {
    static const std::regex place("\\b[xyz]\\b");
    return std::regex_search(expression, place);
  }


  template <int dim, int n_components>
  const std::string &
  Expression<dim, n_components>::text() const
  {
    return expression;
  }


  template <int dim, int n_components>
  bool
  Expression<dim, n_components>::is_zero() const
  {
    return zero;
  }


  template struct UndefinedValue<1>;
  template struct UndefinedValue<2>;
  template struct UndefinedValue<3>;
  template class Expression<1, 1>;
  template class Expression<2, 1>;
  template class Expression<3, 1>;
  template class Expression<2, 2>;
  template class Expression<3, 3>;
} // namespace undine
