// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_forces_h
#define undine_particles_pressure_forces_h

#include <undine/particles/assemble_pressure.h>

namespace undine::particles
{
  /// Gives the particles their pressures, which do not pull.
  template <int dim, class Real>
  struct TakePressures
  {
    const int         *is_unknown;
    const Real        *solution;
    Motion<dim, Real> *motions;
    const StepControl *control;

    UNDINE_HOST_DEVICE void
    operator()(const int i) const
    {
      if (!control->done())
        motions[i].pressure = is_unknown[i] ? maximum(solution[i], Real(0)) : Real(0);
    }
  };


  /// The accelerations by pressure, a_i = -(2 / rho_i) sum_j P_ij a_ij with the pressure at the
  /// middle
  ///     P_ij = (rho_j P_i + rho_i P_j) / (rho_i + rho_j)
  /// that makes both particles of a pair accelerate alike, and virtual faces a_ij by PairForce;
  /// then the correction of velocity and place (the source's equations 8 to 10), and a shift
  /// towards even spacing. For bodies the acceleration is only kept.
  template <int dim, class Real>
  struct PressureForces
  {
    Constants<dim, Real>     constants;
    Neighbours<dim, Real>    neighbours;
    Neighbourhood<dim, Real> neighbourhood;
    VirtualFaces<dim, Real>  faces;
    const Motion<dim, Real> *motions;
    const int               *identities;
    Place<dim, Real>        *new_places;
    Motion<dim, Real>       *new_motions;
    Vector<dim, Real>       *solid_accelerations; ///< by identity [m/s^2]
    StepControl             *control;

    UNDINE_HOST_DEVICE void
    operator()(const int i) const
    {
      Place<dim, Real>  place  = neighbours.places[i];
      Motion<dim, Real> motion = motions[i];
      if (!control->done() && place.tag.is_free())
        {
          auto       shift        = Vector<dim, Real>::zero();
          const auto acceleration = this->acceleration(i, place.tag, motion.pressure, shift);
          if (place.tag.kind() == Kind::solid)
            solid_accelerations[identities[i]] = acceleration;
          else
            {
              const Real dt = static_cast<Real>(control->dt);
              motion.v += dt * acceleration;
              place.x += (dt * dt) * acceleration;
              if (neighbourhood.is_covered[i])
                place.x += limited(shift);
              place.x = constants.grid.wrapped(place.x);
              atomic_maximum(&control->largest_speed,
                             static_cast<float>(sqrt(norm_square(motion.v))));
            }
        }
      new_places[i]  = place;
      new_motions[i] = motion;
    }

  private:
    /// [m/s^2]; also what points away from the neighbours, sum_j w r / r^2 [1/m].
    UNDINE_HOST_DEVICE Vector<dim, Real>
    acceleration(const int i, const Tag tag, const Real P, Vector<dim, Real> &crowd) const
    {
      const auto M = neighbourhood.corrections[i];
      const auto L = faces.potentials != nullptr ? faces.potentials[i] : Vector<dim, Real>::zero();
      const Real density = constants.densities[tag.material()];
      const Real least =
        constants.pair_force == PairForce::minimum ? least_pressure(i, P) : Real(0);
      auto force = Vector<dim, Real>::zero();
      neighbours.for_each(i, [&](const int j, const Pair<dim, Real> &pair) {
        const Vector<dim, Real> plain = (pair.weight / pair.square) * pair.r;
        crowd += plain;
        if (pair.tag.kind() == Kind::dummy)
          return;
        const Real P_j   = motions[j].pressure;
        const Real other = constants.densities[pair.tag.material()];
        const Real twice = 2 * (other * P + density * P_j) / (density + other);
        switch (constants.pair_force)
          {
            case PairForce::balanced:
              {
                const Real k = pressure_coefficient(constants, tag, pair);
                force += twice * faces.closed(M, L, j, k, pair);
                break;
              }
            case PairForce::corrected:
              {
                force += ((twice - 2 * P) * faces.factor) * (M * plain);
                break;
              }
            case PairForce::minimum:
              {
                force += ((P_j - least) * faces.factor) * plain;
                break;
              }
            case PairForce::conserving:
              {
                force += (twice * faces.factor) * plain;
                break;
              }
          }
      });
      return (-1 / density) * force;
    }

    UNDINE_HOST_DEVICE Real
    least_pressure(const int i, Real least) const
    {
      neighbours.for_each(i, [&](const int j, const Pair<dim, Real> &pair) {
        if (pair.tag.kind() != Kind::dummy)
          least = minimum(least, motions[j].pressure);
      });
      return least;
    }

    UNDINE_HOST_DEVICE Vector<dim, Real>
                       limited(const Vector<dim, Real> &crowd) const
    {
      auto shift =
        (-constants.shifting * constants.spacing * constants.spacing * faces.factor) * crowd;
      const Real square = norm_square(shift);
      const Real limit  = constants.shifting_limit;
      if (square > limit * limit)
        shift *= limit * inverse_square_root(square);
      return shift;
    }
  };
} // namespace undine::particles

#endif
