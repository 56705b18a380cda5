// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary_condition.h>
#include <undine/fluid/interpolation.h>
#include <undine/output/fluid_sampler.h>

#include <algorithm>
#include <cmath>

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
  } // namespace


  template <int dim>
  FluidSampler<dim>::FluidSampler(const FluidModel<dim> &model,
                                  const FluidState<dim> &state,
                                  const double           time)
    : model(model)
    , velocity_fields(state.velocity)
    , pressure_field(prepared(state.pressure, Continuation::linear))
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      velocity_fields[axis].exchange(layers);
    const auto frozen = velocity_fields;
    for (unsigned int axis = 0; axis < dim; ++axis)
      fill_boundary_points<dim>(
        velocity_fields[axis], model, VelocityCondition<dim>(axis), frozen, time);
    for (const auto &scalar : state.scalars)
      {
        names.push_back(scalar.first);
        scalar_fields.push_back(prepared(scalar.second, Continuation::constant));
      }
  }


  template <int dim>
  dealii::Tensor<1, dim>
  FluidSampler<dim>::velocity(const dealii::Point<dim> &place) const
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      result[axis] = interpolate(velocity_fields[axis], place);
    return result;
  }


  template <int dim>
  double
  FluidSampler<dim>::pressure(const dealii::Point<dim> &place) const
  {
    return interpolate(pressure_field, place);
  }


  template <int dim>
  std::vector<double>
  FluidSampler<dim>::scalars(const dealii::Point<dim> &place) const
  {
    std::vector<double> result;
    for (const auto &field : scalar_fields)
      result.push_back(interpolate(field, place));
    return result;
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
            gradient[axis][component] = (interpolate(velocity_fields[component], above) -
                                         interpolate(velocity_fields[component], below)) /
                                        (above[axis] - below[axis]);
      }
    return (gradient - dealii::transpose(gradient)).norm() / std::sqrt(2.);
  }


  template class FluidSampler<2>;
  template class FluidSampler<3>;
} // namespace undine
