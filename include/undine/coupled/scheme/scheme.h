// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_scheme_scheme_h
#define undine_coupled_scheme_scheme_h

#include <undine/base/core/timing.h>
#include <undine/base/options/options.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/report.h>
#include <undine/coupled/state/state.h>

#include <functional>
#include <string>

namespace undine
{
  /// A way to take fluid and bodies from one time to the next. During a run the only writer of
  /// State, but for the clock, which the loop over steps advances.
  template <int dim>
  class Scheme
  {
  public:
    virtual ~Scheme() = default;

    /// Declare and read the keys of this scheme.
    virtual void
    add_options(const Options &options) = 0;

    /// The discretisation of fluid and bodies, which decides on the models that the scheme gets.
    enum class Method
    {
      grid_and_elements,
      particles
    };

    /// The method by which fluid and bodies are discretised.
    virtual Method
    method() const
    {
      return Method::grid_and_elements;
    }

    /// Bring an empty state to t = 0; the report holds the columns of that state. The references
    /// must outlive the scheme. Collective. Throws InputError, SolveError.
    virtual Report
    initialize(State<dim> &state, const Models<dim> &models, TimingTree &timing) = 0;

    /// The step to try next [s]; lands on the clock's landing times.
    virtual double
    choose_dt(const State<dim> &state) const = 0;

    /// Is told, in words, how far a step is; returns false if the step is to be abandoned.
    using Follower = std::function<bool(const std::string &)>;

    /// From now on tell `follower` of steps that take longer than a second, about every second.
    /// Schemes that do not know how far a step is tell nothing.
    virtual void
    follow(const Follower &)
    {
    }

    /// Advance fluid and bodies (of the clock only Clock::limit) by at most `dt` [s]. Throws
    /// SolveError if no step can be accepted; the state is then the one before the step.
    /// Collective.
    virtual Report
    step(State<dim> &state, double dt) = 0;
  };
} // namespace undine

#endif
