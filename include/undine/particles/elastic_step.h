// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elastic_step_h
#define undine_particles_elastic_step_h

#include <undine/particles/body_force.h>
#include <undine/particles/contact.h>
#include <undine/particles/elastic_bodies.h>
#include <undine/particles/implicit_elasticity.h>
#include <undine/particles/step_control.h>
#include <undine/particles/sums.h>

namespace undine::particles
{
  /// What a run of ElasticStep is for.
  enum class ElasticRun
  {
    alone,   ///< no fluid: all of elasticity, in explicit steps
    attempt, ///< without the fluid's pressure; tells the pressure equation where bodies want to go
    final    ///< again from the same start, with the acceleration by pressures held constant
  };

  /// Takes the elastic bodies over a sub-step in smaller explicit steps (symplectic Euler), all in
  /// one launch.
  template <int dim, class Real>
  struct ElasticStep
  {
    ElasticRun                 purpose;
    Elasticity<dim, Real>      elasticity;
    Contact<dim, Real>         contact;
    BodyForce<dim, Real>       force;
    Vector<dim, Real>         *x_start;         ///< [m]
    const Vector<dim, Real>   *v_start;         ///< [m/s]
    Vector<dim, Real>         *x_next, *v_next; ///< while others still read x and v
    ImplicitVectors<dim, Real> implicit_vectors;
    const Vector<dim, Real>   *pressure_accelerations; ///< [m/s^2]
    int                        n_bodies;
    Real                      *carried;     ///< of ElasticBodies [Pa]
    Real                       carry_share; ///< of the difference, in a sub-step [1]
    Place<dim, Real>          *places;      ///< of the sorted particles; receives the result
    Motion<dim, Real>         *motions;
    StepControl               *control;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      const int steps = control->elastic_steps;
      if (control->done() || steps == 0)
        return;
      ElasticStep now = *this; // its x, v and x_next, v_next change places
      const Real  h   = static_cast<Real>(control->dt / steps);
      const int   n   = elasticity.bodies.n;
      team.for_each(n, [&](const int i) { now.begin(i); });
      team.sync();
      if (control->elastic_is_implicit)
        now.move_implicitly(team, h);
      else
        for (int step = 0; step < steps; ++step)
          {
            team.for_each(n, [&](const int i) { now.elasticity.deform(i); });
            team.sync();
            team.for_each(n, [&](const int i) { now.move(i, h); });
            team.sync();
            now.swap();
          }
      team.for_each(n, [&](const int i) { end(i, now); });
      if (purpose == ElasticRun::final)
        carry_pressure(team);
    }

  private:
    /// Elasticity takes over the mean pressure of each body little by little: at once, bodies would
    /// swing with their own sound.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    carry_pressure(Team &team) const
    {
      for (int body = 0; body < n_bodies; ++body)
        {
          team.sync();
          const auto sums =
            team.template sum<2>(elasticity.bodies.n, [&](const int i, Sums<2> &add) {
              if (elasticity.bodies.bodies[i] != body)
                return;
              add[0] += motions[contact.where[i]].pressure;
              add[1] += 1;
            });
          if (team.is_first())
            carried[body] += carry_share * (static_cast<Real>(sums[0] / sums[1]) - carried[body]);
        }
    }

    UNDINE_HOST_DEVICE
    ElasticBodies<dim, Real> &
    bodies()
    {
      return elasticity.bodies;
    }

    UNDINE_HOST_DEVICE
    void
    begin(const int i)
    {
      if (purpose == ElasticRun::final)
        bodies().x[i] = x_start[i];
      else
        x_start[i] = bodies().x[i];
      bodies().v[i] = v_start[i];
    }

    UNDINE_HOST_DEVICE
    void
    move(const int i, const Real h)
    {
      auto v = Vector<dim, Real>::zero();
      if (!bodies().held[i])
        v = bodies().v[i] + h * acceleration(i);
      v_next[i] = v;
      x_next[i] = bodies().x[i] + h * v;
    }

    /// One step of backward Euler; what contacts and pressures do is held constant.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    move_implicitly(Team &team, const Real h)
    {
      const int n          = bodies().n;
      elasticity.is_damped = false;
      team.for_each(n, [&](const int i) { elasticity.deform(i); });
      team.sync();
      ImplicitElasticity<dim, Real>{elasticity, implicit_vectors, h}.step(
        team, bodies().v, [&](const int i) { return acceleration(i); });
      team.sync();
      team.for_each(n, [&](const int i) {
        v_next[i] =
          bodies().held[i] ? Vector<dim, Real>::zero() : bodies().v[i] + implicit_vectors.change[i];
        x_next[i] = bodies().x[i] + h * v_next[i];
      });
      team.sync();
      swap();
    }

    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration(const int i) const
    {
      auto result = elasticity.acceleration(i) + contact.acceleration(i) +
                    force.acceleration(elasticity.bodies.x[i]);
      if (purpose == ElasticRun::final)
        result += pressure_accelerations[i];
      return result;
    }

    UNDINE_HOST_DEVICE
    void
    swap()
    {
      auto *const x = bodies().x, *const v = bodies().v;
      bodies().x = contact.bodies.x = x_next;
      bodies().v = contact.bodies.v = v_next;
      x_next                        = x;
      v_next                        = v;
    }

    /// `now` knows where the last x and v are.
    UNDINE_HOST_DEVICE
    void
    end(const int i, ElasticStep &now) const
    {
      const auto x = now.bodies().x[i], v = now.bodies().v[i];
      const int  slot = contact.where[i];
      places[slot].x  = elasticity.grid.wrapped(x);
      if (!elasticity.grid.contains(places[slot].x))
        atomic_or(&control->failures, static_cast<unsigned int>(Failure::outside));
      if (purpose == ElasticRun::attempt)
        {
          // The mean velocity: what matters to the fluid is how far the surface comes, not in which
          // phase of an unresolved vibration it arrives.
          motions[slot].v = static_cast<Real>(1 / control->dt) * (x - x_start[i]);
          return;
        }
      motions[slot].v        = v;
      elasticity.bodies.x[i] = x;
      elasticity.bodies.v[i] = v;
      atomic_maximum(&control->largest_speed, static_cast<float>(sqrt(norm_square(v))));
    }
  };
} // namespace undine::particles

#endif
