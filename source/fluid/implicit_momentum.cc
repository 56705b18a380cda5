// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/implicit_momentum.h>
#include <undine/fluid/pressure/pressure_gradient.h>

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
  void
  ImplicitMomentum<dim>::solve(FluidStage<dim>                            &step,
                               const std::function<void(Velocity<dim> &)> &use_w)
  {
    auto &velocity = step.state.velocity;
    auto  pressure = step.state.pressure;
    pressure.exchange(1);
    const auto gradient = pressure_acceleration(
      step.model,
      pressure,
      open_faces(step.model, step.tracer.velocity(), velocity.topology(), step.time));
    add(velocity, step.dt, gradient);
    set_boundary_velocity(velocity, step.model.boundaries(), step.end);
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto &terms = equation(step, axis);
        step.linear_iterations += terms.step(velocity[axis],
                                             step.tracer.bodies().wall_velocities,
                                             step.end,
                                             step.dt,
                                             step.carrying ? &*step.carrying : nullptr);
        if (!step.tracer.bodies().walls || step.viscosity == 0)
          continue;
        if (!step.friction)
          step.friction.emplace();
        const auto copy = [&](auto &to, const auto &from) {
          to.resize(from.size());
          for (std::size_t k = 0; k < from.size(); ++k)
            to[k][axis] = from[k];
        };
        copy(step.friction->on_nodes, terms.forces().on_nodes);
        copy(step.friction->on_boundaries, terms.forces().on_boundaries);
      }
    use_w(velocity);
    add(velocity, -step.dt, gradient);
  }


  template <int dim>
  std::size_t
  ImplicitMomentum<dim>::memory_consumption() const
  {
    std::size_t sum = 0;
    for (const auto &equation : equations)
      sum += equation ? equation->memory_consumption() : 0;
    return sum;
  }


  template class ImplicitMomentum<2>;
  template class ImplicitMomentum<3>;
} // namespace undine
