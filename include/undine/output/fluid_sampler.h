// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fluid_sampler_h
#define undine_output_fluid_sampler_h

#include <undine/fluid/fluid_model.h>
#include <undine/fluid/fluid_state.h>

#include <deal.II/base/tensor.h>

#include <map>
#include <string>

namespace undine
{
  /// The fluid at any place that this rank's cells or their next neighbours contain, interpolated
  /// multilinearly between the points of the staggered grid. On the boundary velocities are those
  /// of the walls, the pressure is continued linearly from the two nearest cells, scalars are
  /// those of the nearest cell.
  template <int dim>
  class FluidSampler
  {
  public:
    /// `time` [s] is that of the state. The model must outlive it. Collective.
    FluidSampler(const FluidModel<dim> &model, const FluidState<dim> &state, double time);

    /// [m/s]
    dealii::Tensor<1, dim>
    velocity(const dealii::Point<dim> &place) const;

    /// Reduced pressure p - rho g.x [Pa].
    double
    pressure(const dealii::Point<dim> &place) const;

    /// In alphabetical order of their names.
    std::vector<double>
    scalars(const dealii::Point<dim> &place) const;

    const std::vector<std::string> &
    scalar_names() const;

    /// |curl v| [1/s] in a corner of cells, by differences of the nearest velocities.
    double
    vorticity_magnitude(const GridIndex<dim> &corner) const;

    /// Position of a corner of cells [m]; `corner`[d] counts the planes normal to d.
    dealii::Point<dim>
    corner_position(const GridIndex<dim> &corner) const;

  private:
    /// The places of the centres of the cells on either side of a corner along `axis`, in the
    /// domain.
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    neighbours(const GridIndex<dim> &corner, unsigned int axis) const;

    const FluidModel<dim>   &model;
    Velocity<dim>            velocity_fields;
    Field<dim>               pressure_field;
    std::vector<std::string> names;
    std::vector<Field<dim>>  scalar_fields;
  };
} // namespace undine

#endif
