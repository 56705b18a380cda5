// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection.h>
#include <undine/fluid/fluid_step.h>
#include <undine/fluid/pressure_gradient.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// The same values on points, and on parts the mean of their point.
    template <int dim>
    Field<dim>
    moved_to(const Field<dim> &old, const std::shared_ptr<const OpenParts<dim>> &open_parts)
    {
      Field<dim> result(old.shared_lattice(), open_parts);
      for_each(result.owned(), [&](const GridIndex<dim> &index) { result(index) = old(index); });
      for (std::size_t k = 0; k < result.parts().size(); ++k)
        if (result.divided()->owns(k))
          result.parts()[k] = old(result.divided()->all()[k].index);
      return result;
    }
  } // namespace


  template <int dim>
  FluidStep<dim>::FluidStep(const FluidModel<dim>            &model_,
                            FluidState<dim>                  &state_,
                            const dealii::Tensor<1, dim>     &gravity_,
                            const double                      time_,
                            const double                      dt_,
                            TimingTree                       &timing_,
                            const typename Flow<dim>::Bodies &bodies)
    : model(model_)
    , state(state_)
    , gravity(gravity_)
    , time(time_)
    , dt(dt_)
    , timing(timing_)
    , flow(model_, state_.velocity, time_, dt_, bodies)
  {
    const auto &now = bodies.open_parts;
    if (state.pressure.open_parts() == now)
      return;
    state.pressure = moved_to(state.pressure, now);
    for (auto &component : state.acceleration.components)
      component = moved_to(component, now);
    if (!now)
      return;
    // Parts have no acceleration to be carried: a body may just have uncovered them.
    for (auto &component : state.acceleration.components)
      {
        std::fill(component.parts().begin(), component.parts().end(), 0.);
        set_means(component, model.grid());
      }
  }


  template <int dim>
  void
  FluidStep<dim>::settle()
  {
    const auto &now = flow.bodies().open_parts;
    if (state.velocity[0].open_parts() == now)
      return;
    const Flow<dim> still(model, flow.velocity(), time, 0., flow.bodies());
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const VelocityCondition<dim> condition(axis);
        const auto                   source = completed(still, state.velocity[axis], condition);
        state.velocity[axis]                = carry(
          still, source, condition, [&](const auto &, const auto &face) { return source(face); });
      }
  }


  template <int dim>
  void
  FluidStep<dim>::finish() const
  {
    if (carried)
      for (unsigned int axis = 0; axis < dim; ++axis)
        for_each(state.velocity[axis].owned(), [&](const GridIndex<dim> &face) {
          const auto *divided = state.velocity[axis].divided();
          const bool  whole   = !divided || divided->kind(face) == LatticeParts<dim>::Kind::whole;
          state.acceleration[axis](face) =
            whole ? (state.velocity[axis](face) - (*carried)[axis](face)) / dt : 0.;
        });
    if (pressure_correction)
      add(state.pressure, 1., *pressure_correction);
  }


  template struct FluidStep<2>;
  template struct FluidStep<3>;
} // namespace undine
