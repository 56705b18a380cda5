// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_surface_friction_h
#define undine_coupled_immersed_surface_friction_h

#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/state/state.h>
#include <undine/fluid/fluid_step.h>

#include <memory>
#include <vector>

namespace undine
{
  /// What the friction of the fluid needs from the surfaces in it, stage by stage, and what it
  /// leaves.
  ///
  /// Friction is found before the bodies move, with nodes that give way by
  ///
  ///     m (u' - u^0) = h (F + G),   G = m (u^{n+1} - u^0)/h - F  of the last stage,
  ///
  /// m being that of node_masses(). G stands for all that holds a node
  /// besides friction: where nothing changes, u' = u^0, and a body is held as it is.
  template <int dim>
  class SurfaceFriction
  {
  public:
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    /// The models must outlive it. Without friction it does nothing. Collective.
    explicit SurfaceFriction(const Models<dim> &models);

    /// Where the surfaces are now. Collective.
    std::shared_ptr<const NoSlipSurfaces<dim>>
    walls(const FluidGeometry<dim> &geometry);

    /// Of all nodes u^0 + h G / m [m/s]; prescribed ones as `geometry` says. A stage of length `dt`
    /// [s] begins.
    Vectors
    start(const State<dim> &state, const FluidGeometry<dim> &geometry, double dt);

    /// The stage has ended: G for the next one. Collective.
    void
    end(State<dim> &state, const FluidStep<dim> &fluid);

    /// In all nodes, of the last stage [N]; empty without friction.
    const Vectors &
    forces() const
    {
      return last_forces;
    }

  private:
    const Models<dim>                         &models;
    const Vectors                              masses;
    std::shared_ptr<const FluidTopology<dim>>  cut_by;
    std::shared_ptr<const NoSlipSurfaces<dim>> known_walls; ///< of the grid that is cut so
    Vectors                                    started;     ///< u^0 [m/s]
    Vectors                                    last_forces;
  };
} // namespace undine

#endif
