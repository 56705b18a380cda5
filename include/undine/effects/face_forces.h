// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_effects_face_forces_h
#define undine_effects_face_forces_h

#include <undine/fluid/fluid_stage.h>
#include <undine/fluid/grid/field_algebra.h>

namespace undine
{
  /// An explicit force on the fluid along `axis`: v += g a on the owned faces and pieces, and the
  /// work that it does, the force times the mean of both velocities,
  ///
  ///     sum_f rho V_f g a_f (v_f + g a_f / 2)                                          [J]
  ///
  /// `on_face(index)` and `on_piece(number)` are the accelerations a [m/s^2].
  template <int dim, class OnFace, class OnPiece>
  void
  accelerate_faces(FluidStage<dim>   &step,
                   const unsigned int axis,
                   const OnFace      &on_face,
                   const OnPiece     &on_piece)
  {
    const auto &grid      = step.model.grid();
    auto       &component = step.state.velocity[axis];
    const auto *divided   = component.divided();
    const auto *open      = component.topology().get();
    double      work      = step.work.value_or(0.);
    const auto  act       = [&](double &velocity, const double volume, const double acceleration) {
      const double gain = step.dt * acceleration;
      work += step.model.density() * volume * gain * (velocity + gain / 2);
      velocity += gain;
    };
    for_each(component.owned(), [&](const GridIndex<dim> &face) {
      if (!divided || divided->kind(face) == SubLattice<dim>::Kind::whole)
        act(component(face), grid.dual_volume(axis, face), on_face(face));
    });
    for (unsigned int k = 0; k < component.parts().size(); ++k)
      if (divided->owns(k))
        act(component.parts()[k], open->pieces[axis][k].volume, on_piece(k));
    set_means(component, grid);
    step.work = work;
  }
} // namespace undine

#endif
