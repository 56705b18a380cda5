// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_scalars_face_means_h
#define undine_fluid_scalars_face_means_h

#include <undine/fluid/scalars/scalar_bounds.h>
#include <undine/fluid/scalars/scalar_fluxes.h>

namespace undine
{
  /// The means over a stage of what the flow brings to the faces: the values at the feet of paths
  /// that arrive there at the middles of n equal parts of the stage, n so that no path crosses more
  /// than a cell in a part,
  ///
  ///     s_face = sum_k s(x(-(k - 1/2) h / n)) / n,                                        (F20)
  ///
  /// by cubic interpolation of `half`, the scalar after half of the stage without flow, `begin`
  /// being that before; what has come in meanwhile is what it was when it did, and has changed
  /// since. NaN on
  /// pieces and where paths come near bodies. Where `bounds` leave no choice on either side, to a
  /// share of the field's range that may be neglected, paths are not traced. One ghost layer is up
  /// to date. Collective.
  template <int dim>
  Velocity<dim>
  face_means(const ScalarFluxes<dim> &fluxes,
             const Field<dim>        &begin,
             const Field<dim>        &half,
             ScalarBounds<dim>       &bounds);
} // namespace undine

#endif
