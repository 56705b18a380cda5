// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_flags.h>
#include <undine/fluid/grid/fluid_regions.h>
#include <undine/operators/sampled_regions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// 1 for components of sampled cells, 0 for all other fluid.
    template <int dim>
    Field<dim>
    mark_sampled(const MacGrid<dim> &grid, const CutCells<dim> &cut, const CutTopology<dim> &parts)
    {
      Field<dim> result(grid.cells(), parts.open);
      for (std::size_t k = 0; k < result.parts().size(); ++k)
        if (const int c = parts.cut_components[k]; c >= 0)
          result.parts()[k] =
            (cut.cells[cut.components[c].cell].flags & cut_needs_sampling) != 0 ? 1. : 0.;
      return result;
    }


    /// Of each region whether all its marks are 1; never of all regions.
    template <int dim>
    std::vector<double>
    find_sampled_regions(Field<dim>              &marks,
                         const FluidRegions<dim> &regions,
                         const MPI_Comm           communicator)
    {
      std::vector<double> result(regions.size(), 1.);
      std::size_t         next = 0;
      for_each_value(marks, [&](const double mark, const auto &, const auto &) {
        auto &of_region = result[regions.of_pressures()[next++]];
        of_region       = std::min(of_region, mark);
      });
      dealii::Utilities::MPI::min(result, communicator, result);
      if (std::count(result.begin(), result.end(), 0.) == 0)
        result.assign(result.size(), 0.);
      return result;
    }
  } // namespace


  template <int dim>
  void
  close_sampled_regions(VoidMask               &voids,
                        const MacGrid<dim>     &grid,
                        const CutCells<dim>    &cut,
                        const CutTopology<dim> &parts)
  {
    const PressureNumbers<dim> numbers(grid, parts.open);
    const FluidRegions<dim>    regions(grid, numbers);
    auto                       marks   = mark_sampled(grid, cut, parts);
    const auto                 sampled = find_sampled_regions(marks, regions, grid.communicator());
    std::size_t                next    = 0;
    for_each_value(marks, [&](double &mark, const auto &, const auto &) {
      mark = sampled[regions.of_pressures()[next++]];
    });
    marks.exchange(1);
    voids.components.resize(cut.components.size(), VoidMask::fluid);
    for (std::size_t c = 0; c < cut.components.size(); ++c)
      if (const int k = parts.open_components[c]; k >= 0 && marks.parts()[k] > 0)
        voids.components[c] = VoidMask::solid;
  }


  template void
  close_sampled_regions(VoidMask &,
                        const MacGrid<2> &,
                        const CutCells<2> &,
                        const CutTopology<2> &);
  template void
  close_sampled_regions(VoidMask &,
                        const MacGrid<3> &,
                        const CutCells<3> &,
                        const CutTopology<3> &);
} // namespace undine
