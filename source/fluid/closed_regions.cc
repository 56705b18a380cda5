// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary_condition.h>
#include <undine/fluid/closed_regions.h>
#include <undine/fluid/fluid_quantities.h>
#include <undine/fluid/fluid_regions.h>
#include <undine/fluid/pressure_gradient.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// For each region whether the pressure is given somewhere on its boundary. Collective.
    template <int dim>
    std::vector<int>
    openness(const FluidModel<dim>           &model,
             const PressureNumbers<dim>      &numbers,
             const std::vector<unsigned int> &regions,
             const unsigned int               n_regions)
    {
      std::vector<int>    is_open(n_regions, 0);
      const auto         &owned = numbers.owned();
      const Velocity<dim> still = model.initial_state().velocity;
      for (const auto &opening : open_faces(model, still, numbers.open_parts().get(), 0.))
        {
          const auto inside = place_inside(numbers.open_parts().get(), opening);
          is_open[regions[owned.index_within_set(numbers.of(inside))]] = 1;
        }
      dealii::Utilities::MPI::max(is_open, model.grid().communicator(), is_open);
      return is_open;
    }
  } // namespace


  template <int dim>
  ClosedRegions<dim>::ClosedRegions(const FluidModel<dim>      &model_,
                                    const PressureNumbers<dim> &numbers_)
    : model(model_)
    , numbers(numbers_)
  {
    const auto &grid = model.grid();
    if (!numbers.open_parts() && model.boundaries().has_opening())
      return;
    const FluidRegions<dim> all(grid, numbers);
    const auto              is_open = openness(model, numbers, all.of_pressures(), all.size());
    std::vector<int>        closed_number(all.size(), open_region);
    int                     n_closed = 0;
    for (unsigned int r = 0; r < all.size(); ++r)
      if (!is_open[r])
        {
          closed_number[r] = n_closed++;
          if (numbers.owned().is_element(all.lowest_numbers()[r]))
            pins.push_back(all.lowest_numbers()[r]);
        }
    if (n_closed == 0)
      return;
    for (const unsigned int r : all.of_pressures())
      regions.push_back(closed_number[r]);
    Field<dim> sizes(grid.cells(), numbers.open_parts());
    set_volumes(sizes, grid);
    for_each_value(sizes,
                   [&](const double size, const auto &, const auto &) { volumes.push_back(size); });
    region_volumes.resize(n_closed);
    region_volumes = sums([&](const std::size_t k) { return volumes[k]; });
  }


  template <int dim>
  template <class Contribution>
  std::vector<double>
  ClosedRegions<dim>::sums(const Contribution &contribution) const
  {
    std::vector<double> result(region_volumes.size(), 0.);
    for (std::size_t k = 0; k < regions.size(); ++k)
      if (regions[k] != open_region)
        result[regions[k]] += contribution(k);
    dealii::Utilities::MPI::sum(result, model.grid().communicator(), result);
    return result;
  }


  template <int dim>
  void
  ClosedRegions<dim>::balance(Vector &right_side) const
  {
    const auto surplus = sums([&](const std::size_t k) { return right_side.begin()[k]; });
    for (std::size_t k = 0; k < regions.size(); ++k)
      if (const int region = regions[k]; region != open_region)
        right_side.begin()[k] -= surplus[region] * volumes[k] / region_volumes[region];
  }


  template <int dim>
  void
  ClosedRegions<dim>::remove_means(Field<dim> &pressure) const
  {
    if (regions.empty())
      return;
    std::vector<double> values;
    for_each_value(
      pressure, [&](const double value, const auto &, const auto &) { values.push_back(value); });
    const auto  moments = sums([&](const std::size_t k) { return volumes[k] * values[k]; });
    std::size_t k       = 0;
    for_each_value(pressure, [&](double &value, const auto &, const auto &) {
      if (const int region = regions[k]; region != open_region)
        value -= moments[region] / region_volumes[region];
      ++k;
    });
  }


  template <int dim>
  void
  ClosedRegions<dim>::check_net_flux(const Velocity<dim>       &velocity,
                                     const std::vector<double> &body_fluxes,
                                     const double               time) const
  {
    if (region_volumes.empty())
      return;
    const auto complain = [&](const std::string &complaint) {
      throw InputError(fmt::format("At {:.6g} s {}. Make one boundary an 'outflow' or of the "
                                   "kind 'pressure', or balance the inflows.",
                                   time,
                                   complaint));
    };
    if (!numbers.open_parts())
      {
        const auto complaint = net_flux_complaint(model, velocity);
        if (!complaint.empty())
          complain(complaint);
        return;
      }
    // Faces between cells cancel in the sum over a region; only what is held counts.
    Velocity<dim> held;
    for (unsigned int axis = 0; axis < dim; ++axis)
      held[axis] = Field<dim>(velocity[axis].shared_lattice(), velocity[axis].open_parts());
    set_boundary_velocity(held, model, time);
    exchange(held);
    const auto fluxes = divergence(model, held);
    Field<dim> pushed(fluxes.shared_lattice(), fluxes.open_parts());
    std::copy(body_fluxes.begin(), body_fluxes.end(), pushed.parts().begin());
    const auto values = [](const Field<dim> &field) {
      std::vector<double> result;
      for_each_value(
        field, [&](const double value, const auto &, const auto &) { result.push_back(value); });
      return result;
    };
    const auto through_boundary = values(fluxes), from_bodies = values(pushed);
    const auto sum =
      sums([&](const std::size_t k) { return through_boundary[k] + from_bodies[k]; });
    const auto size = sums([&](const std::size_t k) {
      return std::abs(through_boundary[k]) + std::abs(from_bodies[k]);
    });
    for (std::size_t region = 0; region < sum.size(); ++region)
      if (std::abs(sum[region]) > 1e-8 * size[region])
        complain(fmt::format("in sum {:.6g} m^{}/s flow out of a part of the fluid of {:.6g} m^{} "
                             "that has no outlet, among bodies and boundaries",
                             sum[region],
                             dim,
                             region_volumes[region],
                             dim));
  }


  template class ClosedRegions<2>;
  template class ClosedRegions<3>;
} // namespace undine
