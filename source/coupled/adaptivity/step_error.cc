// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/adaptivity/step_error.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr unsigned int n_samples = 4; // as many as the third derivative of a velocity takes

    // Share of the bodies' extent that they are taken to move at least.
    constexpr double least_share = 1e-3;

    // Of the tolerance, for displacements that grow.
    constexpr double growing_share = 0.25;

    // Share of the tolerance that one step may use up.
    constexpr double step_share = 0.25;

    // That of a fluid alone in steps of one stage: forces and friction act at the end.
    constexpr TimeAccuracy fluid_accuracy{1, 0.5};


    template <int dim>
    TimeAccuracy
    accuracy_of(const Models<dim> &models, const TimeIntegrator &integrator)
    {
      const bool by_stages = integrator.stages(1, RatesAtBegin::known).front().keeps_rates();
      return models.solid || by_stages ? integrator.accuracy() : fluid_accuracy;
    }


    /// C h^(p+1) |y^(p+1)|.
    double
    error_of_step(const TimeAccuracy &accuracy, const double dt, const double derivative)
    {
      return accuracy.constant * std::pow(dt, accuracy.order + 1) * derivative;
    }
  } // namespace


  template <int dim>
  StepError<dim>::StepError(const Models<dim>    &models,
                            const TimeIntegrator &integrator,
                            const Settings       &settings)
    : models(models)
    , norms(models)
    , settings(settings)
    , accuracy(accuracy_of(models, integrator))
    , least_size(!models.solid               ? 0
                 : settings.displacement > 0 ? settings.displacement
                                             : least_share * norms.extent_of_bodies())
  {
  }


  template <int dim>
  double
  StepError<dim>::size(const State<dim> &state) const
  {
    return models.solid ? norms.of_bodies(state.solid.displacement)
                        : norms.of_fluid(state.fluid.velocity);
  }


  template <int dim>
  void
  StepError<dim>::start(State<dim> &state) const
  {
    auto &history = state.history;
    history       = History();
    history.samples.assign(n_samples, norms.sample(state, state.clock.time));
    history.before  = history.samples.front();
    history.uncut   = norms.zero_velocity();
    history.largest = size(state);
    history.step    = settings.first_step;
    take_sample(state, state.clock.time);
  }


  template <int dim>
  void
  StepError<dim>::take_sample(State<dim> &state, const double time) const
  {
    auto &history = state.history;
    history.samples.pop_back();
    history.samples.insert(history.samples.begin(), norms.sample(state, time));
    history.n_samples = std::min(history.n_samples + 1, n_samples);
    norms.count_uncut(history.uncut, state.fluid.velocity);
  }


  template <int dim>
  bool
  StepError<dim>::is_too_large(const State<dim> &old_state,
                               const State<dim> &state,
                               const double      dt) const
  {
    const auto &history = state.history;
    const auto  order   = accuracy.order;
    if (!models.solid || state.clock.step + 1 < order)
      return false;
    const auto                                    now = norms.sample(state, state.clock.time + dt);
    const auto                                    old = norms.sample(old_state, state.clock.time);
    std::vector<const typename History::Sample *> samples{&now, &old};
    if (order > 1)
      samples.push_back(&history.before);
    const double error = error_of_step(accuracy, dt, norms.bodies_derivative(samples));
    return error > step_share * settings.tolerance * std::max(scale(history), size(state));
  }


  template <int dim>
  double
  StepError<dim>::scale(const History &history) const
  {
    return std::max(history.largest, least_size);
  }


  template <int dim>
  double
  StepError<dim>::allowed_rate(const State<dim> &state, const double time) const
  {
    const auto  &history = state.history;
    const double run     = std::max(state.clock.end_time, time);
    const double even    = settings.tolerance * scale(history) / run;
    const bool   grows   = models.solid && size(state) >= history.largest;
    return even + (grows
                     ? growing_share * settings.tolerance * norms.of_bodies(state.solid.velocity)
                     : 0.);
  }


  template <int dim>
  void
  StepError<dim>::accept(State<dim> &state, const State<dim> &old_state, const Report &report) const
  {
    const double dt      = report.dt;
    auto        &history = state.history;
    const double time    = state.clock.time + dt;
    const double run     = std::max(state.clock.end_time, time);
    history.largest      = std::max(history.largest, size(state));
    history.error += error_of_step(accuracy, dt, history.derivative);
    history.before = norms.sample(old_state, state.clock.time);

    if (history.n_samples < n_samples ||
        time - history.samples.front().time > interval(history, dt, run) - dt / 2)
      {
        take_sample(state, time);
        if (history.n_samples == n_samples)
          estimate(history, allowed_rate(state, time));
      }
    if (report.halvings > 0)
      history.step = dt;
    else if (history.best_step > 0)
      history.step = std::min(2 * history.step, history.next_step);
    history.step = std::min(settings.longest_step, std::max(settings.shortest_step, history.step));
  }


  template <int dim>
  double
  StepError<dim>::interval(const History &history, const double dt, const double run) const
  {
    const unsigned int p = accuracy.order;
    const double wanted  = std::pow(4 * accuracy.constant * std::pow(dt, p) * run, 1. / (p + 1));
    // In the beginning intervals grow with the time that is known.
    return std::min(wanted, (history.samples.front().time - history.samples.back().time) / 2);
  }


  template <int dim>
  double
  StepError<dim>::derivative(const History &history, const unsigned int order) const
  {
    if (!models.solid)
      return norms.fluid_derivative(history, order);
    std::vector<const typename History::Sample *> samples;
    for (unsigned int i = 0; i < order; ++i) // d = int u dt
      samples.push_back(&history.samples[i]);
    return norms.bodies_derivative(samples);
  }


  template <int dim>
  void
  StepError<dim>::estimate(History &history, const double allowed) const
  {
    const auto   p      = accuracy.order;
    const double middle = derivative(history, p + 1);
    history.derivative =
      models.solid
        ? std::hypot(middle, std::sqrt(derivative(history, p) * derivative(history, p + 2)))
        : middle;
    const double rate = accuracy.constant * history.derivative;
    const double best = rate * std::pow(settings.longest_step, p) > allowed
                          ? std::pow(allowed / rate, 1. / p)
                          : settings.longest_step;
    history.next_step = history.best_step > 0 ? std::sqrt(best * history.best_step) : best;
    history.best_step = best;
  }


  template <int dim>
  double
  StepError<dim>::error(const History &history) const
  {
    return scale(history) > 0 ? history.error / scale(history) : 0;
  }


  template <int dim>
  bool
  StepError<dim>::is_missed(const History &history) const
  {
    return history.next_step < settings.shortest_step && error(history) > settings.tolerance;
  }


  template class StepError<2>;
  template class StepError<3>;
} // namespace undine
