// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_single_physics_h
#define undine_coupled_single_physics_h

#include <undine/base/core/timing.h>
#include <undine/coupled/fluid_geometry.h>
#include <undine/coupled/models.h>
#include <undine/coupled/report.h>
#include <undine/coupled/state.h>
#include <undine/fluid/projection.h>
#include <undine/solid/solid_step.h>

#include <memory>

namespace undine
{
  /// Bodies without a fluid. Each function advances one physics and adds to the report.
  template <int dim>
  class SolidAlone
  {
  public:
    /// The references must outlive it. Collective.
    SolidAlone(const Models<dim> &models, TimingTree &timing);

    /// `dt` [s] is the length of the first step.
    void
    initialize(State<dim> &state, double dt, Report &report) const;

    /// A step of report.dt [s]. Throws SolveError; the state may then be half advanced.
    void
    step(State<dim> &state, Report &report);

  private:
    const SolidModel<dim> &model;
    TimingTree            &timing;
    SolidEnvironment<dim>  environment;
    SolidStep<dim>         solid_step;
  };

  /// A fluid without deformable bodies; obstacles may stand and move in it.
  template <int dim>
  class FluidAlone
  {
  public:
    /// The references must outlive it. Collective.
    FluidAlone(const Models<dim> &models, TimingTree &timing);

    /// `dt` [s] is the length of the first step.
    void
    initialize(State<dim> &state, double dt, Report &report);

    /// A step of report.dt [s]. Throws SolveError; the state may then be half advanced.
    void
    step(State<dim> &state, Report &report);

  private:
    /// Cut the grid by obstacles where they are at the beginning of a step of dt [s].
    void
    place_obstacles(const State<dim> &state, double dt);

    void
    add_columns(Report &report, const FluidState<dim> &state, double divergence, double time) const;

    const Models<dim>                  &models;
    const FluidModel<dim>              &model;
    TimingTree                         &timing;
    Projection<dim>                     projection;
    std::unique_ptr<FluidGeometry<dim>> geometry; ///< nullptr: no obstacles
  };
} // namespace undine

#endif
