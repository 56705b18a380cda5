// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/remap.h>
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/implicit_momentum.h>
#include <undine/fluid/pressure/pressure_gradient.h>

#include <utility>

namespace undine
{
  template <int dim>
  ImmersedViscousTerm<dim> &
  ImplicitMomentum<dim>::equation(const FluidStage<dim> &step, const unsigned int axis)
  {
    const auto &bodies   = step.tracer.bodies();
    auto       &equation = equations[axis];
    if (!nothing_cut)
      nothing_cut = std::make_shared<const FluidTopology<dim>>();
    if (!no_surfaces)
      no_surfaces = std::make_shared<const NoSlipSurfaces<dim>>();
    const auto &walls    = bodies.walls ? bodies.walls : no_surfaces;
    const auto &topology = bodies.topology ? bodies.topology : nothing_cut;
    if (!equation || equation->walls() != walls || equation->topology() != topology)
      equation = std::make_unique<ImmersedViscousTerm<dim>>(
        step.model, axis, topology, walls, step.viscosity);
    return *equation;
  }


  template <int dim>
  ImplicitDiffusion<dim> &
  ImplicitMomentum<dim>::diffusion(const FluidStage<dim> &step, const unsigned int axis)
  {
    if (!diffusions[axis])
      {
        conditions[axis] = std::make_unique<VelocityCondition<dim>>(axis);
        diffusions[axis] =
          std::make_unique<ImplicitDiffusion<dim>>(step.model,
                                                   step.model.grid().faces(axis),
                                                   *conditions[axis],
                                                   step.viscosity / step.model.density());
      }
    return *diffusions[axis];
  }


  /// With convection, where nothing is cut and nothing moves. False, and nothing has changed, where
  /// that is not so or relaxation would take long.
  template <int dim>
  bool
  ImplicitMomentum<dim>::relax(FluidStage<dim> &step)
  {
    if (step.carrying->topology() || step.carrying->start())
      return false;
    auto         velocity = step.state.velocity;
    unsigned int n_sweeps = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto sweeps =
          diffusion(step, axis).relax(velocity[axis], step.end, step.dt, &*step.carrying);
        if (!sweeps)
          return false;
        n_sweeps += *sweeps;
      }
    step.state.velocity = std::move(velocity);
    step.linear_iterations += n_sweeps;
    return true;
  }


  template <int dim>
  void
  ImplicitMomentum<dim>::solve_among_surfaces(FluidStage<dim> &step)
  {
    const auto &bodies     = step.tracer.bodies();
    const auto &velocities = step.impedance ? step.impedance->velocities() : bodies.wall_velocities;
    typename FrictionWithBodies<dim>::Equations all;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        all[axis] = &equation(step, axis);
        all[axis]->start(step.state.velocity[axis],
                         velocities,
                         step.end,
                         step.dt,
                         step.carrying ? &*step.carrying : nullptr);
      }
    step.wall_velocities = velocities;
    if (step.impedance)
      solve_with_bodies(step, all);
    else
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          auto solution = all[axis]->guess();
          step.linear_iterations += all[axis]->solve(solution);
          all[axis]->finish(step.state.velocity[axis], solution);
        }
    if (!bodies.walls || step.viscosity == 0)
      return;
    step.friction.emplace();
    const auto copy = [&](const unsigned int axis, auto &to, const auto &from) {
      to.resize(from.size());
      for (std::size_t k = 0; k < from.size(); ++k)
        to[k][axis] = from[k];
    };
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        copy(axis, step.friction->on_nodes, all[axis]->forces().on_nodes);
        copy(axis, step.friction->on_boundaries, all[axis]->forces().on_boundaries);
      }
    if (step.impedance)
      step.impedance->add_friction_of_motion(step.friction->on_nodes, step.wall_velocities);
  }


  template <int dim>
  void
  ImplicitMomentum<dim>::solve_with_bodies(FluidStage<dim>                                   &step,
                                           const typename FrictionWithBodies<dim>::Equations &all)
  {
    FrictionWithBodies<dim> problem(all, *step.impedance, step.dt);
    step.linear_iterations += problem.solve();
    const auto change = problem.finish(step.state.velocity);
    for (std::size_t node = 0; node < change.size(); ++node)
      step.wall_velocities[node] += change[node];
    step.wall_damping = problem.damping();
  }


  template <int dim>
  void
  ImplicitMomentum<dim>::solve(FluidStage<dim>   &step,
                               const std::string &effect,
                               const Action      &use_w)
  {
    auto &velocity = step.state.velocity;
    // Friction must not see the pressure of the other side of a thin body that has moved.
    if (step.pressure_before)
      step.state.pressure = remapped(step.tracer, *step.pressure_before, PressureCondition<dim>());
    auto pressure = step.state.pressure;
    pressure.exchange(1);
    const auto gradient =
      pressure_acceleration(step.model,
                            pressure,
                            open_faces(step.model,
                                       step.tracer.velocity(),
                                       velocity.topology(),
                                       step.state.pressure_time.value_or(step.time)));
    add(velocity, step.dt, gradient);
    set_boundary_velocity(velocity, step.model.boundaries(), step.end);
    if (step.tracer.bodies().walls || (step.carrying && !relax(step)))
      solve_among_surfaces(step);
    else if (!step.carrying)
      for (unsigned int axis = 0; axis < dim; ++axis)
        step.linear_iterations += diffusion(step, axis).step(velocity[axis], step.end, step.dt);
    use_w(velocity);
    std::size_t memory = pressure.memory_consumption() + undine::memory_consumption(gradient);
    for (const auto *field : {&step.pressure_correction, &step.pressure_before})
      if (*field)
        memory += (*field)->memory_consumption();
    step.timing.memory.hold_briefly(effect, memory);
    add(velocity, -step.dt, gradient);
  }


  template <int dim>
  std::size_t
  ImplicitMomentum<dim>::memory_consumption() const
  {
    std::size_t sum = 0;
    for (const auto &diffusion : diffusions)
      sum += diffusion ? diffusion->memory_consumption() : 0;
    for (const auto &equation : equations)
      sum += equation ? equation->memory_consumption() : 0;
    return sum;
  }


  template class ImplicitMomentum<2>;
  template class ImplicitMomentum<3>;
} // namespace undine
