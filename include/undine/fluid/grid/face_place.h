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


  /// The value of a point, or of the part with that number unless it is negative. @{
  template <int dim>
  double &
  value_at(Field<dim> &field, const GridIndex<dim> &index, const int part)
  {
    return part < 0 ? field(index) : field.parts()[part];
  }

  template <int dim>
  double
  value_at(const Field<dim> &field, const GridIndex<dim> &index, const int part)
  {
    return part < 0 ? field(index) : field.parts()[part];
  }
  /// @}


  /// Is a point open all over? nullptr: all are.
  template <int dim>
  bool
  is_whole(const SubLattice<dim> *divided, const GridIndex<dim> &index)
  {
    return !divided || divided->kind(index) == SubLattice<dim>::Kind::whole;
  }


  /// Call `action(FacePlace)` for what is open of a face.
  template <int dim, class Action>
  void
  for_each_place(const SubLattice<dim> *divided, const GridIndex<dim> &face, Action &&action)
  {
    if (is_whole(divided, face))
      action(FacePlace<dim>{face, -1});
    else
      for_each_part(*divided, face, [&](const int part) { action(FacePlace<dim>{face, part}); });
  }
} // namespace undine

#endif
