// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_fluid_side_h
#define undine_coupled_step_fluid_side_h

#include <undine/base/core/timing.h>
#include <undine/coupled/budget/budget.h>
#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/immersed/viscous_coupling.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/report.h>
#include <undine/coupled/state/state.h>
#include <undine/coupled/step/misplacement.h>
#include <undine/fluid/fluid_stage.h>
#include <undine/fluid/pressure/projection.h>

#include <memory>

namespace undine
{
  /// The part of a stage that the fluid goes through in every scheme: cutting the grid, transport,
  /// forces and implicit terms, and what follows the pressures; all but the pressures themselves.
  template <int dim>
  class FluidSide
  {
  public:
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    /// The references must outlive it. Collective.
    FluidSide(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing);

    /// Set the fluid of `state` to its initial fields, made divergence-free by `projection`, around
    /// the bodies of `state`; adds to the report. `dt` [s] is the length of the first step.
    /// Collective. Throws SolveError, and InputError if bodies and obstacles leave no fluid.
    void
    initialize(State<dim> &state, Projection<dim> &projection, double dt, Report &report);

    /// Cut the grid by the surfaces of bodies and obstacles, then transport, forces and implicit
    /// terms of every effect that is on: v^n in `state` becomes v*. The bodies in `state` are those
    /// at the stage's start. In the last stage the account of `report`, if it has one, gets the
    /// power of forces and of walls that move along themselves. Collective. Throws SolveError.
    std::unique_ptr<FluidStage<dim>>
    predict(State<dim> &state, const Stage &stage, Report &report);

    /// The next predict() cuts the grid where surfaces have nodes at `places` [m], instead of where
    /// it expects them.
    void
    expect(typename FluidGeometry<dim>::Positions places);

    /// Of the surfaces, whose nodes have come to `places` [m], from where the grid was cut in this
    /// stage.
    Misplacement
    misplacement(const typename FluidGeometry<dim>::Positions &places) const;

    /// The end of the stage that predict() began, after the velocity has been made divergence-free
    /// up to `divergence` [1]; adds to the report, and to its account the power of the kinetic
    /// energy that the flow brings in and takes out. Collective.
    void
    finish(FluidStage<dim> &fluid, State<dim> &state, Report &report, double divergence);

    /// After finish(): see ViscousCoupling::defect().
    double
    friction_defect() const
    {
      return viscous_coupling.defect();
    }

    /// Forces of pressure, weight and friction in the nodes of all surfaces [N], after finish(), at
    /// `time` [s]; empty if there is no surface in the fluid. Collective.
    Vectors
    loads_on_surfaces(const State<dim> &state, double time) const;

    /// The grid as surfaces cut it; nullptr if there is no surface in the fluid.
    const FluidGeometry<dim> *
    geometry() const
    {
      return cut.get();
    }

    /// Gravity of the effects [m/s^2].
    const dealii::Tensor<1, dim> &
    gravity() const
    {
      return environment.gravity;
    }

  private:
    double
    pressure_at_rest(const FluidState<dim> &fluid, double time) const;
    template <class Action, class Book>
    void
    run_phase(FluidStage<dim> &fluid, const Action &act, const Book &book);
    void
    count_memory(const FluidState<dim> &state);
    Vectors
    pressures_on_surfaces(const State<dim> &state, double time) const;
    void
    add_impulses(Impulses<dim>         &impulses,
                 const FluidStage<dim> &fluid,
                 const Vectors         &pressures) const;
    SolidState
    expected_bodies(const State<dim> &state, const Stage &stage, double time) const;
    void
    place_surfaces(const State<dim> &state, const Stage &stage);
    void
    share_parts(FluidState<dim> &state) const;
    typename CharacteristicTracer<dim>::Bodies
    bodies() const;
    typename CharacteristicTracer<dim>::Bodies
    no_slip_bodies();
    void
    add_columns(Report &report, const State<dim> &state, double divergence, double time) const;

    const Models<dim>                     &models;
    const FluidModel<dim>                 &model;
    Budget<dim>                           &budget;
    TimingTree                            &timing;
    const SolidEnvironment<dim>            environment;
    std::unique_ptr<FluidGeometry<dim>>    cut;
    ViscousCoupling<dim>                   viscous_coupling;
    typename FluidGeometry<dim>::Positions expected; ///< of the next predict(); empty: to be found
  };
} // namespace undine

#endif
