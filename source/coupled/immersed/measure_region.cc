// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/throw_together.h>
#include <undine/coupled/immersed/measure_region.h>
#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/grid/fluid_regions.h>
#include <undine/operators/enclosed_volume.h>
#include <undine/operators/pressure_place_at.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace undine
{
  namespace
  {
    /// For each owned pressure, in the order of its number: is it in the region around the point?
    template <int dim>
    std::vector<bool>
    region_around(const dealii::Point<dim>                         &point,
                  const MacGrid<dim>                               &grid,
                  const PressureNumbers<dim>                       &numbers,
                  const typename CharacteristicTracer<dim>::Bodies &bodies)
    {
      const FluidRegions<dim> regions(grid, numbers);
      int                     found = -1;
      std::string             complaint;
      if (grid.cells()->owned().contains(grid.cell_at(point)))
        try
          {
            const auto place =
              pressure_place_at(point, grid, bodies.topology.get(), bodies.obstruction);
            found = regions.of_pressures()[numbers.owned().index_within_set(numbers.of(place))];
          }
        catch (const SolveError &error)
          {
            complaint =
              fmt::format("The point ({:.6g}) of a chamber {}. Try: a place farther away from the "
                          "bodies.",
                          fmt::join(point.begin_raw(), point.begin_raw() + dim, ", "),
                          error.what());
          }
      throw_together(complaint, grid.communicator());
      found = dealii::Utilities::MPI::max(found, grid.communicator());
      std::vector<bool> result;
      for (const unsigned int region : regions.of_pressures())
        result.push_back(static_cast<int>(region) == found);
      return result;
    }


    /// What the grid says.
    template <int dim>
    double
    volume_of(const std::vector<bool>                         &is_in,
              const MacGrid<dim>                              &grid,
              const std::shared_ptr<const FluidTopology<dim>> &topology)
    {
      Field<dim> volumes(grid.cells(), topology);
      set_volumes(volumes, grid);
      std::size_t k   = 0;
      double      sum = 0;
      for_each_value(volumes, [&](const double volume, const auto &, const auto &) {
        sum += is_in[k++] ? volume : 0;
      });
      return dealii::Utilities::MPI::sum(sum, grid.communicator());
    }


    template <int dim>
    RegionBoundary<dim>
    boundary_of(const std::vector<bool>    &is_in,
                const MacGrid<dim>         &grid,
                const PressureNumbers<dim> &numbers,
                const CutTopology<dim>     &parts)
    {
      Field<dim>  inside(grid.cells(), parts.open);
      std::size_t k = 0;
      for_each_value(
        inside, [&](double &value, const auto &, const auto &) { value = is_in[k++] ? 1 : 0; });
      RegionBoundary<dim> result{};
      for (const double value : parts.of_cut_cells(inside.parts()))
        result.has_component.push_back(value != 0);
      std::vector<double> areas(2 * dim, 0.);
      for_each_side_face(grid, parts.open.get(), [&](const SideFace<dim> &face, const auto &) {
        const auto number = numbers.of(place_inside(parts.open.get(), face));
        if (is_in[numbers.owned().index_within_set(number)])
          areas[face.side.number()] += std::abs(signed_area(grid, parts.open.get(), face));
      });
      dealii::Utilities::MPI::sum(areas, grid.communicator(), areas);
      std::copy(areas.begin(), areas.end(), result.side_areas.begin());
      return result;
    }


    /// That of the surfaces themselves, unless the domain is periodic along all axes.
    template <int dim>
    double
    volume_around(const dealii::Point<dim> &point,
                  const Models<dim>        &models,
                  const FluidGeometry<dim> &geometry)
    {
      const auto                &grid  = models.fluid->grid();
      const auto                &parts = geometry.cut_topology();
      const PressureNumbers<dim> numbers(grid, parts.open);
      const auto                 is_in     = region_around(point, grid, numbers, geometry.bodies());
      bool                       has_sides = false;
      for (unsigned int axis = 0; axis < dim; ++axis)
        has_sides = has_sides || !grid.periodic(axis);
      if (!has_sides)
        return volume_of(is_in, grid, parts.open);
      return enclosed_volume(grid,
                             geometry.cut_cells(),
                             models.surface->surface(),
                             geometry.cut_positions(),
                             geometry.surface_positions(),
                             boundary_of(is_in, grid, numbers, parts));
    }


    template <int dim>
    double
    inflow_around(const dealii::Point<dim>                         &point,
                  const FluidModel<dim>                            &model,
                  const typename CharacteristicTracer<dim>::Bodies &bodies,
                  const Velocity<dim>                              &velocity)
    {
      const auto                &grid = model.grid();
      const PressureNumbers<dim> numbers(grid, bodies.topology);
      const auto                 is_in = region_around(point, grid, numbers, bodies);
      const auto                *open  = bodies.topology.get();
      double                     sum   = 0;
      for_each_side_face(model.grid(), open, [&](const SideFace<dim> &face, const auto &) {
        const auto number = numbers.of(place_inside(open, face));
        if (is_in[numbers.owned().index_within_set(number)])
          sum -= outward_flux(grid, velocity, face);
      });
      return dealii::Utilities::MPI::sum(sum, grid.communicator());
    }


    /// The grid, cut where the surfaces' nodes are at `positions`.
    template <int dim>
    std::unique_ptr<FluidGeometry<dim>>
    cut_at(const Models<dim> &models, const std::vector<dealii::Point<dim>> &positions)
    {
      auto result = std::make_unique<FluidGeometry<dim>>(models);
      result->place(
        positions, positions, typename FluidGeometry<dim>::Velocities(positions.size()));
      return result;
    }
  } // namespace


  template <int dim>
  std::vector<std::optional<double>>
  region_volumes(const Models<dim>                     &models,
                 const FluidGeometry<dim>              &geometry,
                 const std::vector<dealii::Point<dim>> &points)
  {
    std::vector<std::optional<double>> result(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      try
        {
          result[k] = volume_around(points[k], models, geometry);
        }
      catch (const SolveError &)
        {
          // Not in the fluid, on all ranks together.
        }
    return result;
  }


  template <int dim>
  std::vector<std::optional<double>>
  region_volumes(const Models<dim>                     &models,
                 const std::vector<dealii::Point<dim>> &positions,
                 const std::vector<dealii::Point<dim>> &points)
  {
    return region_volumes(models, *cut_at(models, positions), points);
  }


  template <int dim>
  RegionMeasures
  measure_region(const Models<dim>        &models,
                 const State<dim>         &state,
                 const dealii::Point<dim> &point)
  {
    const auto &model = *models.fluid;
    if (!models.surface)
      {
        const PressureNumbers<dim> numbers(model.grid(), nullptr);
        return {volume_of<dim>(
                  region_around<dim>(point, model.grid(), numbers, {}), model.grid(), nullptr),
                inflow_around<dim>(point, model, {}, state.fluid.velocity)};
      }
    const auto   now    = cut_at(models, models.surface->positions(state.solid, state.clock.time));
    const double volume = volume_around(point, models, *now);
    // The velocity belongs to where the grid was cut for it.
    const auto before = geometry_of(models, state);
    return {volume, inflow_around(point, model, before->bodies(), state.fluid.velocity)};
  }


  template std::vector<std::optional<double>>
  region_volumes(const Models<2> &,
                 const FluidGeometry<2> &,
                 const std::vector<dealii::Point<2>> &);
  template std::vector<std::optional<double>>
  region_volumes(const Models<2> &,
                 const std::vector<dealii::Point<2>> &,
                 const std::vector<dealii::Point<2>> &);
  template std::vector<std::optional<double>>
  region_volumes(const Models<3> &,
                 const FluidGeometry<3> &,
                 const std::vector<dealii::Point<3>> &);
  template std::vector<std::optional<double>>
  region_volumes(const Models<3> &,
                 const std::vector<dealii::Point<3>> &,
                 const std::vector<dealii::Point<3>> &);
  template RegionMeasures
  measure_region(const Models<2> &, const State<2> &, const dealii::Point<2> &);
  template RegionMeasures
  measure_region(const Models<3> &, const State<3> &, const dealii::Point<3> &);
} // namespace undine
