// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/adaptivity/steadiness.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace undine
{
  namespace
  {
    // Steps that end at multiples of their length miss the end of a time by rounding.
    constexpr double all_but_rounding = 1 - 1e-9;


    /// On bodies and obstacles.
    std::vector<double>
    forces_of_fluid(const Columns &columns)
    {
      std::vector<double> result;
      for (const auto &column : columns)
        for (const std::string what : {"pressure force ", "viscous force "})
          if (column.name.compare(0, what.size(), what) == 0)
            result.push_back(column.value);
      return result;
    }


    double
    length(const std::vector<double> &vector)
    {
      double sum = 0;
      for (const double value : vector)
        sum += value * value;
      return std::sqrt(sum);
    }
  } // namespace


  template <int dim>
  Steadiness<dim>::Steadiness(const Models<dim> &models, const double within, const double lasting)
    : models(models)
    , norms(models)
    , within(within)
    , lasting(lasting)
  {
  }


  template <int dim>
  std::optional<double>
  Steadiness<dim>::observe(const State<dim> &state, const Columns &columns, const double time)
  {
    auto         forces = forces_of_fluid(columns);
    const double now = reference ? change(state, forces) : std::numeric_limits<double>::infinity();
    if (now > within)
      {
        reference =
          Reference{time, state.fluid.velocity, state.solid.displacement, std::move(forces)};
        return {};
      }
    if (time - reference->time < all_but_rounding * lasting)
      return {};
    return now;
  }


  /// Infinite as long as nothing has moved.
  template <int dim>
  double
  Steadiness<dim>::change(const State<dim> &state, const std::vector<double> &forces) const
  {
    double     result    = 0;
    bool       has_moved = false;
    const auto take      = [&](const double difference, const double size) {
      has_moved |= size > 0;
      if (size > 0)
        result = std::max(result, difference / size);
    };
    if (models.fluid)
      take(norms.of_change(reference->fluid, state.fluid.velocity),
           norms.of_fluid(state.fluid.velocity));
    if (models.solid)
      {
        auto way = state.solid.displacement;
        way -= reference->bodies;
        take(norms.of_bodies(way), norms.of_bodies(state.solid.displacement));
      }
    auto difference = forces;
    for (std::size_t k = 0; k < forces.size(); ++k)
      difference[k] -= reference->forces[k];
    if (has_moved) // what is at rest may be under pressure
      take(length(difference), length(forces));
    return has_moved ? result : std::numeric_limits<double>::infinity();
  }


  template class Steadiness<2>;
  template class Steadiness<3>;
} // namespace undine
