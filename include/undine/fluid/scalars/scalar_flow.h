// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_scalars_scalar_flow_h
#define undine_fluid_scalars_scalar_flow_h

#include <undine/fluid/advection/characteristic_tracer.h>
#include <undine/fluid/pressure/projection.h>
#include <undine/fluid/visibility/cell_transfer.h>

#include <optional>

namespace undine
{
  /// The flow that carries scalars from cell to cell during a stage, that in its middle, and the
  /// volumes of cells and components meanwhile, on the present topology of the fluid. With the
  /// volume rate phi out through each face and piece and the duration h of the stage,
  ///
  ///     V - V^b = -h sum phi                                                              (F17)
  ///
  /// in each of them, V^b being the volume at its begin, where surfaces have since been taken to
  /// where they are now (CellTransfer): a uniform scalar stays uniform.
  template <int dim>
  class ScalarFlow
  {
  public:
    /// `tracer` has the flow in the middle of the stage, `projection` makes it fit. The references
    /// must outlive this. Collective.
    ScalarFlow(const CharacteristicTracer<dim> &tracer, Projection<dim> &projection);

    /// From the topology at the begin of the stage to the present one: what there is of a scalar,
    /// as its mean over V^b; NaN where V^b = 0. Collective.
    Field<dim>
    at_start(const Field<dim> &scalar) const;

    /// V^b + t sum -phi for `share` t / h of the stage [m^dim]; not negative.
    Field<dim>
    volumes(double share) const;

    /// Have surfaces changed the topology, and with it the volumes?
    bool
    has_moved() const
    {
      return transfer.has_value();
    }

    const FluidModel<dim> &
    model() const
    {
      return tracer.model();
    }

    /// Of the fluid, during the stage.
    const CharacteristicTracer<dim> &
    paths() const
    {
      return tracer;
    }

    /// [m/s]; one ghost layer is up to date.
    const Velocity<dim> &
    velocity() const
    {
      return flow;
    }

    /// The present one of the fluid.
    const std::shared_ptr<const FluidTopology<dim>> &
    topology() const
    {
      return tracer.bodies().topology;
    }

    /// Begin of the stage [s].
    double
    begin() const
    {
      return tracer.time();
    }

    /// h [s].
    double
    duration() const
    {
      return tracer.dt();
    }

    /// For the timing of solvers.
    unsigned int
    iterations() const
    {
      return n_iterations;
    }

    /// [bytes]
    std::size_t
    memory_consumption() const;

  private:
    void
    fit(Projection<dim> &projection, const Field<dim> &growth);

    const CharacteristicTracer<dim>       &tracer;
    std::optional<const CellTransfer<dim>> transfer; ///< none: the topology is the same
    Velocity<dim>                          flow;
    Field<dim>                             begin_volumes; ///< V^b on the present topology [m^dim]
    Field<dim>                             start_volumes; ///< as the fluxes say [m^dim]
    Field<dim>                             outflow;       ///< sum phi [m^dim/s]
    unsigned int                           n_iterations = 0;
  };
} // namespace undine

#endif
