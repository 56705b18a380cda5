// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_local_shift_h
#define undine_particles_fluid_local_shift_h

#include <undine/particles/model/constants.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// Moves the fluid at a free surface towards even spacing, as PressureForces says, but for the
  /// mean of what neighbours are moved by: what a whole neighbourhood has in common does not even
  /// its spacing. It would let fluid flow from where its lattice is compressed along the surface,
  /// below crests, to where it is stretched, and dampen waves by 10 % a period. Half of the rest is
  /// made: what differs from one particle to the next is then evened as fast as by the whole.
  template <int dim, class Real>
  struct LocalShift
  {
    Constants<dim, Real>           constants;
    Neighbours<dim, Real>          neighbours;
    const StoredVector<dim, Real> *shifts; ///< [m]
    Place<dim, Real>              *new_places;
    const StepControl             *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      if (control->done() || neighbours.places[i].tag.kind() != Kind::fluid)
        return;
      auto       common = Vector<dim, Real>::zero();
      Real       weight = 0;
      const auto fetch  = [&](const int j) { return Vector<dim, Real>(shifts[j]); };
      neighbours.for_each(
        i, fetch, [&](const int, const Pair<dim, Real> &pair, const Vector<dim, Real> &other) {
          if (pair.tag.kind() != Kind::fluid)
            return;
          common += pair.weight * other;
          weight += pair.weight;
        });
      auto shift = Vector<dim, Real>(shifts[i]);
      if (weight > 0)
        shift -= (1 / weight) * common;
      new_places[i].x = constants.grid.wrapped(new_places[i].x + Real(0.5) * shift);
    }
  };
} // namespace undine::particles

#endif
