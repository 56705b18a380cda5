// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_chamber_volume_h
#define undine_tests_chamber_volume_h

#include <undine/fluid/fluid_regions.h>
#include <undine/fluid/pressure_gradient.h>

#include <coupled/coupled_run.h>

namespace undine_tests
{
  /// Of a region of the fluid (FluidRegions), cut where the bodies are now [m^dim].
  template <int dim>
  double
  volume_of_region(const CoupledRun<dim> &run, const unsigned int region)
  {
    auto              &models = run.models;
    FluidGeometry<dim> geometry(models);
    const auto         positions = models.surface->positions(run.state.solid, run.state.clock.time);
    geometry.place(positions, positions, std::vector<dealii::Tensor<1, dim>>(positions.size()));
    const auto                &grid = models.fluid->grid();
    const PressureNumbers<dim> numbers(grid, geometry.bodies().open_parts);
    const FluidRegions<dim>    regions(grid, numbers);
    Field<dim>                 volumes(grid.cells(), geometry.bodies().open_parts);
    set_volumes(volumes, grid);
    std::size_t k   = 0;
    double      sum = 0;
    for_each_value(volumes, [&](const double volume, const auto &, const auto &) {
      if (regions.of_pressures()[k++] == region)
        sum += volume;
    });
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }


  /// What has flown in through the boundary `in`, and what the chamber holds more than at first.
  template <int dim>
  class ChamberRecord
  {
  public:
    /// Region 0 is that of the grid's first cell.
    ChamberRecord(const CoupledRun<dim> &run, const unsigned int region)
      : run(run)
      , region(region)
      , first(volume_of_region(run, region))
    {
    }

    /// After every step.
    void
    note_step()
    {
      inflow -= run.report.dt * run.column("Flux through in");
    }

    /// [m^dim]
    double
    error() const
    {
      return volume_of_region(run, region) - first - inflow;
    }

    const CoupledRun<dim> &run;
    const unsigned int     region;
    const double           first;
    double                 inflow = 0;
  };
} // namespace undine_tests

#endif
