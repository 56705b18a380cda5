// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_one_way_h
#define undine_coupled_step_one_way_h

#include <undine/coupled/step/fluid_side.h>
#include <undine/coupled/step/physics.h>
#include <undine/coupled/step/solid_side.h>

namespace undine
{
  /// One-way coupling of bodies and fluid (Direction), the same for all schemes. A stage of length
  /// h from its start:
  ///
  ///     fluid to body    1. fluid: v*, p^{n+1} and v^{n+1} around bodies that stay as they were at
  ///                         the start of the run: their surface is cut once
  ///                      2. bodies: u^{n+1} under the load J p^{n+1} of that surface
  ///     body to fluid    1. bodies: u^{n+1} without a fluid
  ///                      2. fluid: v*, then the projection between surfaces that move with u^{n+1}
  template <int dim>
  class OneWay : public Physics<dim>
  {
  public:
    /// The references must outlive it. Collective.
    OneWay(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing);

    void
    initialize(State<dim> &state, double dt, Report &report) override;

    void
    solve_stage(State<dim> &state, const Stage &stage, Report &report) override;

    std::vector<dealii::Tensor<1, dim>>
    loads_on_surfaces(const State<dim> &state, double time) const override;

  private:
    using Exchange = SurfaceExchange<dim>;
    using Vectors  = typename Exchange::Vectors;

    struct Half
    {
      std::unique_ptr<FluidStage<dim>> fluid;
      typename Projection<dim>::Report projected;
      SolidReport<dim>                 solid;
      Exchange                         exchange;
    };

    Half
    fluid_then_body(State<dim> &state, const Stage &stage, Report &report);
    Half
    body_then_fluid(State<dim> &state, const Stage &stage, Report &report);
    void
    advance_bodies(Half                                   &half,
                   State<dim>                             &state,
                   const Stage                            &stage,
                   const typename SolidModel<dim>::Vector &forces);
    void
    project(Half &half, State<dim> &state, const Vectors &velocities);
    void
    book(Half &half, const State<dim> &state);

    const Models<dim> &models;
    Budget<dim>       &budget;
    TimingTree        &timing;
    FluidSide<dim>     fluid_side;
    SolidSide<dim>     solid_side;
    Projection<dim>    projection;
    SolidState         at_start; ///< the bodies that the fluid flows around with `fluid to body`
  };
} // namespace undine

#endif
