// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_even_spacing_h
#define undine_particles_fluid_even_spacing_h

#include <undine/particles/fluid/neighbourhood.h>

namespace undine::particles
{
  /// Moves the fluid of a full domain towards even spacing, and gives its particles the velocities
  /// of the places that they come to (P13): nothing else keeps the volume of particles there, and
  /// nothing that moves the fluid does. After PressureForces, which has moved the particles from
  /// `neighbours` and `motions` to `new_places` and `new_motions`.
  template <int dim, class Real>
  struct EvenSpacing
  {
    Constants<dim, Real>     constants;
    Neighbours<dim, Real>    neighbours;
    Neighbourhood<dim, Real> neighbourhood;
    const Motion<dim, Real> *motions;
    Place<dim, Real>        *new_places;
    Motion<dim, Real>       *new_motions;
    const StepControl       *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      if (control->done() || neighbours.places[i].tag.kind() != Kind::fluid)
        return;
      const auto v      = motions[i].v;
      auto       crowd  = Vector<dim, Real>::zero();
      auto       change = Matrix<dim, Real>::diagonal(0);
      const auto fetch  = [&](const int j) { return motions[j].v; };
      neighbours.for_each(
        i, fetch, [&](const int, const Pair<dim, Real> &pair, const Vector<dim, Real> &other) {
          const auto plain = pair.weight_over_square() * pair.r;
          crowd += plain;
          if (pair.tag.kind() == Kind::fluid)
            change.add_outer_product(Real(1), other - v, plain);
        });
      const Real factor = dim / constants.number_density;
      auto shift = (-constants.shifting * constants.spacing * constants.spacing * factor) * crowd;
      const Real square = norm_square(shift), limit = constants.shifting_limit;
      if (square > limit * limit)
        shift *= limit * inverse_square_root(square);
      new_places[i].x = constants.grid.wrapped(new_places[i].x + shift);
      new_motions[i].v += factor * (change * (neighbourhood.corrections[i].matrix() * shift));
    }
  };
} // namespace undine::particles

#endif
