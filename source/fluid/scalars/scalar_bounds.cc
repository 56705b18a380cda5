// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/scalars/scalar_bounds.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  ScalarBounds<dim>::ScalarBounds(const Field<dim> &value)
    : lower(value)
    , upper(value)
  {
  }


  template <int dim>
  void
  ScalarBounds<dim>::include(const PressurePlace<dim> &place, const double value)
  {
    double &least = value_at(lower, place), &most = value_at(upper, place);
    least = std::min(least, value);
    most  = std::max(most, value);
  }


  template <int dim>
  void
  ScalarBounds<dim>::include_neighbours(const ScalarFluxes<dim> &fluxes, Field<dim> &values)
  {
    values.exchange(1);
    fluxes.for_each([&](const CellLink<dim> &link, const auto &) {
      include(link.from, value_at(values, link.from));
      include(link.from, value_at(values, link.to));
    });
  }


  template <int dim>
  void
  ScalarBounds<dim>::spread(const ScalarFluxes<dim> &fluxes)
  {
    const auto &flow = fluxes.flow;
    const auto &grid = flow.model().grid();
    struct Reach
    {
      double by_flow, in_all; ///< [cells]
    };
    const auto reach = [&](const CellLink<dim> &link, const auto &flux) {
      const double cells   = flow.duration() / std::min(grid.cell_volume(link.from.cell),
                                                      grid.cell_volume(link.to.cell));
      const double by_flow = cells * std::abs(flux.rate);
      return Reach{by_flow, by_flow + std::max(0., 2 * std::sqrt(cells * flux.conductance) - 1)};
    };
    Reach farthest{0, 0};
    fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
      const auto here = reach(link, flux);
      farthest = {std::max(farthest.by_flow, here.by_flow), std::max(farthest.in_all, here.in_all)};
    });
    const auto n_cells = [&](const double distance) {
      constexpr double rounding = 1e-6; // lest it decide
      const double     longest  = dealii::Utilities::MPI::max(distance, grid.communicator());
      return std::max(1, static_cast<int>(std::ceil(longest - rounding)));
    };
    const int n_rounds = n_cells(farthest.in_all);
    reached_by_flow    = n_cells(farthest.by_flow);
    // What sides give may change in a stage.
    for (const double share : {0., .5, 1.})
      fluxes.for_each_side(flow.begin() + share * flow.duration(),
                           [&](const PressurePlace<dim> &place, const auto &flux) {
                             if (flux.upwind().other != 0)
                               include(place, flux.beyond);
                           });
    for (int round = 0; round < n_rounds; ++round)
      {
        lower.exchange(1);
        upper.exchange(1);
        const auto before = *this;
        fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
          if (round > 0 && reach(link, flux).in_all <= round)
            return;
          include(link.from, value_at(before.lower, link.to));
          include(link.from, value_at(before.upper, link.to));
        });
      }
  }


  template struct ScalarBounds<2>;
  template struct ScalarBounds<3>;
} // namespace undine
