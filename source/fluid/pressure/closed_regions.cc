// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/grid/fluid_regions.h>
#include <undine/fluid/pressure/closed_regions.h>
#include <undine/fluid/pressure/divergence.h>
#include <undine/fluid/pressure/pressure_gradient.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// For each region whether the pressure is given somewhere on its boundary, or gives rise to
    /// flow there. Collective.
    template <int dim>
    std::vector<int>
    openness(const FluidModel<dim>                                    &model,
             const PressureNumbers<dim>                               &numbers,
             const FluidRegions<dim>                                  &all,
             const std::vector<typename PressureNumbers<dim>::Number> &compliant)
    {
      std::vector<int> is_open(all.size(), 0);
      const auto      &owned   = numbers.owned();
      const auto      &regions = all.of_pressures();
      for (const auto number : compliant)
        is_open[regions[owned.index_within_set(number)]] = 1;
      const Velocity<dim> still = model.initial_state().velocity;
      for (const auto &opening : open_faces(model, still, numbers.topology().get(), 0.))
        {
          const auto inside = place_inside(numbers.topology().get(), opening);
          is_open[regions[owned.index_within_set(numbers.of(inside))]] = 1;
        }
      dealii::Utilities::MPI::max(is_open, model.grid().communicator(), is_open);
      return is_open;
    }
  } // namespace


  template <int dim>
  ClosedRegions<dim>::ClosedRegions(const FluidModel<dim>      &model_,
                                    const PressureNumbers<dim> &numbers_,
                                    const std::vector<Number>  &compliant)
    : model(model_)
    , numbers(numbers_)
  {
    const auto &grid = model.grid();
    if (!numbers.topology() && model.boundaries().has_opening())
      return;
    const FluidRegions<dim> all(grid, numbers);
    const auto              is_open = openness(model, numbers, all, compliant);
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
    Field<dim> sizes(grid.cells(), numbers.topology());
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
  template <class Function>
  std::vector<double>
  ClosedRegions<dim>::sums_of(const Field<dim> &field, const Function &function) const
  {
    std::vector<double> values;
    for_each_value(field, [&](const double value, const auto &, const auto &) {
      values.push_back(function(value));
    });
    return sums([&](const std::size_t k) { return values[k]; });
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
  ClosedRegions<dim>::fix_pressure_level(Vector &pressure) const
  {
    if (region_volumes.empty())
      return;
    std::vector<bool> is_pinned(regions.size(), false);
    for (const auto pin : pins)
      is_pinned[numbers.owned().index_within_set(pin)] = true;
    const auto values =
      sums([&](const std::size_t k) { return is_pinned[k] ? pressure.begin()[k] : 0.; });
    for (std::size_t k = 0; k < regions.size(); ++k)
      if (const int region = regions[k]; region != open_region)
        pressure.begin()[k] -= values[region];
  }


  template <int dim>
  void
  ClosedRegions<dim>::remove_means(Field<dim> &pressure) const
  {
    if (region_volumes.empty()) // the same on all ranks, also where one has no fluid
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
  ClosedRegions<dim>::keep_means(Field<dim> &pressure, const Field<dim> &before) const
  {
    if (region_volumes.empty())
      return;
    auto level = before, shifted = before;
    remove_means(shifted);
    add(level, -1., shifted);
    remove_means(pressure);
    add(pressure, 1., level);
  }


  template <int dim>
  Field<dim>
  ClosedRegions<dim>::regions_of_pressures() const
  {
    Field<dim>  result(model.grid().cells(), numbers.topology());
    std::size_t k = 0;
    for_each_value(result,
                   [&](double &value, const auto &, const auto &) { value = regions[k++]; });
    return result;
  }


  template <int dim>
  std::string
  ClosedRegions<dim>::describe(const int              region,
                               const SweptVolumeFlux &swept,
                               const double           through_boundaries) const
  {
    const auto             which = regions_of_pressures();
    dealii::Tensor<1, dim> moment;
    std::size_t            k = 0;
    for_each_value(which, [&](const double value, const auto &place, const auto &) {
      if (value == region)
        moment += volumes[k] / region_volumes[region] * place;
      ++k;
    });
    const auto          communicator = model.grid().communicator();
    const auto          middle       = dealii::Utilities::MPI::sum(moment, communicator);
    std::vector<double> fluxes(swept.bodies.size(), 0.);
    std::vector<int>    touches(swept.bodies.size(), 0);
    for (const auto &contribution : swept.contributions)
      if (which.parts()[contribution.component] == region)
        {
          fluxes[contribution.body] += contribution.flux;
          touches[contribution.body] = 1;
        }
    dealii::Utilities::MPI::sum(fluxes, communicator, fluxes);
    dealii::Utilities::MPI::max(touches, communicator, touches);
    std::string list;
    for (std::size_t body = 0; body < touches.size(); ++body)
      if (touches[body])
        list += fmt::format("through '{}' {:.6g}, ", swept.bodies[body], fluxes[body]);
    return fmt::format("a part of the fluid of {:.6g} m^{} around ({:.4g}) that has no outlet "
                       "(outwards {}through boundaries {:.6g})",
                       region_volumes[region],
                       dim,
                       fmt::join(middle.begin_raw(), middle.begin_raw() + dim, ", "),
                       list,
                       through_boundaries);
  }


  template <int dim>
  std::vector<dealii::Point<dim>>
  ClosedRegions<dim>::places_within() const
  {
    const auto                      communicator = model.grid().communicator();
    std::vector<double>             largest(size(), 0.);
    std::vector<dealii::Point<dim>> places(size());
    const auto                      which = regions_of_pressures();
    std::size_t                     k     = 0;
    for_each_value(which, [&](const double value, const auto &place, const auto &) {
      const double volume = volumes[k++];
      const int    region = static_cast<int>(value);
      if (region == open_region || volume <= largest[region])
        return;
      largest[region] = volume;
      places[region]  = place;
    });
    // The first rank that has the largest.
    const auto all =
      dealii::Utilities::MPI::all_gather(communicator, std::make_pair(largest, places));
    for (std::size_t region = 0; region < size(); ++region)
      {
        double found = 0;
        for (const auto &[volumes_there, places_there] : all)
          if (volumes_there[region] > found)
            {
              found          = volumes_there[region];
              places[region] = places_there[region];
            }
      }
    return places;
  }


  template <int dim>
  std::vector<double>
  ClosedRegions<dim>::sums_on_components(const std::vector<double> &values) const
  {
    Field<dim> field(model.grid().cells(), numbers.topology());
    std::copy(values.begin(), values.end(), field.parts().begin());
    return sums_of(field, [](const double value) { return value; });
  }


  /// What leaves each cell through walls and inflows. Faces between cells cancel in the sum over a
  /// region; only what is prescribed counts.
  template <int dim>
  Field<dim>
  ClosedRegions<dim>::prescribed_fluxes(const double time) const
  {
    Velocity<dim> prescribed;
    for (unsigned int axis = 0; axis < dim; ++axis)
      prescribed[axis] = Field<dim>(model.grid().faces(axis), numbers.topology());
    set_boundary_velocity(prescribed, model.boundaries(), time);
    exchange(prescribed);
    return divergence(model, prescribed);
  }


  template <int dim>
  std::vector<double>
  ClosedRegions<dim>::prescribed_outflow(const double time) const
  {
    return sums_of(prescribed_fluxes(time), [](const double flux) { return flux; });
  }


  template <int dim>
  std::vector<int>
  ClosedRegions<dim>::of_components() const
  {
    const auto which = regions_of_pressures();
    return {which.parts().begin(), which.parts().end()};
  }


  template <int dim>
  std::vector<double>
  ClosedRegions<dim>::balanced_fluxes(const Velocity<dim>   &velocity,
                                      const SweptVolumeFlux &swept,
                                      const double           time) const
  {
    if (region_volumes.empty())
      return swept.fluxes;
    if (!numbers.topology())
      {
        const auto complaint = net_flux_complaint(model.boundaries(), velocity);
        if (!complaint.empty())
          throw InputError(fmt::format("At {:.6g} s {}. Make one boundary an 'outflow' or of the "
                                       "kind 'pressure', or balance the inflows.",
                                       time,
                                       complaint));
        return swept.fluxes;
      }
    const auto fluxes      = prescribed_fluxes(time);
    const auto boundaries  = sums_of(fluxes, [](const double flux) { return flux; });
    const auto sizes       = sums_of(fluxes, [](const double flux) { return std::abs(flux); });
    const auto bodies      = sums_on_components(swept.fluxes);
    const auto uncertainty = sums_on_components(swept.uncertainties);
    auto       areas       = swept.compliant_areas;
    areas.resize(swept.fluxes.size(), 0.);
    const auto          compliant = sums_on_components(areas);
    std::vector<double> shares(boundaries.size(), 0.); // of the uncertainties
    std::vector<double> speeds(boundaries.size(), 0.); // at which compliant surfaces move
    for (std::size_t region = 0; region < shares.size(); ++region)
      {
        const double sum = boundaries[region] + bodies[region];
        if (compliant[region] > 0)
          {
            speeds[region] = sum / compliant[region];
            continue;
          }
        if (std::abs(sum) > 1e-10 * sizes[region] + uncertainty[region])
          throw NoOutletError(fmt::format(
            "{}: at {:.6g} s {:.6g} m^{}/s in sum flow out of {}. Likely an obstacle grows or "
            "shrinks, leaves the domain or enters it, moves into another one, or seals a place "
            "off. Try: another 'Displacement', an 'outflow' or a boundary of the kind 'pressure' "
            "that this part reaches, or balance the inflows.",
            swept.scene,
            time,
            sum,
            dim,
            describe(region, swept, boundaries[region])));
        if (uncertainty[region] > 0)
          shares[region] = std::clamp(sum / uncertainty[region], -1., 1.);
      }
    const auto which  = regions_of_pressures();
    auto       result = swept.fluxes;
    for (std::size_t c = 0; c < result.size(); ++c)
      if (const int region = static_cast<int>(which.parts()[c]); region != open_region)
        {
          result[c] -= shares[region] * swept.uncertainties[c];
          result[c] -= speeds[region] * areas[c];
        }
    return result;
  }


  template class ClosedRegions<2>;
  template class ClosedRegions<3>;
} // namespace undine
