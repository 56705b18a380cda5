// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_fluid_alone_h
#define undine_coupled_step_fluid_alone_h

#include <undine/base/core/timing.h>
#include <undine/coupled/step/fluid_side.h>
#include <undine/coupled/step/physics.h>
#include <undine/fluid/pressure/projection.h>

namespace undine
{
  /// A fluid without deformable bodies; it may contain obstacles, fixed or moving.
  template <int dim>
  class FluidAlone : public Physics<dim>
  {
  public:
    /// The references must outlive it. Collective.
    FluidAlone(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing);

    void
    initialize(State<dim> &state, double dt, Report &report) override;

    void
    solve_stage(State<dim> &state, const Stage &stage, Report &report) override;

    std::vector<dealii::Tensor<1, dim>>
    loads_on_surfaces(const State<dim> &state, double time) const override;

  private:
    void
    solve_once(State<dim> &state, const Stage &stage, Report &report);
    void
    balance(const State<dim> &state, const typename Projection<dim>::Report &projected);

    const Models<dim>     &models;
    const FluidModel<dim> &model;
    Budget<dim>           &budget;
    TimingTree            &timing;
    FluidSide<dim>         fluid_side;
    Projection<dim>        projection;
    const bool             keeps_levels; ///< of pressure in closed regions, between sleeping bodies
    const bool             loads_bodies; ///< that sleep: else they wake of their own loads alone
  };
} // namespace undine

#endif
