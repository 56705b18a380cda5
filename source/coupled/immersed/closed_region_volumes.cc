// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/closed_region_volumes.h>
#include <undine/coupled/immersed/measure_region.h>
#include <undine/operators/boundary_flux.h>

namespace undine
{
  template <int dim>
  ClosedRegionVolumes<dim>::ClosedRegionVolumes(const Models<dim>          &models,
                                                const FluidGeometry<dim>   &geometry,
                                                const PressureNumbers<dim> &numbers,
                                                const Stage                &stage,
                                                const double                time,
                                                Positions                   before)
    : surface(models.surface->surface())
    , geometry(geometry)
    , regions(*models.fluid, numbers)
    , length(stage.length)
    , before(std::move(before))
  {
    if (empty())
      return;
    areas = geometry.cut_topology().of_fluid_topology(
      wetted_areas(geometry.cut_cells(), surface, models.surface->n_body_nodes()));
    region_areas = regions.sums_on_components(areas);
    gained       = gained_until_cut(models);
    earlier.resize(regions.size(), 0.);
    for (const auto &part : stage.earlier)
      if (part.length != 0)
        {
          const auto outflow = regions.prescribed_outflow(time + part.at);
          for (std::size_t region = 0; region < earlier.size(); ++region)
            earlier[region] += part.length * outflow[region];
        }
  }


  template <int dim>
  std::vector<double>
  ClosedRegionVolumes<dim>::gained_until_cut(const Models<dim> &models) const
  {
    const auto &cut_at = geometry.surface_positions();
    Vectors     increment(cut_at.size());
    for (std::size_t node = 0; node < increment.size(); ++node)
      increment[node] = cut_at[node] - before[node];
    auto       result   = swept(before, increment);
    const auto places   = regions.places_within();
    const auto at_start = region_volumes(models, before, places);
    const auto at_cut   = region_volumes(models, geometry, places);
    for (std::size_t region = 0; region < result.size(); ++region)
      if (at_start[region] && at_cut[region])
        {
          // If regions have parted or merged since, the volume at the begin is that of another
          // region. What facets sweep is exact unless they slide along sides of the domain.
          constexpr double the_same = 1e-5;
          const double     exact    = *at_cut[region] - *at_start[region];
          if (std::abs(exact - result[region]) <= the_same * *at_cut[region])
            result[region] = exact;
        }
    return result;
  }


  template <int dim>
  std::vector<double>
  ClosedRegionVolumes<dim>::swept(const Positions &from, const Vectors &increment) const
  {
    return regions.sums_on_components(geometry.cut_topology().of_fluid_topology(
      swept_volumes(geometry.cut_cells(), surface, geometry.cut_positions(), from, increment)));
  }


  template <int dim>
  std::vector<double>
  ClosedRegionVolumes<dim>::missing_fluxes(const std::vector<double> &fluxes,
                                           const Vectors             &increment) const
  {
    const auto &cut_at = geometry.surface_positions();
    auto        rest   = increment;
    for (std::size_t node = 0; node < rest.size(); ++node)
      rest[node] -= cut_at[node] - before[node];
    const auto          then  = swept(cut_at, rest);
    const auto          swept = regions.sums_on_components(fluxes);
    std::vector<double> speeds(regions.size(), 0.);
    for (std::size_t region = 0; region < speeds.size(); ++region)
      if (region_areas[region] > 0)
        speeds[region] =
          ((gained[region] + then[region] + earlier[region]) / length - swept[region]) /
          region_areas[region];
    auto       result    = fluxes;
    const auto region_of = regions.of_components();
    for (std::size_t c = 0; c < result.size(); ++c)
      result[c] = region_of[c] >= 0 ? speeds[region_of[c]] * areas[c] : 0.;
    return result;
  }


  template class ClosedRegionVolumes<2>;
  template class ClosedRegionVolumes<3>;
} // namespace undine
