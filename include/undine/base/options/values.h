// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_values_h
#define undine_base_options_values_h

#include <undine/base/options/expression.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace undine
{
  /// Which values a key may take: a test for each number, or a list of words.
  struct Allowed
  {
    std::string                 description;    ///< "> 0", "a | b | c"; empty: anything
    std::function<bool(double)> number;         ///< empty: every finite number
    std::vector<std::string>    words;          ///< empty: every text
    bool                        in_time = true; ///< of an expression: may name the time t

    static Allowed
    anything();
    static Allowed
    positive();
    static Allowed
    not_negative();
    /// lower <= v <= upper
    static Allowed
    between(double lower, double upper);
    /// lower <= v < upper
    static Allowed
    below(double lower, double upper);
    static Allowed
    one_of(const std::vector<std::string> &words);
    /// An expression of place alone, for what is evaluated once.
    static Allowed
    constant_in_time();
  };

  /// Convert text to a value, or throw InputError whose text continues "the value 'abc' ...".
  /// Numbers may be written as expressions without variables: "1/30", "2*pi".
  /// @{
  void
  read_value(const std::string &text, const Allowed &allowed, double &value);
  void
  read_value(const std::string &text, const Allowed &allowed, unsigned int &value);
  void
  read_value(const std::string &text, const Allowed &allowed, bool &value);
  void
  read_value(const std::string &text, const Allowed &allowed, std::string &value);
  void
  read_value(const std::string &text, const Allowed &allowed, std::vector<double> &value);
  void
  read_value(const std::string &text, const Allowed &allowed, std::vector<std::string> &value);
  template <int dim>
  void
  read_value(const std::string &text, const Allowed &allowed, dealii::Tensor<1, dim> &value);
  template <int dim>
  void
  read_value(const std::string &text, const Allowed &allowed, dealii::Point<dim> &value);
  template <std::size_t n>
  void
  read_value(const std::string &text, const Allowed &allowed, std::array<unsigned int, n> &value);
  template <int dim, int n_components>
  void
  read_value(const std::string &text, const Allowed &allowed, Expression<dim, n_components> &value)
  {
    const Expression<dim, n_components> expression(text);
    if (!allowed.in_time && expression.names_time())
      throw InputError("names the time t, but is evaluated only once");
    value = expression;
  }
  /// @}

  /// The text from which read_value() makes the same value.
  /// @{
  std::string
  write_value(double value);
  std::string
  write_value(unsigned int value);
  std::string
  write_value(bool value);
  std::string
  write_value(const std::string &value);
  std::string
  write_value(const std::vector<double> &value);
  std::string
  write_value(const std::vector<std::string> &value);
  template <int dim>
  std::string
  write_value(const dealii::Tensor<1, dim> &value);
  template <std::size_t n>
  std::string
  write_value(const std::array<unsigned int, n> &value);
  template <int dim, int n_components>
  std::string
  write_value(const Expression<dim, n_components> &value)
  {
    return value.text();
  }
  /// @}

  /// What a value of this type looks like, for the reference: "number", "3 numbers", "text", ...
  /// @{
  inline std::string
  type_name(const double &)
  {
    return "number";
  }
  inline std::string
  type_name(const unsigned int &)
  {
    return "whole number";
  }
  inline std::string
  type_name(const bool &)
  {
    return "true | false";
  }
  inline std::string
  type_name(const std::string &)
  {
    return "text";
  }
  inline std::string
  type_name(const std::vector<double> &)
  {
    return "list of numbers";
  }
  inline std::string
  type_name(const std::vector<std::string> &)
  {
    return "list of words";
  }
  template <int dim>
  std::string
  type_name(const dealii::Tensor<1, dim> &)
  {
    return std::to_string(dim) + " numbers";
  }
  template <std::size_t n>
  std::string
  type_name(const std::array<unsigned int, n> &)
  {
    return std::to_string(n) + " whole numbers";
  }
  template <int dim, int n_components>
  std::string
  type_name(const Expression<dim, n_components> &)
  {
    const std::string variables = dim == 1 ? "x, t" : (dim == 2 ? "x, y, t" : "x, y, z, t");
    return (n_components == 1 ? "expression in "
                              : std::to_string(n_components) + " expressions (';' between) in ") +
           variables;
  }
  /// @}
} // namespace undine

#endif
