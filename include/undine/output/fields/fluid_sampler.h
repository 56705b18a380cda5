// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fields_fluid_sampler_h
#define undine_output_fields_fluid_sampler_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/fluid/visibility/body_vicinity.h>
#include <undine/fluid/visibility/visible_samples.h>
#include <undine/surface/surface_queries.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  /// Velocities of the nodes of all surfaces at the time of the state [m/s]. Collective.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  surface_velocities(const Models<dim> &models, const State<dim> &state);

  /// The fluid at any place that this rank's cells or their next neighbours contain, interpolated
  /// multilinearly between the points of the staggered grid. On the boundary velocities are those
  /// of the walls, the pressure is continued linearly from the two nearest cells, scalars are
  /// those of the nearest cell.
  ///
  /// Between bodies only samples that are visible from the place count: points behind a surface are
  /// left out, and of divided cells and faces the visible sub-cells and sub-faces count
  /// (VisibleSamples). Where none of the points around is visible, velocities are those of the
  /// nearest surface; pressure and scalars those of the nearest component in the place's cell, in a
  /// body zero.
  template <int dim>
  class FluidSampler
  {
  public:
    /// The references must outlive it. Collective.
    FluidSampler(const Models<dim> &models, const State<dim> &state);
    FluidSampler(const FluidSampler &) = delete;
    FluidSampler &
    operator=(const FluidSampler &) = delete;

    /// [m/s]
    dealii::Tensor<1, dim>
    velocity(const dealii::Point<dim> &place) const;

    /// Reduced pressure p - rho g.x [Pa].
    double
    pressure(const dealii::Point<dim> &place) const;

    /// Values of all scalars, in alphabetical order of their names.
    std::vector<double>
    scalars(const dealii::Point<dim> &place) const;

    const std::vector<std::string> &
    scalar_names() const;

    /// |curl v| [1/s] in a corner of cells, by differences of the nearest velocities.
    double
    vorticity_magnitude(const GridIndex<dim> &corner) const;

    /// How bodies divide the cells; nullptr: not at all.
    const SubLattice<dim> *
    divided_cells() const;

    /// True unless a surface lies between two places.
    bool
    is_clear(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const;

    /// Velocity of the nearest surface [m/s]. Only where there are bodies.
    dealii::Tensor<1, dim>
    surface_velocity(const dealii::Point<dim> &place) const;

    /// Position of a corner of cells [m]; `corner`[d] counts the planes normal to d.
    dealii::Point<dim>
    corner_position(const GridIndex<dim> &corner) const;

  private:
    /// The places of the centres of the cells on either side of a corner along `axis`, in the
    /// domain.
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    neighbours(const GridIndex<dim> &corner, unsigned int axis) const;

    /// A field and, between bodies, its visible samples.
    struct Sampled
    {
      Field<dim>                           field;
      std::unique_ptr<VisibleSamples<dim>> visible; ///< nullptr: no bodies
    };

    /// Prepare a field for value(). Collective.
    void
    see(Sampled &sampled) const;

    /// Nothing if no point around is visible.
    std::optional<double>
    value(const Sampled &sampled, const dealii::Point<dim> &place) const;

    double
    velocity_component(const unsigned int axis, const dealii::Point<dim> &place) const;

    /// Of a field in cells.
    double
    cell_value(const Sampled &sampled, const dealii::Point<dim> &place) const;

    const FluidModel<dim>                     &model;
    std::unique_ptr<const SurfaceQueries<dim>> surfaces; ///< nullptr: no bodies
    BodyVicinity<dim>                          vicinity;
    std::array<Sampled, dim>                   velocity_fields;
    Sampled                                    pressure_field;
    std::vector<std::string>                   names;
    std::vector<Sampled>                       scalar_fields;
  };
} // namespace undine

#endif
