// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_viscous_coupling_h
#define undine_coupled_immersed_viscous_coupling_h

#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/state/state.h>
#include <undine/fluid/fluid_stage.h>

#include <memory>
#include <vector>

namespace undine
{
  /// The coupling of surfaces in the fluid with its viscous forces, stage by stage: no-slip
  /// surfaces, velocities of their nodes, and the forces that result.
  ///
  /// Friction is found before the bodies move, with nodes that give way to it by (I8)
  ///
  ///     m (u' - u^0) = h (F + G),   G = m (u^{n+1} - u^0)/h - F  of the last stage,
  ///
  /// m being that of node_masses(). G stands for all forces on a node other than friction: in a
  /// steady state u' = u^0.
  template <int dim>
  class ViscousCoupling
  {
  public:
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    /// The models must outlive it. Without friction it does nothing. Collective.
    explicit ViscousCoupling(const Models<dim> &models);

    /// The no-slip surfaces of the grid as it is cut now. Collective.
    std::shared_ptr<const NoSlipSurfaces<dim>>
    walls(const FluidGeometry<dim> &geometry);

    /// A stage of length `dt` [s] begins. Returns the velocities of all nodes, u^0 + h G / m [m/s];
    /// where they are prescribed, those of `geometry`.
    Vectors
    start(const State<dim> &state, const FluidGeometry<dim> &geometry, double dt);

    /// The stage has ended: G for the next one. Collective.
    void
    end(State<dim> &state, const FluidStage<dim> &fluid);

    /// Friction of the last stage on all nodes [N]; empty without friction.
    const Vectors &
    forces() const
    {
      return last_forces;
    }

  private:
    const Models<dim>                         &models;
    const Vectors                              masses;
    std::shared_ptr<const FluidTopology<dim>>  cut_by;
    std::shared_ptr<const NoSlipSurfaces<dim>> known_surfaces; ///< of the grid that is cut so
    Vectors                                    started;        ///< u^0 [m/s]
    Vectors                                    last_forces;
  };
} // namespace undine

#endif
