// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/options/similar_words.h>
#include <undine/base/options/values.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace undine
{
  namespace
  {
    /// Shortest of the two usual spellings that gives back the same bits.
    std::string
    shortest(const double value)
    {
      for (const int digits : {6, 15, 17})
        {
          std::ostringstream text;
          text << std::setprecision(digits) << value;
          // Not std::stod, which refuses numbers that are nearly zero.
          if (std::strtod(text.str().c_str(), nullptr) == value)
            return text.str();
        }
      return std::to_string(value);
    }


    template <class Value>
    std::string
    join(const Value &values)
    {
      std::string text;
      for (const auto &value : values)
        text += (text.empty() ? "" : ", ") + write_value(value);
      return text;
    }


    std::vector<std::string>
    split(const std::string &text, const std::size_t expected)
    {
      const auto parts = dealii::Utilities::split_string_list(text, ',');
      if (parts.size() != expected)
        throw InputError("has " + std::to_string(parts.size()) + " entries instead of " +
                         std::to_string(expected) + " (separated by ',')");
      return parts;
    }
  } // namespace


  Allowed
  Allowed::anything()
  {
    return {};
  }


  Allowed
  Allowed::positive()
  {
    return {"> 0", [](const double v) { return v > 0; }, {}};
  }


  Allowed
  Allowed::not_negative()
  {
    return {">= 0", [](const double v) { return v >= 0; }, {}};
  }


  Allowed
  Allowed::between(const double lower, const double upper)
  {
    return {"from " + shortest(lower) + " to " + shortest(upper),
            [=](const double v) { return v >= lower && v <= upper; },
            {}};
  }


  Allowed
  Allowed::below(const double lower, const double upper)
  {
    return {"from " + shortest(lower) + " to below " + shortest(upper),
            [=](const double v) { return v >= lower && v < upper; },
            {}};
  }


  Allowed
  Allowed::one_of(const std::vector<std::string> &words)
  {
    std::string description;
    for (const auto &word : words)
      description += (description.empty() ? "" : " | ") + word;
    return {description, {}, words};
  }


  Allowed
  Allowed::constant_in_time()
  {
    Allowed result;
    result.in_time = false;
    return result;
  }


  void
  read_value(const std::string &text, const Allowed &allowed, double &value)
  {
    char  *end    = nullptr;
    double number = std::strtod(text.c_str(), &end);
    if (text.empty() || end != text.c_str() + text.size())
      try
        {
          const Expression<1> expression(text);
          if (expression.names_time() || expression.names_place())
            throw InputError("names a variable, but must be constant");
          number = expression.value(dealii::Point<1>(), 0);
        }
      catch (const InputError &reason)
        {
          throw InputError(std::string("is not a number: it ") + reason.what());
        }
    if (!std::isfinite(number))
      throw InputError("is not a finite number");
    if (allowed.number && !allowed.number(number))
      throw InputError("is out of range");
    value = number;
  }


  void
  read_value(const std::string &text, const Allowed &allowed, unsigned int &value)
  {
    double number = 0;
    read_value(text, allowed, number);
    if (number != std::floor(number) || number < 0 ||
        number > std::numeric_limits<unsigned int>::max())
      throw InputError("is not a whole number that is zero or more");
    value = static_cast<unsigned int>(number);
  }


  void
  read_value(const std::string &text, const Allowed &, bool &value)
  {
    if (text != "true" && text != "false")
      throw InputError("is neither 'true' nor 'false'");
    value = text == "true";
  }


  void
  read_value(const std::string &text, const Allowed &allowed, std::string &value)
  {
    if (!allowed.words.empty() &&
        std::find(allowed.words.begin(), allowed.words.end(), text) == allowed.words.end())
      {
        const std::string guess = did_you_mean(allowed.words, text);
        throw InputError("is not among the allowed words" + (guess.empty() ? "" : ". " + guess));
      }
    value = text;
  }


  namespace
  {
    /// What is no value of its kind leaves the whole list as it was: mistakes are collected, and
    /// what is read after one must make sense.
    template <class Value>
    void
    read_list(const std::string &text, const Allowed &allowed, std::vector<Value> &values)
    {
      std::vector<Value> result;
      for (const auto &part : dealii::Utilities::split_string_list(text, ','))
        {
          result.emplace_back();
          read_value(part, allowed, result.back());
        }
      values = std::move(result);
    }
  } // namespace


  void
  read_value(const std::string &text, const Allowed &allowed, std::vector<double> &value)
  {
    read_list(text, allowed, value);
  }


  void
  read_value(const std::string &text, const Allowed &allowed, std::vector<std::string> &value)
  {
    read_list(text, allowed, value);
  }


  template <int dim>
  void
  read_value(const std::string &text, const Allowed &allowed, dealii::Tensor<1, dim> &value)
  {
    const auto parts  = split(text, dim);
    auto       result = value;
    for (unsigned int axis = 0; axis < dim; ++axis)
      read_value(parts[axis], allowed, result[axis]);
    value = result;
  }


  template <int dim>
  void
  read_value(const std::string &text, const Allowed &allowed, dealii::Point<dim> &value)
  {
    read_value(text, allowed, static_cast<dealii::Tensor<1, dim> &>(value));
  }


  template <std::size_t n>
  void
  read_value(const std::string &text, const Allowed &allowed, std::array<unsigned int, n> &value)
  {
    const auto parts  = split(text, n);
    auto       result = value;
    for (std::size_t i = 0; i < n; ++i)
      read_value(parts[i], allowed, result[i]);
    value = result;
  }


  std::string
  write_value(const double value)
  {
    return shortest(value);
  }


  std::string
  write_value(const unsigned int value)
  {
    return std::to_string(value);
  }


  std::string
  write_value(const bool value)
  {
    return value ? "true" : "false";
  }


  std::string
  write_value(const std::string &value)
  {
    return value;
  }


  std::string
  write_value(const std::vector<double> &value)
  {
    return join(value);
  }


  std::string
  write_value(const std::vector<std::string> &value)
  {
    return join(value);
  }


  template <int dim>
  std::string
  write_value(const dealii::Tensor<1, dim> &value)
  {
    std::array<double, dim> numbers;
    for (unsigned int axis = 0; axis < dim; ++axis)
      numbers[axis] = value[axis];
    return join(numbers);
  }


  template <std::size_t n>
  std::string
  write_value(const std::array<unsigned int, n> &value)
  {
    return join(value);
  }


  template void
  read_value(const std::string &, const Allowed &, dealii::Tensor<1, 2> &);
  template void
  read_value(const std::string &, const Allowed &, dealii::Tensor<1, 3> &);
  template void
  read_value(const std::string &, const Allowed &, dealii::Point<2> &);
  template void
  read_value(const std::string &, const Allowed &, dealii::Point<3> &);
  template void
  read_value(const std::string &, const Allowed &, std::array<unsigned int, 2> &);
  template void
  read_value(const std::string &, const Allowed &, std::array<unsigned int, 3> &);
  template std::string
  write_value(const dealii::Tensor<1, 2> &);
  template std::string
  write_value(const dealii::Tensor<1, 3> &);
  template std::string
  write_value(const std::array<unsigned int, 2> &);
  template std::string
  write_value(const std::array<unsigned int, 3> &);
} // namespace undine
