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


  /// An acceleration a [m/s^2] as it acts on a piece of area A_f, along the segment from the
  /// pressure below to the one above, x_0 and x_1, taken as the centroids of their components (at a
  /// side of the domain as that of the piece):
  ///
  ///     (A_f / V_f) a . (x_1 - x_0)                                                    [m/s^2]
  ///
  /// A uniform force is then the gradient of a pressure, exactly, and fluid that it cannot move
  /// stays at rest.
  template <int dim>
  double
  acting_on_piece(const MacGrid<dim>           &grid,
                  const FluidTopology<dim>     &open,
                  const unsigned int            axis,
                  const unsigned int            piece,
                  const dealii::Tensor<1, dim> &acceleration)
  {
    const auto &part  = open.faces[axis].all()[piece];
    const auto  place = [&](const unsigned int end) {
      const int beside = open.pieces[axis][piece].components[end];
      if (beside == FluidTopology<dim>::outside)
        return part.place;
      if (beside == FluidTopology<dim>::whole)
        return grid.cells()->point(moved<dim>(part.index, axis, int(end) - 1));
      return open.cells.all()[beside].place;
    };
    return acceleration * (place(1) - place(0)) * part.measure / open.pieces[axis][piece].volume;
  }
} // namespace undine

#endif
