// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/remap.h>
#include <undine/fluid/convection/moved_dual_volumes.h>
#include <undine/fluid/fluid_stage.h>
#include <undine/fluid/grid/field_algebra.h>

#include <algorithm>
#include <utility>

namespace undine
{
  namespace
  {
    /// The same values on points, and in sub-cells or sub-faces the value of their point.
    template <int dim>
    Field<dim>
    moved_to(const Field<dim> &old, const std::shared_ptr<const FluidTopology<dim>> &topology)
    {
      Field<dim> result(old.shared_lattice(), topology);
      for_each(result.owned(), [&](const GridIndex<dim> &index) { result(index) = old(index); });
      for (std::size_t k = 0; k < result.parts().size(); ++k)
        if (result.divided()->owns(k))
          result.parts()[k] = old(result.divided()->all()[k].index);
      return result;
    }


    /// The flow in the middle of the stage.
    template <int dim>
    Velocity<dim>
    advecting_velocity(const FluidState<dim> &state, const Stage &stage)
    {
      auto result = state.velocity;
      if (stage.keeps_rates())
        add(result, stage.duration() / 2, state.change);
      return result;
    }


    /// (after - before) / length.
    template <int dim>
    Velocity<dim>
    difference(Velocity<dim> after, const Velocity<dim> &before, const double length)
    {
      add(after, -1., before);
      scale(after, 1 / length);
      return after;
    }
  } // namespace


  template <int dim>
  FluidStage<dim>::FluidStage(const FluidModel<dim>                            &model_,
                              FluidState<dim>                                  &state_,
                              const dealii::Tensor<1, dim>                     &gravity_,
                              const double                                      time_,
                              const Stage                                      &stage_,
                              TimingTree                                       &timing_,
                              const typename CharacteristicTracer<dim>::Bodies &bodies)
    : model(model_)
    , state(state_)
    , gravity(gravity_)
    , stage(stage_)
    , time(time_ + stage.begin)
    , start(time_ + stage.start())
    , end(time_ + stage.end)
    , dt(stage.length)
    , timing(timing_)
    , tracer(model_,
             advecting_velocity(state_, stage),
             time,
             stage.duration(),
             bodies,
             stage.keeps_rates() ? time + stage.duration() / 2 : time)
  {
    if (stage.keeps_rates())
      go_on();
    move_pressure_and_acceleration();
  }


  /// From v^b to v^0.
  template <int dim>
  void
  FluidStage<dim>::go_on()
  {
    before = state.velocity;
    if (keeps_mean())
      advected_begin = before;
    if (stage.going_on() != 0)
      add(state.velocity, stage.going_on(), state.acceleration);
  }


  template <int dim>
  void
  FluidStage<dim>::move_pressure_and_acceleration()
  {
    const auto &now = tracer.bodies().topology;
    if (state.pressure.topology() != now)
      {
        pressure_before = std::move(state.pressure);
        state.pressure  = moved_to(*pressure_before, now);
      }
    // Stages that keep rates have advected accelerations as part of velocities.
    if (stage.keeps_rates() || state.acceleration[0].topology() == now)
      return;
    for (auto &component : state.acceleration.components)
      component = moved_to(component, now);
    for (auto &component : state.change.components) // which this integrator does not know
      component = Field<dim>(component.shared_lattice(), now);
    if (!now)
      return;
    // Pieces have no acceleration to be advected: they may be freshly cleared.
    for (auto &component : state.acceleration.components)
      {
        std::fill(component.parts().begin(), component.parts().end(), 0.);
        set_means(component, model.grid());
      }
  }


  template <int dim>
  std::vector<Velocity<dim> *>
  FluidStage<dim>::advected_velocities()
  {
    if (advected_begin)
      return {&state.velocity, &*advected_begin};
    return {&state.velocity};
  }


  /// The same velocity on the present topology of the fluid.
  template <int dim>
  Velocity<dim>
  FluidStage<dim>::remapped_velocity(const Velocity<dim> &velocity) const
  {
    auto result = velocity;
    for (unsigned int axis = 0; axis < dim; ++axis)
      result[axis] = remapped(tracer, velocity[axis], VelocityCondition<dim>(axis));
    return result;
  }


  template <int dim>
  void
  FluidStage<dim>::remap()
  {
    std::optional<Velocity<dim>> begin;
    const bool has_moved = tracer.velocity()[0].topology() != tracer.bodies().topology;
    // Where surfaces have just come to rest, the rates of the stage before still count.
    if (conserves_momentum && (has_moved || (state.volume_rates.time > 0 && stage.going_on() != 0)))
      begin = stage.keeps_rates() ? before : state.velocity;
    for (auto *velocity : advected_velocities())
      if ((*velocity)[0].topology() != tracer.bodies().topology)
        *velocity = remapped_velocity(*velocity);
    if (stage.keeps_rates())
      {
        advected = state.velocity;
        before   = remapped_velocity(before);
      }
    if (begin)
      move_dual_volumes(*begin);
    if (!has_moved)
      state.volume_rates.time = 0;
  }


  /// With momentum conserved as the volumes of faces change, where these had one: `velocity` is v^b
  /// on the topology of the fluid before (F15).
  template <int dim>
  void
  FluidStage<dim>::move_dual_volumes(const Velocity<dim> &velocity)
  {
    const MovedDualVolumes<dim> volumes(model.grid(),
                                        velocity[0].topology(),
                                        tracer.bodies().topology,
                                        tracer.vicinity(),
                                        state.volume_rates,
                                        stage);
    volumes.move_to_start(state.velocity, velocity, state.acceleration);
    if (stage.keeps_rates())
      {
        advected        = state.velocity;
        resampled_begin = before;
        volumes.move(before, velocity);
        if (advected_begin)
          volumes.move(*advected_begin, velocity);
      }
    dual_motion.emplace();
    dual_motion->rates  = volumes.rates();
    dual_motion->growth = volumes.growth();
    dual_motion->start  = state.velocity;
    state.volume_rates  = volumes.kept_rates();
  }


  template <int dim>
  Velocity<dim>
  FluidStage<dim>::flow_at_end() const
  {
    auto result = remapped_velocity(tracer.velocity());
    if (stage.keeps_rates())
      {
        add(result, 1., result);
        add(result, -1., resampled_begin ? *resampled_begin : before);
      }
    set_boundary_velocity(result, model.boundaries(), end);
    return result;
  }


  template <int dim>
  void
  FluidStage<dim>::finish()
  {
    state.pressure_time.reset();
    if (stage.keeps_rates())
      {
        state.acceleration = advected_begin
                               ? difference(state.velocity, *advected_begin, stage.duration())
                               : difference(state.velocity, *advected, stage.length);
        if (by_contact)
          add(state.acceleration,
              -1 / (advected_begin ? stage.duration() : stage.length),
              *by_contact);
        state.change = difference(state.velocity, before, stage.duration());
      }
    else if (advected)
      for (unsigned int axis = 0; axis < dim; ++axis)
        for_each(state.velocity[axis].owned(), [&](const GridIndex<dim> &face) {
          const auto *divided = state.velocity[axis].divided();
          const bool  whole   = !divided || divided->kind(face) == SubLattice<dim>::Kind::whole;
          state.acceleration[axis](face) =
            whole ? (state.velocity[axis](face) - (*advected)[axis](face)) / dt : 0.;
        });
    if (pressure_correction)
      {
        add(state.pressure, 1., *pressure_correction);
        set_means(state.pressure, model.grid());
      }
  }


  template struct FluidStage<2>;
  template struct FluidStage<3>;
} // namespace undine
