// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_face_place_h
#define undine_fluid_grid_face_place_h

#include <undine/fluid/grid/field.h>

namespace undine
{
  /// Where one velocity sits: on a whole face or on a piece of a divided one.
  template <int dim>
  struct FacePlace
  {
    GridIndex<dim> face;
    int            part; ///< number in FluidTopology::faces; -1: the face is whole
  };

  /// The value of a component of the velocity there.
  template <int dim>
  double
  value_at(const Field<dim> &field, const FacePlace<dim> &place)
  {
    return place.part < 0 ? field(place.face) : field.parts()[place.part];
  }
} // namespace undine

#endif
