// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/cutting/flush_facets.h>
#include <undine/cutting/whole_facets.h>
#include <undine/operators/body_forces.h>
#include <undine/operators/outside_forces.h>
#include <undine/operators/sampled_regions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// Does any rank have a cell or a component of one? Collective.
    template <int dim>
    bool
    has_fluid(const MacGrid<dim> &grid, const SubLattice<dim> &cells)
    {
      bool any = false;
      for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
        any = any || cells.kind(cell) == SubLattice<dim>::Kind::whole;
      });
      for (std::size_t k = 0; !any && k < cells.all().size(); ++k)
        any = cells.owns(k);
      return dealii::Utilities::MPI::max(any ? 1 : 0, grid.communicator()) == 1;
    }
  } // namespace


  template <int dim>
  FluidGeometry<dim>::FluidGeometry(const Models<dim> &models)
    : surface(*models.surface)
    , model(*models.fluid)
    , void_regions(models.void_regions.get())
    , cells(block_of_rank(model.grid()))
  {
  }


  /// Where facets lie in planes of the grid it is cut a little beyond them, with the volumes of the
  /// surfaces as they are: else those of closed regions would jump when a piston passes a plane.
  template <int dim>
  void
  FluidGeometry<dim>::cut_beyond_planes()
  {
    cut_at             = beyond_planes(cells.block.planes(), surface.surface(), positions);
    const auto &blocks = model.grid().cells()->blocks();
    if (const auto united = united_surface(surface.surface(), cut_at, surface.held()))
      {
        cut_block(cells, work, {united->surface, united->positions}, blocks);
        refer_to_whole_facets(cells, united->parts);
      }
    else
      cut_block(cells, work, {surface.surface(), cut_at}, blocks);
    if (cut_at == positions)
      return;
    Velocities back(cut_at.size());
    for (std::size_t node = 0; node < back.size(); ++node)
      back[node] = positions[node] - cut_at[node];
    // What flows out of a component through a surface that gives way fills the room behind it.
    const auto swept = swept_volumes(cells, surface.surface(), cut_at, cut_at, back, true);
    for (std::size_t c = 0; c < swept.size(); ++c)
      cells.components[c].volume += swept[c];
  }


  template <int dim>
  void
  FluidGeometry<dim>::cut(const VoidMask &last_voids)
  {
    const auto &grid = model.grid();
    cut_beyond_planes();
    last_report   = report(cells, surface.surface(), grid.communicator());
    parts         = make_cut_topology(grid, cells);
    flux_operator = std::make_unique<const BoundaryFlux<dim>>(cells, surface.surface());
    voids         = {};
    if (void_regions != nullptr)
      {
        voids = void_regions->find(cells, parts, *queries, last_voids);
        parts = make_cut_topology(grid, cells, voids);
      }
    if (last_report.sampled_cells > 0)
      {
        close_sampled_regions(voids, grid, cells, parts);
        parts = make_cut_topology(grid, cells, voids);
      }
    fluid_is_left = undine::has_fluid(grid, parts.open->cells);
  }


  template <int dim>
  void
  FluidGeometry<dim>::place(const Positions  &before,
                            const Positions  &now,
                            const Velocities &new_velocities)
  {
    const bool moved = now != positions;
    if (moved)
      surface.check(now);
    // Void regions must not take cells that held fluid. To check that, the grid has to be cut at
    // `before`, which it is not after a rejected step or in a resumed run.
    if (moved && void_regions != nullptr && before != now && before != positions)
      place(before, before, Velocities(before.size()));
    if (moved || before != was_at || new_velocities != velocities)
      queries = std::make_unique<const SurfaceQueries<dim>>(
        model.grid(),
        MovedSurface<dim>{&surface.surface(), before, now, new_velocities, surface.n_body_nodes()});
    velocities = new_velocities;
    was_at     = before;
    if (!moved)
      return;
    const auto last_voids = before == positions ? voids : VoidMask();
    positions             = now;
    try
      {
        cut(last_voids);
      }
    catch (...)
      {
        positions.clear(); // the cut is incomplete
        throw;
      }
  }


  template <int dim>
  typename CharacteristicTracer<dim>::Bodies
  FluidGeometry<dim>::bodies() const
  {
    return {queries.get(), parts.open};
  }


  template <int dim>
  SweptVolumeFlux
  FluidGeometry<dim>::swept_volume_flux(const BoundaryFlux<dim> &boundary_flux,
                                        const Velocities        &given,
                                        const double             dt) const
  {
    StepAccuracy accuracy{dt, 0};
    const auto   include = [&](const auto &place) {
      for (unsigned int d = 0; d < dim; ++d)
        accuracy.largest_coordinate = std::max(accuracy.largest_coordinate, std::abs(place[d]));
    };
    include(model.grid().lower());
    include(model.grid().upper());
    for (const auto &position : positions)
      include(position);
    auto result =
      undine::swept_volume_flux(boundary_flux, cells, parts, surface.surface(), given, accuracy);
    result.bodies = surface.section_names();
    result.scene  = surface.scene_name();
    return result;
  }


  template <int dim>
  SweptVolumeFlux
  FluidGeometry<dim>::swept_volume_flux(const Velocities &given, const double dt) const
  {
    return swept_volume_flux(*flux_operator, given, dt);
  }


  template <int dim>
  SweptVolumeFlux
  FluidGeometry<dim>::swept_volume_flux(const double dt) const
  {
    return swept_volume_flux(velocities, dt);
  }


  template <int dim>
  SweptVolumeFlux
  FluidGeometry<dim>::initial_swept_volume_flux(const double dt) const
  {
    auto       result      = swept_volume_flux(dt);
    const auto areas       = wetted_areas(cells, surface.surface(), surface.n_body_nodes());
    result.compliant_areas = parts.of_fluid_topology(areas);
    return result;
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  FluidGeometry<dim>::pressure_forces(const Field<dim> &pressure) const
  {
    return pressure_forces(pressure.parts());
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  FluidGeometry<dim>::pressure_forces(const std::vector<double> &pressures) const
  {
    return nodal_forces(*flux_operator, parts.of_cut_cells(pressures), model.grid().communicator());
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  FluidGeometry<dim>::uniform_pressure_forces(const double pressure) const
  {
    return pressure_forces(std::vector<double>(parts.open->cells.all().size(), pressure));
  }


  template <int dim>
  std::vector<double>
  FluidGeometry<dim>::static_pressures(const dealii::Tensor<1, dim> &gravity) const
  {
    std::vector<double> pressures;
    for (const auto &component : parts.open->cells.all())
      pressures.push_back(model.density() * (gravity * component.place));
    return pressures;
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  FluidGeometry<dim>::gravity_forces(const dealii::Tensor<1, dim> &gravity) const
  {
    const std::vector<double> densities(parts.open->cells.all().size(), model.density());
    return gravity_loads(cells,
                         surface.surface(),
                         positions,
                         parts.of_cut_cells(densities),
                         gravity,
                         model.grid().communicator());
  }


  template <int dim>
  std::vector<double>
  FluidGeometry<dim>::void_pressures(const double time) const
  {
    return void_regions == nullptr ? std::vector<double>() : void_regions->pressures(voids, time);
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  FluidGeometry<dim>::void_forces(const double time) const
  {
    return nodal_forces(*flux_operator, void_pressures(time), model.grid().communicator());
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  FluidGeometry<dim>::outside_forces(const dealii::Tensor<1, dim> &gravity, const double time) const
  {
    return undine::outside_forces(
      model.boundaries(), surface.surface(), cut_at, model.density() * gravity, time);
  }


  template <int dim>
  std::vector<double>
  FluidGeometry<dim>::outside_pressures_on_facets(const dealii::Tensor<1, dim> &gravity,
                                                  const double                  time) const
  {
    return undine::outside_pressures_on_facets(
      model.boundaries(), surface.surface(), cut_at, model.density() * gravity, time);
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  FluidGeometry<dim>::other_forces(const dealii::Tensor<1, dim> &gravity, const double time) const
  {
    Velocities forces(positions.size());
    const auto add = [&](const Velocities &more) {
      for (std::size_t node = 0; node < forces.size(); ++node)
        forces[node] += more[node];
    };
    if (gravity.norm() > 0)
      add(gravity_forces(gravity));
    if (void_regions != nullptr)
      add(void_forces(time));
    add(outside_forces(gravity, time));
    return forces;
  }


  template <int dim>
  Columns
  FluidGeometry<dim>::columns(const Field<dim>             &pressure,
                              const dealii::Tensor<1, dim> &gravity,
                              const double                  time,
                              const Velocities             &friction) const
  {
    PressureForces<dim> forces;
    forces.reduced = pressure_forces(pressure);
    const auto add = [&](const Velocities &more) {
      for (std::size_t node = 0; node < more.size(); ++node)
        forces.reduced[node] += more[node];
    };
    if (void_regions != nullptr)
      add(void_forces(time));
    add(outside_forces(gravity, time));
    if (gravity.norm() > 0)
      forces.gravity = gravity_forces(gravity);
    auto columns = pressure_force_columns(surface.surface(), forces);
    if (!friction.empty())
      for (const auto &column : body_columns("viscous force",
                                             "N",
                                             surface.surface(),
                                             sums_over_bodies(surface.surface(), friction)))
        columns.push_back(column);
    columns.push_back({"Cut cells", "1", double(last_report.cut_cells)});
    columns.push_back({"Flagged cells", "1", double(last_report.flagged_cells)});
    return columns;
  }


  template <int dim>
  std::size_t
  FluidGeometry<dim>::memory_consumption() const
  {
    const auto bytes = [](const auto &...lists) {
      return ((lists.capacity() * sizeof(lists.front())) + ...);
    };
    std::size_t sum = bytes(cells.cells,
                            cells.components,
                            cells.faces,
                            cells.pieces,
                            cells.fragments,
                            cells.corners.first,
                            cells.corners.points,
                            parts.cut_components,
                            parts.open_components,
                            positions,
                            cut_at,
                            was_at,
                            velocities) +
                      work.cache.memory_consumption();
    if (parts.open)
      for (unsigned int axis = 0; axis < dim; ++axis)
        sum += bytes(parts.open->pieces[axis], parts.open->faces[axis].all());
    if (flux_operator)
      sum += bytes(flux_operator->entries());
    return sum;
  }


  template <int dim>
  std::unique_ptr<FluidGeometry<dim>>
  geometry_of(const Models<dim> &models, const State<dim> &state)
  {
    if (!models.fluid || !models.surface || state.surface_positions.empty())
      return nullptr;
    auto geometry = std::make_unique<FluidGeometry<dim>>(models);
    geometry->place(state.surface_positions,
                    state.surface_positions,
                    typename FluidGeometry<dim>::Velocities(state.surface_positions.size()));
    return geometry;
  }


  template class FluidGeometry<2>;
  template class FluidGeometry<3>;
  template std::unique_ptr<FluidGeometry<2>>
  geometry_of(const Models<2> &, const State<2> &);
  template std::unique_ptr<FluidGeometry<3>>
  geometry_of(const Models<3> &, const State<3> &);
} // namespace undine
