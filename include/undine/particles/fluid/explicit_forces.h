// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_explicit_forces_h
#define undine_particles_fluid_explicit_forces_h

#include <undine/particles/fluid/inward_directions.h>
#include <undine/particles/model/constants.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// Intermediate velocity and place of the fluid from friction, gravity and collisions (the
  /// source's equations 1-4, with the step that 1 and 3 lack), and the kick that friction and
  /// collisions give to elastic bodies. Friction between two particles is the weighted difference
  /// of their velocities with the fluid's viscosity, collisions are inelastic impacts of particles
  /// that come closer than `collision_distance`: both are equal and opposite. Walls may have
  /// friction by the law of the wall instead, see WallFriction. Positions are (P2).
  template <int dim, class Real>
  struct ExplicitForces
  {
    Constants<dim, Real>     constants;
    Neighbours<dim, Real>    neighbours;
    const Motion<dim, Real> *motions;
    const int               *identities;
    Place<dim, Real>        *new_places;
    Motion<dim, Real>       *new_motions;
    Vector<dim, Real>       *solid_velocities; ///< by identity [m/s]
    StopEntry<dim, Real>     entry;            ///< of fluid into bodies
    const StepControl       *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      Place<dim, Real>  place  = neighbours.places[i];
      Motion<dim, Real> motion = motions[i];
      if (!control->done())
        {
          const Real dt = static_cast<Real>(control->dt);
          if (place.tag.kind() == Kind::fluid)
            {
              const auto force = constants.fluid_acceleration(place.x);
              motion.v += velocity_change(i, place.tag, motion.v, dt) + dt * force;
              if (constants.wall_friction.acts())
                motion.v += friction_of_walls(i, motion.v, dt);
              const Real ahead = (1 - constants.path_weight) * dt;
              place.x          = constants.grid.wrapped(place.x + constants.pressure_place * dt *
                                                           (motion.v - ahead * force));
            }
          else if (place.tag.kind() == Kind::solid)
            solid_velocities[identities[i]] =
              motion.v + velocity_change(i, place.tag, motion.v, dt);
        }
      new_places[i]  = place;
      new_motions[i] = motion;
    }

  private:
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    velocity_change(const int i, const Tag tag, const Vector<dim, Real> &v, const Real dt) const
    {
      const Real density  = constants.density(tag);
      const Real friction = dt * constants.viscosity * 2 * dim /
                            (constants.spread * constants.number_density) *
                            constants.fluid_density / density;
      const Real near_fluid = tag.kind() == Kind::fluid ? constants.fluid_collision_distance
                                                        : constants.collision_distance;
      auto       change     = Vector<dim, Real>::zero();
      const auto fetch      = [&](const int j) { return motions[j].v; };
      neighbours.for_each(
        i, fetch, [&](const int j, const Pair<dim, Real> &pair, const Vector<dim, Real> &other) {
          if (tag.kind() == Kind::solid &&
              (pair.tag.kind() == Kind::solid || pair.tag.kind() == Kind::dummy))
            return; // elasticity and contact act between these
          const Vector<dim, Real> approach = other - v;
          const Real              their    = constants.density(pair.tag);
          change += tag.kind() == Kind::fluid ? entry.of_fluid(i, pair, their, approach)
                                              : entry.of_solid(j, pair, density, approach);
          const bool is_opening = pair.tag.material() == opening_material; // without traction
          if (pair.tag.is_free() || !(constants.wall_friction.acts() || is_opening))
            change += (constants.is_full ? friction * constants.spread * pair.weight_over_square()
                                         : friction * pair.weight) *
                      approach;
          const Real speed = approach * pair.r;
          const Real near  = pair.tag.kind() == Kind::fluid || is_opening
                               ? near_fluid
                               : constants.collision_distance;
          if (pair.square < near * near && speed < 0)
            {
              const Real share = pair.tag.is_free() ? their / (density + their) : Real(1);
              change += ((1 + constants.restitution) * share * speed / pair.square) * pair.r;
            }
        });
      return change;
    }

    /// Walls and obstacles touch the particle with the area 2 V |W|, W = (d / n0) sum w r / r^2
    /// over their particles: the sum of the open virtual faces. Its speed is that of the fluid's
    /// first layer, at half a spacing from the wall; it is not reversed in a sub-step however long.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    friction_of_walls(const int i, const Vector<dim, Real> &v, const Real dt) const
    {
      auto wall = Vector<dim, Real>::zero(), wall_velocity = wall;
      Real weight = 0;
      neighbours.for_each(i, [&](const int j, const Pair<dim, Real> &pair) {
        const bool moves = pair.tag.material() == moving_material;
        if (pair.tag.is_free() || (pair.tag.material() != 0 && !moves))
          return;
        wall += pair.weight_over_square() * pair.r;
        weight += pair.weight;
        if (moves)
          wall_velocity += pair.weight * motions[j].v;
      });
      wall *= dim / constants.number_density;
      const Real square = norm_square(wall);
      if (!(square > 0))
        return wall;
      const auto relative = v - (1 / weight) * wall_velocity;
      const auto along    = relative - ((relative * wall) / square) * wall;
      const Real speed    = square_root(norm_square(along));
      if (!(speed > 0))
        return Vector<dim, Real>::zero();
      const Real u    = constants.wall_friction.friction_velocity(speed, constants.spacing / 2);
      const Real drag = dt * 2 * sqrt(square) * u * u / speed;
      return (-drag / (1 + drag)) * along;
    }
  };
} // namespace undine::particles

#endif
