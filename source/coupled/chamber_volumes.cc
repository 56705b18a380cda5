// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/chamber_volumes.h>
#include <undine/interface/boundary_flux.h>

namespace undine
{
  template <int dim>
  ChamberVolumes<dim>::ChamberVolumes(const FluidModel<dim>      &model,
                                      const Surface<dim>         &surface,
                                      const FluidGeometry<dim>   &geometry,
                                      const PressureNumbers<dim> &numbers,
                                      const Stage                &stage,
                                      const double                time,
                                      const std::size_t           n_body_nodes,
                                      Positions                   before)
    : surface(surface)
    , geometry(geometry)
    , chambers(model, numbers)
    , length(stage.length)
    , before(std::move(before))
  {
    if (empty())
      return;
    areas =
      geometry.cut_parts().of_open_parts(wetted_areas(geometry.cut_cells(), surface, n_body_nodes));
    region_areas = chambers.sums_on_components(areas);
    earlier.resize(chambers.size(), 0.);
    for (const auto &part : stage.earlier)
      if (part.length != 0)
        {
          const auto outflow = chambers.held_outflow(time + part.at);
          for (std::size_t region = 0; region < earlier.size(); ++region)
            earlier[region] += part.length * outflow[region];
        }
  }


  template <int dim>
  std::vector<double>
  ChamberVolumes<dim>::missing_fluxes(const std::vector<double> &fluxes, const Vectors &way) const
  {
    const auto          swept  = chambers.sums_on_components(geometry.cut_parts().of_open_parts(
      swept_volumes(geometry.cut_cells(), surface, geometry.surface_positions(), before, way)));
    const auto          pushed = chambers.sums_on_components(fluxes);
    std::vector<double> speeds(chambers.size(), 0.);
    for (std::size_t region = 0; region < speeds.size(); ++region)
      if (region_areas[region] > 0)
        speeds[region] =
          ((swept[region] + earlier[region]) / length - pushed[region]) / region_areas[region];
    auto       result  = fluxes;
    const auto regions = chambers.of_components();
    for (std::size_t c = 0; c < result.size(); ++c)
      result[c] = regions[c] >= 0 ? speeds[regions[c]] * areas[c] : 0.;
    return result;
  }


  template class ChamberVolumes<2>;
  template class ChamberVolumes<3>;
} // namespace undine
