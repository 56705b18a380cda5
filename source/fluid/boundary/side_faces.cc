// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/side_faces.h>

namespace undine
{
  template <int dim>
  double
  signed_area(const MacGrid<dim>       &grid,
              const FluidTopology<dim> *topology,
              const SideFace<dim>      &face)
  {
    const unsigned int axis = face.side.axis;
    return face.side.sign() * (face.piece < 0 ? grid.face_area(axis, face.face)
                                              : topology->faces[axis].all()[face.piece].measure);
  }


  template <int dim>
  double
  value_on(const Velocity<dim> &velocity, const SideFace<dim> &face)
  {
    const auto &component = velocity[face.side.axis];
    return face.piece < 0 ? component(face.face) : component.parts()[face.piece];
  }


  template <int dim>
  double
  outward_flux(const MacGrid<dim> &grid, const Velocity<dim> &velocity, const SideFace<dim> &face)
  {
    return signed_area(grid, velocity.topology(), face) * value_on(velocity, face);
  }


  template <int dim>
  PressurePlace<dim>
  place_inside(const FluidTopology<dim> *topology, const SideFace<dim> &face)
  {
    if (face.piece < 0)
      return {face.cell, -1};
    return end_of_piece(*topology, face.side.axis, face.piece, 1 - face.side.end);
  }


#define INSTANTIATE(dim)                                                      \
  template double signed_area(                                                \
    const MacGrid<dim> &, const FluidTopology<dim> *, const SideFace<dim> &); \
  template double value_on(const Velocity<dim> &, const SideFace<dim> &);     \
  template double outward_flux(                                               \
    const MacGrid<dim> &, const Velocity<dim> &, const SideFace<dim> &);      \
  template PressurePlace<dim> place_inside(const FluidTopology<dim> *, const SideFace<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
