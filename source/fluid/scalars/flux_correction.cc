// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/scalars/flux_correction.h>
#include <undine/fluid/scalars/flux_limiter.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  void
  FluxCorrection<dim>::move(Field<dim> &values)
  {
    auto rest = move_all_that_can(values);
    of_links.clear();
    at_sides.clear();
    // Fluxes that had to wait for others may follow, the more the farther values come.
    const auto communicator = fluxes.flow.model().grid().communicator();
    const int  n_left       = dealii::Utilities::MPI::max(rest.empty() ? 0 : 1, communicator);
    const int  n_rounds     = n_left == 0 ? 0 : 4 * bounds.reached_by_flow - 1;
    for (int round = 0; round < n_rounds; ++round)
      move_within_bounds(values, rest);
  }


  /// Where bounds leave no choice nothing moves but rounding.
  template <int dim>
  bool
  FluxCorrection<dim>::is_fixed(const PressurePlace<dim> &place) const
  {
    constexpr double rounding = 1e-14; // relative
    const double     lower = value_at(bounds.lower, place), upper = value_at(bounds.upper, place);
    return upper - lower <= rounding * std::max(std::abs(lower), std::abs(upper));
  }


  template <int dim>
  bool
  FluxCorrection<dim>::is_outside(const PressurePlace<dim> &place, const double value) const
  {
    return value < value_at(bounds.lower, place) || value > value_at(bounds.upper, place);
  }


  /// Places that stay behind begin with those that are fixed. The result is what goes into the
  /// others or out of them.
  template <int dim>
  std::vector<typename FluxCorrection<dim>::Amount>
  FluxCorrection<dim>::move_all_that_can(Field<dim> &values) const
  {
    Field<dim> behind(values.shared_lattice(), values.topology());
    const auto is_behind = [&](const PressurePlace<dim> &place) {
      return value_at(behind, place) > 0;
    };
    constexpr double fixed = 2;
    for_each_cell_place(behind, [&](const PressurePlace<dim> &place) {
      value_at(behind, place) = is_fixed(place) ? fixed : 0.;
    });
    behind.exchange(1);
    std::vector<Amount> rest;
    auto                moved    = values;
    int                 n_others = 1; // that have come to stay behind
    while (n_others > 0)
      {
        moved = values;
        rest.clear();
        const auto take = [&](const Amount &each) {
          const double most = std::max(value_at(behind, each.link.from),
                                       each.at_side ? 0. : value_at(behind, each.link.to));
          if (most == fixed)
            return;
          if (most > 0)
            rest.push_back(each);
          else
            value_at(moved, each.link.from) -= each.amount / value_at(volumes, each.link.from);
        };
        auto next = of_links.begin();
        fluxes.for_each([&](const CellLink<dim> &link, const auto &) {
          take({link, *next++, false});
        });
        for (const auto &each : at_sides)
          take(each);
        n_others = 0;
        for_each_cell_place(moved, [&](const PressurePlace<dim> &place) {
          if (!is_behind(place) && is_outside(place, value_at(moved, place)))
            {
              value_at(behind, place) = 1;
              ++n_others;
            }
        });
        n_others = dealii::Utilities::MPI::max(n_others, fluxes.flow.model().grid().communicator());
        behind.exchange(1);
      }
    values = moved;
    return rest;
  }


  template <int dim>
  void
  FluxCorrection<dim>::move_within_bounds(Field<dim> &values, std::vector<Amount> &amounts) const
  {
    FluxLimiter<dim> limiter(values, bounds.lower, bounds.upper, volumes);
    for (const auto &each : amounts)
      limiter.count(each.link.from, each.amount);
    limiter.finish();
    for (auto &each : amounts)
      {
        const double share = each.at_side ? limiter.share(each.link.from, each.amount)
                                          : limiter.share(each.link, each.amount);
        value_at(values, each.link.from) -= share * each.amount / value_at(volumes, each.link.from);
        each.amount *= 1 - share;
      }
  }


  template class FluxCorrection<2>;
  template class FluxCorrection<3>;
} // namespace undine
