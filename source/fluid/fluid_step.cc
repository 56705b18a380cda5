// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/fluid_step.h>

namespace undine
{
  template <int dim>
  FluidStep<dim>::FluidStep(const FluidModel<dim>        &model_,
                            FluidState<dim>              &state_,
                            const dealii::Tensor<1, dim> &gravity_,
                            const double                  time_,
                            const double                  dt_,
                            TimingTree                   &timing_)
    : model(model_)
    , state(state_)
    , gravity(gravity_)
    , time(time_)
    , dt(dt_)
    , timing(timing_)
    , flow(model_, state_.velocity, time_, dt_)
  {
  }


  template <int dim>
  void
  FluidStep<dim>::finish() const
  {
    if (carried)
      for (unsigned int axis = 0; axis < dim; ++axis)
        for_each(state.velocity[axis].owned(), [&](const GridIndex<dim> &face) {
          state.acceleration[axis](face) =
            (state.velocity[axis](face) - (*carried)[axis](face)) / dt;
        });
    if (pressure_correction)
      for_each(state.pressure.owned(), [&](const GridIndex<dim> &cell) {
        state.pressure(cell) += (*pressure_correction)(cell);
      });
  }


  template struct FluidStep<2>;
  template struct FluidStep<3>;
} // namespace undine
