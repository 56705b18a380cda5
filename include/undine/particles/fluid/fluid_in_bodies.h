// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_fluid_in_bodies_h
#define undine_particles_fluid_fluid_in_bodies_h

#include <undine/particles/execution/atomics.h>
#include <undine/particles/model/constants.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// Counts particles of the fluid that are inside of a body: it makes most of their neighbourhood,
  /// and on all sides. Fluid between two bodies is in neither.
  template <int dim, class Real>
  struct CountFluidInBodies
  {
    Constants<dim, Real>  constants;
    Neighbours<dim, Real> neighbours;
    int                  *count;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      if (neighbours.places[i].tag.kind() != Kind::fluid)
        return;
      Tag  body    = neighbours.places[i].tag; // of the nearest particle of a body
      Real nearest = 0, density = 0;
      auto side = Vector<dim, Real>::zero();
      neighbours.for_each(i, [&](const int, const Pair<dim, Real> &pair) {
        if (pair.tag.kind() != Kind::solid || pair.weight <= nearest)
          return;
        nearest = pair.weight;
        body    = pair.tag;
      });
      neighbours.for_each(i, [&](const int, const Pair<dim, Real> &pair) {
        if (pair.tag.kind() != Kind::solid || pair.tag.code != body.code)
          return;
        density += pair.weight;
        side += (pair.weight * pair.inverse_distance) * pair.r;
      });
      const Real one_sided = Real(0.35) * density;
      if (density > Real(0.6) * constants.number_density &&
          norm_square(side) < one_sided * one_sided)
        atomic_add(count, 1);
    }
  };
} // namespace undine::particles

#endif
