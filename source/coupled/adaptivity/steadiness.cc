// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/adaptivity/steadiness.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    // Steps that end at multiples of their length miss the end of a time by rounding.
    constexpr double all_but_rounding = 1 - 1e-9;
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
  Steadiness<dim>::observe(const State<dim> &state, const double time)
  {
    const double now = reference ? change(state) : std::numeric_limits<double>::infinity();
    if (now > within)
      {
        reference = Reference{time, state.fluid.velocity, state.solid.displacement};
        return {};
      }
    if (time - reference->time < all_but_rounding * lasting)
      return {};
    return now;
  }


  /// Infinite as long as nothing has moved.
  template <int dim>
  double
  Steadiness<dim>::change(const State<dim> &state) const
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
    return has_moved ? result : std::numeric_limits<double>::infinity();
  }


  template class Steadiness<2>;
  template class Steadiness<3>;
} // namespace undine
