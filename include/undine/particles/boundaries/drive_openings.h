// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_boundaries_drive_openings_h
#define undine_particles_boundaries_drive_openings_h

#include <undine/particles/boundaries/open_boundaries.h>

namespace undine::particles
{
  /// Gives the layers behind openings their velocity and pressure (P16). They go along the normal
  /// as fast as the fluid before them, in or out: u = sum W v . e / sum W over the fluid around the
  /// foot of each particle on the plane, W = (1 - r^2 / r_e^2)^2. Particles of one column have the
  /// same foot, so that columns keep their spacing. The pressure is that of the opening, less
  /// rho u^2 / 2 where fluid enters from rest, and in a full domain without what bears the fluid's
  /// weight (P11).
  template <int dim, class Real>
  struct DriveOpenings
  {
    Constants<dim, Real>      constants;
    OpenBoundaries<dim, Real> open;
    const Place<dim, Real>   *places;
    const int                *cell_starts;
    Motion<dim, Real>        *motions;
    const StepControl        *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      const Place<dim, Real> place = places[i];
      if (control->done() || place.tag.material() != opening_material)
        return;
      const auto boundary = open.boundaries[open.of_layers(opening_material, place.x)];
      const int  axis     = boundary.axis;
      auto       foot     = place.x;
      foot[axis]          = boundary.plane;
      Motion<dim, Real> motion{Vector<dim, Real>::zero(), 0};
      motion.v[axis]    = speed_before(foot, axis, motions[i].v[axis]);
      const Real enters = maximum(Real(0), motion.v[axis] * boundary.inward);
      motion.pressure   = boundary.pressure - pressure_at_rest(foot);
      if (boundary.enters_from_rest)
        motion.pressure -= constants.fluid_density * enters * enters / 2;
      motions[i] = motion;
    }

  private:
    /// Of the fluid around `foot` along an axis; `otherwise` if there is none [m/s].
    UNDINE_HOST_DEVICE
    Real
    speed_before(const Vector<dim, Real> &foot, const int axis, const Real otherwise) const
    {
      const Real inverse_square = 1 / (constants.reach * constants.reach);
      Real       sum = 0, weights = 0;
      constants.grid.for_each_run_around(
        foot, [&](const int first_cell, const int end_cell, const Vector<dim, Real> &x) {
          for (int j = cell_starts[first_cell]; j < cell_starts[end_cell]; ++j)
            {
              const Real rest = 1 - norm_square(places[j].x - x) * inverse_square;
              if (places[j].tag.kind() != Kind::fluid || !(rest > 0))
                continue;
              sum += rest * rest * motions[j].v[axis];
              weights += rest * rest;
            }
        });
      return weights > 0 ? sum / weights : otherwise;
    }

    /// [Pa]
    UNDINE_HOST_DEVICE
    Real
    pressure_at_rest(const Vector<dim, Real> &x) const
    {
      return constants.displaced_density * (constants.top_potential - constants.force.potential(x));
    }
  };
} // namespace undine::particles

#endif
