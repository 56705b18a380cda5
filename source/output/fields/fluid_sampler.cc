// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/grid/interpolation.h>
#include <undine/output/fields/fluid_sampler.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    // A corner of an owned cell lies between points of the second layer around it.
    constexpr int layers = 2;


    enum class Continuation
    {
      constant,
      linear
    };


    /// The value at the boundary point `index` of a row along `axis` from those inside.
    template <int dim>
    double
    continued(const Field<dim>     &field,
              const GridIndex<dim> &index,
              const unsigned int    axis,
              const Continuation    continuation)
    {
      const Row           &row    = field.lattice().row(axis);
      const int            inward = index[axis] < 0 ? 1 : -1;
      const GridIndex<dim> first  = moved<dim>(index, axis, inward);
      if (continuation == Continuation::constant || row.size() < 2)
        return field(first);
      const GridIndex<dim> second = moved<dim>(first, axis, inward);
      const double         slope =
        (field(first) - field(second)) / (row.position(first[axis]) - row.position(second[axis]));
      return field(first) + slope * (row.position(index[axis]) - row.position(first[axis]));
    }


    /// Fill the stored boundary points of a field of cells, direction by direction, so that edges
    /// and corners continue what was filled before them.
    template <int dim>
    void
    continue_to_boundary(Field<dim> &field, const Continuation continuation)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const Row &row = field.lattice().row(axis);
          if (!row.has_boundary_points())
            continue;
          for (const int end : {-1, row.size()})
            {
              IndexBox<dim> side = field.stored();
              // Boundary points of later directions are not filled yet, and not needed here.
              for (unsigned int later = axis + 1; later < dim; ++later)
                if (field.lattice().row(later).has_boundary_points())
                  {
                    side.lower[later] = std::max(side.lower[later], 0);
                    side.upper[later] =
                      std::min(side.upper[later], field.lattice().row(later).size());
                  }
              side.lower[axis] = std::max(side.lower[axis], end);
              side.upper[axis] = std::min(side.upper[axis], end + 1);
              for_each(side, [&](const GridIndex<dim> &index) {
                field(index) = continued<dim>(field, index, axis, continuation);
              });
            }
        }
    }


    template <int dim>
    Field<dim>
    prepared(Field<dim> field, const Continuation continuation)
    {
      field.exchange(layers);
      continue_to_boundary(field, continuation);
      return field;
    }


    /// The surfaces for which the fields hold, standing still; nullptr: there are none.
    template <int dim>
    std::unique_ptr<const SurfaceQueries<dim>>
    surfaces_of(const Models<dim> &models, const State<dim> &state)
    {
      if (!models.surface || state.surface_positions.empty())
        return nullptr;
      return std::make_unique<const SurfaceQueries<dim>>(
        models.fluid->grid(),
        MovedSurface<dim>{&models.surface->surface(),
                          state.surface_positions,
                          state.surface_positions,
                          surface_velocities(models, state)});
    }
  } // namespace


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  surface_velocities(const Models<dim> &models, const State<dim> &state)
  {
    // Obstacles say how they move in a step; this one is so short that it is the motion now.
    constexpr double share = 1e-6;
    return models.surface->velocities(
      state.solid, state.clock.time, share * std::max(state.clock.end_time, share));
  }


  template <int dim>
  FluidSampler<dim>::FluidSampler(const Models<dim> &models, const State<dim> &state)
    : model(*models.fluid)
    , surfaces(surfaces_of(models, state))
  {
    const auto &topology = state.fluid.pressure.topology();
    if (surfaces)
      vicinity = BodyVicinity<dim>(
        model.grid(), topology, topology, surfaces.get(), all_directions<dim>(layers));
    auto velocity = state.fluid.velocity;
    for (auto &component : velocity.components)
      component.exchange(layers);
    const auto frozen = velocity;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        fill_boundary_points<dim>(velocity[axis],
                                  model.boundaries(),
                                  VelocityCondition<dim>(axis),
                                  frozen,
                                  state.clock.time);
        velocity_fields[axis].field = velocity[axis];
        see(velocity_fields[axis]);
      }
    pressure_field.field = prepared(state.fluid.pressure, Continuation::linear);
    see(pressure_field);
    // Samples refer to their fields, which must not move any more.
    scalar_fields.resize(state.fluid.scalars.size());
    for (const auto &scalar : state.fluid.scalars)
      {
        auto &sampled = scalar_fields[names.size()];
        sampled.field = prepared(scalar.second, Continuation::constant);
        see(sampled);
        names.push_back(scalar.first);
      }
  }


  template <int dim>
  void
  FluidSampler<dim>::see(Sampled &sampled) const
  {
    if (surfaces)
      sampled.visible = std::make_unique<VisibleSamples<dim>>(
        sampled.field,
        std::make_shared<VisibilityStencils<dim>>(
          sampled.field, all_directions<dim>(layers), *surfaces, vicinity),
        vicinity);
  }


  template <int dim>
  std::optional<double>
  FluidSampler<dim>::value(const Sampled &sampled, const dealii::Point<dim> &place) const
  {
    const auto here = vicinity.place(place);
    return surfaces && vicinity.is_next_to_body(here) ? sampled.visible->at(here)
                                                      : interpolate(sampled.field, place);
  }


  template <int dim>
  double
  FluidSampler<dim>::velocity_component(const unsigned int        axis,
                                        const dealii::Point<dim> &place) const
  {
    const auto seen = value(velocity_fields[axis], place);
    return seen ? *seen : surfaces->nearest_velocity(place)[axis];
  }


  template <int dim>
  double
  FluidSampler<dim>::cell_value(const Sampled &sampled, const dealii::Point<dim> &place) const
  {
    if (const auto seen = value(sampled, place))
      return *seen;
    const auto &divided = *sampled.field.divided();
    const auto  cell    = model.grid().cell_at(place);
    double      result = 0, nearest = std::numeric_limits<double>::infinity();
    for (int k = divided.first(cell); k < divided.last(cell); ++k)
      if (const double distance = place.distance(divided.all()[k].place); distance < nearest)
        {
          nearest = distance;
          result  = sampled.field.parts()[k];
        }
    return result;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  FluidSampler<dim>::velocity(const dealii::Point<dim> &place) const
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      result[axis] = velocity_component(axis, place);
    return result;
  }


  template <int dim>
  double
  FluidSampler<dim>::pressure(const dealii::Point<dim> &place) const
  {
    return cell_value(pressure_field, place);
  }


  template <int dim>
  std::vector<double>
  FluidSampler<dim>::scalars(const dealii::Point<dim> &place) const
  {
    std::vector<double> result;
    for (const auto &sampled : scalar_fields)
      result.push_back(cell_value(sampled, place));
    return result;
  }


  template <int dim>
  const SubLattice<dim> *
  FluidSampler<dim>::divided_cells() const
  {
    return surfaces ? pressure_field.field.divided() : nullptr;
  }


  template <int dim>
  bool
  FluidSampler<dim>::is_clear(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const
  {
    return !vicinity.is_hidden(vicinity.place(from), vicinity.place(to));
  }


  template <int dim>
  dealii::Tensor<1, dim>
  FluidSampler<dim>::surface_velocity(const dealii::Point<dim> &place) const
  {
    return surfaces->nearest_velocity(place);
  }


  template <int dim>
  const std::vector<std::string> &
  FluidSampler<dim>::scalar_names() const
  {
    return names;
  }


  template <int dim>
  dealii::Point<dim>
  FluidSampler<dim>::corner_position(const GridIndex<dim> &corner) const
  {
    dealii::Point<dim> position;
    for (unsigned int axis = 0; axis < dim; ++axis)
      position[axis] = model.grid().planes(axis)[corner[axis]];
    return position;
  }


  template <int dim>
  std::pair<dealii::Point<dim>, dealii::Point<dim>>
  FluidSampler<dim>::neighbours(const GridIndex<dim> &corner, const unsigned int axis) const
  {
    const auto &grid   = model.grid();
    const int   plane  = corner[axis];
    const int   last   = grid.cells_along()[axis];
    auto        result = std::make_pair(corner_position(corner), corner_position(corner));
    if (plane > 0 || grid.periodic(axis))
      result.first[axis] -= grid.cell_width(axis, plane - 1) / 2;
    if (plane < last || grid.periodic(axis))
      result.second[axis] += grid.cell_width(axis, plane) / 2;
    return result;
  }


  template <int dim>
  double
  FluidSampler<dim>::vorticity_magnitude(const GridIndex<dim> &corner) const
  {
    dealii::Tensor<2, dim> gradient; // [axis of derivative][component]
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto [below, above] = neighbours(corner, axis);
        for (unsigned int component = 0; component < dim; ++component)
          if (component != axis)
            gradient[axis][component] =
              (velocity_component(component, above) - velocity_component(component, below)) /
              (above[axis] - below[axis]);
      }
    return (gradient - dealii::transpose(gradient)).norm() / std::sqrt(2.);
  }


  template std::vector<dealii::Tensor<1, 2>>
  surface_velocities(const Models<2> &, const State<2> &);
  template std::vector<dealii::Tensor<1, 3>>
  surface_velocities(const Models<3> &, const State<3> &);
  template class FluidSampler<2>;
  template class FluidSampler<3>;
} // namespace undine
