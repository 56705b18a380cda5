// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_expression_h
#define undine_base_options_expression_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <optional>
#include <string>

namespace undine
{
  /// Where and when an expression had no finite value.
  template <int dim>
  struct UndefinedValue
  {
    dealii::Point<dim> place;    ///< [m]
    double             time = 0; ///< [s]

    /// "(1, 0.5) and 0.3 s"
    std::string
    text() const;
  };


  /// A function of place x, y(, z) [m] and time t [s], written in muParser's language by the user.
  /// `n_components` expressions are separated by ';' (or by ',' where they are plain numbers).
  template <int dim, int n_components = 1>
  class Expression
  {
  public:
    /// Zero everywhere.
    Expression();

    /// Throws InputError, saying why, if the text cannot be evaluated.
    explicit Expression(const std::string &text);

    /// One component at `point` and `time`.
    double
    value(const dealii::Point<dim> &point, double time, unsigned int component = 0) const;

    /// Of this expression and its copies: the latest time at which value() was not a finite number,
    /// and the first place at that time; none: it always was.
    std::optional<UndefinedValue<dim>>
    undefined_value() const;

    /// All components at once, as a vector in space.
    dealii::Tensor<1, n_components>
    vector(const dealii::Point<dim> &point, double time) const;

    const std::string &
    text() const;

    /// True if the time t occurs in the text.
    bool
    names_time() const;

    /// True if a coordinate x, y or z occurs in the text.
    bool
    names_place() const;

    /// True if the text is the number zero (or a list of them): nothing to evaluate.
    bool
    is_zero() const;

  private:
    struct Function;

    std::string               expression;
    bool                      zero;
    std::shared_ptr<Function> function; ///< shared: copies read the same text
  };
} // namespace undine

#endif
